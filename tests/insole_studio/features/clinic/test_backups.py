"""The record is backed up, by hand and by the clock, and restored in place of a damaged one."""

from __future__ import annotations

import shutil
import time
from collections.abc import Callable, Mapping
from datetime import date, datetime, timedelta
from pathlib import Path
from threading import Event

import pyrage
import pytest
from administering import PASSWORD, shown, type_into
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from insole_core.cases.sample import SAMPLE_PSEUDONYM
from insole_core.messages import Value
from insole_core.progress import Cancelled, Progress
from insole_core.records.backup.back_up import _Source, back_up, set_up_backups
from insole_core.records.backup.backup_folder import BackupFolder, folder_is_away
from insole_core.records.backup.backup_key import BackupKey
from insole_core.records.backup.snapshot import Manifest
from insole_core.records.person import Person
from insole_core.records.records import Records
from insole_core.records.retention import ErasureReason, erase_person
from insole_studio.app.bootstrap import Application
from insole_studio.document.clinic_record import RecordState
from insole_studio.features.clinic import backups
from insole_studio.features.clinic.backup_dialog import BackupDialog
from insole_studio.features.clinic.backups import BackupFacts, reminder_text
from insole_studio.features.clinic.restore_dialog import RestoreDialog
from insole_studio.features.clinic.verify_dialog import VerifyDialog
from insole_studio.settings import BackupDay
from insole_studio.user_paths import UserPaths
from tests.patience import PATIENCE_S, wait_for

Run = Callable[[str, type], object]
IDENTITY = pyrage.x25519.Identity.generate()
SECRET, RECIPIENT = str(IDENTITY), str(IDENTITY.to_public())
"""A private key of age: a passphrase takes a second each time, by design."""


def snapshots_in(folder: Path) -> list[int]:
    return [snapshot.number for snapshot in BackupFolder(folder).snapshots()]


def set_up(records: Records) -> None:
    set_up_backups(records.context, BackupKey.for_recipients([RECIPIENT]))


def notices_of(clinic: Application) -> list[str]:
    return [notice.text for notice in clinic.services.notices.notices]


def test_a_backup_counts_the_patients_that_a_restoration_counts(
    clinic: Application, records: Records, run: Run, rest: Callable[[], None], backup_folder: Path
) -> None:
    anna, twice, gone = (records.persons.add(Person(n)) for n in ("Anna", "Ana", "Bo"))
    records.persons.merge(anna.id, twice.id)
    erase_person(records.context, gone.id, ErasureReason.REQUEST, date.today())
    records.persons.add(Person("Anna Example", pseudonym=SAMPLE_PSEUDONYM))
    set_up(records)
    clinic.settings.backup_folder = str(backup_folder)
    backup = run("backup", BackupDialog)
    assert isinstance(backup, BackupDialog)
    backup.now.click()
    rest()
    assert "is made: patients 1," in backup.message.text()
    backup.reject()
    dialog = run("restore_record", RestoreDialog)
    assert isinstance(dialog, RestoreDialog)
    type_into(dialog.secret, SECRET)
    dialog.show_button.click()
    rest()
    assert "It holds: patients 1," in dialog.contents.text()
    assert dialog.restore_button.isEnabled()
    assert dialog.restore_button.toolTip() == ""


def test_the_first_backup_asks_for_a_passphrase_and_tells_that_it_was_checked(
    clinic: Application, run: Run, rest: Callable[[], None], backup_folder: Path, questions
) -> None:
    dialog = run("backup", BackupDialog)
    assert isinstance(dialog, BackupDialog)
    dialog.now.click()
    assert "Choose the folder" in dialog.message.text()
    questions.path = backup_folder
    dialog.choose.click()
    rest()
    type_into(dialog.passphrase.first, PASSWORD)
    type_into(dialog.passphrase.again, "something else")
    dialog.now.click()
    assert "not the same" in dialog.message.text()
    type_into(dialog.passphrase.first, "short")
    type_into(dialog.passphrase.again, "short")
    dialog.now.click()
    rest()
    assert "at least 12 characters" in dialog.message.text()
    for line in (dialog.passphrase.first, dialog.passphrase.again):
        type_into(line, PASSWORD)
    QTest.keyClick(dialog.passphrase.again, Qt.Key.Key_Return)
    rest()
    assert "read again and is right" in dialog.message.text()
    assert not dialog.passphrase.first.isVisible()
    assert dialog.passphrase.first.text() == ""
    assert snapshots_in(backup_folder) == [1]
    assert dialog.last.text().startswith(str(date.today()))


def test_a_public_key_is_taken_in_place_of_a_passphrase(
    clinic: Application, run: Run, rest: Callable[[], None], backup_folder: Path
) -> None:
    dialog = run("backup", BackupDialog)
    assert isinstance(dialog, BackupDialog)
    type_into(dialog.folder, str(backup_folder))
    dialog.kind.setCurrentIndex(1)
    dialog.kind.activated.emit(1)
    assert dialog.recipient.isVisible()
    assert not dialog.passphrase.first.isVisible()
    type_into(dialog.recipient, "age1nonsense")
    QTest.keyClick(dialog.recipient, Qt.Key.Key_Return)
    rest()
    assert "public key of age" in dialog.message.text()
    assert snapshots_in(backup_folder) == []


def test_a_backup_is_stopped_and_leaves_no_snapshot(
    clinic: Application,
    records: Records,
    run: Run,
    rest: Callable[[], None],
    backup_folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    qtbot: QtBot,
) -> None:
    set_up(records)
    monkeypatch.setattr(_Source, "write_all", _work_until_cancelled)
    dialog = run("backup", BackupDialog)
    assert isinstance(dialog, BackupDialog)
    type_into(dialog.folder, str(backup_folder))
    dialog.now.click()
    qtbot.waitUntil(lambda: dialog.progress.isVisible() and dialog.cancel.isVisible())
    assert not dialog.now.isEnabled()
    dialog.cancel.click()
    assert "was stopped" in dialog.message.text()
    rest()
    assert dialog.now.isEnabled()
    assert not dialog.progress.isVisible()
    assert snapshots_in(backup_folder) == []


def _work_until_cancelled(
    _source: _Source, _made_at: datetime, _settings: Mapping[str, Path], progress: Progress
) -> Manifest:
    while True:
        progress.step(0.5, "Backing up files ({done} of {all})", done=1, all=2)
        time.sleep(0.01)


def test_a_missed_backup_is_made_up_for_and_another_one_is_not_due_yet(
    clinic: Application, records: Records, rest: Callable[[], None], backup_folder: Path
) -> None:
    set_up(records)
    back_up(records.context, backup_folder)
    (path,) = (backup_folder / "snapshots").iterdir()
    old = datetime.now().astimezone() - timedelta(days=3)
    path.rename(path.with_name(f"000001-{old:%Y-%m-%dT%H-%M-%S}Z.age"))
    planned = clinic.features.clinic.backups
    planned.set_plan(backup_folder, "daily", 0)
    rest()
    assert snapshots_in(backup_folder) == [1, 2]
    planned.look()
    rest()
    assert snapshots_in(backup_folder) == [1, 2]
    assert notices_of(clinic) == []


def test_a_disk_that_is_not_there_is_told_and_nothing_is_written_in_its_place(
    clinic: Application, records: Records, rest: Callable[[], None], backup_folder: Path
) -> None:
    set_up(records)
    planned = clinic.features.clinic.backups
    planned.set_plan(backup_folder, "daily", 0)  # the empty folder that a disk is mounted on
    rest()
    (notice,) = notices_of(clinic)
    assert "No backup was made" in notice
    assert "connect its disk" in notice
    assert list(backup_folder.iterdir()) == []
    planned.set_plan(backup_folder / "gone", "daily", 0)
    rest()
    assert len(notices_of(clinic)) == 1
    assert not (backup_folder / "gone").exists()
    planned.begin(is_first=True)
    rest()
    assert notices_of(clinic) == []


def test_a_disk_that_was_disconnected_since_the_last_backup_is_told_and_not_replaced(
    clinic: Application, records: Records, rest: Callable[[], None], backup_folder: Path
) -> None:
    """Its mount point is an empty folder, on the disk of the record."""
    set_up(records)
    planned = clinic.features.clinic.backups
    planned.set_plan(backup_folder, "never", 0)
    planned.begin(is_first=True)
    rest()
    assert snapshots_in(backup_folder) == [1]
    backup_folder.rename(backup_folder.with_name("disconnected"))
    backup_folder.mkdir()
    planned.set_plan(backup_folder, "daily", 0)
    rest()
    (notice,) = notices_of(clinic)
    assert "connect its disk" in notice
    assert list(backup_folder.iterdir()) == []
    backup_folder.rmdir()
    backup_folder.with_name("disconnected").rename(backup_folder)
    planned.begin()
    rest()
    assert snapshots_in(backup_folder) == [1, 2]
    assert notices_of(clinic) == []


def test_back_up_now_begins_no_second_folder_where_the_disk_is_not_connected(
    clinic: Application,
    records: Records,
    run: Run,
    rest: Callable[[], None],
    backup_folder: Path,
) -> None:
    set_up(records)
    dialog = run("backup", BackupDialog)
    assert isinstance(dialog, BackupDialog)
    type_into(dialog.folder, str(backup_folder))
    dialog.now.click()
    rest()
    assert snapshots_in(backup_folder) == [1]
    for path in sorted(backup_folder.rglob("*"), reverse=True):
        path.rmdir() if path.is_dir() else path.unlink()
    dialog.now.click()
    rest()
    assert "connect its disk, or choose another folder" in dialog.message.text()
    assert list(backup_folder.iterdir()) == []


def test_the_start_page_reminds_of_backups_until_there_is_one_or_it_is_put_off(
    clinic: Application, records: Records, rest: Callable[[], None], backup_folder: Path
) -> None:
    planned = clinic.features.clinic.backups
    page = clinic.features.records.start
    assert page is not None
    planned.remind()
    rest()
    assert not page.reminder.isVisible()  # there is nothing to lose yet
    records.persons.add(Person("Anna Berg"))
    rest()

    def places() -> list[QPoint]:
        reminder = (page.reminder, page.back_up, page.put_off)
        parts = page.findChildren(QWidget)
        return [part.pos() for part in parts if part.isVisible() and part not in reminder]

    before = places()
    planned.remind()
    rest()
    assert page.reminder.isVisible()
    assert "There is no backup yet" in page.reminder.text()
    assert page.reminder.width() >= page.reminder.needed_px
    assert places() == before, "nothing moves as it comes"
    page.put_off.click()
    assert not page.reminder.isVisible()
    assert not page.put_off.isVisible()
    planned.remind()
    rest()
    assert not page.reminder.isVisible()
    clinic.settings.backup_reminder_from = str(date.today())
    planned.remind()
    rest()
    assert page.back_up.isVisible()
    set_up(records)
    planned.set_plan(backup_folder, "never", 0)
    planned.begin(is_first=True)
    rest()
    assert not page.reminder.isVisible()


@pytest.mark.parametrize(
    ("day", "days_ago", "reminds"),
    [("daily", 1.9, False), ("daily", 2.1, True), ("0", 13.9, False), ("never", 14.1, True)],
)
def test_two_intervals_may_pass_without_a_backup(
    day: BackupDay, days_ago: float, reminds: bool
) -> None:
    now = datetime.now().astimezone()
    facts = BackupFacts(now - timedelta(days=days_ago), has_patients=True)
    assert bool(reminder_text(facts, day, now)) is reminds


def test_which_old_backups_stay_is_chosen_in_the_dialog(
    clinic: Application, records: Records, run: Run, rest: Callable[[], None], backup_folder: Path
) -> None:
    set_up(records)
    back_up(records.context, backup_folder)
    for path in [*(backup_folder / "snapshots").iterdir(), *(backup_folder / "lists").iterdir()]:
        for number in range(1, 33):  # of a record that has not changed they are alike
            shutil.copy(path, path.with_name(f"{number:06}-2020-01-01T00-00-00Z{path.suffix}"))
        path.unlink()
    clinic.settings.backup_folder = str(backup_folder)
    dialog = run("backup", BackupDialog)
    assert isinstance(dialog, BackupDialog)
    assert "backups in the folder: 32, the oldest of 2020-01-01" in dialog.last.text()
    dialog.keep.setCurrentIndex(dialog.keep.findData("all"))
    dialog.keep.activated.emit(dialog.keep.currentIndex())
    dialog.now.click()
    rest()
    assert len(snapshots_in(backup_folder)) == 33
    dialog.keep.setCurrentIndex(dialog.keep.findData("year"))
    dialog.keep.activated.emit(dialog.keep.currentIndex())
    dialog.now.click()
    rest()
    assert "Old backups removed: 4." in dialog.message.text()
    assert snapshots_in(backup_folder) == list(range(5, 35))


def test_a_folder_with_no_finished_backup_is_told_before_a_restore(
    clinic: Application, records: Records, run: Run, rest: Callable[[], None], backup_folder: Path
) -> None:
    set_up(records)
    with pytest.raises(Cancelled):
        back_up(records.context, backup_folder, progress=Progress(is_cancelled=lambda: True))
    clinic.settings.backup_folder = str(backup_folder)
    dialog = run("restore_record", RestoreDialog)
    assert isinstance(dialog, RestoreDialog)
    rest()
    assert "holds no finished backup" in dialog.message.text()
    assert dialog.table.rows == ()
    assert not dialog.show_button.isEnabled()
    assert dialog.show_button.toolTip() == "Choose a backup in the list first."
    assert dialog.restore_button.toolTip() == "Show what the backup holds first."


def test_a_restore_waits_until_a_backup_has_stopped(
    clinic: Application,
    records: Records,
    rest: Callable[[], None],
    backup_folder: Path,
    qtbot: QtBot,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    records.persons.add(Person("Anna Berg"))
    set_up(records)
    back_up(records.context, backup_folder)
    records.persons.add(Person("Berta Dal"))
    step, told_steps = Progress.step, []

    def noted_step(progress: Progress, fraction: float, template: str, /, **values: Value) -> None:
        told_steps.append(template)
        step(progress, fraction, template, **values)

    def stop_slowly(_source: object, _at: object, _settings: object, progress: Progress) -> None:
        """Hold the record after cancelling until the restore waits for it."""
        wait_for(progress.is_cancelled)
        wait_for(lambda: "Waiting until the backup has stopped" in told_steps)
        raise Cancelled

    monkeypatch.setattr(Progress, "step", noted_step)
    monkeypatch.setattr(_Source, "write_all", stop_slowly)
    planned = clinic.features.clinic.backups
    planned.set_plan(backup_folder, "never", 0)
    planned.begin()
    dialog = run_while_working(clinic, qtbot)
    type_into(dialog.secret, SECRET)
    dialog.show_button.click()
    qtbot.waitUntil(lambda: "patients 1" in dialog.contents.text())
    assert planned.is_running
    for told in ("newer than the backup", "The record is as it was on"):
        dialog.restore_button.click()
        rest()
        assert told in dialog.message.text()
    assert "The record is as it was on" in dialog.message.text()
    record = clinic.services.clinic
    assert [p.name for p in record.ask_now(lambda r: r.persons.everybody())] == ["Anna Berg"]


def test_no_backup_begins_once_the_record_is_closed_to_be_restored(
    clinic: Application,
    records: Records,
    rest: Callable[[], None],
    backup_folder: Path,
    qtbot: QtBot,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The schedule has looked for the last one, and its answer comes later."""
    set_up(records)
    back_up(records.context, backup_folder)
    goes_on = Event()

    def look_slowly(_folder: Path) -> None:
        goes_on.wait(PATIENCE_S)

    monkeypatch.setattr(backups, "newest_in", look_slowly)
    planned = clinic.features.clinic.backups
    planned.set_plan(backup_folder, "daily", 0)
    clinic.services.clinic.let_go()
    goes_on.set()
    rest()
    assert snapshots_in(backup_folder) == [1]
    assert notices_of(clinic) == []


def run_while_working(clinic: Application, qtbot: QtBot) -> RestoreDialog:
    """Open the dialog while a backup is being made, and wait for its list."""
    clinic.window.actions_by_key["restore_record"].trigger()
    dialog = shown(clinic, RestoreDialog)
    qtbot.waitUntil(lambda: len(dialog.table.rows) == 1)
    return dialog


def test_after_a_failure_it_is_tried_again_only_after_a_while(
    clinic: Application,
    records: Records,
    rest: Callable[[], None],
    backup_folder: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    set_up(records)
    asked: list[Path] = []

    def newest(folder: Path) -> datetime:
        asked.append(folder)
        raise folder_is_away(folder)

    monkeypatch.setattr(backups, "newest_in", newest)
    planned = clinic.features.clinic.backups
    planned.set_plan(backup_folder, "daily", 0)
    rest()
    planned.look()
    rest()
    assert len(asked) == 1


def test_a_backup_is_shown_and_never_restored_over_a_newer_record_without_a_word(
    clinic: Application,
    records: Records,
    run: Run,
    rest: Callable[[], None],
    backup_folder: Path,
    paths: UserPaths,
) -> None:
    records.persons.add(Person("Anna Berg", date(1970, 2, 28)))
    set_up(records)
    back_up(records.context, backup_folder)
    records.persons.add(Person("Berta Dal"))
    clinic.settings.backup_folder = str(backup_folder)
    dialog = run("restore_record", RestoreDialog)
    assert isinstance(dialog, RestoreDialog)
    assert [row.cells[0] for row in dialog.table.rows] == ["1"]
    assert not dialog.restore_button.isEnabled()
    type_into(dialog.secret, "another one of words")
    dialog.show_button.click()
    rest()
    assert "does not open this backup" in dialog.message.text()
    type_into(dialog.secret, SECRET)
    dialog.show_button.click()
    rest()
    assert "patients 1, visits 0" in dialog.contents.text()
    dialog.restore_button.click()
    rest()
    assert "holds a record that is newer than the backup" in dialog.message.text()
    record = clinic.services.clinic
    assert record.is_open
    assert len(record.ask_now(lambda r: r.persons.everybody())) == 2
    assert dialog.restore_button.text() == "Set the present record aside and restore"
    dialog.restore_button.click()
    rest()
    assert "The record is as it was on" in dialog.message.text()
    assert "is kept as" in dialog.message.text()
    assert record.is_open
    assert [p.name for p in record.ask_now(lambda r: r.persons.everybody())] == ["Anna Berg"]
    assert len(list(paths.records_folder.glob("* until *.sqlite3"))) == 1


@pytest.mark.parametrize("is_readable", [True, False])
def test_who_was_erased_after_the_backup_is_erased_again_or_that_is_not_known(
    clinic: Application,
    records: Records,
    run: Run,
    rest: Callable[[], None],
    backup_folder: Path,
    damage: Callable[[str], None],
    is_readable: bool,
) -> None:
    anna = records.persons.add(Person("Anna Berg", date(1970, 2, 28)))
    set_up(records)
    back_up(records.context, backup_folder)
    erase_person(records.context, anna.id, ErasureReason.REQUEST, date.today())
    if not is_readable:
        damage("persons")
        clinic.services.clinic.open()
        rest()
    clinic.settings.backup_folder = str(backup_folder)
    dialog = run("restore_record", RestoreDialog)
    assert isinstance(dialog, RestoreDialog)
    type_into(dialog.secret, SECRET)
    dialog.show_button.click()
    rest()
    dialog.restore_button.click()
    rest()
    dialog.restore_button.click()
    rest()
    there = clinic.services.clinic.ask_now(lambda r: r.persons.get(anna.id))
    assert there.is_erased is is_readable
    assert ("One patient was erased after" in dialog.message.text()) is is_readable
    assert ("who was erased after the backup may be" in dialog.message.text()) is not is_readable


def test_a_damaged_record_is_restored_from_the_start_page(
    clinic: Application,
    records: Records,
    rest: Callable[[], None],
    backup_folder: Path,
    qtbot: QtBot,
) -> None:
    records.persons.add(Person("Anna Berg"))
    set_up(records)
    back_up(records.context, backup_folder)
    record = clinic.services.clinic
    record.let_go()
    file = clinic.services.paths.records_folder / "records.sqlite3"
    file.write_bytes(b"no database at all" * 1000)
    record.open()
    qtbot.waitUntil(lambda: record.state is RecordState.REFUSED)
    page = clinic.features.records.start
    assert page is not None
    assert "restore the record from a backup" in page.message.text()
    page.remedies["restore_record"].click()
    dialog = shown(clinic, RestoreDialog)
    type_into(dialog.folder, str(backup_folder))
    dialog.list_snapshots()
    rest()
    type_into(dialog.secret, SECRET)
    dialog.show_button.click()
    rest()
    dialog.restore_button.click()
    rest()
    assert "holds a record that cannot be read" in dialog.message.text()
    dialog.restore_button.click()
    rest()
    assert record.is_open
    assert not page.remedies["restore_record"].isVisible()
    assert [p.name for p in record.ask_now(lambda r: r.persons.everybody())] == ["Anna Berg"]


def test_verifying_tells_that_all_is_sound_and_names_what_is_not(
    clinic: Application, records: Records, run: Run, rest: Callable[[], None]
) -> None:
    records.persons.add(Person("Anna Berg"))
    dialog = run("verify_record", VerifyDialog)
    assert isinstance(dialog, VerifyDialog)
    assert "Everything is what was stored" in dialog.verdict.text()
    assert "1 line of the audit log" in dialog.verdict.text()
    with records.context.database.writing() as connection:
        connection.exec_driver_sql("UPDATE audit_head SET seq = 7")
    dialog.again.click()
    rest()
    assert "Everything" not in dialog.verdict.text()
    assert "7 lines were written" in dialog.message.text()
