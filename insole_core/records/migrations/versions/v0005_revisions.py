"""Revisions of orders, terms of a visit's order, and photos."""

import sqlalchemy as sa
from alembic import op

revision = "0005"
down_revision = "0004"

_KEYS = {"order_feet": ("prescription_version_id",), "order_files": ("name",)}
"""What made a row of an order unique beside the order."""


def upgrade() -> None:
    """Add the columns: what was ordered before is the first revision of its order."""
    op.add_column("visits", sa.Column("terms", sa.Text(), server_default="{}", nullable=False))
    op.add_column("orders", _release())
    op.add_column("orders", sa.Column("place", sa.Text(), server_default="", nullable=False))
    op.add_column("order_events", _release())
    if op.get_bind().dialect.name == "sqlite":
        _make_anew("order_feet", _order_feet(), "prescription_version_id")
        _make_anew("order_files", _order_files(), "content_sha256")
    else:
        for table, names in _KEYS.items():
            op.add_column(table, _release())
            op.drop_constraint(f"pk_{table}", table)
            op.create_primary_key(f"pk_{table}", table, ["order_id", *names, "release"])
    _make_photos()


def _release() -> sa.Column[int]:
    return sa.Column("release", sa.Integer(), server_default="1", nullable=False)


def _make_anew(name: str, columns: tuple[sa.schema.SchemaItem, ...], indexed: str) -> None:
    """Give a table of SQLite another primary key, which it cannot change."""
    names = ", ".join(c.name for c in columns if isinstance(c, sa.Column) and c.name != "release")
    op.create_table(f"{name}_new", *columns)
    op.execute(f"INSERT INTO {name}_new ({names}) SELECT {names} FROM {name}")
    op.drop_table(name)
    op.rename_table(f"{name}_new", name)
    op.create_index(f"ix_{name}_{indexed}", name, [indexed])


def _order_feet() -> tuple[sa.schema.SchemaItem, ...]:
    return (
        sa.Column("order_id", sa.Text(), nullable=False),
        sa.Column("prescription_version_id", sa.Text(), nullable=False),
        _release(),
        sa.ForeignKeyConstraint(["order_id"], ["orders.id"], name="fk_order_feet_order_id"),
        sa.ForeignKeyConstraint(
            ["prescription_version_id"],
            ["prescription_versions.id"],
            name="fk_order_feet_prescription_version_id",
        ),
        sa.PrimaryKeyConstraint(
            "order_id", "prescription_version_id", "release", name="pk_order_feet"
        ),
    )


def _order_files() -> tuple[sa.schema.SchemaItem, ...]:
    return (
        sa.Column("order_id", sa.Text(), nullable=False),
        sa.Column("name", sa.Text(), nullable=False),
        _release(),
        sa.Column("content_sha256", sa.Text(), nullable=False),
        sa.Column("size", sa.BigInteger(), nullable=False),
        sa.ForeignKeyConstraint(
            ["content_sha256"], ["contents.sha256"], name="fk_order_files_content_sha256"
        ),
        sa.ForeignKeyConstraint(["order_id"], ["orders.id"], name="fk_order_files_order_id"),
        sa.PrimaryKeyConstraint("order_id", "name", "release", name="pk_order_files"),
    )


def _make_photos() -> None:
    op.create_table(
        "visit_photos",
        sa.Column("id", sa.Text(), nullable=False),
        sa.Column("visit_id", sa.Text(), nullable=False),
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("content_sha256", sa.Text(), nullable=False),
        sa.Column("caption", sa.Text(), server_default="", nullable=False),
        sa.Column("marks", sa.Text(), server_default="[]", nullable=False),
        sa.Column("created_at", sa.Text(), nullable=False),
        sa.Column("changed_at", sa.Text(), nullable=False),
        sa.Column("revision", sa.Integer(), nullable=False),
        sa.Column("author", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(
            ["content_sha256"], ["contents.sha256"], name="fk_visit_photos_content_sha256"
        ),
        sa.ForeignKeyConstraint(["visit_id"], ["visits.id"], name="fk_visit_photos_visit_id"),
        sa.PrimaryKeyConstraint("id", name="pk_visit_photos"),
        sa.UniqueConstraint("visit_id", "number", name="uq_visit_photos_visit_id_number"),
    )
    op.create_index("ix_visit_photos_content_sha256", "visit_photos", ["content_sha256"])
