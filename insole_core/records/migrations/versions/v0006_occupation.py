"""What somebody works as: how long they stand and walk."""

import sqlalchemy as sa
from alembic import op

revision = "0006"
down_revision = "0005"


def upgrade() -> None:
    """Add the column; nobody was asked before."""
    op.add_column("persons", sa.Column("occupation", sa.Text(), server_default="", nullable=False))
