"""Commands and replies, byte by byte."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kinect_v1 import commands
from kinect_v1.command_channel import CommandChannel
from kinect_v1.errors import CommandRefusedError, NoAnswerError, ProtocolError, TransferError
from kinect_v1.modes import (
    BAYER_640,
    BAYER_1280,
    DEPTH,
    DEPTH_10,
    DEPTH_11,
    IR_640,
    IR_1280,
    MODES,
    mode_from_registers,
)


class ScriptedPipe:
    """Endpoint 0 that gives prepared replies; `{tag}` is answered by the tag of the request."""

    def __init__(self, *replies: bytes) -> None:
        self.sent: list[bytes] = []
        self.replies = list(replies)

    def control_out(self, request: int, value: int = 0, data: bytes = b"") -> None:
        self.sent.append(data)

    def control_in(self, request: int, length: int) -> bytes:
        reply = self.replies.pop(0) if self.replies else b""
        if reply is HELD_BACK:
            raise NoAnswerError("The device does not answer; plug it in again.")
        return reply


HELD_BACK = b"held back"
"""The device does not answer the request before the host's time runs out."""


def test_a_register_write_on_the_wire() -> None:
    pipe = ScriptedPipe(bytes.fromhex("5242 0100 0300 0000 0000"))
    CommandChannel(pipe).write_register(0x105, 0)
    assert pipe.sent == [bytes.fromhex("474d 0200 0300 0000 0501 0000")]


def test_reading_a_register_and_the_colour_sensor() -> None:
    pipe = ScriptedPipe(
        bytes.fromhex("5242 0200 0200 0000 0000 3412"),
        bytes.fromhex("5242 0300 9500 0100 0000 0601 8240"),
    )
    channel = CommandChannel(pipe)
    assert channel.read_register(0x15) == 0x1234
    assert channel.read_cmos(0x106) == 0x4082
    assert pipe.sent[1] == bytes.fromhex("474d 0300 9500 0100 0100 0601 0000")


def test_tags_count_up_and_wrap() -> None:
    replies = (commands.encode_reply(3, tag & 0xFFFF, 0, b"") for tag in range(0x10001))
    pipe = ScriptedPipe()
    channel = CommandChannel(pipe)
    for reply in replies:
        pipe.replies.append(reply)
        channel.write_register(5, 0)
    assert pipe.sent[-1] == pipe.sent[0]


def test_stale_replies_are_skipped() -> None:
    stale = commands.encode_reply(3, 77, 0, b"")
    pipe = ScriptedPipe(b"", stale, b"\0" * 512, commands.encode_reply(3, 0, 0, b""))
    CommandChannel(pipe).write_register(5, 0)
    assert not pipe.replies


def test_a_reply_may_come_late() -> None:
    late = commands.encode_reply(3, 0, 0, b"")
    pipe = ScriptedPipe(*[b""] * 40, HELD_BACK, b"\xa5" * 512, HELD_BACK, late)
    CommandChannel(pipe).write_register(5, 0)
    assert not pipe.replies


def test_a_stale_reply_with_the_same_number_is_skipped() -> None:
    stale = commands.encode_reply(2, 0, 0, b"")
    pipe = ScriptedPipe(stale, commands.encode_reply(3, 0, 0, b""))
    CommandChannel(pipe).write_register(5, 0)
    assert not pipe.replies


def test_drain_empties_the_pipe() -> None:
    stale = commands.encode_reply(3, 77, 0, b"")
    pipe = ScriptedPipe(stale, stale, b"", b"kept")
    CommandChannel(pipe).drain()
    assert pipe.replies == [b"kept"]


@pytest.mark.parametrize(
    ("reply", "error", "words"),
    [
        (b"RB\x01", ProtocolError, "only 3 bytes"),
        (bytes.fromhex("5842 0100 0300 0000 0000"), ProtocolError, "begin with RB"),
        (bytes.fromhex("5242 0100 0400 0000 0000"), ProtocolError, "other commands"),
        (bytes.fromhex("5242 0200 0300 0000 0000"), ProtocolError, "length"),
        (bytes.fromhex("5242 0100 0300 0000 0500"), CommandRefusedError, "bad parameters"),
        (bytes.fromhex("5242 0100 0300 0000 6300"), CommandRefusedError, "undocumented"),
        (b"", TransferError, "does not answer"),
        (commands.encode_reply(3, 9, 0, b""), ProtocolError, "other commands"),
    ],
)
def test_bad_replies(reply: bytes, error: type[Exception], words: str) -> None:
    with pytest.raises(error, match=words):
        CommandChannel(ScriptedPipe(reply), limit_s=0.02).write_register(5, 0)


def test_a_reply_without_its_value() -> None:
    pipe = ScriptedPipe(commands.encode_reply(2, 0, 0, b""))
    with pytest.raises(ProtocolError, match="too short"):
        CommandChannel(pipe).read_register(5)


@given(st.integers(0, 0xFFFF), st.integers(0, 0xFFFF), st.binary(max_size=1016))
def test_requests_and_replies_round_trip(opcode: int, tag: int, data: bytes) -> None:
    payload = data[: len(data) // 2 * 2]
    request = commands.encode_request(opcode, tag, payload)
    assert commands.decode_request(request) == (opcode, tag, payload)
    reply = commands.encode_reply(opcode, tag, 0, payload)
    assert commands.decode_reply(reply, opcode, tag) == payload
    assert commands.answers(reply) == (opcode, tag)


@given(st.binary(max_size=600))
def test_garbage_is_an_error_of_the_protocol(garbage: bytes) -> None:
    try:
        commands.decode_reply(garbage, 3, 0)
    except (ProtocolError, CommandRefusedError):
        return
    assert garbage[:2] == b"RB"


@pytest.mark.parametrize("request_bytes", [b"GM", b"XM\0\0\3\0\0\0", b"GM\5\0\3\0\0\0"])
def test_what_is_no_command(request_bytes: bytes) -> None:
    with pytest.raises(ProtocolError):
        commands.decode_request(request_bytes)


def test_start_sequences_are_those_of_the_device() -> None:
    expected = {
        DEPTH_11: "105=0 6=0 12=3 13=1 14=1e 6=2 17=0",
        DEPTH_10: "105=0 6=0 12=2 13=1 14=1e 6=2 17=0",
        BAYER_640: "c=0 d=1 e=1e 5=1 47=0",
        BAYER_1280: "c=0 d=2 e=f 5=1 47=0",
        IR_640: "19=0 1a=1 1b=1e 105=0 5=3 48=0",
        IR_1280: "13=1 14=1e 6=2 6=0 19=0 1a=2 1b=f 105=0 5=3 48=0",
    }
    for mode, sequence in expected.items():
        assert " ".join(f"{reg:x}={value:x}" for reg, value in mode.start) == sequence


def test_registers_tell_the_mode() -> None:
    for mode in MODES.values():
        assert mode_from_registers(mode.kind, dict(mode.start)) is mode
    assert mode_from_registers(DEPTH, {}) is None
