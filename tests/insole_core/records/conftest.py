"""An empty record for each test; its tables are made once, since that takes half a second."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from insole_core.records.database import Database
from insole_core.records.migrate import SCHEMA, migrate
from insole_core.records.place import RecordsPlace


@pytest.fixture(scope="session")
def empty_database_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An SQLite database with all tables, to be copied."""
    place = RecordsPlace.local(tmp_path_factory.mktemp("empty record"))
    place.database_file.touch()
    database = Database(place)
    migrate(database)
    database.close()
    return place.database_file


@pytest.fixture
def database(empty_database_file: Path, tmp_path: Path) -> Iterator[Database]:
    """The database of an empty record of one computer."""
    place = RecordsPlace.local(tmp_path / "record")
    place.database_file.parent.mkdir()
    shutil.copy(empty_database_file, place.database_file)
    database = Database(place)
    database.schema = SCHEMA
    yield database
    database.close()
