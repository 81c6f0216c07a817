"""What all parts of an open record share."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from sqlalchemy import Connection

from insole_core.records.audit import AuditLog, Detail
from insole_core.records.author import Author, utc_now
from insole_core.records.content_store import ContentStore
from insole_core.records.database import Database, upsert
from insole_core.records.rights import Right, require
from insole_core.records.rows import locked_person, touch_person, visit_of
from insole_core.records.schema import contents
from insole_core.records.visit import Visit


@dataclass(frozen=True)
class RecordsContext:
    """The database, the large files, and who works with them."""

    database: Database
    contents: ContentStore
    author: Author

    @contextmanager
    def reading(self) -> Iterator[Connection]:
        """Yield a connection whose statements all see the same moment.

        Raises
        ------
        NotAllowed
            When the account may not see patients.
        RecordsError
            Whatever else goes wrong.
        """
        with self.database.reading() as connection:
            require(connection, self.author, Right.SEE)
            yield connection

    @contextmanager
    def writing(self, right: Right, person_id: str | None = None) -> Iterator[Connection]:
        """Yield a connection for one transaction that concerns a person, whose row it locks.

        Raises
        ------
        NotAllowed
            When the account does not have the right.
        RecordsError
            Whatever else goes wrong; then nothing was written.
        """
        with self.database.writing() as connection:
            require(connection, self.author, right)
            if person_id is not None:
                touch_person(connection, person_id)
            yield connection

    @contextmanager
    def writing_visit(self, right: Right, visit_id: str) -> Iterator[tuple[Connection, Visit]]:
        """Yield a connection for one transaction that concerns a visit, and the visit as it is.

        The rows of the visit and its person are locked until the end.

        Raises
        ------
        NotAllowed
            When the account does not have the right.
        RecordsError
            Whatever else goes wrong, or when there is no such visit or its person was erased; then
            nothing was written.
        """
        with self.database.writing() as connection:
            require(connection, self.author, right)
            person_id = visit_of(connection, visit_id).person_id
            touch_person(connection, person_id)
            if right is not Right.SEE:
                locked_person(connection, person_id)
            yield connection, visit_of(connection, visit_id, locked=True)

    def log(
        self,
        connection: Connection,
        action: str,
        subject_kind: str,
        subject_id: str,
        **details: Detail,
    ) -> None:
        """Write the audit line of a transaction, its last statement."""
        AuditLog.append(connection, self.author, action, subject_kind, subject_id, **details)

    def log_each(
        self,
        connection: Connection,
        action: str,
        subject_kind: str,
        subject_ids: Sequence[str],
        **details: Detail,
    ) -> None:
        """Do the same as `log` for each of some subjects, at least one."""
        AuditLog.append_each(connection, self.author, action, subject_kind, subject_ids, **details)


def refer_to(connection: Connection, sha256: str, size: int, kind: str) -> None:
    """Write the row of a content that is stored by now, unless there is one.

    Parameters
    ----------
    size
        Bytes.
    kind
        ``mesh``, ``session``, ``file``, …: what to expect in it.
    """
    values = {"sha256": sha256, "size": size, "kind": kind, "created_at": utc_now()}
    upsert(connection, contents, values)


def put_file(store: ContentStore, path: Path) -> tuple[str, int]:
    """Store a file; return its SHA-256 and its size in bytes.

    Raises
    ------
    InputError, OutputError, Unreachable
        As for `ContentStore.put`.
    """
    sha256 = store.put(path)
    return sha256, store.path(sha256).stat().st_size
