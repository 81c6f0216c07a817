"""Tables of the clinic's record (docs/formats/record.md).

The same tables are made in SQLite and PostgreSQL, by the migrations beside this module. Keys are
UUIDs that the program draws, so that rows of two records never collide. Times are UTC, ISO 8601
with microseconds, written by the program; they are for people to read. What comes first is told by
numbers that only grow, never by a clock.
"""

from __future__ import annotations

from sqlalchemy import (
    BigInteger,
    Boolean,
    Column,
    Date,
    Float,
    ForeignKey,
    Index,
    Integer,
    MetaData,
    Table,
    Text,
    UniqueConstraint,
    text,
)
from sqlalchemy.types import TypeEngine

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
    return Column("id", Text, primary_key=True)


def _times() -> tuple[Column[str], Column[str], Column[int]]:
    return (
        Column("created_at", Text, nullable=False),
        Column("changed_at", Text, nullable=False),
        Column("revision", Integer, nullable=False),
    )


def _text(name: str) -> Column[str]:
    return Column(name, Text, nullable=False, server_default="")


persons = Table(
    "persons",
    metadata,
    _id(),
    Column("name", Text, nullable=False),
    Column("search_text", _bytewise(), nullable=False),
    Column("sort_key", _bytewise(), nullable=False, server_default="", index=True),
    Column("name_key", _bytewise(), nullable=False, server_default=""),
    Column("birth_date", Date),
    _text("personal_number"),
    _text("number_kind"),
    _text("contact"),
    _text("notes"),
    Column("consent_on", Date),
    Column("pseudonym", Text, nullable=False, unique=True),
    Column("is_erased", Boolean, nullable=False, server_default=text("false")),
    Column("merged_into", Text, ForeignKey("persons.id"), index=True),
    # seq of the latest line of the audit log that concerns this person: the order of recent ones
    Column("last_seq", BigInteger, nullable=False, server_default="0", index=True),
    *_times(),
    Index("ix_persons_personal_number", "personal_number"),
    Index("ix_persons_name_key_birth_date", "name_key", "birth_date"),
)

person_words = Table(
    "person_words",
    metadata,
    Column("word", _bytewise(), primary_key=True),
    Column("person_id", Text, ForeignKey("persons.id"), primary_key=True),
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
)

visits = Table(
    "visits",
    metadata,
    _id(),
    Column("person_id", Text, ForeignKey("persons.id"), nullable=False),
    Column("visited_on", Date, nullable=False, index=True),
    _text("reason"),
    _text("findings"),
    Column("weight_kg", Float),
    Column("shoe_size_eu", Float),
    Column("measures", Text, nullable=False, server_default="{}"),
    Column("capture_state", Text, nullable=False, server_default="none", index=True),
    *_times(),
    Index("ix_visits_person_id_visited_on", "person_id", "visited_on"),
)

captures = Table(
    "captures",
    metadata,
    _id(),
    Column("visit_id", Text, ForeignKey("visits.id"), nullable=False),
    Column("number", Integer, nullable=False),
    Column("kind", Text, nullable=False),
    Column("file_name", Text, nullable=False),
    Column("content_sha256", Text, ForeignKey("contents.sha256"), nullable=False, index=True),
    # as a case names its scan: of the manifest of a session's folder, or of the file
    _text("source_sha256"),
    _text("recorded_at"),
    Column("sensor_serials", Text, nullable=False, server_default="[]"),
    _text("calibrated_on"),
    Column("calibration_residuals", Text, nullable=False, server_default="{}"),
    Column("report", Text, nullable=False, server_default="{}"),
    Column("program_version", Text, nullable=False),
    Column("created_at", Text, nullable=False),
    Column("author", Text, nullable=False),
    UniqueConstraint("visit_id", "number"),
)

prescription_versions = Table(
    "prescription_versions",
    metadata,
    _id(),
    Column("visit_id", Text, ForeignKey("visits.id"), nullable=False),
    Column("side", Text, nullable=False),
    Column("number", Integer, nullable=False),
    Column("document", Text, nullable=False),
    Column("mesh_sha256", Text, ForeignKey("contents.sha256"), nullable=False, index=True),
    Column("capture_id", Text, ForeignKey("captures.id")),
    Column("author", Text, nullable=False),
    Column("station", Text, nullable=False),
    _text("reason"),
    Column("program_version", Text, nullable=False),
    *_times(),
    Column("is_closed", Boolean, nullable=False, server_default=text("false")),
    Column("signed_by", Text),
    Column("signed_at", Text),
    Column("signature", Text),
    UniqueConstraint("visit_id", "side", "number"),
)

orders = Table(
    "orders",
    metadata,
    _id(),
    Column("number", Text, nullable=False, unique=True),
    Column("visit_id", Text, ForeignKey("visits.id"), nullable=False, index=True),
    Column("person_id", Text, ForeignKey("persons.id"), nullable=False, index=True),
    Column("state", Text, nullable=False),
    _text("shop"),
    Column("due_on", Date),
    _text("remarks"),
    *_times(),
    Index("ix_orders_state_due_on", "state", "due_on"),
)

order_feet = Table(
    "order_feet",
    metadata,
    Column("order_id", Text, ForeignKey("orders.id"), primary_key=True),
    Column(
        "prescription_version_id",
        Text,
        ForeignKey("prescription_versions.id"),
        primary_key=True,
        index=True,
    ),
)

order_files = Table(
    "order_files",
    metadata,
    Column("order_id", Text, ForeignKey("orders.id"), primary_key=True),
    Column("name", Text, primary_key=True),
    Column("content_sha256", Text, ForeignKey("contents.sha256"), nullable=False, index=True),
    Column("size", BigInteger, nullable=False),
)

order_events = Table(
    "order_events",
    metadata,
    Column("order_id", Text, ForeignKey("orders.id"), primary_key=True),
    Column("seq", Integer, primary_key=True, autoincrement=False),
    Column("at", Text, nullable=False),
    Column("author", Text, nullable=False),
    Column("from_state", Text),
    Column("to_state", Text, nullable=False),
    _text("remarks"),
)

follow_ups = Table(
    "follow_ups",
    metadata,
    _id(),
    Column("person_id", Text, ForeignKey("persons.id"), nullable=False, index=True),
    Column("order_id", Text, ForeignKey("orders.id"), index=True),
    Column("visit_id", Text, ForeignKey("visits.id"), index=True),
    Column("on_date", Date, nullable=False),
    _text("outcome"),
    _text("notes"),
    Column("author", Text, nullable=False),
    Column("created_at", Text, nullable=False),
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
)

audit_head = Table(
    "audit_head",
    metadata,
    Column("id", Integer, primary_key=True, autoincrement=False),
    Column("seq", BigInteger, nullable=False),
    Column("hash", Text, nullable=False),
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
    Column("failures", Integer, nullable=False, server_default="0"),
    Column("locked_until", Text),
    Column("is_disabled", Boolean, nullable=False, server_default=text("false")),
    Column("changed_at", Text, nullable=False),
    Column("must_change_password", Boolean, nullable=False, server_default=text("false")),
    Column("system_user", Text),
    Index("ix_accounts_system_user", "system_user", unique=True),
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
)

presence = Table(
    "presence",
    metadata,
    Column("visit_id", Text, ForeignKey("visits.id"), primary_key=True),
    Column("station", Text, primary_key=True),
    Column("author", Text, primary_key=True),
    Column("since", Text, nullable=False),
    Column("seen_at", Text, nullable=False),
)

clinic = Table(
    "clinic",
    metadata,
    Column("key", Text, primary_key=True),
    Column("value", Text, nullable=False),
)
"""Settings of the clinic, as JSON values."""

FIRST_HASH = "0" * 64
"""previous_hash of the first line of the audit log."""
