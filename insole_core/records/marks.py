"""What a column of the record holds: declared once, on the column, and followed by general code.

Erasure (`erasure`), merging (`merging`) and verification (`row_seals`) go by these marks. A test
walks every column: one without a mark, or one that stays without a reason, fails it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum, auto
from typing import TYPE_CHECKING, Any, Final, TypeAlias

if TYPE_CHECKING:  # the window knows marks before it loads the database
    from sqlalchemy import Column


class Erased(Enum):
    """What becomes of a column when its person is erased."""

    KEPT = auto()
    """It stays, for the reason that the mark gives."""
    CHECKED = auto()
    """It stays for that reason, unless it holds a word of the person's name."""
    EMPTIED = auto()
    PSEUDONYM = auto()
    """The pseudonym takes its place."""
    DOCUMENT = auto()
    """A prescription stays without names, notes and places of files."""
    FILE_NAME = auto()
    """A neutral name takes its place."""
    FILE = auto()
    """The file stays without any text in it, or goes where it has no other use."""
    REMOVED = auto()
    """Its row goes: what it holds shows the person, and documents no device."""


class Merged(Enum):
    """What becomes of a column of the person who is merged into another one."""

    OWN = auto()
    """Each row keeps its own value."""
    FILLED = auto()
    """It is taken where the person that is kept has none."""


@dataclass(frozen=True)
class Mark:
    """What general code has to know of a column.

    Parameters
    ----------
    why
        Reason why the column is kept; empty for one that is not.
    is_sealed
        Whether the audit log keeps a digest of it, by which a change behind its back is found.
    """

    erased: Erased
    why: str = ""
    merged: Merged = Merged.OWN
    is_sealed: bool = True


Info: TypeAlias = dict[Any, Any]
"""The `info` of a column or a table: its mark."""


def kept(why: str, *, is_sealed: bool = True) -> Info:
    """Mark a column that stays when a person is erased, for a reason."""
    return {"mark": Mark(Erased.KEPT, why, is_sealed=is_sealed)}


def checked(why: str) -> Info:
    """Mark a column that stays for a reason, unless it holds a word of the name."""
    return {"mark": Mark(Erased.CHECKED, why)}


def filled(info: Info) -> Info:
    """Mark a column of persons that a merge takes over where it is empty."""
    return {"mark": replace(info["mark"], merged=Merged.FILLED)}


def unsealed(info: Info) -> Info:
    """Mark a column that changes without a line of the audit log about its row."""
    return {"mark": replace(info["mark"], is_sealed=False)}


def mark_of(column: Column[Any]) -> Mark:
    """Return the mark of a column, or that of its table."""
    info = column.info or column.table.info
    mark: Mark = info["mark"]
    return mark


EMPTIED: Final[Info] = {"mark": Mark(Erased.EMPTIED)}
TAKEN_OVER: Final = filled(EMPTIED)
"""Erased with its person, and taken over by a merge."""
PSEUDONYM: Final[Info] = {"mark": Mark(Erased.PSEUDONYM)}
DOCUMENT: Final[Info] = {"mark": Mark(Erased.DOCUMENT)}
FILE_NAME: Final[Info] = {"mark": Mark(Erased.FILE_NAME)}
FILE: Final[Info] = {"mark": Mark(Erased.FILE)}
REMOVED: Final[Info] = {"mark": Mark(Erased.REMOVED)}

KEY: Final = kept("a key that the program draws or counts")
WHEN: Final = kept("when something was done, by which the time of keeping is told")
BOOKKEEPING: Final = kept("drawn up by the program, and holds no text", is_sealed=False)
STATE: Final = kept("one of a few words of the program")
STAFF: Final = kept("who did it, who is no patient")
DEVICE: Final = kept("documents the device (Regulation (EU) 2017/745, Annex XIII)")
CONTENT: Final = kept("names a file of this program that holds no text")
PSEUDONYM_STAYS: Final = checked("stands for the name of whom the law keeps a device")
MAKER: Final = checked("who made the device")
MEASURED_BY: Final = checked("documents the device: by what it was measured (Annex XIII)")
SCANNED_WHEN: Final = checked("when the scan was made")
SCANNED_HOW: Final = checked("how well the scan was reconstructed")
NOBODY: Final = kept("the table is about no patient")
