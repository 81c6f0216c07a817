"""The camera's command channel as pure functions on bytes (PROTOCOL.md, section 2)."""

from __future__ import annotations

import struct
from enum import IntEnum

from kinect_v1.errors import CommandRefusedError, ProtocolError

REQUEST_MAGIC = b"GM"
REPLY_MAGIC = b"RB"
REPLY_BYTES = 512
"""Length that replies are asked with; a reply of just this length means "not yet"."""

_HEADER = struct.Struct("<2sHHH")
HEADER_BYTES = _HEADER.size

CMOS_WRITE = 0x8000
CMOS_SHUTTER = 0x0009
CMOS_FLAGS = 0x0106
AUTO_EXPOSURE = 1 << 14
AUTO_FLICKER = 1 << 7
AUTO_WHITE_BALANCE = 1 << 1
SHUTTER_STEP_US = 54.21

_ERROR_NAMES = {
    1: "unknown error",
    2: "invalid command",
    3: "bad checksum",
    4: "bad packet size",
    5: "bad parameters",
    12: "bad command size",
    13: "not ready",
    14: "overflow",
}


class Opcode(IntEnum):
    """The commands this driver sends."""

    READ_REGISTER = 0x02
    WRITE_REGISTER = 0x03
    FIXED_PARAMETERS = 0x04
    ALGORITHM_PARAMETERS = 0x16
    CMOS = 0x95


class Algorithm(IntEnum):
    """What `Opcode.ALGORITHM_PARAMETERS` can be asked for."""

    CONSTANT_SHIFT = 0x00
    REGISTRATION = 0x40
    PADDING = 0x41


def words(*values: int) -> bytes:
    """Little-endian 16-bit words."""
    return struct.pack(f"<{len(values)}H", *values)


def encode_request(opcode: int, tag: int, payload: bytes) -> bytes:
    """Frame a command; the payload has an even length."""
    return _HEADER.pack(REQUEST_MAGIC, len(payload) // 2, opcode, tag) + payload


def decode_request(request: bytes) -> tuple[int, int, bytes]:
    """Take a command apart: opcode, tag, payload.

    Raises
    ------
    ProtocolError
        When it is not a command.
    """
    if len(request) < HEADER_BYTES:
        raise ProtocolError(f"A command of {len(request)} bytes is too short; resend it.")
    magic, length, opcode, tag = _HEADER.unpack_from(request)
    payload = request[HEADER_BYTES:]
    if magic != REQUEST_MAGIC or length * 2 != len(payload):
        raise ProtocolError("The bytes are not a command of the camera; resend it.")
    return opcode, tag, payload


def encode_reply(opcode: int, tag: int, error: int, data: bytes) -> bytes:
    """Frame a reply: error word, then data."""
    payload = words(error) + data
    return _HEADER.pack(REPLY_MAGIC, len(payload) // 2, opcode, tag) + payload


def is_pending(reply: bytes) -> bool:
    """Tell whether the device says "not yet".

    Nothing, or all 512 bytes: on xHCI controllers a premature read returns a full buffer of
    garbage.
    """
    return len(reply) in (0, REPLY_BYTES)


def answers(reply: bytes) -> tuple[int, int] | None:
    """Opcode and tag of the command that a reply answers; None where it is no reply at all."""
    if len(reply) < HEADER_BYTES or not reply.startswith(REPLY_MAGIC):
        return None
    _magic, _length, opcode, tag = _HEADER.unpack_from(reply)
    return opcode, tag


def decode_reply(reply: bytes, opcode: int, tag: int) -> bytes:
    """Check a reply and give its data, without the error word.

    Raises
    ------
    ProtocolError
        When it is damaged or answers something else.
    CommandRefusedError
        When the device reports an error.
    """
    if len(reply) < HEADER_BYTES + 2:
        raise ProtocolError(_damaged(opcode, f"its reply has only {len(reply)} bytes"))
    magic, length, got_opcode, got_tag = _HEADER.unpack_from(reply)
    if magic != REPLY_MAGIC:
        raise ProtocolError(_damaged(opcode, "its reply does not begin with RB"))
    if got_opcode != opcode or got_tag != tag:
        raise ProtocolError(
            _damaged(opcode, f"it answered command 0x{got_opcode:02x} number {got_tag} instead")
        )
    payload = reply[HEADER_BYTES:]
    if length * 2 != len(payload):
        raise ProtocolError(_damaged(opcode, "the length in its reply is wrong"))
    (error,) = struct.unpack_from("<H", payload)
    if error:
        name = _ERROR_NAMES.get(error, "undocumented error")
        raise CommandRefusedError(
            f"The sensor refused command 0x{opcode:02x} with error {error} ({name}); "
            "unplug the sensor and plug it in again."
        )
    return payload[2:]


def _damaged(opcode: int, reason: str) -> str:
    return (
        f"The sensor's answer to command 0x{opcode:02x} is unusable, {reason}; "
        "unplug the sensor and plug it in again."
    )
