"""Frames as isochronous packets, as a Kinect sends them, with the faults that are asked for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from kinect_v1.modes import StreamMode
from kinect_v1.packets import (
    HEADER_BYTES,
    ByteArray,
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
        self._payloads = self._split(frames[0])
        self._microframe = 0
        self._frame = -1
        self._index = mode.packets // 2  # the first frame after the start is incomplete
        self._sequence = 0
        self._last = _IDLE

    def microframes(self, count: int) -> list[bytes]:
        """Return what the next microframes carry; empty where the bus is idle."""
        sent: list[bytes] = []
        while len(sent) < count:
            idle = self._frame_start() - self._microframe if self._index == 0 else 0
            if idle > 0:
                idle = min(idle, count - len(sent))
                sent += [_IDLE] * idle
                self._microframe += idle
            else:
                sent += self._next_packets(count - len(sent))
        return sent

    def _frame_start(self) -> int:
        return round((self._frame + 0.5) * MICROFRAMES_PER_S / self._mode.fps)

    def _next_packets(self, most: int) -> list[bytes]:
        """Return the next packets of the frame that is being sent."""
        steps = np.arange(min(most, self._mode.packets - self._index))
        run = slice(self._index, self._index + len(steps))
        packets = np.empty((len(steps), HEADER_BYTES + self._mode.kind.payload_bytes), np.uint8)
        packets[:, :HEADER_BYTES] = encode_headers(
            self._flags[run],
            self._sequence + steps,
            self._lengths[run],
            (self._microframe + steps) * _CLOCK_PER_MICROFRAME,
        )
        packets[:, HEADER_BYTES:] = self._payloads[run]
        self._advance(len(steps))
        sent = [
            packet[:length].tobytes()
            for packet, length in zip(packets, self._lengths[run].tolist(), strict=True)
        ]
        return [self._spoil(packet) for packet in sent] if self._faults else sent

    def _advance(self, count: int) -> None:
        self._sequence += count
        self._microframe += count
        self._index += count
        if self._index == self._mode.packets:
            self._index = 0
            self._frame += 1
            self._payloads = self._split(self._frames[self._frame % len(self._frames)])

    def _split(self, frame: bytes) -> ByteArray:
        """Return the payloads of a frame's packets, the last one filled up."""
        shape = (self._mode.packets, self._mode.kind.payload_bytes)
        payloads = np.zeros(shape, np.uint8)
        payloads.reshape(-1)[: len(frame)] = np.frombuffer(frame, np.uint8)
        return payloads

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
