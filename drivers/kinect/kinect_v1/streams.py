"""A running stream: whole frames as arrays, counted, with a watchdog."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray

from kinect_v1.errors import KinectError, NoFramesError
from kinect_v1.modes import StreamMode
from kinect_v1.packets import FrameAssembler, PackedFrame, PacketBlock
from kinect_v1.pixels import decode_image

WATCHDOG_S = 1.0
_LONGEST_GAP_S = 1.0
"""Sequence numbers have 8 bits; after a longer silence they are ambiguous."""
_KEPT_FRAMES = 32


@dataclass(frozen=True, eq=False)
class Frame:
    """One undamaged image.

    Parameters
    ----------
    image : (height, width)
        Depth: uint16 raw numbers, 2047 = no reading. Infrared: uint16, 10 bits. Colour: uint8,
        the Bayer mosaic; see `kinect_v1.pixels.demosaic`.
    mode
        The mode that the stream was started with.
    number
        Index among the stream's delivered frames, from 0.
    device_time
        The sensor's own clock, about 60 MHz, 32 bits; it wraps.
    host_time_s
        `time.monotonic()` at the arrival of the last packet; pairs depth with colour.
    discarded
        Damaged frames discarded so far.
    """

    image: NDArray[Any]
    mode: StreamMode
    number: int
    device_time: int
    host_time_s: float
    discarded: int


@dataclass(frozen=True)
class StreamCounts:
    """The counters of a stream.

    Parameters
    ----------
    frames
        Delivered frames.
    discarded
        Frames damaged in transit, never delivered.
    overrun
        Frames delivered, but not fetched in time by `Stream.read`.
    """

    frames: int
    discarded: int
    lost_packets: int
    overrun: int


Deliver = Callable[[Frame], None]


class Stream:
    """Receives the packets of one endpoint and delivers frames.

    Parameters
    ----------
    deliver
        Called with every frame, in the thread that handles USB events: it must be quick, and must
        not stop the stream. Without it frames are kept for `read`.
    watchdog_s
        The longest silence that is not an error.
    """

    def __init__(
        self, mode: StreamMode, deliver: Deliver | None = None, watchdog_s: float = WATCHDOG_S
    ) -> None:
        self.mode = mode
        self._deliver = deliver or self._keep
        self._watchdog_s = watchdog_s
        self._assembler = FrameAssembler(mode)
        self._kept: deque[Frame] = deque()
        self._changed = threading.Condition()
        self._failure: BaseException | None = None
        self._frames = self._overrun = 0
        self._last_frame_s = self._last_block_s = time.monotonic()

    @property
    def counts(self) -> StreamCounts:
        """Return the frames delivered and lost so far."""
        assembler = self._assembler
        return StreamCounts(
            self._frames, assembler.discarded, assembler.lost_packets, self._overrun
        )

    def receive(self, block: PacketBlock) -> None:
        """Process the packets of one transfer; called by the USB side."""
        now = time.monotonic()
        if now - self._last_block_s > _LONGEST_GAP_S:
            self._assembler.interrupt()
        self._last_block_s = now
        if self._failure is not None:
            return
        try:
            for packed in self._assembler.feed(block):
                self._pass_on(packed, now)
        except Exception as error:  # noqa: BLE001 - raised again by read and check
            self.end(error)

    def end(self, reason: BaseException) -> None:
        """Note why no more frames will arrive; called by the USB side."""
        with self._changed:
            self._failure = self._failure or reason
            self._changed.notify_all()

    def check(self) -> None:
        """Raise the stream's error, if there is one.

        Raises
        ------
        UnpluggedError
            The device is gone.
        NoFramesError
            No frame for longer than the watchdog allows.
        """
        if self._failure is not None:
            raise self._failure
        silence_s = time.monotonic() - self._last_frame_s
        if silence_s > self._watchdog_s:
            raise self._silent(silence_s)

    def read(self, timeout_s: float | None = None) -> Frame:
        """Wait for the next frame.

        Parameters
        ----------
        timeout_s
            By default the watchdog's time.

        Raises
        ------
        UnpluggedError, NoFramesError
        """
        limit_s = self._watchdog_s if timeout_s is None else timeout_s
        with self._changed:
            self._changed.wait_for(lambda: self._kept or self._failure, limit_s)
            if self._kept:
                return self._kept.popleft()
            if self._failure is not None:
                raise self._failure
        raise self._silent(limit_s)

    def read_latest(self) -> Frame:
        """Like `read`, but skip frames that arrived in between."""
        frame = self.read()
        with self._changed:
            if self._kept:
                frame = self._kept[-1]
                self._kept.clear()
        return frame

    def poll(self) -> Frame | None:
        """Return the next frame if one is waiting, else None."""
        with self._changed:
            return self._kept.popleft() if self._kept else None

    def _pass_on(self, packed: PackedFrame, now: float) -> None:
        image = decode_image(packed.data, self.mode)
        frame = Frame(
            image, self.mode, self._frames, packed.device_time, now, self._assembler.discarded
        )
        self._frames += 1
        self._last_frame_s = now
        self._deliver(frame)

    def _keep(self, frame: Frame) -> None:
        with self._changed:
            if len(self._kept) == _KEPT_FRAMES:
                self._kept.popleft()
                self._overrun += 1
            self._kept.append(frame)
            self._changed.notify_all()

    def _silent(self, silence_s: float) -> KinectError:
        reason = "they arrive damaged" if self._assembler.discarded else "none arrives"
        return NoFramesError(
            f"The sensor has sent no usable {self.mode.kind.name} picture for {silence_s:.1f} s "
            f"({reason}); check its power supply and plug it into a USB controller of its own."
        )
