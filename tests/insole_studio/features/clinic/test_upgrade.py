"""A record of an older program is brought up to date as the window opens it."""

from __future__ import annotations

from contextlib import closing

from pytestqt.qtbot import QtBot

from insole_core.records.database import Database
from insole_core.records.migrate import SCHEMA, migrate
from insole_core.records.place import RecordsPlace
from insole_studio.app.bootstrap import Application


def test_that_a_record_was_brought_up_to_date_is_told_with_the_copy_from_before(
    clinic: Application, qtbot: QtBot
) -> None:
    record, folder = clinic.services.clinic, clinic.services.paths.records_folder
    record.let_go()
    place = RecordsPlace.local(folder)
    for file in folder.glob(f"{place.database_file.name}*"):
        file.unlink()
    (folder / "contents" / "identity").unlink(missing_ok=True)
    place.database_file.touch()
    with closing(Database(place)) as database:
        migrate(database, f"{int(SCHEMA) - 1:04d}")
    record.open()
    qtbot.waitUntil(lambda: record.is_open)
    (copy,) = folder.glob("records until *")
    assert any(copy.name in notice.text for notice in clinic.services.notices.notices)
