"""The header of an isochronous packet (PROTOCOL.md, section 3)."""

from __future__ import annotations

import struct

from kinect_v1.modes import StreamMode

MAGIC = b"RB"
HEADER_BYTES = 12
FIRST, MIDDLE, LAST = 0x1, 0x2, 0x5
_HEADER = struct.Struct("<2sxBxBHI")


def packet_flag(mode: StreamMode, index: int) -> int:
    """Return the flag of packet `index` of a frame.

    Parameters
    ----------
    index
        From 0.
    """
    place = {0: FIRST, mode.packets - 1: LAST}.get(index, MIDDLE)
    return mode.kind.flag | place


def encode_header(flag: int, sequence: int, length: int, device_time: int) -> bytes:
    """Encode the header of one packet.

    Parameters
    ----------
    length
        Of header and payload, bytes.
    device_time
        The sensor's clock.
    """
    return _HEADER.pack(MAGIC, flag, sequence & 0xFF, length, device_time & 0xFFFFFFFF)
