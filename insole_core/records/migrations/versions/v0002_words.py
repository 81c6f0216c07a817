"""Words to find persons by, and indexes for duplicates and the audit log."""

from collections import defaultdict

import sqlalchemy as sa
from alembic import op

from insole_core.records.person_matching import MOST_KEY, name_key_of, search_text_of

revision = "0002"
down_revision = "0001"

_TEXT = sa.Text().with_variant(sa.Text(collation="C"), "postgresql")


def upgrade() -> None:
    """Make them, and write the words of everybody."""
    op.add_column("persons", sa.Column("name_key", _TEXT, server_default="", nullable=False))
    op.create_table(
        "person_words",
        sa.Column("word", _TEXT, nullable=False),
        sa.Column("person_id", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(
            ["person_id"], ["persons.id"], name=op.f("fk_person_words_person_id")
        ),
        sa.PrimaryKeyConstraint("word", "person_id", name=op.f("pk_person_words")),
        sqlite_with_rowid=False,
    )
    op.create_index("ix_persons_name_key_birth_date", "persons", ["name_key", "birth_date"])
    op.create_index("ix_persons_merged_into", "persons", ["merged_into"])
    op.create_index("ix_audit_author_seq", "audit", ["author", "seq"])
    op.create_index("ix_audit_at_seq", "audit", ["at", "seq"])
    if op.get_bind().dialect.name == "sqlite":
        _make_triggers_of_sqlite()
    else:
        _make_trigger_of_postgresql()
        # Stations ask once a second what has changed, in either database.
        op.execute("DROP TRIGGER audit_line ON audit")
        op.execute("DROP FUNCTION tell_audit_line()")
    _write_texts()
    op.execute("UPDATE visits SET capture_state = 'wanted' WHERE capture_state = 'running'")


def _make_triggers_of_sqlite() -> None:
    remove = f"DELETE FROM person_words WHERE person_id = OLD.id AND word IN ({_words('OLD')});"
    write = f"INSERT INTO person_words (word, person_id) {_words('NEW', 'DISTINCT', ', NEW.id')};"
    op.execute(f"CREATE TRIGGER person_insert AFTER INSERT ON persons BEGIN {write} END")
    op.execute(f"CREATE TRIGGER person_delete BEFORE DELETE ON persons BEGIN {remove} END")
    op.execute(
        "CREATE TRIGGER person_update AFTER UPDATE OF search_text ON persons "
        f"WHEN OLD.search_text <> NEW.search_text BEGIN {remove} {write} END"
    )


def _words(row: str, distinct: str = "", more: str = "") -> str:
    """Return the query of the words of a row: no text holds a space within a word."""
    array = f"""'[' || replace(json_quote({row}.search_text), ' ', '","') || ']'"""
    return f"SELECT {distinct} value{more} FROM json_each({array}) WHERE value <> ''"


def _make_trigger_of_postgresql() -> None:
    op.execute(
        "CREATE FUNCTION write_person_words() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN "
        "IF TG_OP <> 'INSERT' THEN DELETE FROM person_words WHERE person_id = OLD.id "
        "AND word = ANY (string_to_array(OLD.search_text, ' ')); END IF; "
        "IF TG_OP = 'DELETE' THEN RETURN OLD; END IF; "
        "INSERT INTO person_words (word, person_id) SELECT DISTINCT word, NEW.id "
        "FROM unnest(string_to_array(NEW.search_text, ' ')) AS word WHERE word <> ''; "
        "RETURN NEW; END $$"
    )
    for name, when in (
        ("person_insert", "AFTER INSERT ON persons FOR EACH ROW"),
        ("person_delete", "BEFORE DELETE ON persons FOR EACH ROW"),
        (
            "person_update",
            "AFTER UPDATE OF search_text ON persons FOR EACH ROW "
            "WHEN (OLD.search_text <> NEW.search_text)",
        ),
    ):
        op.execute(f"CREATE TRIGGER {name} {when} EXECUTE FUNCTION write_person_words()")


def _write_texts() -> None:
    """Write what persons are found by, as this program does for new ones."""
    connection = op.get_bind()
    names = ("id", "name", "personal_number", "pseudonym", "is_erased", "search_text", "name_key")
    persons = sa.table("persons", *map(sa.column, names), sa.column("birth_date", sa.Date))
    orders = sa.table("orders", sa.column("person_id"), sa.column("number"))
    numbers = defaultdict(list)
    for person_id, number in connection.execute(sa.select(orders).order_by(orders.c.number)):
        numbers[person_id].append(number)
    rows = connection.execute(sa.select(persons).where(~persons.c.is_erased)).all()
    if not rows:
        return
    update = sa.update(persons).where(persons.c.id == sa.bindparam("key"))
    values = [
        {
            "key": row.id,
            "search_text": search_text_of(
                row.name, row.birth_date, row.personal_number, [row.pseudonym, *numbers[row.id]]
            ),
            "name_key": name_key_of(row.name)[:MOST_KEY],
        }
        for row in rows
    ]
    connection.execute(update, values)
