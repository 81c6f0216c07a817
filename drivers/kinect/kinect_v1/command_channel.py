"""Commands to a camera, one at a time, with time limits and checked replies."""

from __future__ import annotations

import threading
import time
from typing import Protocol

from kinect_v1 import commands
from kinect_v1.commands import Opcode, words
from kinect_v1.errors import NoAnswerError, ProtocolError, TransferError

_POLL_S = 0.001
COMMAND_LIMIT_S = 2.0
_DRAIN_READS = 8


class ControlPipe(Protocol):
    """Endpoint 0 of a camera."""

    def control_out(self, request: int, value: int = 0, data: bytes = b"") -> None:
        """Send a vendor request."""
        ...

    def control_in(self, request: int, length: int) -> bytes:
        """Request at most `length` bytes."""
        ...


class CommandChannel:
    """Sends commands and waits for their replies.

    Parameters
    ----------
    limit_s
        Longest wait for one reply.
    """

    def __init__(self, pipe: ControlPipe, limit_s: float = COMMAND_LIMIT_S) -> None:
        self._pipe = pipe
        self._limit_s = limit_s
        self._tag = 0
        self._lock = threading.Lock()

    def drain(self) -> None:
        """Discard replies that a killed program left unread."""
        with self._lock:
            for _ in range(_DRAIN_READS):
                try:
                    if commands.is_pending(self._pipe.control_in(0, commands.REPLY_BYTES)):
                        return
                except TransferError:
                    return  # a device with nothing to report may refuse the request

    def send(self, opcode: int, payload: bytes) -> bytes:
        """Carry out one command and return the data of its reply.

        Parameters
        ----------
        opcode
            See `Opcode`.
        payload
            Of even length.

        Returns
        -------
        bytes
            The reply's data without the error word.

        Raises
        ------
        TransferError, ProtocolError, CommandRefusedError, UnpluggedError
        """
        with self._lock:
            tag = self._tag
            self._tag = (tag + 1) & 0xFFFF
            self._pipe.control_out(0, 0, commands.encode_request(opcode, tag, payload))
            return self._await_reply(opcode, tag)

    def read_register(self, register: int) -> int:
        """Read a parameter of the camera."""
        return _word(self.send(Opcode.READ_REGISTER, words(register)), 0, Opcode.READ_REGISTER)

    def write_register(self, register: int, value: int) -> None:
        """Set a parameter of the camera."""
        self.send(Opcode.WRITE_REGISTER, words(register, value))

    def read_cmos(self, register: int) -> int:
        """Read a register of the colour sensor."""
        return _word(self.send(Opcode.CMOS, words(1, register, 0)), 1, Opcode.CMOS)

    def write_cmos(self, register: int, value: int) -> None:
        """Write a register of the colour sensor."""
        self.send(Opcode.CMOS, words(1, register | commands.CMOS_WRITE, value))

    def _await_reply(self, opcode: int, tag: int) -> bytes:
        deadline = time.monotonic() + self._limit_s
        stale = False
        while time.monotonic() < deadline:
            reply = self._read_reply()
            if commands.is_pending(reply):
                time.sleep(_POLL_S)
                continue
            stale = commands.answers(reply) not in (None, (opcode, tag))
            if not stale:
                return commands.decode_reply(reply, opcode, tag)
        if stale:
            raise ProtocolError(
                "The sensor answers other commands than those it was sent; unplug the sensor and "
                "plug it in again."
            )
        raise NoAnswerError(
            f"The sensor does not answer (command 0x{opcode:02x}, {self._limit_s:g} s); unplug "
            "the sensor and plug it in again."
        )

    def _read_reply(self) -> bytes:
        """Read once; return nothing if the device does not answer the request in time."""
        try:
            return self._pipe.control_in(0, commands.REPLY_BYTES)
        except NoAnswerError:
            return b""


def _word(data: bytes, index: int, opcode: int) -> int:
    word = data[2 * index : 2 * index + 2]
    if len(word) < 2:
        raise ProtocolError(
            f"The sensor's answer to command 0x{opcode:02x} is too short; unplug the sensor and "
            "plug it in again."
        )
    return int.from_bytes(word, "little")
