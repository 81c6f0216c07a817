"""What all parts of an open record share."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from sqlalchemy import Connection, func, select

from insole_core.records.audit import AuditLog, Detail
from insole_core.records.author import Author
from insole_core.records.content_store import ContentStore
from insole_core.records.database import Database
from insole_core.records.person_rows import touch_person
from insole_core.records.visit import Visit
from insole_core.records.visit_rows import visit_of

CHANNEL = "insole_studio_records"
"""Where PostgreSQL tells the other stations of a change."""


@dataclass(frozen=True)
class RecordsContext:
    """The database, the large files, and who works with them."""

    database: Database
    contents: ContentStore
    author: Author

    @contextmanager
    def writing(self, person_id: str | None = None) -> Iterator[Connection]:
        """Yield a connection for one transaction that concerns a person, whose row it locks.

        Raises
        ------
        RecordsError
            Whatever goes wrong; then nothing was written.
        """
        with self.database.writing() as connection:
            if person_id is not None:
                touch_person(connection, person_id)
            yield connection

    @contextmanager
    def writing_visit(self, visit_id: str) -> Iterator[tuple[Connection, Visit]]:
        """Yield a connection for one transaction that concerns a visit, and the visit as it is.

        The rows of the visit and its person are locked until the end.

        Raises
        ------
        RecordsError
            Whatever goes wrong, or when there is no such visit; then nothing was written.
        """
        with self.database.writing() as connection:
            touch_person(connection, visit_of(connection, visit_id).person_id)
            yield connection, visit_of(connection, visit_id, locked=True)

    def log(
        self,
        connection: Connection,
        action: str,
        subject_kind: str,
        subject_id: str,
        **details: Detail,
    ) -> None:
        """Write the audit line of a transaction, its last statement, and tell other stations."""
        line = AuditLog.append(connection, self.author, action, subject_kind, subject_id, **details)
        if not self.database.is_sqlite:
            connection.execute(select(func.pg_notify(CHANNEL, str(line.seq))))
