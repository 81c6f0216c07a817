"""The stream modes: image format on the wire, and how they are switched on and off."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, IntEnum


class Register(IntEnum):
    """The camera parameters that this driver reads or writes."""

    VIDEO_STREAM = 0x05
    DEPTH_STREAM = 0x06
    IMAGE_FORMAT = 0x0C
    IMAGE_RESOLUTION = 0x0D
    IMAGE_FPS = 0x0E
    DEPTH_FORMAT = 0x12
    DEPTH_RESOLUTION = 0x13
    DEPTH_FPS = 0x14
    SENSOR_GAIN = 0x15
    DEPTH_MIRROR = 0x17
    IR_FORMAT = 0x19
    IR_RESOLUTION = 0x1A
    IR_FPS = 0x1B
    IMAGE_MIRROR = 0x47
    IR_MIRROR = 0x48
    PROJECTOR_CYCLE = 0x105
    NEAR_RANGE = 0x2EF


STREAM_OFF = 0
VIDEO_COLOR = 1
VIDEO_IR = 3
DEPTH_ON = 2

RegisterWrite = tuple[Register, int]


@dataclass(frozen=True)
class StreamKind:
    """One of the two isochronous endpoints.

    Parameters
    ----------
    endpoint
        Its address.
    flag
        High nibble of the packet flag.
    payload_bytes
        Payload of every packet but a frame's last.
    switch
        The register that turns the stream on and off.
    """

    name: str
    endpoint: int
    flag: int
    payload_bytes: int
    switch: Register


DEPTH = StreamKind("depth", 0x82, 0x70, 1748, Register.DEPTH_STREAM)
VIDEO = StreamKind("video", 0x81, 0x80, 1908, Register.VIDEO_STREAM)


class PixelFormat(Enum):
    """The meaning of an image's numbers."""

    DEPTH = "depth"
    BAYER = "bayer"
    IR = "ir"


@dataclass(frozen=True)
class StreamMode:
    """An image format of one stream.

    Parameters
    ----------
    width, height
        Image size, px.
    bits
        Bits per pixel, packed most significant bit first.
    fps
        Nominal frame rate.
    start
        Register writes that switch the mode on, in order.
    """

    name: str
    kind: StreamKind
    pixels: PixelFormat
    width: int
    height: int
    bits: int
    fps: float
    start: tuple[RegisterWrite, ...]

    @property
    def frame_bytes(self) -> int:
        """Size of one packed frame."""
        return self.width * self.height * self.bits // 8

    @property
    def packets(self) -> int:
        """Number of packets per frame."""
        return -(-self.frame_bytes // self.kind.payload_bytes)

    @property
    def last_payload_bytes(self) -> int:
        """Payload of a frame's last packet."""
        return self.frame_bytes - (self.packets - 1) * self.kind.payload_bytes


def _depth_mode(name: str, bits: int, wire_format: int) -> StreamMode:
    start = (
        (Register.PROJECTOR_CYCLE, 0),
        (Register.DEPTH_STREAM, STREAM_OFF),
        (Register.DEPTH_FORMAT, wire_format),
        (Register.DEPTH_RESOLUTION, 1),
        (Register.DEPTH_FPS, 30),
        (Register.DEPTH_STREAM, DEPTH_ON),
        (Register.DEPTH_MIRROR, 0),
    )
    return StreamMode(name, DEPTH, PixelFormat.DEPTH, 640, 480, bits, 30, start)


def _bayer_mode(name: str, size: tuple[int, int], resolution: int, asked_fps: int) -> StreamMode:
    start = (
        (Register.IMAGE_FORMAT, 0),
        (Register.IMAGE_RESOLUTION, resolution),
        (Register.IMAGE_FPS, asked_fps),
        (Register.VIDEO_STREAM, VIDEO_COLOR),
        (Register.IMAGE_MIRROR, 0),
    )
    fps = 30 if asked_fps == 30 else 10
    return StreamMode(name, VIDEO, PixelFormat.BAYER, *size, 8, fps, start)


_WAKE_IR_SENSOR = (
    (Register.DEPTH_RESOLUTION, 1),
    (Register.DEPTH_FPS, 30),
    (Register.DEPTH_STREAM, DEPTH_ON),
    (Register.DEPTH_STREAM, STREAM_OFF),
)
"""Without it the large infrared image does not start, so the depth stream must be off."""


def _ir_mode(
    name: str, size: tuple[int, int], resolution: int, before: tuple[RegisterWrite, ...]
) -> StreamMode:
    asked_fps = 30 if resolution == 1 else 15
    start = (
        *before,
        (Register.IR_FORMAT, 0),
        (Register.IR_RESOLUTION, resolution),
        (Register.IR_FPS, asked_fps),
        (Register.PROJECTOR_CYCLE, 0),
        (Register.VIDEO_STREAM, VIDEO_IR),
        (Register.IR_MIRROR, 0),
    )
    fps = 30 if resolution == 1 else 9
    return StreamMode(name, VIDEO, PixelFormat.IR, *size, 10, fps, start)


DEPTH_11 = _depth_mode("depth-11", bits=11, wire_format=3)
DEPTH_10 = _depth_mode("depth-10", bits=10, wire_format=2)
BAYER_640 = _bayer_mode("bayer-640x480", (640, 480), resolution=1, asked_fps=30)
BAYER_1280 = _bayer_mode("bayer-1280x1024", (1280, 1024), resolution=2, asked_fps=15)
IR_640 = _ir_mode("ir-640x488", (640, 488), resolution=1, before=())
IR_1280 = _ir_mode("ir-1280x1024", (1280, 1024), resolution=2, before=_WAKE_IR_SENSOR)

MODES = {mode.name: mode for mode in (DEPTH_11, DEPTH_10, BAYER_640, BAYER_1280, IR_640, IR_1280)}


def mode_from_registers(kind: StreamKind, registers: dict[int, int]) -> StreamMode | None:
    """Return the mode that a camera's registers select; None if the stream is off.

    Parameters
    ----------
    registers
        Register values by address.
    """
    switch = registers.get(kind.switch, STREAM_OFF)
    if switch == STREAM_OFF:
        return None
    if kind is DEPTH:
        return DEPTH_11 if registers.get(Register.DEPTH_FORMAT) == 3 else DEPTH_10
    if switch == VIDEO_IR:
        return IR_1280 if registers.get(Register.IR_RESOLUTION) == 2 else IR_640
    return BAYER_1280 if registers.get(Register.IMAGE_RESOLUTION) == 2 else BAYER_640
