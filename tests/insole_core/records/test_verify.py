"""A verification of the record names everything that is not what was stored."""

from __future__ import annotations

import sqlite3
from contextlib import closing

import pytest
from backed_up_record import MESH, SESSION, fill
from sqlalchemy import text
from stations import Stations
from tampering import without_triggers

from insole_core.errors import NotAllowed, RecordsError
from insole_core.records.accounts import Accounts
from insole_core.records.audit import AuditLog
from insole_core.records.context import RecordsContext
from insole_core.records.verify import verify_record


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
    assert [sentence.split(",")[0] for sentence in others] == [
        "1 signed prescriptions are not what was signed",
        "1 files were changed since the record stored them",
        "1 files of the record are missing",
    ]
    assert digests[0][:12] in others[1]


def test_rows_that_refer_to_nothing_are_counted(context: RecordsContext) -> None:
    if not context.database.is_sqlite:
        pytest.skip("a server checks its references always")
    with closing(sqlite3.connect(context.database.place.database_file)) as without_checks:
        without_checks.execute("DELETE FROM visits")
        without_checks.commit()
    report = verify_record(context)
    assert report.references == {"captures": 1, "orders": 1, "prescription_versions": 1}
    assert "1 rows of captures refer to something that is not there" in str(report.problems())


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
