"""The first tables, and the triggers that keep what must not change."""

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None

_FIXED = (
    "id", "visit_id", "side", "number", "document", "mesh_sha256", "capture_id", "author",
    "station", "reason", "program_version", "created_at", "changed_at", "is_closed",
)  # fmt: skip
"""What a closed version keeps for good; a signature may still be added, once."""
_CHANGED = "a closed or signed prescription cannot be changed"
_CHANNEL = "insole_studio_records"
_APPENDED = "the audit log is only appended to"


def upgrade() -> None:
    """Make all tables."""
    _make_tables()
    op.execute(f"INSERT INTO audit_head (id, seq, hash) VALUES (1, 0, '{'0' * 64}')")
    if op.get_bind().dialect.name == "sqlite":
        _make_triggers_of_sqlite()
    else:
        _make_triggers_of_postgresql()


def _is_changed(distinct: str) -> str:
    """Return the condition under which an update touches what is closed."""
    differs = " OR ".join(f"OLD.{name} {distinct} NEW.{name}" for name in _FIXED)
    signed = f"OLD.signature IS NOT NULL AND OLD.signature {distinct} NEW.signature"
    signer = f"OLD.signature IS NOT NULL AND OLD.signed_by {distinct} NEW.signed_by"
    time = f"OLD.signature IS NOT NULL AND OLD.signed_at {distinct} NEW.signed_at"
    return f"(OLD.is_closed AND ({differs})) OR ({signed}) OR ({signer}) OR ({time})"


def _is_kept() -> str:
    """Return the condition under which a version may not be deleted."""
    erased = (
        "EXISTS (SELECT 1 FROM visits JOIN persons ON persons.id = visits.person_id "
        "WHERE visits.id = OLD.visit_id AND persons.is_erased)"
    )
    return f"OLD.is_closed AND NOT {erased}"


def _make_triggers_of_sqlite() -> None:
    rules = {
        "audit_update": ("BEFORE UPDATE ON audit", "true", _APPENDED),
        "audit_delete": ("BEFORE DELETE ON audit", "true", _APPENDED),
        "audit_head_delete": ("BEFORE DELETE ON audit_head", "true", _APPENDED),
        "audit_head_update": (
            "BEFORE UPDATE ON audit_head", "NEW.id <> OLD.id OR NEW.seq <= OLD.seq", _APPENDED,
        ),
        "version_update": (
            "BEFORE UPDATE ON prescription_versions", _is_changed("IS NOT"), _CHANGED,
        ),
        "version_delete": ("BEFORE DELETE ON prescription_versions", _is_kept(), _CHANGED),
    }  # fmt: skip
    for name, (when, condition, sentence) in rules.items():
        op.execute(
            f"CREATE TRIGGER {name} {when} "
            f"BEGIN SELECT RAISE(ABORT, '{sentence}') WHERE {condition}; END"
        )


def _make_triggers_of_postgresql() -> None:
    distinct = "IS DISTINCT FROM"
    op.execute(
        "CREATE FUNCTION tell_audit_line() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN "
        f"PERFORM pg_notify('{_CHANNEL}', NEW.seq::text); RETURN NULL; END $$"
    )
    _make_function("refuse_audit_change", "true", _APPENDED)
    _make_function("check_audit_head", "NEW.id <> OLD.id OR NEW.seq <= OLD.seq", _APPENDED)
    _make_function("check_version_update", _is_changed(distinct), _CHANGED)
    _make_function("check_version_delete", _is_kept(), _CHANGED, "OLD")
    for name, when, function in (
        ("audit_change", "BEFORE UPDATE OR DELETE ON audit FOR EACH ROW", "refuse_audit_change"),
        ("audit_line", "AFTER INSERT ON audit FOR EACH ROW", "tell_audit_line"),
        ("audit_truncate", "BEFORE TRUNCATE ON audit", "refuse_audit_change"),
        ("audit_head_delete", "BEFORE DELETE ON audit_head FOR EACH ROW", "refuse_audit_change"),
        ("audit_head_update", "BEFORE UPDATE ON audit_head FOR EACH ROW", "check_audit_head"),
        (
            "version_update",
            "BEFORE UPDATE ON prescription_versions FOR EACH ROW",
            "check_version_update",
        ),
        (
            "version_delete",
            "BEFORE DELETE ON prescription_versions FOR EACH ROW",
            "check_version_delete",
        ),
    ):
        op.execute(f"CREATE TRIGGER {name} {when} EXECUTE FUNCTION {function}()")


def _make_function(name: str, condition: str, sentence: str, returned: str = "NEW") -> None:
    op.execute(
        f"CREATE FUNCTION {name}() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN "
        f"IF {condition} THEN RAISE EXCEPTION '{sentence}'; END IF; "
        f"RETURN {returned}; END $$"
    )


def _make_tables() -> None:
    op.create_table(
        "accounts",
        sa.Column("id", sa.Text(), nullable=False),
        sa.Column("name", sa.Text(), nullable=False),
        sa.Column("full_name", sa.Text(), nullable=False),
        sa.Column("role", sa.Text(), nullable=False),
        sa.Column("password_hash", sa.Text(), nullable=False),
        sa.Column("failures", sa.Integer(), server_default="0", nullable=False),
        sa.Column("locked_until", sa.Text(), nullable=True),
        sa.Column("is_disabled", sa.Boolean(), server_default=sa.text("false"), nullable=False),
        sa.Column("changed_at", sa.Text(), nullable=False),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_accounts")),
        sa.UniqueConstraint("name", name=op.f("uq_accounts_name")),
    )
    op.create_table(
        "audit",
        sa.Column("seq", sa.BigInteger(), autoincrement=False, nullable=False),
        sa.Column("at", sa.Text(), nullable=False),
        sa.Column("author", sa.Text(), nullable=False),
        sa.Column("station", sa.Text(), nullable=False),
        sa.Column("action", sa.Text(), nullable=False),
        sa.Column("subject_kind", sa.Text(), nullable=False),
        sa.Column("subject_id", sa.Text(), nullable=False),
        sa.Column("details", sa.Text(), server_default="{}", nullable=False),
        sa.Column("previous_hash", sa.Text(), nullable=False),
        sa.Column("hash", sa.Text(), nullable=False),
        sa.PrimaryKeyConstraint("seq", name=op.f("pk_audit")),
    )
    op.create_index("ix_audit_subject_id", "audit", ["subject_id"], unique=False)
    op.create_table(
        "audit_head",
        sa.Column("id", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("seq", sa.BigInteger(), nullable=False),
        sa.Column("hash", sa.Text(), nullable=False),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_audit_head")),
    )
    op.create_table(
        "clinic",
        sa.Column("key", sa.Text(), nullable=False),
        sa.Column("value", sa.Text(), nullable=False),
        sa.PrimaryKeyConstraint("key", name=op.f("pk_clinic")),
    )
    op.create_table(
        "contents",
        sa.Column("sha256", sa.Text(), nullable=False),
        sa.Column("size", sa.BigInteger(), nullable=False),
        sa.Column("kind", sa.Text(), nullable=False),
        sa.Column("created_at", sa.Text(), nullable=False),
        sa.PrimaryKeyConstraint("sha256", name=op.f("pk_contents")),
    )
    op.create_table(
        "persons",
        sa.Column("id", sa.Text(), nullable=False),
        sa.Column("name", sa.Text(), nullable=False),
        sa.Column(
            "search_text",
            sa.Text().with_variant(sa.Text(collation="C"), "postgresql"),
            nullable=False,
        ),
        sa.Column(
            "sort_key",
            sa.Text().with_variant(sa.Text(collation="C"), "postgresql"),
            server_default="",
            nullable=False,
        ),
        sa.Column("birth_date", sa.Date(), nullable=True),
        sa.Column("personal_number", sa.Text(), server_default="", nullable=False),
        sa.Column("number_kind", sa.Text(), server_default="", nullable=False),
        sa.Column("contact", sa.Text(), server_default="", nullable=False),
        sa.Column("notes", sa.Text(), server_default="", nullable=False),
        sa.Column("consent_on", sa.Date(), nullable=True),
        sa.Column("pseudonym", sa.Text(), nullable=False),
        sa.Column("is_erased", sa.Boolean(), server_default=sa.text("false"), nullable=False),
        sa.Column("merged_into", sa.Text(), nullable=True),
        sa.Column("last_seq", sa.BigInteger(), server_default="0", nullable=False),
        sa.Column("created_at", sa.Text(), nullable=False),
        sa.Column("changed_at", sa.Text(), nullable=False),
        sa.Column("revision", sa.Integer(), nullable=False),
        sa.ForeignKeyConstraint(
            ["merged_into"], ["persons.id"], name=op.f("fk_persons_merged_into")
        ),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_persons")),
        sa.UniqueConstraint("pseudonym", name=op.f("uq_persons_pseudonym")),
    )
    op.create_index(op.f("ix_persons_last_seq"), "persons", ["last_seq"], unique=False)
    op.create_index("ix_persons_personal_number", "persons", ["personal_number"], unique=False)
    op.create_index(op.f("ix_persons_sort_key"), "persons", ["sort_key"], unique=False)
    op.create_table(
        "merges",
        sa.Column("id", sa.Text(), nullable=False),
        sa.Column("kept_id", sa.Text(), nullable=False),
        sa.Column("merged_id", sa.Text(), nullable=False),
        sa.Column("moved", sa.Text(), nullable=False),
        sa.Column("at", sa.Text(), nullable=False),
        sa.Column("author", sa.Text(), nullable=False),
        sa.Column("undone_at", sa.Text(), nullable=True),
        sa.ForeignKeyConstraint(["kept_id"], ["persons.id"], name=op.f("fk_merges_kept_id")),
        sa.ForeignKeyConstraint(["merged_id"], ["persons.id"], name=op.f("fk_merges_merged_id")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_merges")),
    )
    op.create_index(op.f("ix_merges_kept_id"), "merges", ["kept_id"], unique=False)
    op.create_index(op.f("ix_merges_merged_id"), "merges", ["merged_id"], unique=False)
    op.create_table(
        "visits",
        sa.Column("id", sa.Text(), nullable=False),
        sa.Column("person_id", sa.Text(), nullable=False),
        sa.Column("visited_on", sa.Date(), nullable=False),
        sa.Column("reason", sa.Text(), server_default="", nullable=False),
        sa.Column("findings", sa.Text(), server_default="", nullable=False),
        sa.Column("weight_kg", sa.Float(), nullable=True),
        sa.Column("shoe_size_eu", sa.Float(), nullable=True),
        sa.Column("measures", sa.Text(), server_default="{}", nullable=False),
        sa.Column("capture_state", sa.Text(), server_default="none", nullable=False),
        sa.Column("created_at", sa.Text(), nullable=False),
        sa.Column("changed_at", sa.Text(), nullable=False),
        sa.Column("revision", sa.Integer(), nullable=False),
        sa.ForeignKeyConstraint(["person_id"], ["persons.id"], name=op.f("fk_visits_person_id")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_visits")),
    )
    op.create_index(op.f("ix_visits_capture_state"), "visits", ["capture_state"], unique=False)
    op.create_index(
        "ix_visits_person_id_visited_on", "visits", ["person_id", "visited_on"], unique=False
    )
    op.create_index(op.f("ix_visits_visited_on"), "visits", ["visited_on"], unique=False)
    op.create_table(
        "captures",
        sa.Column("id", sa.Text(), nullable=False),
        sa.Column("visit_id", sa.Text(), nullable=False),
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("kind", sa.Text(), nullable=False),
        sa.Column("file_name", sa.Text(), nullable=False),
        sa.Column("content_sha256", sa.Text(), nullable=False),
        sa.Column("source_sha256", sa.Text(), server_default="", nullable=False),
        sa.Column("recorded_at", sa.Text(), server_default="", nullable=False),
        sa.Column("sensor_serials", sa.Text(), server_default="[]", nullable=False),
        sa.Column("calibrated_on", sa.Text(), server_default="", nullable=False),
        sa.Column("calibration_residuals", sa.Text(), server_default="{}", nullable=False),
        sa.Column("report", sa.Text(), server_default="{}", nullable=False),
        sa.Column("program_version", sa.Text(), nullable=False),
        sa.Column("created_at", sa.Text(), nullable=False),
        sa.Column("author", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(
            ["content_sha256"], ["contents.sha256"], name=op.f("fk_captures_content_sha256")
        ),
        sa.ForeignKeyConstraint(["visit_id"], ["visits.id"], name=op.f("fk_captures_visit_id")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_captures")),
        sa.UniqueConstraint("visit_id", "number", name=op.f("uq_captures_visit_id_number")),
    )
    op.create_index(
        op.f("ix_captures_content_sha256"), "captures", ["content_sha256"], unique=False
    )
    op.create_table(
        "orders",
        sa.Column("id", sa.Text(), nullable=False),
        sa.Column("number", sa.Text(), nullable=False),
        sa.Column("visit_id", sa.Text(), nullable=False),
        sa.Column("person_id", sa.Text(), nullable=False),
        sa.Column("state", sa.Text(), nullable=False),
        sa.Column("shop", sa.Text(), server_default="", nullable=False),
        sa.Column("due_on", sa.Date(), nullable=True),
        sa.Column("remarks", sa.Text(), server_default="", nullable=False),
        sa.Column("created_at", sa.Text(), nullable=False),
        sa.Column("changed_at", sa.Text(), nullable=False),
        sa.Column("revision", sa.Integer(), nullable=False),
        sa.ForeignKeyConstraint(["person_id"], ["persons.id"], name=op.f("fk_orders_person_id")),
        sa.ForeignKeyConstraint(["visit_id"], ["visits.id"], name=op.f("fk_orders_visit_id")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_orders")),
        sa.UniqueConstraint("number", name=op.f("uq_orders_number")),
    )
    op.create_index(op.f("ix_orders_person_id"), "orders", ["person_id"], unique=False)
    op.create_index("ix_orders_state_due_on", "orders", ["state", "due_on"], unique=False)
    op.create_index(op.f("ix_orders_visit_id"), "orders", ["visit_id"], unique=False)
    op.create_table(
        "presence",
        sa.Column("visit_id", sa.Text(), nullable=False),
        sa.Column("station", sa.Text(), nullable=False),
        sa.Column("author", sa.Text(), nullable=False),
        sa.Column("since", sa.Text(), nullable=False),
        sa.Column("seen_at", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(["visit_id"], ["visits.id"], name=op.f("fk_presence_visit_id")),
        sa.PrimaryKeyConstraint("visit_id", "station", "author", name=op.f("pk_presence")),
    )
    op.create_table(
        "follow_ups",
        sa.Column("id", sa.Text(), nullable=False),
        sa.Column("person_id", sa.Text(), nullable=False),
        sa.Column("order_id", sa.Text(), nullable=True),
        sa.Column("visit_id", sa.Text(), nullable=True),
        sa.Column("on_date", sa.Date(), nullable=False),
        sa.Column("outcome", sa.Text(), server_default="", nullable=False),
        sa.Column("notes", sa.Text(), server_default="", nullable=False),
        sa.Column("author", sa.Text(), nullable=False),
        sa.Column("created_at", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(["order_id"], ["orders.id"], name=op.f("fk_follow_ups_order_id")),
        sa.ForeignKeyConstraint(
            ["person_id"], ["persons.id"], name=op.f("fk_follow_ups_person_id")
        ),
        sa.ForeignKeyConstraint(["visit_id"], ["visits.id"], name=op.f("fk_follow_ups_visit_id")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_follow_ups")),
    )
    op.create_index(op.f("ix_follow_ups_order_id"), "follow_ups", ["order_id"], unique=False)
    op.create_index(op.f("ix_follow_ups_person_id"), "follow_ups", ["person_id"], unique=False)
    op.create_index(op.f("ix_follow_ups_visit_id"), "follow_ups", ["visit_id"], unique=False)
    op.create_table(
        "order_events",
        sa.Column("order_id", sa.Text(), nullable=False),
        sa.Column("seq", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("at", sa.Text(), nullable=False),
        sa.Column("author", sa.Text(), nullable=False),
        sa.Column("from_state", sa.Text(), nullable=True),
        sa.Column("to_state", sa.Text(), nullable=False),
        sa.Column("remarks", sa.Text(), server_default="", nullable=False),
        sa.ForeignKeyConstraint(["order_id"], ["orders.id"], name=op.f("fk_order_events_order_id")),
        sa.PrimaryKeyConstraint("order_id", "seq", name=op.f("pk_order_events")),
    )
    op.create_table(
        "order_files",
        sa.Column("order_id", sa.Text(), nullable=False),
        sa.Column("name", sa.Text(), nullable=False),
        sa.Column("content_sha256", sa.Text(), nullable=False),
        sa.Column("size", sa.BigInteger(), nullable=False),
        sa.ForeignKeyConstraint(
            ["content_sha256"], ["contents.sha256"], name=op.f("fk_order_files_content_sha256")
        ),
        sa.ForeignKeyConstraint(["order_id"], ["orders.id"], name=op.f("fk_order_files_order_id")),
        sa.PrimaryKeyConstraint("order_id", "name", name=op.f("pk_order_files")),
    )
    op.create_index(
        op.f("ix_order_files_content_sha256"), "order_files", ["content_sha256"], unique=False
    )
    op.create_table(
        "prescription_versions",
        sa.Column("id", sa.Text(), nullable=False),
        sa.Column("visit_id", sa.Text(), nullable=False),
        sa.Column("side", sa.Text(), nullable=False),
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("document", sa.Text(), nullable=False),
        sa.Column("mesh_sha256", sa.Text(), nullable=False),
        sa.Column("capture_id", sa.Text(), nullable=True),
        sa.Column("author", sa.Text(), nullable=False),
        sa.Column("station", sa.Text(), nullable=False),
        sa.Column("reason", sa.Text(), server_default="", nullable=False),
        sa.Column("program_version", sa.Text(), nullable=False),
        sa.Column("created_at", sa.Text(), nullable=False),
        sa.Column("changed_at", sa.Text(), nullable=False),
        sa.Column("revision", sa.Integer(), nullable=False),
        sa.Column("is_closed", sa.Boolean(), server_default=sa.text("false"), nullable=False),
        sa.Column("signed_by", sa.Text(), nullable=True),
        sa.Column("signed_at", sa.Text(), nullable=True),
        sa.Column("signature", sa.Text(), nullable=True),
        sa.ForeignKeyConstraint(
            ["capture_id"], ["captures.id"], name=op.f("fk_prescription_versions_capture_id")
        ),
        sa.ForeignKeyConstraint(
            ["mesh_sha256"], ["contents.sha256"], name=op.f("fk_prescription_versions_mesh_sha256")
        ),
        sa.ForeignKeyConstraint(
            ["visit_id"], ["visits.id"], name=op.f("fk_prescription_versions_visit_id")
        ),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_prescription_versions")),
        sa.UniqueConstraint(
            "visit_id", "side", "number", name=op.f("uq_prescription_versions_visit_id_side_number")
        ),
    )
    op.create_index(
        op.f("ix_prescription_versions_mesh_sha256"),
        "prescription_versions",
        ["mesh_sha256"],
        unique=False,
    )
    op.create_table(
        "order_feet",
        sa.Column("order_id", sa.Text(), nullable=False),
        sa.Column("prescription_version_id", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(["order_id"], ["orders.id"], name=op.f("fk_order_feet_order_id")),
        sa.ForeignKeyConstraint(
            ["prescription_version_id"],
            ["prescription_versions.id"],
            name=op.f("fk_order_feet_prescription_version_id"),
        ),
        sa.PrimaryKeyConstraint("order_id", "prescription_version_id", name=op.f("pk_order_feet")),
    )
    op.create_index(
        op.f("ix_order_feet_prescription_version_id"),
        "order_feet",
        ["prescription_version_id"],
        unique=False,
    )
