"""Frames as isochronous packets, as a Kinect sends them."""

from __future__ import annotations

from collections.abc import Sequence

from kinect_v1.emulation.faults import FaultPlan
from kinect_v1.modes import StreamMode
from kinect_v1.packet_header import HEADER_BYTES, encode_header, packet_flag

MICROFRAMES_PER_S = 8000
_CLOCK_PER_MICROFRAME = 7500
"""The device's clock runs at about 60 MHz."""
_IDLE = b""


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
                sent.append(self._next_packet())
        return sent

    def _frame_start(self) -> int:
        return round((self._frame + 0.5) * MICROFRAMES_PER_S / self._mode.fps)

    def _next_packet(self) -> bytes:
        mode, index = self._mode, self._index
        first_byte = index * mode.kind.payload_bytes
        frame = self._frames[max(self._frame, 0) % len(self._frames)]
        payload = frame[first_byte : first_byte + mode.kind.payload_bytes]
        time = self._microframe * _CLOCK_PER_MICROFRAME
        length = HEADER_BYTES + len(payload)
        header = encode_header(packet_flag(mode, index), self._sequence, length, time)
        self._sequence += 1
        self._microframe += 1
        self._index += 1
        if self._index == mode.packets:
            self._index = 0
            self._frame += 1
        return self._spoil(header + payload) if self._faults else header + payload

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
