"""Faults that the emulated device produces on request."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

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
