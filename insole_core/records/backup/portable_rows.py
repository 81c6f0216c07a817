"""The rows of a database as text that any other database takes (docs/formats/backup.md).

A table is written in pieces of rows, one JSON array a line. A piece ends after a row whose key says
so, not after a number of rows: a row that is added or changed makes one new piece, and all others
are what they were in the backup before.
"""

from __future__ import annotations

import json
import zlib
from collections.abc import Iterable, Iterator, Sequence
from datetime import date
from typing import Any, Final

from sqlalchemy import Column, Connection, Date, MetaData, Select, Table, insert, select, update

VERSION_TABLE: Final = "alembic_version"
_DERIVED: Final = frozenset(["person_words"])
"""Written by triggers of the database, from rows of other tables."""
_ROWS_EXPECTED: Final = 512
"""Mean number of rows of a piece."""
_MOST_BYTES: Final = 8 * 2**20
_BATCH: Final = 500
_ENCODER: Final = json.JSONEncoder(
    ensure_ascii=False, separators=(",", ":"), default=date.isoformat
)
"""Days are all that JSON does not know."""


def tables_of(connection: Connection) -> list[Table]:
    """Return the tables of a record as they are in its database, those referred to first.

    Those that the database fills by itself are left out.
    """
    metadata = MetaData()
    metadata.reflect(connection)
    left_out = _DERIVED | {VERSION_TABLE}
    return [table for table in metadata.sorted_tables if table.name not in left_out]


def pieces_of(connection: Connection, table: Table) -> Iterator[tuple[bytes, int]]:
    """Yield the content of a table in pieces, with their numbers of rows.

    Rows come in the order in which they were made, so that new ones are in the last pieces.
    """
    lines: list[bytes] = []
    size = 0
    keys = [column.name for column in table.primary_key]
    for row in _rows(connection, table):
        line = _ENCODER.encode(tuple(row)).encode() + b"\n"
        lines.append(line)
        size += len(line)
        if _ends_piece([row._mapping[name] for name in keys]) or size > _MOST_BYTES:
            yield b"".join(lines), len(lines)
            lines, size = [], 0
    if lines:
        yield b"".join(lines), len(lines)


def insert_pieces(
    connection: Connection, table: Table, columns: Sequence[str], pieces: Iterable[bytes]
) -> int:
    """Insert the pieces of a table into an empty one; return the number of rows.

    Parameters
    ----------
    columns
        Names, in the order of the values of a row.

    Raises
    ------
    ValueError, KeyError
        When a piece is not what `pieces_of` has written for such a table.
    """
    to_itself = [
        key.parent.name for key in table.foreign_keys if key.column.table.name == table.name
    ]
    count, later = 0, []
    for piece in pieces:
        rows = _read_rows(table, columns, piece)
        for row in rows:
            later += [_referring(table, row, name) for name in to_itself if row[name] is not None]
        for start in range(0, len(rows), _BATCH):
            connection.execute(insert(table), rows[start : start + _BATCH])
        count += len(rows)
    for key, value in later:
        connection.execute(update(table).where(key).values(value))
    return count


def replace_pieces(
    connection: Connection, table: Table, columns: Sequence[str], pieces: Iterable[bytes]
) -> int:
    """Do the same for a table that comes with rows, such as the head of the audit log."""
    count = 0
    for row in (row for piece in pieces for row in _read_rows(table, columns, piece)):
        (key,) = table.primary_key.columns
        found = connection.execute(select(table).where(key == row[key.name])).one_or_none()
        if found is None:
            connection.execute(insert(table).values(row))
        elif found._asdict() != row:
            connection.execute(update(table).where(key == row[key.name]).values(row))
        count += 1
    return count


def _referring(table: Table, row: dict[str, Any], name: str) -> tuple[Any, dict[str, Any]]:
    """Take the reference of a row to its own table out, to be set once all rows are there."""
    (key,) = table.primary_key.columns
    value = {name: row[name]}
    row[name] = None
    return key == row[key.name], value


def _rows(connection: Connection, table: Table) -> Iterator[Any]:
    if "created_at" not in table.c:
        yield from _streamed(connection, select(table).order_by(*table.primary_key.columns))
        return
    # Keys are sorted alone: the rows of some tables are large.
    (key,) = table.primary_key.columns
    ordered = _streamed(connection, select(key).order_by(table.c.created_at, key))
    batch: list[Any] = []
    for (value,) in list(ordered):
        batch.append(value)
        if len(batch) == _BATCH:
            yield from _fetched(connection, table, key, batch)
            batch = []
    yield from _fetched(connection, table, key, batch)


def _fetched(
    connection: Connection, table: Table, key: Column[Any], values: list[Any]
) -> Iterator[Any]:
    rows = {row._mapping[key.name]: row for row in connection.execute(
        select(table).where(key.in_(values))
    )}  # fmt: skip
    return (rows[value] for value in values)


def _streamed(connection: Connection, query: Select[Any]) -> Iterator[Any]:
    with connection.execute(query.execution_options(yield_per=_BATCH)) as result:
        yield from result


def _ends_piece(key: list[Any]) -> bool:
    return zlib.crc32(repr(key).encode()) % _ROWS_EXPECTED == 0


def _read_rows(table: Table, columns: Sequence[str], piece: bytes) -> list[dict[str, Any]]:
    days = [name for name in columns if isinstance(table.c[name].type, Date)]
    rows = []
    for line in piece.splitlines():
        row = dict(zip(columns, json.loads(line), strict=True))
        for name in days:
            if row[name] is not None:
                row[name] = date.fromisoformat(row[name])
        rows.append(row)
    return rows
