"""Frames as isochronous packets, as a Kinect sends them, with the faults that are asked for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from kinect_v1.modes import StreamMode
from kinect_v1.packets import (
    HEADER_BYTES,
    ByteArray,
    PacketBlock,
    encode_headers,
    packet_flags,
    packet_lengths,
)

FaultKind = Literal[
    "lost",  # the packet is lost
    "packet magic",  # its first bytes are wrong
    "flag",  # its flag is wrong
    "short",  # it ends early
    "sequence",  # its number is not incremented
    "repeated",  # it also replaces the next packet
    "no reply",  # the command is never answered
    "full reply",  # 512 bytes of garbage precede the reply
    "stall",  # the request is refused
    "error word",  # the reply contains an error
    "reply tag",  # the reply answers another command
    "no bandwidth",  # the controller refuses the stream
]
Where = Literal["command", "depth", "video"]
MICROFRAMES_PER_S = 8000
_CLOCK_PER_MICROFRAME = 7500
"""The device's clock runs at about 60 MHz."""
_IDLE = b""


@dataclass(frozen=True)
class Fault:
    """A fault to be produced.

    Parameters
    ----------
    where
        On the command channel, or on one of the two streams.
    at
        How many commands, packets, or (for "no bandwidth") starts pass between injection and
        fault.
    count
        How many of them it affects.
    """

    kind: FaultKind
    where: Where = "command"
    at: int = 0
    count: int = 1


class FaultPlan:
    """The pending faults of one command channel or stream."""

    def __init__(self) -> None:
        self._faults: list[tuple[int, int, FaultKind]] = []
        self._passed = 0

    def inject(self, fault: Fault) -> None:
        """Let a fault happen from now on."""
        start = self._passed + fault.at
        self._faults.append((start, start + fault.count, fault.kind))

    def step(self) -> set[FaultKind]:
        """Count one command, packet or start; return the faults that affect it."""
        struck = {kind for start, stop, kind in self._faults if start <= self._passed < stop}
        self._passed += 1
        return struck

    def __bool__(self) -> bool:
        return any(stop > self._passed for _, stop, _ in self._faults)


class PacketSource:
    """The packets of one running stream, microframe by microframe.

    Parameters
    ----------
    frames
        Packed frames, played in a loop.
    """

    def __init__(self, mode: StreamMode, frames: Sequence[bytes], faults: FaultPlan) -> None:
        self._mode = mode
        self._frames = frames
        self._faults = faults
        self._flags = packet_flags(mode)
        self._lengths = packet_lengths(mode)
        self._begin(frames[0])
        self._microframe = 0
        self._frame = -1
        self._index = mode.packets // 2  # the first frame after the start is incomplete
        self._sequence = 0
        self._last = _IDLE

    def microframes(self, count: int) -> list[bytes]:
        """Return what the next microframes carry; empty where the bus is idle."""
        block = self.block(count, HEADER_BYTES + self._mode.kind.payload_bytes)
        lengths = block.lengths.tolist()
        return [row[:length].tobytes() for row, length in zip(block.buffer, lengths, strict=True)]

    def block(self, count: int, packet_bytes: int) -> PacketBlock:
        """Return what the next microframes carry, as a transfer.

        Parameters
        ----------
        packet_bytes
            Largest packet of one microframe.
        """
        block = PacketBlock.idle(count, packet_bytes)
        at = 0
        while at < count:
            pause = self._frame_start() - self._microframe if self._index == 0 else 0
            if pause > 0:
                run = min(pause, count - at)
                self._microframe += run
            else:
                run = self._send(block.buffer[at:], block.lengths[at:])
            at += run
        return block

    def _frame_start(self) -> int:
        return round((self._frame + 0.5) * MICROFRAMES_PER_S / self._mode.fps)

    def _send(self, rows: ByteArray, lengths: NDArray[np.uint32]) -> int:
        """Write the next packets of the frame that is being sent; return how many."""
        rest = self._payloads[self._index :] if self._index < len(self._payloads) else self._end
        payloads = rest[: len(rows)]
        count = len(payloads)
        steps = np.arange(count)
        run = slice(self._index, self._index + count)
        rows[:count, :HEADER_BYTES] = encode_headers(
            self._flags[run],
            self._sequence + steps,
            self._lengths[run],
            (self._microframe + steps) * _CLOCK_PER_MICROFRAME,
        )
        rows[:count, HEADER_BYTES : HEADER_BYTES + payloads.shape[1]] = payloads
        lengths[:count] = self._lengths[run]
        if self._faults:
            self._spoil_rows(rows[:count], lengths[:count])
        self._advance(count)
        return count

    def _advance(self, count: int) -> None:
        self._sequence += count
        self._microframe += count
        self._index += count
        if self._index == self._mode.packets:
            self._index = 0
            self._frame += 1
            self._begin(self._frames[self._frame % len(self._frames)])

    def _begin(self, frame: bytes) -> None:
        """Take the payloads of a frame's packets, of which the last one is shorter."""
        size = self._mode.kind.payload_bytes
        whole = self._mode.packets - 1
        payloads = np.frombuffer(frame, np.uint8)
        self._payloads = payloads[: whole * size].reshape(whole, size)
        self._end = payloads[np.newaxis, whole * size :]

    def _spoil_rows(self, rows: ByteArray, lengths: NDArray[np.uint32]) -> None:
        for index, length in enumerate(lengths.tolist()):
            packet = self._spoil(rows[index, :length].tobytes())
            rows[index, : len(packet)] = np.frombuffer(packet, np.uint8)
            lengths[index] = len(packet)

    def _spoil(self, packet: bytes) -> bytes:
        """Apply the faults that are due."""
        struck = self._faults.step()
        if "packet magic" in struck:
            packet = b"XX" + packet[2:]
        if "flag" in struck:
            packet = packet[:3] + bytes((packet[3] ^ 0x0F,)) + packet[4:]
        if "short" in struck:
            packet = packet[: (len(packet) + HEADER_BYTES) // 2]
        if "sequence" in struck:
            packet = packet[:5] + b"\0" + packet[6:]
        if "repeated" in struck and self._last:
            packet = self._last
        self._last = packet
        return _IDLE if "lost" in struck else packet
