"""What goes wrong with a camera, a sentence each, which says what to do."""


class RealSenseError(Exception):
    """A camera cannot be used, or stopped working."""


class NoCameraError(RealSenseError):
    """No camera is plugged in, or not the one asked for."""


class LibraryMissingError(RealSenseError):
    """The library of the cameras is not installed."""


class BandwidthError(RealSenseError):
    """The USB controller cannot carry another camera."""
