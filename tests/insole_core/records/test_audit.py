"""The audit log: nothing is changed, removed or added without being found."""

from __future__ import annotations

import json
import tracemalloc
from collections.abc import Callable

import pytest
from sqlalchemy import insert, text, update
from stations import Stations
from tampering import without_triggers

from insole_core.errors import RecordsError
from insole_core.records.audit import AuditLog, hash_of_line, verify_chain
from insole_core.records.author import Author
from insole_core.records.database import Database
from insole_core.records.schema import FIRST_HASH, audit, audit_head

ANNA = Author("anna", "desk")


@pytest.fixture
def database(stations: Stations) -> Database:
    """Of an empty record, in each kind of database."""
    return stations.open().context.database


@pytest.fixture
def log(database: Database) -> AuditLog:
    return AuditLog(database, ANNA)


def write(database: Database, count: int) -> None:
    with database.writing() as connection:
        for number in range(count):
            AuditLog.append(
                connection, ANNA, "changed", "person", f"id-{number % 3}", number=number
            )


def tamper(database: Database, *statements: str) -> None:
    with without_triggers(database) as connection:
        for statement in statements:
            connection.execute(text(statement))


def test_lines_are_chained_and_intact(database: Database, log: AuditLog) -> None:
    assert log.head() == (0, FIRST_HASH)
    assert log.verify().is_intact
    write(database, 5)
    newest = log.lines()
    assert [line.seq for line in newest] == [5, 4, 3, 2, 1]
    assert newest[-1].previous_hash == FIRST_HASH
    assert [line.hash for line in newest[1:]] == [line.previous_hash for line in newest[:-1]]
    assert log.head() == (5, newest[0].hash)
    report = log.verify()
    assert (report.is_intact, report.lines, report.head) == (True, 5, newest[0].hash)


def test_lines_are_found_by_subject_and_page(database: Database, log: AuditLog) -> None:
    write(database, 9)
    assert [line.seq for line in log.lines(subject_id="id-1")] == [8, 5, 2]
    assert [line.seq for line in log.lines(before=4, limit=2)] == [3, 2]
    assert json.loads(log.lines(limit=1)[0].details) == {"number": 8}


def test_a_line_that_is_not_committed_is_not_there(database: Database, log: AuditLog) -> None:
    write(database, 2)

    def fail_after_a_line() -> None:
        with database.writing() as connection:
            AuditLog.append(connection, ANNA, "changed", "person", "id")
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        fail_after_a_line()
    assert log.head()[0] == 2
    assert log.verify().is_intact


@pytest.mark.parametrize(
    "statement",
    [
        "UPDATE audit SET author = 'eva' WHERE seq = 2",
        "DELETE FROM audit WHERE seq = 2",
        "DELETE FROM audit_head",
        "UPDATE audit_head SET seq = 1",
    ],
)
def test_the_database_refuses_to_change_lines(
    database: Database, log: AuditLog, statement: str
) -> None:
    write(database, 3)
    with pytest.raises(RecordsError), database.writing() as connection:
        connection.execute(text(statement))
    assert log.verify().is_intact


@pytest.mark.parametrize(
    ("statement", "broken", "problem"),
    [
        ("UPDATE audit SET author = 'eva' WHERE seq = 3", 3, r"Line 3 .* is not what was written"),
        ("UPDATE audit SET at = '1970' WHERE seq = 1", 1, r"Line 1 .*1970.* is not what was"),
        ("UPDATE audit SET details = '{}' WHERE seq = 5", 5, r"Line 5 .* is not what was written"),
        ("DELETE FROM audit WHERE seq = 2", 2, r"Line 2 of the audit log is missing"),
        ("DELETE FROM audit WHERE seq = 1", 1, r"Line 1 of the audit log is missing"),
        ("DELETE FROM audit WHERE seq = 5", 5, r"ends with line 4, but 5 lines were written"),
        ("DELETE FROM audit", 1, r"ends with line 0, but 5 lines were written"),
        ("UPDATE audit_head SET seq = 4", 5, r"ends with line 5, but 4 lines were written"),
        ("UPDATE audit_head SET hash = 'x'", 5, r"Line 5 .* is not the last one"),
    ],
)
def test_the_first_broken_line_is_named(
    database: Database, log: AuditLog, statement: str, broken: int, problem: str
) -> None:
    write(database, 5)
    tamper(database, statement)
    report = log.verify()
    assert not report.is_intact
    assert report.broken_line == broken
    with pytest.raises(AssertionError, match=problem):
        raise AssertionError(report.problem)


def rewrite_all(database: Database) -> None:
    """Forge a chain that is consistent in itself, with another author."""
    lines = AuditLog(database, ANNA).lines()
    previous = FIRST_HASH
    with without_triggers(database) as connection:
        connection.execute(text("DELETE FROM audit"))
        for line in reversed(lines):
            fields = (
                line.seq, line.at, "eva", line.station, line.action, line.subject_kind,
                line.subject_id, line.details, previous,
            )  # fmt: skip
            previous = hash_of_line(fields)
            connection.execute(
                insert(audit).values(dict(zip(audit.c.keys(), (*fields, previous), strict=True)))
            )
        connection.execute(update(audit_head).values(hash=previous))


def test_a_log_that_was_written_anew_is_found_by_the_heads_of_backups(
    database: Database, log: AuditLog
) -> None:
    write(database, 3)
    known = dict([log.head()])
    write(database, 2)
    assert log.verify(known).is_intact
    rewrite_all(database)
    assert log.verify().is_intact
    report = log.verify(known)
    assert report.broken_line == 3


def test_a_log_that_is_shorter_than_a_backup_is_found(database: Database, log: AuditLog) -> None:
    write(database, 3)
    assert log.verify({7: "x"}).broken_line == 4


@pytest.mark.parametrize(
    "details", [{"name": "x" * 201}, {"name": object()}], ids=["long", "no text"]
)
def test_texts_about_patients_do_not_get_into_the_log(
    database: Database, details: dict[str, str]
) -> None:
    with pytest.raises((ValueError, TypeError)), database.writing() as connection:
        AuditLog.append(connection, ANNA, "changed", "person", "id", **details)


@pytest.mark.parametrize("words", [("Changed!", "person"), ("changed", "Anna Ek")])
def test_actions_and_subjects_are_words(database: Database, words: tuple[str, str]) -> None:
    with pytest.raises(ValueError, match="no words"), database.writing() as connection:
        AuditLog.append(connection, ANNA, *words, "id")


def test_names_in_any_script_are_kept(database: Database, log: AuditLog) -> None:
    with database.writing() as connection:
        AuditLog.append(connection, Author("Zoë Østergård \u202e", "空"), "seen", "person", "id")
    assert log.verify().is_intact
    assert log.lines()[0].station == "空"


def fill(database: Database, count: int) -> None:
    """Write a long chain in a moment."""
    rows, previous = [], FIRST_HASH
    for seq in range(1, count + 1):
        fields = (seq, "2026", "anna", "desk", "seen", "person", "id", "{}", previous)
        previous = hash_of_line(fields)
        rows.append(dict(zip(audit.c.keys(), (*fields, previous), strict=True)))
    with database.writing() as connection:
        connection.execute(insert(audit), rows)
        connection.execute(update(audit_head).values(seq=count, hash=previous))


def peak_bytes(work: Callable[[], object]) -> int:
    tracemalloc.start()
    work()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return peak


@pytest.mark.slow
def test_verification_takes_as_much_memory_for_a_long_log(database: Database) -> None:
    fill(database, 10_000)
    with database.reading() as connection:
        verify_chain(connection)
        assert peak_bytes(lambda: verify_chain(connection)) < 5 * 2**20
