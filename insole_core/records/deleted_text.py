"""Text that was deleted in a database and is still in its files."""

from __future__ import annotations

import logging
import sqlite3
from contextlib import closing

from sqlalchemy import Engine, text
from sqlalchemy.exc import DBAPIError

from insole_core.records.database import Database
from insole_core.records.rows_of_person import tables_of_persons
from insole_core.records.schema import persons

log = logging.getLogger(__name__)


def forget_deleted(database: Database) -> None:
    """Write the database anew without what was deleted, as far as it lets this program do that.

    A local file is written anew as a whole, with its journal: what somebody has changed long ago
    is still in free pages. A server writes the tables of persons anew; its journal is its own. What
    another program keeps from that is told in the log, and the erasure holds all the same.
    """
    try:
        if database.is_sqlite:
            _rewrite_file(database.engine)
        else:
            _rewrite_tables(database.engine)
    except (DBAPIError, sqlite3.Error) as error:
        log.warning("deleted text may still be in files of the database: %s", error)


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
