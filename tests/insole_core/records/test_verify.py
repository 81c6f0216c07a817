"""A verification of the record names everything that is not what was stored."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable
from contextlib import closing
from datetime import date
from pathlib import Path
from typing import Any

import pytest
from backed_up_record import MESH, RECIPIENT, SESSION, fill
from sqlalchemy import Boolean, Column, Date, Text, func, select, text, update
from stations import Stations
from tampering import without_triggers

from insole_core.errors import NotAllowed, RecordsError
from insole_core.records import verify
from insole_core.records.accounts import Accounts
from insole_core.records.audit import AuditLog, head_of
from insole_core.records.audit_search import verify_audit
from insole_core.records.author import Role
from insole_core.records.backup.back_up import set_up_backups
from insole_core.records.backup.backup_key import BackupKey
from insole_core.records.content_store import HEAD_FILE
from insole_core.records.context import RecordsContext
from insole_core.records.marks import mark_of
from insole_core.records.person import Person
from insole_core.records.records import Records
from insole_core.records.retention import ErasureReason, erase_person
from insole_core.records.rights import require
from insole_core.records.row_report import problems_of_rows, verify_rows
from insole_core.records.row_seals import SEALED, digests_of
from insole_core.records.schema import persons
from insole_core.records.verify import verify_record
from insole_core.records.visit import FollowUp, Visit


@pytest.fixture
def context(stations: Stations) -> RecordsContext:
    context = stations.open().context
    fill(context, context.contents.put(MESH), context.contents.put(SESSION))
    return context


def test_a_sound_record_is_sound(context: RecordsContext) -> None:
    report = verify_record(context)
    assert report.problems() == []
    assert report.is_sound
    assert (report.audit.lines, report.signatures.checked, report.contents.checked) == (
        AuditLog(context.database, context.author).head()[0], 1, 2,
    )  # fmt: skip


def test_everything_that_is_wrong_is_named(context: RecordsContext) -> None:
    digests = sorted(context.contents.digests())
    context.contents.path(digests[0]).write_bytes(b"changed on the disk")
    context.contents.path(digests[1]).unlink()
    with without_triggers(context.database) as connection:
        connection.execute(text("UPDATE audit SET author = 'eva' WHERE seq = 2"))
        connection.execute(text("UPDATE prescription_versions SET document = 'x'"))
    first, *others = verify_record(context).problems()
    assert "Line 2 of the audit log" in first
    assert [sentence.split(":")[0] for sentence in others] == [
        "One signed prescription is not what was signed",
        "One file was changed since the record stored it",
        "One file of the record is missing",
        "One row of prescription is not what the audit log says was stored",
    ]
    assert digests[0][:12] in others[1]


def set_up(stations: Stations) -> Records:
    """A record in which everything was done through the program, with accounts on."""
    records = stations.open()
    eva = records.persons.add(Person("Eva Berg", date(1971, 4, 2), notes="shy"))
    visit = records.visits.add(Visit(eva.id, date(2026, 11, 22), findings="flat foot"))
    follow_up = FollowUp(eva.id, date(2026, 11, 22), "better", visit_id=visit.id)
    records.follow_ups.add(follow_up)
    records.clinic.set("name", "Foot clinic")
    set_up_backups(records.context, BackupKey.for_recipients([RECIPIENT]))
    other = records.persons.add(Person("Eva Berg", contact="Storgatan 1"))
    records.visits.add(Visit(other.id, date(2026, 11, 21)))
    records.persons.undo_merge(records.persons.merge(eva.id, other.id))
    records.persons.merge(eva.id, other.id)
    accounts = Accounts(records.context.database, records.who)
    accounts.switch_on("chef", "Carla", "vier Schuhe gehen")
    return records.for_author(accounts.sign_in("chef", "vier Schuhe gehen"))


BEHIND_THE_BACK = (
    ("One row of account is not what", "UPDATE accounts SET role = 'technician'"),
    ("One row of account is not what", "UPDATE accounts SET password_hash = 'mine'"),
    ("One row of person is not what", "UPDATE persons SET name = 'Ida' WHERE notes = 'shy'"),
    ("One row of clinic is not what", "UPDATE clinic SET value = '1' WHERE key = 'name'"),
    ("One row of visit is not what", "UPDATE visits SET findings = 'none' WHERE findings <> ''"),
    ("One row of follow up is gone", "DELETE FROM follow_ups"),
    ("One row of account is in no line",
     "INSERT INTO accounts (id, name, full_name, role, password_hash, changed_at) "
     "VALUES ('x', 'x', 'x', 'administrator', 'x', 'x')"),
    ("One row of clinic is not what", "UPDATE clinic SET value = 'mine' WHERE key = 'backup_key'"),
    ("One row of clinic is gone", "DELETE FROM clinic WHERE key = 'backup_key'"),
    ("One row of clinic is in no line", "INSERT INTO clinic VALUES ('retention_years', '1')"),
    ("Accounts are off, although nobody", "DELETE FROM clinic WHERE key = 'accounts_on'"),
)  # fmt: skip


def test_what_was_done_behind_the_back_of_the_program_is_told(stations: Stations) -> None:
    context = set_up(stations).context
    assert verify_record(context).problems() == []
    with without_triggers(context.database) as connection:
        for told, change in BEHIND_THE_BACK:
            with connection.begin_nested() as step:
                connection.execute(text(change))
                (problem,) = problems_of_rows(verify_rows(connection))
                step.rollback()
            assert told in problem, change
        assert list(problems_of_rows(verify_rows(connection))) == []


def test_a_log_whose_end_was_cut_off_is_told(stations: Stations) -> None:
    records = set_up(stations)
    context, lines = records.context, records.audit.head()[0]
    for cut in (1, 3):
        with without_triggers(context.database) as connection:
            connection.execute(text(f"DELETE FROM audit WHERE seq > {lines - cut}"))
            connection.execute(text(
                f"UPDATE audit_head SET seq = {lines - cut}, "
                f"hash = (SELECT hash FROM audit WHERE seq = {lines - cut})"
            ))  # fmt: skip
        told = verify_record(context).problems()[0]
        assert f"ends with line {lines - cut}, but {lines} lines" in told
        assert verify_audit(context).problem == told
    # Whoever goes on with such a log is told as well.
    for name in ("anna", "ben", "cleo", "dora"):
        records.accounts.add(name, name, Role.ORTHOPEDIST, "vier Schuhe gehen")
    assert f"Line {lines} of the audit log" in verify_record(context).problems()[0]


@pytest.mark.parametrize("spoil", [Path.unlink, lambda note: note.write_bytes(b"no line")])
def test_that_the_last_line_is_not_noted_is_told_until_it_is_again(
    stations: Stations, spoil: Callable[[Path], object]
) -> None:
    records = set_up(stations)
    context = records.context
    assert "and with the last one noted" in verify_record(context).compared()
    spoil(context.contents.folder / HEAD_FILE)
    report = verify_record(context)
    (told,) = report.problems()
    assert "the last one is not noted beside the files" in told
    assert "and not with the last one, which is not noted" in report.compared()
    assert verify_audit(context).problem == told
    records.accounts.add("anna", "anna", Role.ORTHOPEDIST, "vier Schuhe gehen")
    assert verify_record(context).is_sound


def test_a_new_record_needs_no_note_of_a_last_line(stations: Stations) -> None:
    context = stations.open().context
    context.database.witness.forget()
    with context.database.reading() as connection:
        assert head_of(connection)[0] == 0
    assert verify_audit(context).is_intact


def test_a_line_that_another_station_writes_meanwhile_is_no_lost_one(
    context: RecordsContext, stations: Stations, monkeypatch: pytest.MonkeyPatch
) -> None:
    other = stations.open()

    def require_and_be_overtaken(*arguments: Any) -> None:
        require(*arguments)  # from here on, the transaction sees nothing new
        other.persons.add(Person("Late Berg"))

    monkeypatch.setattr(verify, "require", require_and_be_overtaken)
    assert verify_record(context).problems() == []


def test_a_change_of_any_column_is_found(context: RecordsContext) -> None:
    """But of those that say on themselves that nothing vouches for them."""
    changed = set()
    with without_triggers(context.database) as connection:
        for kind, table in SEALED.items():
            for column in table.columns:
                if not mark_of(column).is_sealed or column.primary_key or column.foreign_keys:
                    continue
                if connection.execute(select(column)).first() is None or column.unique:
                    continue
                with connection.begin_nested() as step:
                    connection.execute(update(table).values({column: another(column)}))
                    report = verify_rows(connection)
                    step.rollback()
                assert list(report.changed) == [kind], column
                changed.add(column)
        assert verify_rows(connection).changed == {}
    assert len(changed) > 40


def another(column: Column[Any]) -> Any:
    if isinstance(column.type, Date):
        return date(1999, 1, 1)
    if isinstance(column.type, Boolean):
        return ~column
    if isinstance(column.type, Text):
        return func.coalesce(column, "").concat("'")
    return 77


def test_digests_do_not_tell_what_was_erased(stations: Stations) -> None:
    records = stations.open()
    person = records.persons.add(Person("Eva Berg"))
    before = records.audit.lines(subject_id=person.id)[0].details
    with records.context.database.reading() as connection:
        assert digests_of(connection, persons, [person.id])[person.id] in before
    erase_person(records.context, person.id, ErasureReason.REQUEST, date(2026, 11, 22))
    with records.context.database.writing() as connection:  # by somebody who guesses the name
        connection.execute(update(persons).values(name="Eva Berg", is_erased=False))
        guess = digests_of(connection, persons, [person.id])[person.id]
    assert guess not in before


def test_rows_that_refer_to_nothing_are_counted(context: RecordsContext) -> None:
    if not context.database.is_sqlite:
        pytest.skip("a server checks its references always")
    with closing(sqlite3.connect(context.database.place.database_file)) as without_checks:
        without_checks.execute("DELETE FROM visits")
        without_checks.commit()
    report = verify_record(context)
    assert report.references == {"captures": 1, "orders": 1, "prescription_versions": 1}
    assert "One row of captures refers to something that is not there" in str(report.problems())


def test_a_damaged_database_is_told(context: RecordsContext) -> None:
    if not context.database.is_sqlite:
        pytest.skip("a server checks its files by itself")
    path = context.database.place.database_file
    context.database.close()
    content = bytearray(path.read_bytes())
    for page in range(4096 * 8, len(content) - 4096, 4096 * 3):
        content[page : page + 64] = b"\xff" * 64
    path.write_bytes(content)
    (told, *_) = problems_or_error(context)
    assert "damaged" in told


def problems_or_error(context: RecordsContext) -> list[str]:
    """What a user reads, whether or not the tables can still be read."""
    try:
        return [str(problem) for problem in verify_record(context).problems()]
    except RecordsError as error:
        return [str(error)]


def test_who_may_not_is_told(context: RecordsContext) -> None:
    Accounts(context.database, context.author).switch_on("chef", "Carla", "vier Schuhe gehen")
    with pytest.raises(NotAllowed):
        verify_record(context)
