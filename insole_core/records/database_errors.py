"""What goes wrong in a database, as sentences."""

from __future__ import annotations

import logging
import re
import sqlite3
from typing import Final

from sqlalchemy.exc import DBAPIError

from insole_core.errors import RecordsError, Unreachable
from insole_core.records.place import RecordsPlace

log = logging.getLogger(__name__)


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
_CROWDED: Final = (
    "{place} takes no more connections at the moment; close windows or programs that use it, or "
    "let whoever looks after the server allow more (max_connections)."
)
_AWAY: Final = (
    "{place} does not answer ({reason}); check the network, the address and that the database is "
    "running."
)
_NO_FILE: Final = (
    "{place} cannot be opened or read ({reason}); check that its disk or share is connected, and "
    "that you may read and write there."
)
_UNREADABLE: Final = (
    "{place} holds something that cannot be read ({reason}), so another program has changed it; "
    "verify the record, and restore it from a backup."
)
_NO_RIGHT: Final = "{place} may not be changed by you; ask for the right to write to it."
_REFUSED: Final = (
    "{place} refused what was to be written ({reason}); nothing was changed. Please report this."
)
_NO_LOGIN: Final = (
    "{place} answers, and refuses the user or the password ({reason}); check the user in the "
    "address of the database, and type its password again or correct PostgreSQL's password file."
)
_NO_PASSWORD: Final = (
    "{place} answers, and asks for a password; type it, or write it into PostgreSQL's password "
    "file."
)
_NO_DATABASE: Final = (
    "{place} answers, and has no such database ({reason}); check the name in the address, or let "
    "whoever looks after the server make it."
)
_NO_TRUST: Final = (
    "{place} answers, but not so that it can be trusted ({reason}); ask whoever looks after the "
    "server for its certificate."
)
_NO_HOST: Final = (
    "{place} names a computer that nobody knows here ({reason}); check the address of the "
    "database, and that this computer is in the network."
)
_TURNED_AWAY: Final = (
    "{place} answers, and does not let this computer in ({reason}); ask whoever looks after the "
    "server."
)

_OF_SQLITE: Final[dict[int, tuple[type[RecordsError], str]]] = {
    sqlite3.SQLITE_BUSY: (Unreachable, _BUSY),
    sqlite3.SQLITE_LOCKED: (Unreachable, _BUSY),
    sqlite3.SQLITE_CORRUPT: (DamagedDatabase, _DAMAGED),
    sqlite3.SQLITE_NOTADB: (DamagedDatabase, _DAMAGED),
    sqlite3.SQLITE_FULL: (FullDatabase, _FULL),
    sqlite3.SQLITE_READONLY: (RecordsError, _NO_RIGHT),
    sqlite3.SQLITE_PERM: (RecordsError, _NO_RIGHT),
    sqlite3.SQLITE_CANTOPEN: (Unreachable, _NO_FILE),
    sqlite3.SQLITE_IOERR: (Unreachable, _NO_FILE),
}
_NOT_WRITTEN: Final = (sqlite3.SQLITE_IOERR_WRITE, sqlite3.SQLITE_IOERR_TRUNCATE)
"""What SQLite says of a full disk where that is not told as such: a quota, a share."""
_OF_POSTGRESQL: Final[dict[str, tuple[type[RecordsError], str]]] = {
    "53100": (FullDatabase, _FULL),
    "53200": (Unreachable, _AWAY),  # out of memory
    "53300": (Unreachable, _CROWDED),  # too many connections
    "55P03": (Unreachable, _BUSY),  # a lock is not available
    "40001": (Unreachable, _BUSY),  # serialization failure
    "40P01": (Unreachable, _BUSY),  # deadlock
    "42501": (RecordsError, _NO_RIGHT),
    "25006": (RecordsError, _NO_RIGHT),  # a standby server
    "XX001": (DamagedDatabase, _DAMAGED),
    "XX002": (DamagedDatabase, _DAMAGED),
    "58030": (Unreachable, _AWAY),  # the server cannot read or write its disk
}
_AWAY_CLASSES: Final = ("08", "57")
"""Classes of codes for a connection that is lost, and a server that is stopped."""
_OF_SERVER: Final = re.compile(r"^\S+:  ")
"""How what a server says begins, after its word for FATAL in any language: it is there."""
_OF_CONNECTING: Final = (
    (re.compile(r"the database system is|terminating connection"), _AWAY),
    (re.compile(r"too many (?:clients|connections)|remaining connection slots"), _CROWDED),
    (re.compile(r"no password supplied"), _NO_PASSWORD),
    (re.compile(r'^\S+:  database ".*" does not exist'), _NO_DATABASE),
    (re.compile(r'authentication failed|^\S+:  role ".*"'), _NO_LOGIN),
    (_OF_SERVER, _TURNED_AWAY),
    (re.compile(r"\bSSL\b|certificate"), _NO_TRUST),
    (re.compile(r"could not translate host name|resolve host|Name or service"), _NO_HOST),
)
"""While it connects, PostgreSQL's library tells no codes, so its words have to do. Work that waits
for the record is tried again after each of these."""


def described(place: RecordsPlace, error: DBAPIError) -> RecordsError:
    """Return the sentence for an error of a database.

    Parameters
    ----------
    error
        As SQLAlchemy reports it; the values of its statement are patients' data and are not told.
    """
    kind, sentence = _kind_of(place, error)
    code = getattr(error.orig, "sqlite_errorname", getattr(error.orig, "sqlstate", None))
    reason = _OF_SERVER.sub("", _first_line(str(error.orig)))
    # Whoever connects sends nothing of a patient; what is said of a statement may quote its values.
    cause = code or f"connecting: {reason}"
    what = sentence.partition("; ")[0].replace("{place}", place.name).replace(" ({reason})", "")
    log.warning("%s (%s)", what, cause)
    if "{reason}" in sentence:
        return kind(sentence, place=place.name, reason=reason)
    return kind(sentence, place=place.name)


def damaged(place: RecordsPlace) -> DamagedDatabase:
    """Return the sentence for a database that is damaged."""
    return DamagedDatabase(_DAMAGED, place=place.name)


def busy(place: RecordsPlace) -> Unreachable:
    """Return the sentence for a database whose connections are all in use."""
    return Unreachable(_BUSY, place=place.name)


def unreadable(place: RecordsPlace, error: Exception) -> RecordsError:
    """Return the error for a value in a table that is none of its kind, such as a date."""
    return RecordsError(_UNREADABLE, place=place.name, reason=_first_line(str(error)))


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
    if not state:
        return Unreachable, _sentence_of_connecting(_first_line(str(original)))
    if error.connection_invalidated or state[:2] in _AWAY_CLASSES:
        return Unreachable, _AWAY
    return RecordsError, _REFUSED


def _sentence_of_connecting(text: str) -> str:
    return next((said for words, said in _OF_CONNECTING if words.search(text)), _AWAY)


def _first_line(text: str) -> str:
    """Return what a database says, without the values that follow on further lines."""
    return text.strip().partition("\n")[0].rpartition("failed: ")[2]
