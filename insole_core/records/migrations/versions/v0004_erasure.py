"""A salt for each person, and closed prescriptions that an erasure may redact."""

import sqlalchemy as sa
from alembic import op

revision = "0004"
down_revision = "0003"

_FIXED = (
    "id", "visit_id", "side", "number", "mesh_sha256", "capture_id", "author", "station",
    "program_version", "created_at", "changed_at", "is_closed",
)  # fmt: skip
"""What a closed version keeps for good; a signature may still be added, once."""
_REDACTED = ("document", "reason")
"""What it keeps until its person is erased."""
_CHANGED = "a closed or signed prescription cannot be changed"
_ERASED = (
    "EXISTS (SELECT 1 FROM visits JOIN persons ON persons.id = visits.person_id "
    "WHERE visits.id = OLD.visit_id AND persons.is_erased)"
)


def upgrade() -> None:
    """Draw the salts, and let erasures change the words of closed versions."""
    op.add_column("persons", sa.Column("salt", sa.Text(), server_default="", nullable=False))
    if op.get_bind().dialect.name == "sqlite":
        op.execute("UPDATE persons SET salt = lower(hex(randomblob(16))) WHERE NOT is_erased")
        op.execute("DROP TRIGGER version_update")
        op.execute(
            "CREATE TRIGGER version_update BEFORE UPDATE ON prescription_versions "
            f"BEGIN SELECT RAISE(ABORT, '{_CHANGED}') WHERE {_is_changed('IS NOT')}; END"
        )
    else:
        op.execute(
            "UPDATE persons SET salt = replace(gen_random_uuid()::text, '-', '') "
            "WHERE NOT is_erased"
        )
        op.execute(
            "CREATE OR REPLACE FUNCTION check_version_update() RETURNS trigger "
            f"LANGUAGE plpgsql AS $$ BEGIN IF {_is_changed('IS DISTINCT FROM')} "
            f"THEN RAISE EXCEPTION '{_CHANGED}'; END IF; RETURN NEW; END $$"
        )


def _is_changed(distinct: str) -> str:
    """Return the condition under which an update touches what is closed."""

    def differs(names: tuple[str, ...]) -> str:
        return " OR ".join(f"OLD.{name} {distinct} NEW.{name}" for name in names)

    words = f"(({differs(_REDACTED)}) AND NOT {_ERASED})"
    signed = differs(("signature", "signed_by", "signed_at"))
    return (
        f"(OLD.is_closed AND ({differs(_FIXED)} OR {words})) "
        f"OR (OLD.signature IS NOT NULL AND ({signed}))"
    )
