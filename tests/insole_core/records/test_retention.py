"""Erasure: what the law keeps stays under the pseudonym, all else goes, and the log tells it."""

from __future__ import annotations

from datetime import UTC, date, datetime, timedelta
from pathlib import Path
from typing import Any

import pytest
from backed_up_record import ANNA, MESH, RECIPIENT, SECRET, SESSION, STRANGE, context_of, fill
from sqlalchemy import insert, select, text
from stations import Stations, proven

from insole_core.errors import NotAllowed, RecordsError
from insole_core.records import schema
from insole_core.records.accounts import Accounts
from insole_core.records.audit import AuditLog
from insole_core.records.author import Role
from insole_core.records.backup.back_up import back_up, set_up_backups
from insole_core.records.backup.backup_key import BackupKey
from insole_core.records.backup.restore import restore
from insole_core.records.clinic import write_setting
from insole_core.records.content_store import GRACE_S, SweptContents
from insole_core.records.context import RecordsContext
from insole_core.records.merging import Merge
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records
from insole_core.records.retention import (
    YEARS_VALUE,
    Erasure,
    ErasureReason,
    erase_person,
    find_erasable,
    keep_for,
    kept_until,
    over_retention,
    over_retention_named,
    sweep_contents,
)
from insole_core.records.signing import SignatureReport, verify_signatures
from insole_core.records.visit import Visit

TODAY = date(2026, 11, 22)
MUCH_LATER = date(2040, 1, 1)
REQUEST, OVER = ErasureReason.REQUEST, ErasureReason.RETENTION_OVER


@pytest.fixture
def context(stations: Stations) -> RecordsContext:
    """A record with a person who has a signed prescription and an order."""
    context = stations.open().context
    mesh, session = context.contents.put(MESH), context.contents.put(SESSION)
    fill(context, mesh, session)
    with context.database.writing() as connection:
        connection.execute(text(
            "UPDATE persons SET search_text = ' eva ', contact = 'Storgatan 1', notes = 'so sly',"
            " personal_number = '19700228-1234', consent_on = '2026-11-22'"
        ))  # fmt: skip
        connection.execute(text("UPDATE visits SET reason = 'pain, left', findings = 'flat foot'"))
        connection.execute(text("UPDATE orders SET remarks = 'for Eva'"))
        connection.execute(insert(schema.follow_ups).values(
            id="f", person_id="kept", order_id="o", visit_id="v", on_date=date(2027, 1, 10),
            outcome="worn", notes="told of her son", author="anna", created_at="2027-01-10",
        ))  # fmt: skip
        connection.execute(insert(schema.captures).values(
            id="unused", visit_id="v", number=2, kind="session", file_name="second.zip",
            content_sha256=session, program_version="0.1", created_at="2026", author="anna",
        ))  # fmt: skip
    return context


def rows(context: RecordsContext, table: Any) -> list[Any]:
    with context.database.reading() as connection:
        return list(connection.execute(select(table)))


def everything(context: RecordsContext) -> str:
    """Return all that the record states, but for the surfaces."""
    return repr([rows(context, table) for table in schema.metadata.sorted_tables])


# Words that no key of a backup, which is drawn by lot, can hold by chance.
PERSONAL = [STRANGE[:3], " eva ", "Storgatan", "so sly", "19700228", "1970, 2, 28", "pain, left",
            "flat foot", "for Eva", "her son", "70.1"]  # fmt: skip


def test_with_a_capture_stays_its_correction_which_may_say_which_foot_it_is(
    context: RecordsContext,
) -> None:
    with context.database.writing() as connection:
        (used,) = connection.execute(
            select(schema.captures.c.content_sha256).where(schema.captures.c.id == "c")
        ).scalars()
        connection.execute(insert(schema.captures).values(
            id="corrected", visit_id="v", number=3, kind="session", file_name="third.zip",
            content_sha256=used, source_sha256=used, program_version="0.1", created_at="2026",
            author="anna",
        ))  # fmt: skip
    erase_person(context, "kept", REQUEST, TODAY)
    assert [row.id for row in rows(context, schema.captures)] == ["c", "corrected"]


def test_on_request_the_device_stays_under_the_pseudonym(context: RecordsContext) -> None:
    assert [word for word in PERSONAL if word not in everything(context)] == []
    erasure = erase_person(context, "kept", REQUEST, TODAY)
    assert erasure == Erasure("kept", date(2037, 1, 10))
    assert [word for word in PERSONAL if word in everything(context)] == []
    names = {row.id: row.name for row in rows(context, schema.persons)}
    assert names == {"kept": "26-A", "merged": "26-B"}
    assert all(row.is_erased for row in rows(context, schema.persons))
    (version,) = rows(context, schema.prescription_versions)
    assert version.signed_by == "anna"
    (order,) = rows(context, schema.orders)
    assert (order.number, order.state) == ("26-7KQ4M", "sent")
    # The scan that the device was made from stays; the other capture documents no device.
    assert [row.id for row in rows(context, schema.captures)] == ["c"]
    with context.database.reading() as connection:
        assert verify_signatures(connection) == SignatureReport(checked=1)
    assert AuditLog(context.database, ANNA).verify().is_intact


def test_after_the_time_of_keeping_nothing_stays_but_the_fact(context: RecordsContext) -> None:
    erasure = erase_person(context, "kept", OVER, MUCH_LATER)
    assert erasure == Erasure("kept", None, visits=1, prescriptions=1, captures=2, orders=1)
    for table in (schema.visits, schema.prescription_versions, schema.captures, schema.orders,
                  schema.order_feet, schema.order_files, schema.follow_ups):  # fmt: skip
        assert rows(context, table) == []
    assert [word for word in PERSONAL if word in everything(context)] == []
    with context.database.reading() as connection:
        assert verify_signatures(connection) == SignatureReport(checked=0)
    lines = AuditLog(context.database, ANNA).lines()
    assert (lines[0].action, lines[0].subject_id, lines[0].author) == ("erased", "kept", "anna")
    assert '"reason":"retention over"' in lines[0].details
    assert AuditLog(context.database, ANNA).verify().is_intact


def test_what_was_kept_for_the_law_goes_later(context: RecordsContext) -> None:
    erase_person(context, "kept", REQUEST, TODAY)
    assert over_retention(context, TODAY) == []
    assert over_retention(context, MUCH_LATER) == ["kept"]
    assert erase_person(context, "kept", OVER, MUCH_LATER).visits == 1
    assert over_retention(context, MUCH_LATER) == []


def test_erased_text_is_not_left_in_a_local_file(context: RecordsContext) -> None:
    place = context.database.place
    if not place.is_local:
        pytest.skip("a server cleans up by itself, in time")

    def content() -> bytes:
        files = place.database_file.parent.glob("records.sqlite3*")
        return b"".join(path.read_bytes() for path in files)

    assert b"Storgatan" in content()
    erase_person(context, "kept", REQUEST, TODAY)
    for word in (b"Storgatan", b"19700228", b"flat foot", STRANGE.encode()):
        assert word not in content()


def test_others_are_not_touched(context: RecordsContext) -> None:
    values = {"name": "Ida", "pseudonym": "26-C", "search_text": " ida ", "created_at": "2026",
              "changed_at": "2026", "revision": 1, "contact": "Torget 2"}  # fmt: skip
    with context.database.writing() as connection:
        connection.execute(insert(schema.persons).values(id="ida", **values))
        connection.execute(insert(schema.visits).values(
            id="w", person_id="ida", visited_on=TODAY, findings="sore", created_at="2026",
            changed_at="2026", revision=1,
        ))  # fmt: skip
    erase_person(context, "kept", OVER, MUCH_LATER)
    assert [word for word in ("Ida", " ida ", "Torget 2", "sore") if word in everything(context)]
    (ida,) = [row for row in rows(context, schema.persons) if row.id == "ida"]
    assert (ida.name, ida.is_erased, ida.revision) == ("Ida", False, 1)
    (visit,) = rows(context, schema.visits)
    assert visit.findings == "sore"


def test_the_time_of_keeping_follows_the_last_entry_and_the_clinic(
    context: RecordsContext,
) -> None:
    # never less than the law, nor more than a calendar has
    for years, until in ((None, 2037), (15, 2042), (1, 2037), (150, 2177), (3000, 5027)):
        with context.database.writing() as connection:
            write_setting(connection, YEARS_VALUE, 10 if years is None else years)
        with context.database.reading() as connection:
            assert kept_until(connection, "kept") == date(until, 1, 10)
        assert over_retention(context, TODAY) == []
    with context.database.writing() as connection:
        write_setting(connection, YEARS_VALUE, 10**12)
    with context.database.reading() as connection:
        assert kept_until(connection, "kept") == date.max
    assert over_retention(context, TODAY) == []
    keep_for(context, 20)
    latest = max(rows(context, schema.audit), key=lambda line: line.seq)
    assert str(10**12) in repr(latest)


def test_a_leap_day_is_kept_a_day_longer(context: RecordsContext) -> None:
    with context.database.writing() as connection:
        connection.execute(text("UPDATE follow_ups SET on_date = '2028-02-29'"))
    with context.database.reading() as connection:
        assert kept_until(connection, "kept") == date(2038, 3, 1)


def test_a_person_is_due_after_the_last_entry_of_any_kind(context: RecordsContext) -> None:
    assert over_retention(context, date(2037, 1, 9)) == []  # the last visit was in 2026
    assert over_retention(context, date(2037, 1, 10)) == ["kept"]


def test_only_the_administrator_erases(context: RecordsContext) -> None:
    Accounts(context.database, ANNA).switch_on("chef", "Carla Chef", "vier Schuhe gehen")
    for work in (lambda: erase_person(context, "kept", REQUEST, TODAY),
                 lambda: over_retention(context, TODAY)):  # fmt: skip
        with pytest.raises(NotAllowed):
            work()
    assert "Storgatan" in everything(context)
    chef = RecordsContext(context.database, context.contents, proven("chef", Role.ADMINISTRATOR))
    erase_person(chef, "kept", REQUEST, TODAY)


def test_who_is_not_there_or_merged_is_told(context: RecordsContext) -> None:
    with pytest.raises(RecordsError, match="no longer in the record"):
        erase_person(context, "nobody", REQUEST, TODAY)
    with pytest.raises(RecordsError, match="merged with another one"):
        erase_person(context, "merged", REQUEST, TODAY)


def test_files_of_erased_persons_leave_the_disk_with_the_sweeps(context: RecordsContext) -> None:
    now = datetime.now(UTC)
    later = [now + timedelta(seconds=days * (GRACE_S + 60)) for days in range(1, 3)]
    assert sweep_contents(context, later[0]) == SweptContents()
    erase_person(context, "kept", OVER, MUCH_LATER)
    assert sweep_contents(context, later[0]) == SweptContents(set_aside=2)
    assert sweep_contents(context, later[1]) == SweptContents(deleted=2)
    assert list(context.contents.digests()) == []
    assert rows(context, schema.contents) == []


def test_an_earlier_backup_does_not_bring_an_erased_person_back(
    context: RecordsContext, tmp_path: Path
) -> None:
    set_up_backups(context, BackupKey.for_recipients([RECIPIENT]))
    back_up(context, tmp_path / "backups")
    erase_person(context, "kept", REQUEST, TODAY)
    back_up(context, tmp_path / "backups")
    place = RecordsPlace.local(tmp_path / "restored")
    report = restore(tmp_path / "backups", SECRET, place, ANNA, number=1)
    assert report.erased_again == 1
    restored = context_of(place)
    assert [word for word in PERSONAL if word in everything(restored)] == []
    restored.database.close()


def test_the_record_that_is_set_aside_is_asked_who_was_erased(
    context: RecordsContext, tmp_path: Path
) -> None:
    """No backup was made since; the record that cannot be read is told of."""
    place = RecordsPlace.local(tmp_path / "restored")
    set_up_backups(context, BackupKey.for_recipients([RECIPIENT]))
    back_up(context, tmp_path / "backups")
    report = restore(tmp_path / "backups", SECRET, place, ANNA)
    assert (report.erased_again, report.is_erasure_unknown) == (0, False)
    restored = context_of(place)
    assert "Storgatan" in everything(restored)
    erase_person(restored, "kept", REQUEST, TODAY)
    restored.database.close()
    report = restore(tmp_path / "backups", SECRET, place, ANNA, replace_existing=True)
    assert (report.erased_again, report.is_erasure_unknown) == (1, False)
    restored = context_of(place)
    assert [word for word in PERSONAL if word in everything(restored)] == []
    restored.database.close()
    place.database_file.write_bytes(b"no database at all" * 1000)
    report = restore(tmp_path / "backups", SECRET, place, ANNA, replace_existing=True)
    assert (report.erased_again, report.is_erasure_unknown) == (0, True)
    assert report.set_aside is not None


def test_who_may_be_erased_is_found_by_the_pseudonym_without_a_name(
    context: RecordsContext,
) -> None:
    with context.database.reading() as connection:
        pseudonym = connection.execute(
            select(schema.persons.c.pseudonym).where(schema.persons.c.id == "kept")
        ).scalar_one()
        until = kept_until(connection, "kept")
    found = find_erasable(context, f" {pseudonym} ")
    assert find_erasable(context, pseudonym.swapcase()) == found
    assert (found.person_id, found.visits, found.orders) == ("kept", 1, 1)
    assert found.kept_until == until
    assert found in over_retention_named(context, MUCH_LATER)
    assert over_retention_named(context, TODAY) == []
    erase_person(context, "kept", OVER, MUCH_LATER)
    with pytest.raises(RecordsError, match="nobody to erase"):
        find_erasable(context, pseudonym)
    with pytest.raises(RecordsError, match="nobody to erase"):
        find_erasable(context, "P-UNKNOWN")


def merged_in_a_row(records: Records) -> tuple[list[Person], list[Merge]]:
    """Return three persons, the last one merged into the second, and that one into the first."""
    people = [
        records.persons.add(Person(name, contact=f"{name} street", notes=f"of {name}"))
        for name in ("Disa", "Berit", "Carin")
    ]
    for person in people:
        records.visits.add(Visit(person.id, TODAY, findings=f"foot of {person.name}"))
    disa, berit, carin = (person.id for person in people)
    return people, [records.persons.merge(berit, carin), records.persons.merge(disa, berit)]


def test_erasure_reaches_those_merged_through_others(records: Records) -> None:
    people, merges = merged_in_a_row(records)
    erase_person(records.context, people[0].id, REQUEST, TODAY)
    stated = everything(records.context)
    assert [p.name for p in people if p.name in stated or p.name.lower() in stated] == []
    assert all(row.is_erased for row in rows(records.context, schema.persons))
    with pytest.raises(RecordsError, match="cannot be undone"):
        records.persons.undo_merge(merges[1])


def test_erasure_spares_who_was_taken_apart_again(records: Records) -> None:
    (disa, *others), merges = merged_in_a_row(records)
    records.persons.undo_merge(merges[1])
    erase_person(records.context, others[0].id, REQUEST, TODAY)
    stated = everything(records.context)
    assert [p.name for p in others if p.name in stated or p.name.lower() in stated] == []
    assert records.persons.get(disa.id).contact == "Disa street"
    assert [v.findings for v in records.visits.of_person(disa.id)] == ["foot of Disa"]
