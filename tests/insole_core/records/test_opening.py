"""Opening a record: made, migrated, refused, or opened for reading, each told in words."""

from __future__ import annotations

import os
import sqlite3
import subprocess
import sys
import threading
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from postgres_server import PostgresServer, binaries, running_server
from psycopg.errors import OperationalError, TooManyConnections
from record_samples import SCHEMAS, place_of_sample, write_newest
from sqlalchemy import text
from sqlalchemy.exc import DBAPIError
from stations import ANNA, BEN, SYNCED, Stations

from insole_core.errors import InputError, RecordsError, Unreachable
from insole_core.records import database as database_module
from insole_core.records import migrate as migrate_module
from insole_core.records import records as open_module
from insole_core.records.author import Role
from insole_core.records.clinic import setting_of, write_setting
from insole_core.records.database import Database, check_not_lost
from insole_core.records.database_errors import DamagedDatabase, FullDatabase, described
from insole_core.records.migrate import SCHEMA, schema_of
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.place_check import look_at_place
from insole_core.records.records import open_records
from insole_core.records.row_report import verify_rows
from insole_core.records.schema import metadata
from tests.patience import PATIENCE_S


def test_a_new_record_is_private(tmp_path: Path) -> None:
    place = RecordsPlace.local(tmp_path / "a" / "b")
    records = open_records(place, ANNA)
    records.persons.add(Person("Anna"))
    files = [path for path in place.database_file.parent.rglob("*") if path.is_file()]
    assert {path.stat().st_mode & 0o777 for path in files} == {0o600}
    folders = [place.database_file.parent, place.contents]
    assert {path.stat().st_mode & 0o777 for path in folders} == {0o700}
    records.close()


def test_settings_of_sqlite_survive_a_power_failure(
    local_place: RecordsPlace, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("insole_core.records.database._connect_file", SYNCED)
    database = Database(local_place)
    with database.writing() as connection:
        found = {
            name: connection.execute(text(f"PRAGMA {name}")).scalar()
            for name in ("journal_mode", "synchronous", "foreign_keys")
        }
    assert found == {"journal_mode": "wal", "synchronous": 2, "foreign_keys": 1}
    database.close()


def test_migrations_make_the_tables_of_the_schema(stations: Stations) -> None:
    from alembic.autogenerate import compare_metadata
    from alembic.migration import MigrationContext

    records = stations.open()
    with records.context.database.reading() as connection:
        context = MigrationContext.configure(connection, opts={"compare_type": True})
        assert compare_metadata(context, metadata) == []


def test_programs_that_start_at_once_make_one_record(tmp_path: Path) -> None:
    place = RecordsPlace.local(tmp_path / "record")
    opened, failed = [], []

    def start() -> None:
        try:
            opened.append(open_records(place, ANNA))
        except Exception as error:  # noqa: BLE001 - any is what the test looks for
            failed.append(error)

    threads = [threading.Thread(target=start) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failed == []
    opened[0].persons.add(Person("Anna"))
    assert [len(records.persons.recent()) for records in opened] == [1] * 4
    assert len({records.contents.identity() for records in opened}) == 1
    for records in opened:
        records.close()


def test_a_newer_record_is_refused_in_words(stations: Stations) -> None:
    records = stations.open()
    with records.context.database.writing() as connection:
        connection.execute(text("UPDATE alembic_version SET version_num = '9999'"))
    with pytest.raises(RecordsError, match=r"newer Insole Studio \(tables 9999"):
        open_records(stations.place, ANNA)


def test_an_older_program_writes_nothing_to_a_record_that_was_migrated(
    stations: Stations,
) -> None:
    old, newer = stations.open(ANNA), stations.open(BEN)
    with newer.context.database.writing() as connection:
        connection.execute(text("UPDATE alembic_version SET version_num = '9999'"))
    with pytest.raises(RecordsError, match=r"changed .* meanwhile; install the newest version"):
        old.persons.add(Person("Anna"))
    assert old.persons.recent() == []


@pytest.mark.parametrize("kind", ["sqlite", "postgresql"])
def test_a_migration_waits_for_an_older_program_that_writes_and_then_stops_it(
    tmp_path: Path, request: pytest.FixtureRequest, kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    place = place_of_sample("0001", kind, tmp_path, request)
    older = Database(place)
    older.schema = "0001"
    has_written, wants_to_migrate, migrated = (threading.Event() for _ in range(3))
    ended: list[bool] = []

    def write() -> None:
        with older.writing() as connection:
            write_setting(connection, "of_older", True)
            has_written.set()
            assert wants_to_migrate.wait(PATIENCE_S)
            ended.append(not migrated.wait(0.5))

    def migrate(*arguments: Any, **options: Any) -> None:
        wants_to_migrate.set()
        migrate_module.migrate(*arguments, **options)
        migrated.set()

    monkeypatch.setattr(open_module, "migrate", migrate)

    writing = threading.Thread(target=write)
    writing.start()
    assert has_written.wait(PATIENCE_S)
    newer = open_records(place, ANNA)
    assert ended == [True]
    writing.join()
    assert newer.clinic.get("of_older", False) is True
    with pytest.raises(RecordsError, match="install the newest version"), older.writing():
        pass
    with older.reading() as connection:
        assert setting_of(connection, "of_older") is True
    newer.persons.add(Person("Ben"))
    older.close()
    newer.close()


_KILLED_MIGRATION = """
import os, signal, sys
from pathlib import Path
from alembic import command
from insole_core.records import person_matching
from insole_core.records.author import Author
from insole_core.records.records import open_records
from insole_core.records.place import RecordsPlace

def die(*_given):
    os.kill(os.getpid(), signal.SIGKILL)

upgrade = command.upgrade
def killed(*given):
    upgrade(*given)
    die()

folder, moment, *url = sys.argv[1:]
if moment == "end":
    command.upgrade = killed
else:  # as the words of a person are written, in a table that has just been made
    person_matching.search_text_of = die
place = RecordsPlace.local(Path(folder))
if url:
    place = RecordsPlace.of_url(*url, Path(folder))
open_records(place, Author("a", "b"))
"""


def _killed_in_migration(place: RecordsPlace, moment: str, *url: str) -> int:
    folder = str(place.contents.parent)
    command = [sys.executable, "-c", _KILLED_MIGRATION, folder, moment, *url]
    return subprocess.run(command, check=False, timeout=PATIENCE_S).returncode


@pytest.mark.parametrize("kind", ["sqlite", "postgresql"])
def test_an_interrupted_migration_is_made_anew(
    tmp_path: Path, request: pytest.FixtureRequest, kind: str
) -> None:
    place, url = RecordsPlace.local(tmp_path), []
    if kind == "postgresql":
        server: PostgresServer = request.getfixturevalue("postgres")
        server.execute("DROP DATABASE IF EXISTS sample")
        server.execute("CREATE DATABASE sample")
        url = [server.url("sample")]
        place = RecordsPlace.of_url(*url, tmp_path / "contents")
    assert _killed_in_migration(place, "end", *url) == -9
    records = open_records(place, ANNA)
    records.persons.add(Person("Anna"))
    assert records.audit.verify().is_intact
    records.close()


@pytest.mark.parametrize("kind", ["sqlite", "postgresql"])
def test_a_migration_of_patients_that_is_interrupted_is_made_anew(
    tmp_path: Path, request: pytest.FixtureRequest, kind: str
) -> None:
    place = place_of_sample("0001", kind, tmp_path, request)
    url = [] if place.is_local else [place.url.render_as_string(hide_password=False)]
    assert _killed_in_migration(place, "words", *url) == -9
    database = Database(place)
    with database.reading() as connection:
        assert schema_of(connection) == "0001"
        assert connection.execute(text("SELECT name FROM persons")).scalar() == "Anna Berg"
    database.close()
    records = open_records(place, ANNA)
    for typed in ("anna", "1970-02-28", "9874"):
        assert [p.name for p in records.persons.search(typed)] == ["Anna Berg"]
    assert records.audit.verify().is_intact
    records.close()


def test_a_record_whose_database_is_gone_is_not_begun_anew(
    tmp_path: Path, local_place: RecordsPlace
) -> None:
    open_records(local_place, ANNA).close()
    local_place.database_file.unlink()
    with pytest.raises(RecordsError, match="is missing, but the files of the record"):
        open_records(local_place, ANNA)
    assert not local_place.database_file.exists()


def test_a_database_cut_to_nothing_is_damaged_and_no_new_one(local_place: RecordsPlace) -> None:
    open_records(local_place, ANNA).close()
    local_place.database_file.write_bytes(b"")
    for look in (lambda: open_records(local_place, ANNA), lambda: look_at_place(local_place)):
        with pytest.raises(DamagedDatabase, match="is damaged; restore the record from a backup"):
            look()
    assert local_place.database_file.read_bytes() == b""


def test_a_database_that_is_in_its_journal_only_is_no_lost_one(local_place: RecordsPlace) -> None:
    """As another program has just begun it; SQLite itself says what it is."""
    open_records(local_place, ANNA).close()
    local_place.database_file.write_bytes(b"")
    local_place.database_file.with_name("records.sqlite3-wal").write_bytes(b"pages")
    check_not_lost(local_place)


@pytest.mark.parametrize("content", [b"no database at all" * 100, b"SQLite format 3\x00" * 300])
def test_what_is_no_database_is_told_and_left_alone(
    local_place: RecordsPlace, content: bytes
) -> None:
    local_place.database_file.write_bytes(content)
    with pytest.raises(DamagedDatabase, match="is damaged; restore the record from a backup"):
        open_records(local_place, ANNA)
    assert local_place.database_file.read_bytes() == content


def test_a_damaged_record_is_opened_for_reading(local_place: RecordsPlace) -> None:
    records = open_records(local_place, ANNA)
    for number in range(200):
        records.clinic.set(f"k{number}", "x" * 200)
    person = records.persons.add(Person("Anna Berg"))
    records.close()
    _damage(local_place.database_file, "audit")
    records = open_records(local_place, ANNA)
    with pytest.raises(DamagedDatabase):
        records.persons.add(Person("Ben"))
    assert records.is_read_only
    assert "restore the record from a backup" in str(records.problem)
    assert records.persons.open(person.id) == person
    with pytest.raises(RecordsError, match="for reading only"):
        records.persons.add(Person("Ben"))
    records.close()


def test_whoever_signs_in_notices_the_damage_and_may_read(local_place: RecordsPlace) -> None:
    records = open_records(local_place, ANNA)
    for number in range(200):
        records.clinic.set(f"k{number}", "x" * 200)
    records.accounts.switch_on("root", "Rut Root", "four words in a row")
    records.close()
    _damage(local_place.database_file, "audit")
    records = open_records(local_place, ANNA)
    assert not records.is_read_only
    author = records.accounts.sign_in("root", "four words in a row")
    assert records.is_read_only
    assert author.role is Role.ADMINISTRATOR
    assert records.accounts.sign_in("root", "four words in a row") == author
    records.close()


def _damage(path: Path, table: str) -> None:
    """Overwrite the pages of a table but for the first one, which finds the others."""
    with sqlite3.connect(path) as connection:
        connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        [size] = connection.execute("PRAGMA page_size").fetchone()
        root = connection.execute(
            "SELECT rootpage FROM sqlite_master WHERE name = ?", (table,)
        ).fetchone()[0]
    connection.close()
    content = bytearray(path.read_bytes())
    start = (root - 1) * size
    assert content[start] == 5  # an inner page, which says where its children are
    content[start + 8 : start + 12] = b"\x7f\xff\xff\xff"
    path.write_bytes(content)


def test_damage_that_is_there_at_the_start_opens_for_reading(local_place: RecordsPlace) -> None:
    records = open_records(local_place, ANNA)
    person = records.persons.add(Person("Anna Berg"))
    records.close()
    with sqlite3.connect(local_place.database_file) as connection:
        connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        [size] = connection.execute("PRAGMA page_size").fetchone()
        [root] = connection.execute(
            "SELECT rootpage FROM sqlite_master WHERE name = 'presence'"
        ).fetchone()
    connection.close()
    content = bytearray(local_place.database_file.read_bytes())
    content[(root - 1) * size : root * size] = b"\xff" * size
    local_place.database_file.write_bytes(content)
    records = open_records(local_place, ANNA)
    assert records.persons.get(person.id) == person
    with pytest.raises(RecordsError, match=r"for reading only.*restore the record from a backup"):
        records.persons.add(Person("Ben"))
    records.close()
    assert local_place.database_file.read_bytes() == content


def test_a_record_that_may_only_be_read_says_so(
    local_place: RecordsPlace, monkeypatch: pytest.MonkeyPatch
) -> None:
    records = open_records(local_place, ANNA)
    person = records.persons.add(Person("Anna Berg"))
    records.close()
    content = local_place.database_file.read_bytes()
    # Root may write everywhere, so what the system says of others is said to everybody.
    monkeypatch.setattr(os, "access", lambda _path, mode: mode == os.R_OK)
    records = open_records(local_place, ANNA)
    assert records.persons.get(person.id) == person
    assert records.visits.of_person(person.id) == []
    with pytest.raises(RecordsError, match="may only be read by you"):
        records.persons.add(Person("Ben"))
    records.close()
    assert local_place.database_file.read_bytes() == content


def test_a_server_that_takes_no_changes_is_opened_for_reading(
    server_place: RecordsPlace, postgres: PostgresServer
) -> None:
    records = open_records(server_place, ANNA)
    person = records.persons.add(Person("Anna Berg"))
    records.close()
    database = f"ALTER DATABASE {server_place.url.database}"
    postgres.execute(f"{database} SET default_transaction_read_only = on")
    try:
        records = open_records(server_place, ANNA)
        assert "takes no changes" in str(records.problem)
        assert records.persons.open(person.id) == person
        with pytest.raises(RecordsError, match="for reading only"):
            records.persons.add(Person("Ben"))
        records.close()
    finally:
        postgres.execute(f"{database} RESET default_transaction_read_only")


def test_a_record_that_is_locked_says_so(
    local_place: RecordsPlace, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(database_module, "BUSY_S", 0.1)
    records = open_records(local_place, ANNA)
    holder = sqlite3.connect(local_place.database_file, isolation_level=None)
    holder.execute("BEGIN IMMEDIATE")
    with pytest.raises(Unreachable, match="is held by another program"):
        records.persons.add(Person("Anna"))
    assert records.persons.recent() == []
    holder.execute("ROLLBACK")
    holder.close()
    records.persons.add(Person("Anna"))
    records.close()


def test_a_full_disk_leaves_what_was_there(local_place: RecordsPlace) -> None:
    records = open_records(local_place, ANNA)
    person = records.persons.add(Person("Anna"))
    with records.context.database.reading() as connection:
        pages = connection.execute(text("PRAGMA page_count")).scalar()
        connection.execute(text(f"PRAGMA max_page_count = {pages}"))
    with pytest.raises(FullDatabase, match="free some space"):
        records.persons.change(replace(person, notes="x" * 20_000), person.revision)
    assert records.persons.get(person.id) == person
    assert records.audit.verify().is_intact
    records.close()


@pytest.mark.skipif(binaries() is None, reason="PostgreSQL is not installed")
def test_a_server_that_goes_away_is_told_and_comes_back(tmp_path: Path) -> None:
    with running_server() as server:
        place = RecordsPlace.of_url(server.url("postgres"), tmp_path)
        records = open_records(place, ANNA)
        records.persons.add(Person("Anna"))
        server.stop("immediate")
        with pytest.raises(Unreachable, match="does not answer"):
            records.persons.add(Person("Ben"))
        with pytest.raises(Unreachable, match="does not answer"):
            records.changes_since(0)
        server.start()
        records.persons.add(Person("Carl"))
        assert {p.name for p in records.persons.recent()} >= {"Carl"}
        records.close()


@pytest.mark.skipif(binaries() is None, reason="PostgreSQL is not installed")
def test_what_a_server_answers_is_not_told_as_trouble_of_the_network(tmp_path: Path) -> None:
    with running_server() as server:
        server.execute("CREATE USER clinic PASSWORD 'right'")
        rules = Path(server.data) / "pg_hba.conf"
        asks = "local records,nothing clinic scram-sha-256\n"
        rules.write_text(f"local postgres {server.user} trust\n{asks}", "utf-8")
        server.execute("SELECT pg_reload_conf()")
        for password, database, told in (
            ("", "records", "asks for a password; type it"),
            ("wrong", "records", "refuses the user or the password"),
            ("right", "nothing", "has no such database"),
            ("right", "other", "does not let this computer in"),
        ):
            url = f"postgresql://clinic@/{database}?host={server.folder}"
            place = RecordsPlace.of_url(url, tmp_path).with_password(password)
            with pytest.raises(Unreachable, match=f"answers, and {told}") as refused:
                open_records(place, ANNA)
            assert "network" not in str(refused.value)
        server.execute("ALTER USER clinic CONNECTION LIMIT 0")
        server.execute("CREATE DATABASE records OWNER clinic")
        url = f"postgresql://clinic@/records?host={server.folder}"
        with pytest.raises(Unreachable, match="takes no more connections"):
            open_records(RecordsPlace.of_url(url, tmp_path).with_password("right"), ANNA)


def test_a_computer_that_nobody_knows_is_told(tmp_path: Path) -> None:
    url = "postgresql://clinic@nowhere.invalid/records?sslrootcert=/nowhere.pem"
    with pytest.raises(Unreachable, match="names a computer that nobody knows here"):
        open_records(RecordsPlace.of_url(url, tmp_path), ANNA)


def test_a_database_that_does_not_exist_is_told(postgres: PostgresServer, tmp_path: Path) -> None:
    place = RecordsPlace.of_url(postgres.url("nothing"), tmp_path)
    with pytest.raises(Unreachable, match='"nothing" does not exist'):
        open_records(place, ANNA)


@pytest.mark.parametrize(
    ("url", "reason"),
    [
        ("mysql://server/records", "cannot use a database of the kind mysql"),
        ("sqlite:///file", "cannot use a database of the kind sqlite"),
        ("server/records", "cannot be read"),
        ("postgresql+psycopg://me@server/records?sslmode=prefer", "sslmode=prefer"),
        ("postgresql+psycopg://me@server/records?sslmode=disable", "sslmode=disable"),
        ("postgresql+psycopg://me@/records?host=server&sslmode=require", "sslmode=require"),
    ],
)
def test_an_address_that_cannot_be_used_is_refused(tmp_path: Path, url: str, reason: str) -> None:
    with pytest.raises(InputError, match=reason):
        RecordsPlace.of_url(url, tmp_path)


def test_connections_to_other_computers_are_verified(tmp_path: Path) -> None:
    place = RecordsPlace.of_url("postgresql://me:secret@server/records", tmp_path)
    assert place.url.query.items() >= {("sslmode", "verify-full"), ("sslrootcert", "system")}
    assert "secret" not in place.name
    assert "secret" not in repr(place)
    own = RecordsPlace.of_url(
        "postgresql://me@server/records?sslrootcert=/etc/clinic.pem", tmp_path
    )
    assert own.url.query["sslrootcert"] == "/etc/clinic.pem"


def test_the_newest_migration_is_the_one_this_program_wants() -> None:
    versions = Path(migrate_module.__file__).parent / "migrations" / "versions"
    assert max(path.stem[1:5] for path in versions.glob("v*.py")) == SCHEMA


SAMPLES = sorted(SCHEMAS.glob("*.sql"))


def test_every_schema_has_a_sample_in_both_databases() -> None:
    revisions = [f"{number:04d}" for number in range(1, int(SCHEMA) + 1)]
    expected = [f"{name}.{kind}.sql" for name in revisions for kind in ("postgresql", "sqlite")]
    assert [sample.name for sample in SAMPLES] == expected


def test_the_newest_samples_have_the_tables_that_are_written_for_them(
    tmp_path: Path, postgres: PostgresServer
) -> None:
    write_newest(tmp_path, postgres)
    written = sorted(tmp_path.glob("*.sql"))
    assert [path.name for path in written] == [path.name for path in SAMPLES[-2:]]
    for path in written:
        assert tables_of_script(path) == tables_of_script(SCHEMAS / path.name)


def tables_of_script(path: Path) -> list[str]:
    """Return a dump without its rows, which may tell when it was made."""
    lines = path.read_text("utf-8").splitlines()
    return [line for line in lines if not line.startswith("INSERT INTO")]


@pytest.mark.parametrize("sample", SAMPLES, ids=lambda path: path.stem)
def test_the_sample_of_every_schema_is_migrated(
    tmp_path: Path, sample: Path, request: pytest.FixtureRequest
) -> None:
    revision, kind = sample.name.split(".")[:2]
    place = place_of_sample(revision, kind, tmp_path, request)
    records = open_records(place, ANNA)
    [person] = records.persons.search("anna")
    assert records.visits.of_person(person.id)[0].findings == "flat foot"
    assert records.orders.of_person(person.id)[0].shop == "CNC"
    assert records.audit.verify().is_intact
    assert len([line for line in records.audit.lines() if line.action != "sealed"]) == 5
    with records.context.database.reading() as connection:
        rows = verify_rows(connection)
    assert (rows.changed, rows.unlogged) == ({}, {})
    records.persons.add(Person("Ben"))
    records.close()


@pytest.mark.parametrize(
    ("kind", "said"),
    [
        (TooManyConnections, "sorry, too many clients already"),
        (OperationalError, "connection failed: FATAL:  remaining connection slots are reserved"),
    ],
)
def test_a_server_with_too_many_connections_says_so(kind: type[Exception], said: str) -> None:
    place = RecordsPlace.of_url("postgresql+psycopg://server/records", Path("contents"))
    error = described(place, DBAPIError("SELECT 1", {}, kind(said)))
    assert isinstance(error, Unreachable)
    assert "takes no more connections" in str(error)
