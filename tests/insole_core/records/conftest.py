"""A record in both databases; each test gets a copy of one whose tables are made already."""

from __future__ import annotations

import shutil
import uuid
from collections.abc import Iterator
from pathlib import Path

import pytest
from postgres_server import PostgresServer, binaries, running_server
from stations import ANNA, Stations

from insole_core.cases.case_record import FootRecord, ScanSource
from insole_core.foot.foot import Foot
from insole_core.records.database import Database
from insole_core.records.migrate import SCHEMA
from insole_core.records.open import open_records
from insole_core.records.place import DATABASE_FILE, RecordsPlace
from insole_core.records.records import Records


@pytest.fixture(scope="session")
def postgres() -> Iterator[PostgresServer]:
    """A server for the whole session, as fast as a power failure does not matter."""
    if binaries() is None:
        pytest.skip("PostgreSQL is not installed")
    with running_server() as server:
        server.execute("CREATE DATABASE migrated")
        place = RecordsPlace.of_url(server.url("migrated"), server.folder / "none")
        open_records(place, ANNA).close()
        yield server


@pytest.fixture(scope="session")
def migrated_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An SQLite database with tables and nothing in them."""
    folder = tmp_path_factory.mktemp("migrated")
    open_records(RecordsPlace.local(folder), ANNA).close()
    return folder / DATABASE_FILE


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
def server_place(tmp_path: Path, postgres: PostgresServer) -> Iterator[RecordsPlace]:
    name = f"t{uuid.uuid4().hex}"
    postgres.execute(f"CREATE DATABASE {name} TEMPLATE migrated")
    yield RecordsPlace.of_url(postgres.url(name), tmp_path / "contents")
    postgres.execute(f"DROP DATABASE {name} WITH (FORCE)")


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
def database(local_place: RecordsPlace) -> Iterator[Database]:
    """The database of an empty record of one computer."""
    database = Database(local_place)
    database.schema = SCHEMA
    yield database
    database.close()


@pytest.fixture
def foot_record(left_foot: Foot) -> FootRecord:
    """A left foot with a prescription without corrections."""
    return FootRecord.begun(left_foot, ScanSource("mesh", "left.stl", "a" * 64))


@pytest.fixture
def right_record(right_foot: Foot) -> FootRecord:
    """A right foot with a prescription without corrections."""
    return FootRecord.begun(right_foot, ScanSource("mesh", "right.stl", "b" * 64))
