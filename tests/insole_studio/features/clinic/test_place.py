"""The record of another place is used once its database answers; its password is stored nowhere."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from administering import type_into
from pytestqt.qtbot import QtBot

from insole_core.records.person import Person
from insole_core.records.records import Records
from insole_studio.app.bootstrap import Application
from insole_studio.features.clinic.place_dialog import PlaceDialog

Run = Callable[[str, type], object]


def test_a_server_that_does_not_answer_is_told_and_not_used(
    clinic: Application, run: Run, rest: Callable[[], None], tmp_path: Path
) -> None:
    dialog = run("record_place", PlaceDialog)
    assert isinstance(dialog, PlaceDialog)
    assert not dialog.url.isEnabled()
    dialog.shared.click()
    dialog.use.click()
    assert "address of the database" in dialog.message.text()
    type_into(dialog.url, "postgresql://clinic:secret@localhost:1/records")
    type_into(dialog.contents, str(tmp_path))
    dialog.use.click()
    assert "The address holds a password" in dialog.message.text()
    type_into(dialog.url, "mysql://clinic@localhost/records")
    dialog.test.click()
    assert "database of the kind mysql" in dialog.message.text()
    type_into(dialog.url, "postgresql://clinic@localhost:1/records")
    type_into(dialog.contents, "share")
    dialog.test.click()
    assert "folder of its large files" in dialog.message.text()
    type_into(dialog.contents, str(tmp_path / "gone"))
    dialog.test.click()
    rest()
    assert "is not there or may not be written" in dialog.message.text()
    type_into(dialog.contents, str(tmp_path))
    type_into(dialog.password, "secret word")
    dialog.use.click()
    rest()
    assert "ocalhost/records does not answer" in dialog.message.text()
    assert "secret" not in dialog.message.text()
    assert clinic.settings.record_database == ""
    assert clinic.services.clinic.is_open


def test_the_record_on_a_server_is_used_and_left_again(
    clinic: Application,
    records: Records,
    run: Run,
    rest: Callable[[], None],
    tmp_path: Path,
    postgres_url: str,
    qtbot: QtBot,
) -> None:
    records.persons.add(Person("Anna Berg"))
    dialog = run("record_place", PlaceDialog)
    assert isinstance(dialog, PlaceDialog)
    dialog.shared.click()
    type_into(dialog.url, postgres_url)
    type_into(dialog.contents, str(tmp_path))
    type_into(dialog.password, "secret word")
    dialog.test.click()
    rest()
    assert "is empty: a new record would begin there" in dialog.message.text()
    dialog.use.click()
    record = clinic.services.clinic
    qtbot.waitUntil(lambda: record.is_open and record.location.is_shared)
    assert record.ask_now(lambda r: r.persons.everybody()) == []
    written = clinic.services.paths.settings_file.read_text()
    assert postgres_url in written
    assert "secret word" not in written
    dialog = run("record_place", PlaceDialog)
    assert isinstance(dialog, PlaceDialog)
    dialog.test.click()
    rest()
    assert "patients in it: 0" in dialog.message.text()
    dialog.here.click()
    dialog.use.click()
    qtbot.waitUntil(lambda: record.is_open and not record.location.is_shared)
    assert len(record.ask_now(lambda r: r.persons.everybody())) == 1
