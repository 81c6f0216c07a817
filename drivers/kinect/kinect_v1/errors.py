"""Errors of sensors; every message is one sentence that includes the remedy."""


class KinectError(Exception):
    """A sensor cannot do what was requested."""


class LibusbMissingError(KinectError):
    """This computer has no libusb-1.0."""


class NoSensorError(KinectError):
    """There is no sensor, or not the requested one."""


class NoPowerError(NoSensorError):
    """Only the motor answers: the 12 V supply is missing."""


class NoPermissionError(KinectError):
    """The operating system does not let this user open the device."""


class InUseError(KinectError):
    """Another program holds the sensor."""


class UnpluggedError(KinectError):
    """The device has left the bus."""


class BandwidthError(KinectError):
    """The USB controller cannot carry another stream."""


class MemoryLimitError(KinectError):
    """The system does not grant enough memory for USB transfers."""


class TransferError(KinectError):
    """A transfer failed, was refused by the device, or timed out."""


class NoAnswerError(TransferError):
    """A transfer timed out."""


class ProtocolError(KinectError):
    """The device's answer does not follow the protocol."""


class CommandRefusedError(KinectError):
    """The device answered a command with an error code."""


class NoFramesError(KinectError):
    """A running stream delivers no frames."""


class StoppedError(KinectError):
    """The stream was stopped, so no more frames arrive."""


class UnsupportedError(KinectError):
    """This model, or the sensor in its present state, cannot do what was requested."""


class RecordingError(KinectError):
    """A recording cannot be read or written."""
