"""A record in both databases; each test gets a copy of one whose tables are made already."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from postgres_server import PostgresServer, binaries, running_server
from stations import Stations, keep_quickly, make_tables, migrated_database

from insole_core.cases.case_record import FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.records.database import Database
from insole_core.records.migrate import SCHEMA
from insole_core.records.place import DATABASE_FILE, RecordsPlace
from insole_core.records.records import Records
from insole_core.records.schema import FIRST_HASH, metadata

_EMPTY = "; ".join(
    (
        "SET session_replication_role = replica",  # neither triggers nor keys object
        *(f"DELETE FROM {table}" for table in metadata.tables if table != "audit_head"),
        f"UPDATE audit_head SET seq = 0, hash = '{FIRST_HASH}'",
        f"UPDATE alembic_version SET version_num = '{SCHEMA}'",
    )
)


@pytest.fixture(scope="session", autouse=True)
def quick_keeping() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        keep_quickly(patch)
        yield


@pytest.fixture(scope="session")
def postgres() -> Iterator[PostgresServer]:
    """A server for the whole session, as fast as a power failure does not matter."""
    if binaries() is None:
        pytest.skip("PostgreSQL is not installed")
    with running_server() as server:
        server.execute("CREATE DATABASE migrated")
        make_tables(RecordsPlace.of_url(server.url("migrated"), server.folder))
        yield server


@pytest.fixture(scope="session")
def migrated_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An SQLite database with tables and nothing in them."""
    return migrated_database(tmp_path_factory.mktemp("migrated"))


@pytest.fixture
def local_place(tmp_path: Path, migrated_file: Path) -> RecordsPlace:
    folder = tmp_path / "record"
    folder.mkdir()
    shutil.copyfile(migrated_file, folder / DATABASE_FILE)
    return RecordsPlace.local(folder)


@pytest.fixture
def database(local_place: RecordsPlace) -> Iterator[Database]:
    """The database of an empty record of one computer."""
    database = Database(local_place)
    database.schema = SCHEMA
    yield database
    database.close()


@pytest.fixture
def server_place(tmp_path: Path, postgres: PostgresServer) -> RecordsPlace:
    """The one database of the server, emptied: another one would take a third of a second."""
    postgres.execute(_EMPTY, database="migrated")
    return RecordsPlace.of_url(postgres.url("migrated"), tmp_path / "contents")


@pytest.fixture(params=["sqlite", "postgresql"])
def stations(request: pytest.FixtureRequest) -> Iterator[Stations]:
    """A place in each database."""
    name = "local_place" if request.param == "sqlite" else "server_place"
    stations = Stations(request.getfixturevalue(name), [])
    yield stations
    for records in stations.opened:
        records.close()


@pytest.fixture
def records(stations: Stations) -> Records:
    """An open record in each database."""
    return stations.open()


@pytest.fixture
def foot_record(left_foot: Foot) -> FootRecord:
    """A left foot with a prescription without corrections."""
    return FootRecord.begun(left_foot, ScanSource("mesh", "left.stl", "a" * 64))


@pytest.fixture
def right_record(right_foot: Foot) -> FootRecord:
    """A right foot with a prescription without corrections."""
    return FootRecord.begun(right_foot, ScanSource("mesh", "right.stl", "b" * 64))
