"""The camera's command channel as pure functions on bytes (PROTOCOL.md, section 2)."""

from __future__ import annotations

import struct
from enum import IntEnum

from kinect_v1.errors import CommandRefusedError, ProtocolError

REQUEST_MAGIC = b"GM"
REPLY_MAGIC = b"RB"
REPLY_BYTES = 512
"""Length requested for replies; a reply of exactly this length means "not yet"."""

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
    """Parameter sets that `Opcode.ALGORITHM_PARAMETERS` can request."""

    CONSTANT_SHIFT = 0x00
    REGISTRATION = 0x40
    PADDING = 0x41


def words(*values: int) -> bytes:
    """Return little-endian 16-bit words."""
    return struct.pack(f"<{len(values)}H", *values)


def encode_request(opcode: int, tag: int, payload: bytes) -> bytes:
    """Encode a command; the payload must have an even length.

    Parameters
    ----------
    payload
        Of even length.
    """
    return _HEADER.pack(REQUEST_MAGIC, len(payload) // 2, opcode, tag) + payload


def decode_request(request: bytes) -> tuple[int, int, bytes]:
    """Split a command into opcode, tag and payload.

    Raises
    ------
    ProtocolError
        When `request` is not a command.
    """
    if len(request) < HEADER_BYTES:
        raise ProtocolError(f"A command of {len(request)} bytes is too short; resend it.")
    magic, length, opcode, tag = _HEADER.unpack_from(request)
    payload = request[HEADER_BYTES:]
    if magic != REQUEST_MAGIC or length * 2 != len(payload):
        raise ProtocolError("The bytes are not a command of the camera; resend it.")
    return opcode, tag, payload


def encode_reply(opcode: int, tag: int, error: int, data: bytes) -> bytes:
    """Encode a reply: error word, then data.

    Parameters
    ----------
    tag
        That of the answered command.
    error
        0 for success.
    """
    payload = words(error) + data
    return _HEADER.pack(REPLY_MAGIC, len(payload) // 2, opcode, tag) + payload


def is_pending(reply: bytes) -> bool:
    """Return whether a reply means "not yet".

    It is empty, or all 512 bytes long: on xHCI controllers a premature read returns a full buffer
    of garbage.
    """
    return len(reply) in (0, REPLY_BYTES)


def answers(reply: bytes) -> tuple[int, int] | None:
    """Return opcode and tag of the command that a reply answers; None if it is not a reply."""
    if len(reply) < HEADER_BYTES or not reply.startswith(REPLY_MAGIC):
        return None
    _magic, _length, opcode, tag = _HEADER.unpack_from(reply)
    return opcode, tag


def decode_reply(reply: bytes, opcode: int, tag: int) -> bytes:
    """Check a reply and return its data, without the error word.

    Parameters
    ----------
    opcode, tag
        Of the command that it must answer.

    Raises
    ------
    ProtocolError
        When the reply is damaged or answers another command.
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
