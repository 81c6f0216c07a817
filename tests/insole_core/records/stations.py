"""Those who work on the record of a test, each at a station."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from weakref import WeakKeyDictionary

import pytest
from argon2 import PasswordHasher
from sqlalchemy import Connection, Engine, Table, event

from insole_core.cases.stored_mesh import pack_mesh
from insole_core.geometry.mesh import TriangleMesh
from insole_core.records import database, passwords, prescriptions
from insole_core.records import records as open_module
from insole_core.records.accounts import Account, Accounts
from insole_core.records.author import Author, Proof, Role
from insole_core.records.backup import back_up, portable_rows, restore
from insole_core.records.database import Database
from insole_core.records.migrate import migrate
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records, open_records

ANNA = Author("anna", "desk")
BEN = Author("ben", "capture room")
FIRST = "told across the desk"


def proven(name: str, role: Role = Role.ORTHOPEDIST, station: str = "desk") -> Author:
    """Return somebody who has signed in with a password."""
    return Author(name, station, role, Proof.PASSWORD)


def add_member(accounts: Accounts, name: str, full_name: str, role: Role, password: str) -> Account:
    """Add an account whose owner has chosen their password."""
    added = accounts.add(name, full_name, role, FIRST)
    accounts.change_password(name, FIRST, password)
    return replace(added, has_first_password=False)


def keep_quickly(patch: pytest.MonkeyPatch) -> None:
    """Do in less time than the product what each record of a test would need again.

    Passwords are hashed quickly, a surface is packed once, a statement is compiled and tables are
    read from a schema once for all records, and what SQLite keeps is not waited for: no test cuts
    the power.
    """
    packed: WeakKeyDictionary[TriangleMesh, bytes] = WeakKeyDictionary()

    def pack_once(mesh: TriangleMesh) -> bytes:
        if mesh not in packed:
            packed[mesh] = pack_mesh(mesh)
        return packed[mesh]

    patch.setattr(passwords, "_HASHER", PasswordHasher(1, 8, 1))
    patch.setattr(prescriptions, "pack_mesh", pack_once)
    patch.setattr(database, "_engine", _sharing_compiled(database._engine))
    patch.setattr(database, "_connect_file", unsynced)
    reflected = _reflected_once(portable_rows.tables_of)
    for module in (back_up, restore):
        patch.setattr(module, "tables_of", reflected)


SYNCED = database._connect_file


def unsynced(path: Path, read_only: bool) -> sqlite3.Connection:
    """Open a database as the product does, but for the disk."""
    connection = SYNCED(path, read_only)
    if not read_only:
        connection.execute("PRAGMA synchronous=OFF")
    return connection


def _reflected_once(
    tables_of: Callable[[Connection], list[Table]],
) -> Callable[[Connection], list[Table]]:
    """Give equal SQLite schemas the same tables."""
    known: dict[tuple[str | None, ...], list[Table]] = {}

    def reflected(connection: Connection) -> list[Table]:
        if connection.dialect.name != "sqlite":
            return tables_of(connection)
        key = tuple(connection.exec_driver_sql("SELECT sql FROM sqlite_master").scalars())
        if key not in known:
            known[key] = tables_of(connection)
        return known[key]

    return reflected


def _sharing_compiled(make: Callable[..., Engine]) -> Callable[..., Engine]:
    """Let engines share the statements that one of their kind has compiled."""
    first: dict[str, Engine] = {}

    def shared(place: RecordsPlace, read_only: bool) -> Engine:
        engine = make(place, read_only)
        known = first.get(engine.dialect.name)
        if known is None:  # until one is connected, nothing is known of its database
            event.listen(engine, "connect", lambda *_: first.setdefault(engine.name, engine))
        else:
            engine.dialect = engine.pool._dialect = known.dialect
            engine._compiled_cache = known._compiled_cache
        return engine

    return shared


def make_tables(place: RecordsPlace) -> None:
    """Make the tables of a record in a database without any."""
    database = Database(place)
    migrate(database)
    database.close()


def migrated_database(folder: Path) -> Path:
    """Make an SQLite database with tables and nothing in them."""
    place = RecordsPlace.local(folder)
    place.database_file.touch()
    make_tables(place)
    return place.database_file


def begin_migrated(patch: pytest.MonkeyPatch, content: bytes) -> None:
    """Let a new record begin as a copy of one whose tables are made already."""
    make_file = open_module._make_file

    def make_migrated(path: Path) -> None:
        make_file(path)
        path.write_bytes(content)

    patch.setattr(open_module, "_make_file", make_migrated)


@dataclass
class Stations:
    """A place, and the records that stations have open there."""

    place: RecordsPlace
    opened: list[Records]

    def open(self, who: Author = ANNA) -> Records:
        records = open_records(self.place, who)
        self.opened.append(records)
        return records
