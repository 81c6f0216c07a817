"""Before the tables of a record are changed, it is kept as it was, and can be put back."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from datetime import date
from typing import Any

import pytest
from record_samples import place_of_sample
from sqlalchemy import delete, text
from stations import ANNA, Stations, proven

from insole_core.errors import NotAllowed, OutputError, RecordsError
from insole_core.records import migrate
from insole_core.records.author import Role
from insole_core.records.database import Database
from insole_core.records.migrate import SCHEMA, copies_of, put_back, schema_of
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records, open_records
from insole_core.records.retention import ErasureReason, erase_person
from insole_core.records.schema import clinic

OLDER = f"{int(SCHEMA) - 1:04d}"


@pytest.fixture(params=["sqlite", "postgresql"])
def older(request: pytest.FixtureRequest, tmp_path) -> RecordsPlace:
    """A record with the tables before the newest ones, and a person."""
    place = place_of_sample(OLDER, request.param, tmp_path, request)
    with closing(Database(place)) as database, database.writing() as connection:
        connection.execute(delete(clinic))  # whose files are not here
    return place


def names(records: Records) -> list[str]:
    return [person.name for person in records.persons.search("")] or [
        person.name for person in records.persons.recent()
    ]


def test_a_copy_is_kept_told_and_put_back(older: RecordsPlace) -> None:
    with closing(open_records(older, ANNA)) as records:
        (copy,) = copies_of(records.context.database)
        assert copy in str(records.upgrade)
        records.persons.add(Person("Ben Ek"))
        with pytest.raises(RecordsError, match="no copy elsewhere"):
            put_back(records.context, "elsewhere")
        kept = put_back(records.context, copy)
    with closing(Database(older)) as database, database.reading() as connection:
        assert schema_of(connection) == OLDER
    with closing(open_records(older, ANNA)) as records:
        assert names(records) == ["Anna Berg"]
        assert records.audit.verify().is_intact
        assert kept in copies_of(records.context.database)
        records.persons.add(Person("Carl Dal"))
        put_back(records.context, kept)
    with closing(open_records(older, ANNA)) as records:
        assert records.upgrade is None
        assert sorted(names(records)) == ["Anna Berg", "Ben Ek"]
        assert records.audit.verify().is_intact


def test_nothing_is_kept_of_a_new_or_a_present_record(stations: Stations) -> None:
    records = stations.open()
    assert records.upgrade is None
    assert copies_of(records.context.database) == []


def test_a_record_that_cannot_be_copied_is_not_upgraded(
    older: RecordsPlace, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_arguments: object) -> None:
        raise OutputError("The disk is full.")

    monkeypatch.setattr(migrate, "_copy_file", full)
    monkeypatch.setattr(migrate, "_copy_to_schema", full)
    with pytest.raises(OutputError, match="disk is full"):
        open_records(older, ANNA)
    with closing(Database(older)) as database, database.reading() as connection:
        assert schema_of(connection) == OLDER


def test_a_copy_that_cannot_be_put_back_leaves_the_record_as_it_is(older: RecordsPlace) -> None:
    with closing(open_records(older, ANNA)) as records:
        (copy,) = copies_of(records.context.database)
        records.context.contents.put(b"a scan")
        records.persons.add(Person("Ben Ek"))
        if older.is_local:
            older.database_file.with_name(copy).write_bytes(b"no database" * 1000)
        else:
            with records.context.database.writing() as connection:
                connection.execute(text(f'DROP TABLE "{copy}".audit_head'))
        with pytest.raises((OutputError, RecordsError)):
            put_back(records.context, copy)
    with closing(open_records(older, ANNA)) as records:
        assert sorted(names(records)) == ["Anna Berg", "Ben Ek"]
        assert records.audit.head()[0] in records.context.database.witness.read()


def test_what_another_station_changes_meanwhile_is_in_what_is_kept(
    older: RecordsPlace, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It writes in the moment between the copy of the record and the exchange."""
    if not older.is_local:
        pytest.skip("a server does both in one transaction")
    with closing(open_records(older, ANNA)) as records, closing(open_records(older, ANNA)) as other:
        (copy,) = copies_of(records.context.database)
        overwrite, coming = migrate._overwrite, [Person("Ben Ek")]

        def after_the_other_station(*arguments: Any) -> None:
            for person in coming:
                other.persons.add(person)
            coming.clear()
            overwrite(*arguments)

        monkeypatch.setattr(migrate, "_overwrite", after_the_other_station)
        kept = put_back(records.context, copy)
        assert sorted(copies_of(records.context.database)) == sorted([copy, kept])
    with closing(sqlite3.connect(older.database_file.with_name(kept))) as database:
        found = database.execute("SELECT name FROM persons ORDER BY name").fetchall()
    assert found == [("Anna Berg",), ("Ben Ek",)]


def test_somebody_who_is_erased_is_in_no_copy(older: RecordsPlace) -> None:
    with closing(open_records(older, ANNA)) as records:
        (person,) = records.persons.recent()
        erase_person(records.context, person.id, ErasureReason.REQUEST, date.today())
        assert copies_of(records.context.database) == []


def test_only_an_administrator_puts_a_copy_back(older: RecordsPlace) -> None:
    with closing(open_records(older, ANNA)) as records:
        records.accounts.switch_on("chef", "Carla Chef", "vier Schuhe gehen")
        (copy,) = copies_of(records.context.database)
        with pytest.raises(NotAllowed):
            put_back(records.context, copy)
        chef = records.for_author(proven("chef", Role.ADMINISTRATOR))
        put_back(chef.context, copy)
