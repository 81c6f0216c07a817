"""What can go wrong on request."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

FaultKind = Literal[
    "lost",  # the packet does not come
    "packet magic",  # its first bytes are wrong
    "flag",  # its flag is wrong
    "short",  # it ends early
    "sequence",  # its number is not counted up
    "repeated",  # it comes in place of the next one too
    "no reply",  # the command is never answered
    "full reply",  # 512 bytes of garbage come before the reply
    "stall",  # the request is refused
    "error word",  # the reply holds an error
    "reply tag",  # the reply answers another command
    "no bandwidth",  # the controller refuses the stream
]
Where = Literal["command", "depth", "video"]


@dataclass(frozen=True)
class Fault:
    """Something that goes wrong.

    Parameters
    ----------
    kind
    where
        On the command channel, or on one of the two streams.
    at
        How many commands, packets, or (for "no bandwidth") starts pass before it, from when it is
        injected.
    count
        How many it strikes.
    """

    kind: FaultKind
    where: Where = "command"
    at: int = 0
    count: int = 1


class FaultPlan:
    """The faults of one command channel or stream, counted as things pass."""

    def __init__(self) -> None:
        self._faults: list[tuple[int, int, FaultKind]] = []
        self._passed = 0

    def inject(self, fault: Fault) -> None:
        """Let a fault happen from now on."""
        start = self._passed + fault.at
        self._faults.append((start, start + fault.count, fault.kind))

    def step(self) -> set[FaultKind]:
        """Let one thing pass; tell what strikes it."""
        struck = {kind for start, stop, kind in self._faults if start <= self._passed < stop}
        self._passed += 1
        return struck

    def __bool__(self) -> bool:
        return any(stop > self._passed for _, stop, _ in self._faults)
