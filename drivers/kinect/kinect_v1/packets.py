"""Isochronous packets: their header, and whole frames of them or none (PROTOCOL.md, section 3)."""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from kinect_v1.errors import KinectError
from kinect_v1.modes import StreamMode

MAGIC = b"RB"
HEADER_BYTES = 12
FIRST, MIDDLE, LAST = 0x1, 0x2, 0x5
_HEADER = np.dtype(
    {
        "names": ("magic", "flag", "sequence", "length", "device_time"),
        "formats": ("S2", "u1", "u1", "<u2", "<u4"),
        "offsets": (0, 3, 5, 6, 8),
        "itemsize": HEADER_BYTES,
    }
)
ByteArray = NDArray[np.uint8]


def packet_flags(mode: StreamMode) -> ByteArray:
    """Return the flags of the packets of a frame, (packets,) uint8."""
    flags = np.full(mode.packets, mode.kind.flag | MIDDLE, np.uint8)
    flags[0], flags[-1] = mode.kind.flag | FIRST, mode.kind.flag | LAST
    return flags


def packet_lengths(mode: StreamMode) -> NDArray[np.uint32]:
    """Return the lengths of header and payload of the packets of a frame, (packets,), bytes."""
    lengths = np.full(mode.packets, HEADER_BYTES + mode.kind.payload_bytes, np.uint32)
    lengths[-1] = HEADER_BYTES + mode.last_payload_bytes
    return lengths


def encode_headers(
    flags: ByteArray,
    sequences: NDArray[np.int64],
    lengths: NDArray[np.uint32],
    device_times: NDArray[np.int64],
) -> ByteArray:
    """Encode the headers of n packets, (n, 12).

    Parameters
    ----------
    flags, sequences, lengths, device_times : (n,)
        Lengths of header and payload, bytes; times by the sensor's clock.
    """
    headers = np.zeros(len(flags), _HEADER)
    headers["magic"] = MAGIC
    headers["flag"] = flags
    headers["sequence"] = sequences & 0xFF
    headers["length"] = lengths
    headers["device_time"] = device_times & 0xFFFFFFFF
    return headers.view(np.uint8).reshape(-1, HEADER_BYTES)


def _headers(buffer: ByteArray, rows: NDArray[np.intp]) -> NDArray[np.void]:
    """Return the headers in some rows of a block, (n,)."""
    return buffer[_span(rows), :HEADER_BYTES].view(_HEADER)[:, 0]


def _span(rows: NDArray[np.intp]) -> slice | NDArray[np.intp]:
    """Return ascending rows as a slice if none is left out: they are copied once, not twice."""
    if not len(rows) or rows[-1] - rows[0] >= len(rows):
        return rows
    return slice(rows[0], rows[-1] + 1)


class PacketBlock(NamedTuple):
    """The packets of one transfer.

    Parameters
    ----------
    buffer : (n, stride) uint8
        Packet i is in row i.
    lengths : (n,) uint32
        Number of valid bytes of each packet; 0 = an idle microframe.
    good : (n,) bool
        False where the host controller reports an error.
    """

    buffer: ByteArray
    lengths: NDArray[np.uint32]
    good: NDArray[np.bool_]

    @classmethod
    def idle(cls, count: int, packet_bytes: int) -> PacketBlock:
        """Return microframes in which nothing was sent.

        Parameters
        ----------
        packet_bytes
            Largest packet of one microframe.
        """
        buffer = np.zeros((count, packet_bytes), np.uint8)
        return cls(buffer, np.zeros(count, np.uint32), np.ones(count, bool))


class PacketReceiver(Protocol):
    """Receives the packets of a stream; called in the event thread, so it must be quick."""

    def receive(self, block: PacketBlock) -> None:
        """Process the packets of one transfer; they are overwritten afterwards."""
        ...

    def end(self, reason: KinectError) -> None:
        """Handle that the stream ended by itself."""
        ...


class PackedFrame(NamedTuple):
    """One undamaged frame, still packed."""

    data: ByteArray
    device_time: int


class FrameAssembler:
    """Assembles the frames of one stream.

    Parameters
    ----------
    mode
        The mode that the stream was started with.

    Attributes
    ----------
    discarded
        Number of frames found damaged.
    lost_packets
        Number of packets missing according to the sequence numbers.
    """

    def __init__(self, mode: StreamMode) -> None:
        self.discarded = 0
        self.lost_packets = 0
        self._mode = mode
        self._flags = packet_flags(mode)
        self._lengths = packet_lengths(mode)
        self._frame = self._new_frame()
        self._index = 0
        self._sequence: int | None = None

    def feed(self, block: PacketBlock) -> list[PackedFrame]:
        """Process the packets of one transfer; return the frames that they complete."""
        rows = np.flatnonzero(block.good & (block.lengths >= HEADER_BYTES))
        headers = _headers(block.buffer, rows)
        genuine = headers["magic"] == MAGIC
        lengths = block.lengths[rows]
        frames: list[PackedFrame] = []
        at = 0
        while at < len(rows):
            if self._sequence is None:
                at = self._find_start(headers, lengths, genuine, at)
                continue
            run = self._count_expected(headers[at:], lengths[at:], genuine[at:])
            self._take(block.buffer, rows[at : at + run], frames)
            at += run
            if at < len(rows):
                self._lose_track(int(headers["sequence"][at]))
        return frames

    def interrupt(self) -> None:
        """Discard the unfinished frame: packets may have been lost without a trace."""
        if self._sequence is not None and self._index:
            self.discarded += 1
        self._sequence = None

    def _new_frame(self) -> ByteArray:
        return np.empty((self._mode.packets, self._mode.kind.payload_bytes), np.uint8)

    def _find_start(
        self,
        headers: NDArray[np.void],
        lengths: NDArray[np.uint32],
        genuine: NDArray[np.bool_],
        at: int,
    ) -> int:
        """Return the index of a frame's first packet from `at` on, or the end."""
        first = genuine[at:] & (headers["flag"][at:] == self._flags[0])
        first &= lengths[at:] == self._lengths[0]
        if not first.any():
            return len(headers)
        at += int(first.argmax())
        self._index = 0
        self._sequence = int(headers["sequence"][at])
        return at

    def _count_expected(
        self, headers: NDArray[np.void], lengths: NDArray[np.uint32], genuine: NDArray[np.bool_]
    ) -> int:
        """Count the packets that follow each other exactly as expected."""
        assert self._sequence is not None
        steps = np.arange(len(headers))
        places = (self._index + steps) % self._mode.packets
        expected = (
            genuine
            & (headers["sequence"] == (self._sequence + steps) & 0xFF)
            & (headers["flag"] == self._flags[places])
            & (lengths == self._lengths[places])
        )
        return len(headers) if expected.all() else int(expected.argmin())

    def _take(self, buffer: ByteArray, rows: NDArray[np.intp], frames: list[PackedFrame]) -> None:
        """Copy valid packets; append the frames that they complete."""
        assert self._sequence is not None
        payload = slice(HEADER_BYTES, HEADER_BYTES + self._mode.kind.payload_bytes)
        self._sequence = (self._sequence + len(rows)) & 0xFF
        while len(rows):
            part = rows[: self._mode.packets - self._index]
            self._frame[self._index : self._index + len(part)] = buffer[_span(part), payload]
            self._index += len(part)
            rows = rows[len(part) :]
            if self._index == self._mode.packets:
                time = int(_headers(buffer, part[-1:])["device_time"][0])
                data = self._frame.reshape(-1)[: self._mode.frame_bytes]
                frames.append(PackedFrame(data, time))
                self._frame = self._new_frame()
                self._index = 0

    def _lose_track(self, sequence: int) -> None:
        """Discard what the anomaly before the packet numbered `sequence` has damaged."""
        assert self._sequence is not None
        gap = (sequence - self._sequence) & 0xFF
        lost = gap if gap < 0x80 else 0  # a larger gap is a repeated or late packet, not a loss
        self.lost_packets += lost
        self.discarded += max(1, -(-(self._index + lost) // self._mode.packets))
        self._sequence = None
