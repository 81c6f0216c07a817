"""What goes wrong in a database, as sentences."""

from __future__ import annotations

import sqlite3
from typing import Final

from sqlalchemy.exc import DBAPIError

from insole_core.errors import RecordsError, Unreachable
from insole_core.records.place import RecordsPlace


class DamagedDatabase(RecordsError):  # noqa: N818 - as the other errors of the record
    """The database is damaged; it has to be restored from a backup."""


class FullDatabase(RecordsError):  # noqa: N818
    """The disk of the database is full; nothing was written."""


_DAMAGED: Final = (
    "{place} is damaged; restore the record from a backup, and keep the damaged file until that "
    "has been checked."
)
_FULL: Final = (
    "Nothing was written to {place}: its disk is full, or takes no more from you; free some space "
    "and try again."
)
_BUSY: Final = "{place} is held by another program; wait until that has finished, and try again."
_AWAY: Final = (
    "{place} does not answer ({reason}); check the network, the address and that the database is "
    "running."
)
_NO_RIGHT: Final = "{place} may not be changed by you; ask for the right to write to it."
_REFUSED: Final = (
    "{place} refused what was to be written ({reason}); nothing was changed. Please report this."
)
_NO_LOGIN: Final = (
    "{place} refuses the user or the password of its address; check the address of the database."
)

_OF_SQLITE: Final[dict[int, tuple[type[RecordsError], str]]] = {
    sqlite3.SQLITE_BUSY: (Unreachable, _BUSY),
    sqlite3.SQLITE_LOCKED: (Unreachable, _BUSY),
    sqlite3.SQLITE_CORRUPT: (DamagedDatabase, _DAMAGED),
    sqlite3.SQLITE_NOTADB: (DamagedDatabase, _DAMAGED),
    sqlite3.SQLITE_FULL: (FullDatabase, _FULL),
    sqlite3.SQLITE_READONLY: (RecordsError, _NO_RIGHT),
    sqlite3.SQLITE_PERM: (RecordsError, _NO_RIGHT),
    sqlite3.SQLITE_CANTOPEN: (Unreachable, _AWAY),
    sqlite3.SQLITE_IOERR: (Unreachable, _AWAY),
}
_NOT_WRITTEN: Final = (sqlite3.SQLITE_IOERR_WRITE, sqlite3.SQLITE_IOERR_TRUNCATE)
"""What SQLite says of a full disk where that is not told as such: a quota, a share."""
_OF_POSTGRESQL: Final[dict[str, tuple[type[RecordsError], str]]] = {
    "53100": (FullDatabase, _FULL),
    "53200": (Unreachable, _AWAY),  # out of memory
    "53300": (Unreachable, _BUSY),  # too many connections
    "55P03": (Unreachable, _BUSY),  # a lock is not available
    "40001": (Unreachable, _BUSY),  # serialization failure
    "40P01": (Unreachable, _BUSY),  # deadlock
    "42501": (RecordsError, _NO_RIGHT),
    "25006": (RecordsError, _NO_RIGHT),  # a standby server
    "28000": (RecordsError, _NO_LOGIN),
    "28P01": (RecordsError, _NO_LOGIN),
    "XX001": (DamagedDatabase, _DAMAGED),
    "XX002": (DamagedDatabase, _DAMAGED),
    "58030": (Unreachable, _AWAY),  # the server cannot read or write its disk
}
_AWAY_CLASSES: Final = ("08", "57")
"""Classes of codes for a connection that is lost, and a server that is stopped."""


def described(place: RecordsPlace, error: DBAPIError) -> RecordsError:
    """Return the sentence for an error of a database.

    Parameters
    ----------
    error
        As SQLAlchemy reports it; the values of its statement are patients' data and are not told.
    """
    kind, sentence = _kind_of(place, error)
    if sentence in (_AWAY, _REFUSED):
        return kind(sentence, place=place.name, reason=_first_line(str(error.orig)))
    return kind(sentence, place=place.name)


def away(place: RecordsPlace, reason: str) -> Unreachable:
    """Return the sentence for a database that does not answer."""
    return Unreachable(_AWAY, place=place.name, reason=_first_line(reason))


def _kind_of(place: RecordsPlace, error: DBAPIError) -> tuple[type[RecordsError], str]:
    original = error.orig
    if place.is_local:
        code = getattr(original, "sqlite_errorcode", 0)
        if code in _NOT_WRITTEN:
            return FullDatabase, _FULL
        return _OF_SQLITE.get(code & 0xFF, (RecordsError, _REFUSED))
    state = getattr(original, "sqlstate", None) or ""
    if state in _OF_POSTGRESQL:
        return _OF_POSTGRESQL[state]
    if error.connection_invalidated or not state or state[:2] in _AWAY_CLASSES:
        return Unreachable, _AWAY
    return RecordsError, _REFUSED


def _first_line(text: str) -> str:
    """Return what a database says, without the values that follow on further lines."""
    return text.strip().partition("\n")[0].rpartition("failed: ")[2]
