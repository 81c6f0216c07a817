"""What the calibrate panel shows, as values."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class StepRow:
    """One step in the list: its title, when it was done, whether it is open or next."""

    key: str
    title: str
    done: str = ""
    open: bool = False


@dataclass(frozen=True)
class LookRow:
    """One picture or wall: its name, whether it can be used, and what it shows."""

    name: str
    usable: bool
    sentence: str


@dataclass(frozen=True)
class BoardSize:
    """The board in use: inner corners and side of a square."""

    columns: int = 10
    rows: int = 7
    square_mm: float = 25.0


@dataclass(frozen=True)
class Buttons:
    """Which buttons can be pressed."""

    choose: bool = False
    calibrate: bool = False
    save: bool = False


@dataclass(frozen=True)
class LiveRow:
    """The live picture: whether it runs, what it shows, whether a picture can be taken."""

    running: bool = False
    sentence: str = ""
    can_take: bool = False
