"""What the files of a database still hold of somebody who was erased from its tables."""

from __future__ import annotations

import logging
import sqlite3
from contextlib import closing

from sqlalchemy import Connection, Engine, delete, select, text
from sqlalchemy.exc import DBAPIError

from insole_core.records.clinic import ERASING, write_setting
from insole_core.records.database import Database
from insole_core.records.migrate import forget_copies
from insole_core.records.schema import clinic, persons, tables_of_persons

log = logging.getLogger(__name__)


def note_erasing(connection: Connection, person_id: str) -> None:
    """Note, in the transaction that erases a person, that the files are still to follow."""
    write_setting(connection, f"{ERASING}{person_id}", True)


def finish_erasing(database: Database) -> None:
    """Let the files follow of all who are noted, also after a crash; nobody may be noted.

    Raises
    ------
    RecordsError, OutputError
        When that is impossible now; the notes stay.
    """
    with database.reading() as connection:
        query = select(clinic.c.key).where(clinic.c.key.startswith(ERASING))
        noted = connection.execute(query).scalars().all()
    if not noted:
        return
    forget_copies(database)
    if not _forget_deleted(database):
        return
    with database.writing() as connection:
        connection.execute(delete(clinic).where(clinic.c.key.in_(noted)))


def _forget_deleted(database: Database) -> bool:
    """Write the database anew without what was deleted, as far as it lets this program do that.

    A local file is written anew as a whole, with its journal: what somebody has changed long ago
    is still in free pages. A server writes the tables of persons anew; its journal is its own. What
    another program keeps from that is told in the log, and the erasure holds all the same.

    Returns
    -------
    bool
        False where another program has kept it from that; the next opening tries again.
    """
    try:
        if database.is_sqlite:
            _rewrite_file(database.engine)
        else:
            _rewrite_tables(database.engine)
    except (DBAPIError, sqlite3.Error) as error:
        log.warning("deleted text may still be in files of the database: %s", error)
        return False
    return True


def _rewrite_file(engine: Engine) -> None:
    with closing(engine.raw_connection()) as unbegun:
        cursor = unbegun.cursor()
        cursor.execute("VACUUM")
        cursor.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        answer = cursor.fetchone()
    if answer is not None and answer[0]:  # busy
        log.warning("the journal of the database is still read, and goes when it is closed")


def _rewrite_tables(engine: Engine) -> None:
    with engine.connect() as connection:
        unbegun = connection.execution_options(isolation_level="AUTOCOMMIT")
        for table in (persons, *tables_of_persons()):
            unbegun.execute(text(f"VACUUM FULL {table.name}"))
