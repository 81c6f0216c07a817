"""First passwords that their owners change, and accounts of the system's users."""

import sqlalchemy as sa
from alembic import op

revision = "0003"
down_revision = "0002"


def upgrade() -> None:
    """Add the columns; passwords of before were told to their owners long ago."""
    changes: sa.Column[bool] = sa.Column(
        "must_change_password", sa.Boolean(), server_default=sa.text("false"), nullable=False
    )
    op.add_column("accounts", changes)
    op.add_column("accounts", sa.Column("system_user", sa.Text()))
    op.create_index("ix_accounts_system_user", "accounts", ["system_user"], unique=True)
