"""Writing a row that may be there already, as each database says it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from sqlalchemy import Connection, Table
from sqlalchemy.dialects import postgresql, sqlite


def upsert(
    connection: Connection, table: Table, values: Mapping[str, Any], changed: Sequence[str] = ()
) -> None:
    """Insert a row; where one with its key is there, change some of its columns.

    Parameters
    ----------
    changed
        Names of the columns that get the new value; without any, the row stays as it is.
    """
    dialect = sqlite if connection.dialect.name == "sqlite" else postgresql
    statement = dialect.insert(table).values(**values)
    if not changed:
        connection.execute(statement.on_conflict_do_nothing())
        return
    key = [column.name for column in table.primary_key]
    new = {name: statement.excluded[name] for name in changed}
    connection.execute(statement.on_conflict_do_update(index_elements=key, set_=new))
