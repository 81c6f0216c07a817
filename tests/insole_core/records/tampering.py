"""What somebody with the password of the database could do."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from sqlalchemy import Connection, text

from insole_core.records.database import Database

_TABLES = ("audit", "audit_head", "prescription_versions")


@contextmanager
def without_triggers(database: Database) -> Iterator[Connection]:
    """Yield a connection of a transaction in which the database refuses no change."""
    with database.writing() as connection:
        if database.is_sqlite:
            query = text("SELECT name FROM sqlite_master WHERE type = 'trigger'")
            for name in connection.execute(query).scalars().all():
                connection.execute(text(f"DROP TRIGGER {name}"))
            yield connection
            return
        for table in _TABLES:
            connection.execute(text(f"ALTER TABLE {table} DISABLE TRIGGER USER"))
        yield connection
        for table in _TABLES:
            connection.execute(text(f"ALTER TABLE {table} ENABLE TRIGGER USER"))
