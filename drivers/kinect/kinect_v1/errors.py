"""What can go wrong with a sensor; every message is one sentence with its remedy."""


class KinectError(Exception):
    """Anything that stops a sensor from doing what was asked."""


class LibusbMissingError(KinectError):
    """No libusb-1.0 on this computer."""


class NoSensorError(KinectError):
    """No sensor, or not the one that was asked for."""


class NoPowerError(NoSensorError):
    """Only the motor answers: the 12 V supply is missing."""


class NoPermissionError(KinectError):
    """The operating system does not let this user open the device."""


class InUseError(KinectError):
    """Another program holds the sensor."""


class UnpluggedError(KinectError):
    """The device left the bus."""


class BandwidthError(KinectError):
    """The USB controller cannot carry another stream."""


class MemoryLimitError(KinectError):
    """The system grants no memory for USB transfers."""


class TransferError(KinectError):
    """A transfer failed, was refused by the device, or timed out."""


class NoAnswerError(TransferError):
    """A transfer timed out."""


class ProtocolError(KinectError):
    """The device answered something that is not the protocol."""


class CommandRefusedError(KinectError):
    """The device answered a command with an error number."""


class NoFramesError(KinectError):
    """A running stream delivers nothing."""


class StoppedError(KinectError):
    """The stream was stopped, so no frame comes any more."""


class UnsupportedError(KinectError):
    """This model, or the present state of the sensor, cannot do what was asked."""


class RecordingError(KinectError):
    """A recording cannot be read or written."""
