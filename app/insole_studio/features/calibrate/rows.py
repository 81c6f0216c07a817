"""Values shown by the calibrate panel."""

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
    """One image or wall: its name, whether it is usable, and what it shows."""

    name: str
    usable: bool
    sentence: str


@dataclass(frozen=True)
class BoardSize:
    """The board in use: number of inner corners and side of a square."""

    columns: int = 10
    rows: int = 7
    square_mm: float = 25.0


@dataclass(frozen=True)
class CalibrateButtons:
    """Why each button is not enabled, a sentence; empty where it is."""

    choose: str
    calibrate: str
    check: str
    save: str
    undo: str


@dataclass(frozen=True)
class LiveRow:
    """The live image: whether it runs, what it shows, why it cannot be captured, if so."""

    running: bool = False
    sentence: str = ""
    why_not_take: str = ""
