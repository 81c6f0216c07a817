"""Bring a database to the tables that this program writes."""

from __future__ import annotations

import platform
import re
from collections.abc import Callable
from typing import Final, TypeAlias

from sqlalchemy import Connection, func, inspect, select

from insole_core.errors import RecordsError
from insole_core.records.author import Author
from insole_core.records.database import MIGRATION_LOCK, SCHEMA_COLUMN, SCHEMA_TABLE, Database
from insole_core.records.row_report import seal_everything

SCHEMA: Final = "0006"
"""The newest revision in `migrations/versions`; revisions are numbered."""
_FIRST_SEALED: Final = "0004"
"""From which on the audit log keeps digests of rows."""
PROGRAM: Final = "Insole Studio"
"""Author of what the program does by itself."""
_REVISION: Final = re.compile(r"000[1-9]|00[1-9]\d|0[1-9]\d\d|[1-9]\d{3}")
Keep: TypeAlias = Callable[[Database, Connection, str], None]


def schema_of(connection: Connection) -> str | None:
    """Return the revision of a database; None where it has no tables yet."""
    if not inspect(connection).has_table(SCHEMA_TABLE.name):
        return None
    row = connection.execute(select(SCHEMA_COLUMN)).first()
    return None if row is None else str(row[0])


def check_schema(found: str | None, name: str) -> None:
    """Raise a `RecordsError` if a database comes from a newer program, or from none."""
    if found is None:
        return
    if _REVISION.fullmatch(found) is None:
        raise RecordsError(
            "{place} has tables of which no Insole Studio knows ({found}); name another record, or "
            "restore this one from a backup.",
            place=name,
            found=found,
        )
    if found > SCHEMA:
        raise RecordsError(
            "{place} was made by a newer Insole Studio (tables {found}; this program knows them up "
            "to {newest}); install the newest version.",
            place=name,
            found=found,
            newest=SCHEMA,
        )


def migrate(database: Database, schema: str = SCHEMA, keep: Keep | None = None) -> bool:
    """Make the tables of an empty database, or change those of an older one.

    All is one transaction: an interrupted migration leaves the database as it was, and the next
    start makes it anew. Of two programs that start at once, one migrates, and the other waits.

    Parameters
    ----------
    schema
        Revision to bring it to: an older one only for the rows of an older backup.
    keep
        Called before the tables of an older record are changed, in the same transaction.

    Returns
    -------
    bool
        Whether anything was changed.

    Raises
    ------
    RecordsError
        When the database is newer than this program, or cannot be changed.
    """
    with database.reading() as connection:
        found = schema_of(connection)
    check_schema(found, database.place.name)
    if found == schema:
        return False
    with database.writing() as connection:
        if not database.is_sqlite:
            connection.execute(select(func.pg_advisory_xact_lock(MIGRATION_LOCK)))
        found = schema_of(connection)
        check_schema(found, database.place.name)
        if found is None and database.is_sqlite and inspect(connection).get_table_names():
            raise RecordsError(
                "{place} is the database of another program; name the folder of a record.",
                place=database.place.name,
            )
        if keep is not None and found is not None and found != schema:
            keep(database, connection, found)
        upgrade(connection, schema)
        if found is not None and found < _FIRST_SEALED and schema == SCHEMA:
            seal_everything(connection, Author(PROGRAM, platform.node() or "?"))
    return found != schema


def upgrade(connection: Connection, schema: str) -> None:
    """Bring the tables that a transaction sees to a revision."""
    # Alembic takes half a second to load, and most starts find nothing to migrate.
    from alembic import command
    from alembic.config import Config

    config = Config()
    config.set_main_option("script_location", "insole_core.records:migrations")
    config.attributes["connection"] = connection
    command.upgrade(config, schema)
