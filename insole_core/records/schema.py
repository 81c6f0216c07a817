"""Tables of the clinic's record (docs/formats/record.md).

The same tables are made in SQLite and PostgreSQL, by the migrations beside this module. Keys are
UUIDs that the program draws, so that rows of two records never collide. Times are UTC, ISO 8601
with microseconds, written by the program; they are for people to read. What comes first is told by
numbers that only grow, never by a clock.
"""

from __future__ import annotations

import secrets
from collections.abc import Iterator, Sequence
from datetime import date
from typing import Any, Final

from sqlalchemy import (
    BigInteger,
    Boolean,
    Column,
    ColumnElement,
    Date,
    DefaultClause,
    Float,
    ForeignKey,
    Index,
    Integer,
    MetaData,
    Table,
    Text,
    UniqueConstraint,
    select,
    text,
)
from sqlalchemy.types import TypeEngine

from insole_core.records.capture import CaptureFacts
from insole_core.records.checked_values import check_values
from insole_core.records.marks import (
    BOOKKEEPING,
    CONTENT,
    DEVICE,
    DOCUMENT,
    EMPTIED,
    FILE,
    FILE_NAME,
    KEY,
    NOBODY,
    REMOVED,
    STAFF,
    STATE,
    WHEN,
    Info,
    checked,
    kept,
    unsealed,
)
from insole_core.records.order import Order
from insole_core.records.person import Person
from insole_core.records.record_field import fields_of
from insole_core.records.visit import FollowUp, Visit

metadata = MetaData(
    naming_convention={
        "pk": "pk_%(table_name)s",
        "fk": "fk_%(table_name)s_%(column_0_name)s",
        "uq": "uq_%(table_name)s_%(column_0_N_name)s",
        "ix": "ix_%(table_name)s_%(column_0_N_name)s",
    }
)


def _bytewise() -> TypeEngine[str]:
    """Return a text that is compared byte by byte, in every database and country."""
    return Text().with_variant(Text(collation="C"), "postgresql")


def _id() -> Column[str]:
    return Column("id", Text, primary_key=True, info=KEY)


def _times() -> tuple[Column[str], Column[str], Column[int]]:
    return (
        Column("created_at", Text, nullable=False, info=WHEN),
        Column("changed_at", Text, nullable=False, info=unsealed(WHEN)),
        Column("revision", Integer, nullable=False, info=BOOKKEEPING),
    )


def _text(name: str, info: Info) -> Column[str]:
    return Column(name, Text, nullable=False, server_default="", info=info)


_TYPES: dict[type, type[TypeEngine[Any]]] = {str: Text, date: Date, float: Float}


def _declared(kind: type[object]) -> Iterator[Column[Any]]:
    """Yield the columns of the fields that a kind of value declares."""
    for name, field in fields_of(kind).items():
        is_nullable = field.empty is None and not field.is_needed
        default = None if field.is_needed else field.empty
        yield Column(
            name,
            _TYPES[field.kind],
            nullable=is_nullable,
            server_default=default,
            info=field.info,
        )


def _release(*, is_key: bool = False) -> Column[int]:
    """Return the column that says which revision of an order's papers a row is about."""
    return Column(
        "release",
        Integer,
        primary_key=is_key,
        autoincrement=False,
        nullable=False,
        server_default="1",
        info=DEVICE,
    )


def _salt() -> str:
    return secrets.token_hex(16)


persons = Table(
    "persons",
    metadata,
    _id(),
    *_declared(Person),
    Column("search_text", _bytewise(), nullable=False, info=unsealed(EMPTIED)),
    Column(
        "sort_key",
        _bytewise(),
        nullable=False,
        server_default="",
        index=True,
        info=unsealed(EMPTIED),
    ),
    Column("name_key", _bytewise(), nullable=False, server_default="", info=unsealed(EMPTIED)),
    Column("is_erased", Boolean, nullable=False, server_default=text("false"), info=STATE),
    Column("merged_into", Text, ForeignKey("persons.id"), index=True, info=KEY),
    # seq of the latest line of the audit log that concerns this person: the order of recent ones
    Column(
        "last_seq", BigInteger, nullable=False, server_default="0", index=True, info=BOOKKEEPING
    ),
    # drawn for each person and erased with them: without it no digest tells what a row held
    Column("salt", Text, nullable=False, server_default="", default=_salt, info=unsealed(EMPTIED)),
    *_times(),
    UniqueConstraint("pseudonym"),
    Index("ix_persons_personal_number", "personal_number"),
    Index("ix_persons_name_key_birth_date", "name_key", "birth_date"),
)

person_words = Table(
    "person_words",
    metadata,
    Column("word", _bytewise(), primary_key=True, info=unsealed(EMPTIED)),
    Column("person_id", Text, ForeignKey("persons.id"), primary_key=True, info=KEY),
    sqlite_with_rowid=False,
)
"""The words of each `persons.search_text`, written by triggers of the database."""

contents = Table(
    "contents",
    metadata,
    Column("sha256", Text, primary_key=True),
    Column("size", BigInteger, nullable=False),
    Column("kind", Text, nullable=False),
    Column("created_at", Text, nullable=False),
    info=CONTENT,
)

visits = Table(
    "visits",
    metadata,
    _id(),
    Column("person_id", Text, ForeignKey("persons.id"), nullable=False, info=KEY),
    *_declared(Visit),
    *_times(),
    Index("ix_visits_visited_on", "visited_on"),
    Index("ix_visits_capture_state", "capture_state"),
    Index("ix_visits_person_id_visited_on", "person_id", "visited_on"),
)

captures = Table(
    "captures",
    metadata,
    _id(),
    Column("visit_id", Text, ForeignKey("visits.id"), nullable=False, info=KEY),
    Column("number", Integer, nullable=False, info=KEY),
    Column("kind", Text, nullable=False, info=STATE),
    Column("file_name", Text, nullable=False, info=FILE_NAME),
    Column(
        "content_sha256", Text, ForeignKey("contents.sha256"), nullable=False, index=True, info=FILE
    ),
    # as a case names its scan: of the manifest of a session's folder, or of the file
    _text("source_sha256", kept("tells which scan it was, and nothing of it")),
    *_declared(CaptureFacts),
    Column("program_version", Text, nullable=False, info=DEVICE),
    Column("created_at", Text, nullable=False, info=WHEN),
    Column("author", Text, nullable=False, info=STAFF),
    UniqueConstraint("visit_id", "number"),
)

visit_photos = Table(
    "visit_photos",
    metadata,
    _id(),
    Column("visit_id", Text, ForeignKey("visits.id"), nullable=False),
    Column("number", Integer, nullable=False),
    Column("content_sha256", Text, ForeignKey("contents.sha256"), nullable=False, index=True),
    Column("caption", Text, nullable=False, server_default=""),
    Column("marks", Text, nullable=False, server_default="[]"),
    Column("created_at", Text, nullable=False),
    Column("changed_at", Text, nullable=False),
    Column("revision", Integer, nullable=False),
    Column("author", Text, nullable=False),
    UniqueConstraint("visit_id", "number"),
    info=REMOVED,
)
"""Pictures of the patient, as JPEG without any place or camera, with what is drawn on them."""

prescription_versions = Table(
    "prescription_versions",
    metadata,
    _id(),
    Column("visit_id", Text, ForeignKey("visits.id"), nullable=False, info=KEY),
    Column("side", Text, nullable=False, info=DEVICE),
    Column("number", Integer, nullable=False, info=KEY),
    Column("document", Text, nullable=False, info=DOCUMENT),
    Column(
        "mesh_sha256", Text, ForeignKey("contents.sha256"), nullable=False, index=True, info=CONTENT
    ),
    Column("capture_id", Text, ForeignKey("captures.id"), info=KEY),
    Column("author", Text, nullable=False, info=STAFF),
    Column("station", Text, nullable=False, info=STAFF),
    _text("reason", EMPTIED),
    Column("program_version", Text, nullable=False, info=DEVICE),
    *_times(),
    Column(
        "is_closed", Boolean, nullable=False, server_default=text("false"), info=unsealed(STATE)
    ),
    Column("signed_by", Text, info=STAFF),
    Column("signed_at", Text, info=WHEN),
    Column("signature", Text, info=DEVICE),
    UniqueConstraint("visit_id", "side", "number"),
)

orders = Table(
    "orders",
    metadata,
    _id(),
    Column(
        "number",
        Text,
        nullable=False,
        unique=True,
        info=checked("by which the shop knows the device"),
    ),
    Column("visit_id", Text, ForeignKey("visits.id"), nullable=False, index=True, info=KEY),
    Column("person_id", Text, ForeignKey("persons.id"), nullable=False, index=True, info=KEY),
    Column("state", Text, nullable=False, info=STATE),
    *_declared(Order),
    _release(),
    *_times(),
    Index("ix_orders_state_due_on", "state", "due_on"),
)

order_feet = Table(
    "order_feet",
    metadata,
    Column("order_id", Text, ForeignKey("orders.id"), primary_key=True, info=KEY),
    Column(
        "prescription_version_id",
        Text,
        ForeignKey("prescription_versions.id"),
        primary_key=True,
        index=True,
        info=KEY,
    ),
    _release(is_key=True),
)

order_files = Table(
    "order_files",
    metadata,
    Column("order_id", Text, ForeignKey("orders.id"), primary_key=True, info=KEY),
    Column("name", Text, primary_key=True, info=FILE_NAME),
    _release(is_key=True),
    Column(
        "content_sha256", Text, ForeignKey("contents.sha256"), nullable=False, index=True, info=FILE
    ),
    Column("size", BigInteger, nullable=False, info=DEVICE),
)

order_events = Table(
    "order_events",
    metadata,
    Column("order_id", Text, ForeignKey("orders.id"), primary_key=True, info=KEY),
    Column("seq", Integer, primary_key=True, autoincrement=False, info=KEY),
    Column("at", Text, nullable=False, info=WHEN),
    Column("author", Text, nullable=False, info=STAFF),
    Column("from_state", Text, info=STATE),
    Column("to_state", Text, nullable=False, info=STATE),
    _text("remarks", EMPTIED),
    _release(),
)

follow_ups = Table(
    "follow_ups",
    metadata,
    _id(),
    Column("person_id", Text, ForeignKey("persons.id"), nullable=False, index=True, info=KEY),
    Column("order_id", Text, ForeignKey("orders.id"), index=True, info=KEY),
    Column("visit_id", Text, ForeignKey("visits.id"), index=True, info=KEY),
    *_declared(FollowUp),
    Column("author", Text, nullable=False, info=STAFF),
    Column("created_at", Text, nullable=False, info=WHEN),
)

audit = Table(
    "audit",
    metadata,
    Column("seq", BigInteger, primary_key=True, autoincrement=False),
    Column("at", Text, nullable=False),
    Column("author", Text, nullable=False),
    Column("station", Text, nullable=False),
    Column("action", Text, nullable=False),
    Column("subject_kind", Text, nullable=False),
    Column("subject_id", Text, nullable=False),
    Column("details", Text, nullable=False, server_default="{}"),
    Column("previous_hash", Text, nullable=False),
    Column("hash", Text, nullable=False),
    Index("ix_audit_subject_id", "subject_id"),
    Index("ix_audit_author_seq", "author", "seq"),
    Index("ix_audit_at_seq", "at", "seq"),
    info=NOBODY,
)

audit_head = Table(
    "audit_head",
    metadata,
    Column("id", Integer, primary_key=True, autoincrement=False),
    Column("seq", BigInteger, nullable=False),
    Column("hash", Text, nullable=False),
    info=NOBODY,
)
"""One row, id 1: the last line of the audit log. Locking it puts writers in a row."""

accounts = Table(
    "accounts",
    metadata,
    _id(),
    Column("name", Text, nullable=False, unique=True),
    Column("full_name", Text, nullable=False),
    Column("role", Text, nullable=False),
    Column("password_hash", Text, nullable=False),
    Column("failures", Integer, nullable=False, server_default="0", info=unsealed(NOBODY)),
    Column("locked_until", Text, info=unsealed(NOBODY)),
    Column("is_disabled", Boolean, nullable=False, server_default=text("false")),
    Column("changed_at", Text, nullable=False, info=unsealed(NOBODY)),
    Column("must_change_password", Boolean, nullable=False, server_default=text("false")),
    Column("system_user", Text),
    Index("ix_accounts_system_user", "system_user", unique=True),
    info=NOBODY,
)

merges = Table(
    "merges",
    metadata,
    _id(),
    Column("kept_id", Text, ForeignKey("persons.id"), nullable=False, index=True),
    Column("merged_id", Text, ForeignKey("persons.id"), nullable=False, index=True),
    Column("moved", Text, nullable=False),
    Column("at", Text, nullable=False),
    Column("author", Text, nullable=False),
    Column("undone_at", Text),
    info=KEY,
)

presence = Table(
    "presence",
    metadata,
    Column("visit_id", Text, ForeignKey("visits.id"), primary_key=True),
    Column("station", Text, primary_key=True),
    Column("author", Text, primary_key=True),
    Column("since", Text, nullable=False),
    Column("seen_at", Text, nullable=False),
    info=unsealed(STAFF),
)

clinic = Table(
    "clinic",
    metadata,
    Column("key", Text, primary_key=True),
    Column("value", Text, nullable=False),
    info=NOBODY,
)
"""Settings of the clinic, as JSON values."""

for _table in metadata.sorted_tables:
    for _column in _table.columns:
        check_values(_column)


def empty_value(column: Column[Any]) -> Any:
    """Return what a column holds that nobody has filled."""
    if column.nullable:
        return None
    default = column.server_default
    return default.arg if isinstance(default, DefaultClause) else ""


FIRST_HASH = "0" * 64
"""previous_hash of the first line of the audit log."""


_OWNERS: Final[dict[str, Table]] = {"person_id": persons, "visit_id": visits, "order_id": orders}
"""By which column a row belongs to which other one; the first that a table has counts."""


def tables_of_persons() -> tuple[Table, ...]:
    """Return all tables whose rows belong to a person, those referred to first."""
    return tuple(table for table in metadata.sorted_tables if owner_of(table) is not None)


def owner_of(table: Table) -> Column[Any] | None:
    """Return the column by which the rows of a table belong to a person, directly or not."""
    return next((table.c[name] for name in _OWNERS if name in table.c), None)


def is_of_person(table: Table, ids: Sequence[str]) -> ColumnElement[bool]:
    """Return the condition under which a row is of one of some persons, by their ids."""
    if table is persons:
        return persons.c.id.in_(ids)
    key = owner_of(table)
    assert key is not None, f"{table.name} is about no person"
    owner = _OWNERS[key.name]
    if owner is persons:
        return key.in_(ids)
    return key.in_(select(owner.c.id).where(is_of_person(owner, ids)))
