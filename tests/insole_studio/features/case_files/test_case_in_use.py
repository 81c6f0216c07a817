"""One case in two windows or processes, and files that cannot be written: nothing is lost."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import textwrap
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QSysInfo
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot
from real_dialogs import answering

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.geometry.side import Side
from insole_studio.app.bootstrap import Application, build_application
from insole_studio.document.case_lock import STALE_MS, CaseInUseError, take_lock
from insole_studio.services.questions import Questions
from insole_studio.user_paths import UserPaths

LOCK = ".~lock.anna.insole#"
OTHER_HOST = "4711\ninsole-studio\nreception\n0123456789abcdef0123456789abcdef\n{boot}\n"


@pytest.fixture
def anna(tmp_path: Path) -> Path:
    path = tmp_path / "cases" / "anna.insole"
    path.parent.mkdir()
    write_case(CaseRecord(Patient(name="Anna")), path)
    return path


def ask_for_real(app: Application) -> Application:
    app.services.messages.questions = Questions(app.window)
    return app


@pytest.fixture
def first(app: Application) -> Application:
    return ask_for_real(app)


@pytest.fixture
def second(qapp: QApplication, qtbot: QtBot, tmp_path: Path) -> Iterator[Application]:
    """Another window of the same user."""
    paths = UserPaths(tmp_path / "config" / "settings.json", tmp_path / "data" / "autosave")
    built = ask_for_real(build_application(qapp, paths))
    built.window.show()
    yield built
    built.autosave.forget()
    built.close()


@pytest.fixture
def open_in(qtbot: QtBot) -> Callable[[Application, Path], None]:
    def open_path(app: Application, path: Path) -> None:
        app.window.activateWindow()
        app.features.case_files.opener.open_path(path)
        finish(qtbot, app)

    return open_path


def finish(qtbot: QtBot, app: Application) -> None:
    qtbot.waitUntil(lambda: not app.jobs.is_running())


def choose(qtbot: QtBot, app: Application, action: str) -> None:
    app.window.actions_by_key[action].trigger()
    finish(qtbot, app)


def test_a_case_in_another_window_is_opened_read_only(
    first: Application,
    second: Application,
    open_in: Callable[[Application, Path], None],
    qtbot: QtBot,
    anna: Path,
) -> None:
    open_in(first, anna)
    with answering("Open read-only") as given:
        open_in(second, anna)
    assert given.asked == [f"{anna} is open in another window."]
    assert second.window.windowTitle().startswith("anna (read-only)")
    first.case.apply(Patient(name="Anna of the first"), "Edit")
    second.case.apply(Patient(name="Anna of the second"), "Edit")
    choose(qtbot, first, "save")
    own = anna.with_name("anna 2.insole")
    with answering(anna, "Replace them", "Save as…", own) as given:
        choose(qtbot, second, "save")  # asks for a name, and refuses that of the first
    assert given.asked[1] == f"{anna} is open in another window."
    assert read_case(anna).patient.name == "Anna of the first"
    assert read_case(own).patient.name == "Anna of the second"
    assert second.window.windowTitle().startswith("anna 2[*]")


def test_a_case_in_another_window_is_opened_as_a_copy(
    first: Application,
    second: Application,
    open_in: Callable[[Application, Path], None],
    anna: Path,
) -> None:
    open_in(first, anna)
    with answering("Open a copy"):
        open_in(second, anna)
    assert second.case.record.patient.name == "Anna"
    assert second.case.path is None
    assert second.case.has_unsaved_changes


def test_a_case_in_another_window_may_stay_there(
    first: Application,
    second: Application,
    open_in: Callable[[Application, Path], None],
    anna: Path,
) -> None:
    open_in(first, anna)
    with answering("Do not open"):
        open_in(second, anna)
    assert second.case.path is None
    assert second.case.record.patient.name == ""


def test_a_link_is_the_same_case(
    first: Application,
    second: Application,
    open_in: Callable[[Application, Path], None],
    anna: Path,
    tmp_path: Path,
) -> None:
    link = tmp_path / "link.insole"
    link.symlink_to(anna)
    open_in(first, anna)
    with answering("Do not open") as given:
        open_in(second, link)
    assert given.asked == [f"{link} is open in another window."]


def test_a_save_that_ends_in_the_next_case_does_not_give_it_its_file(
    first: Application,
    open_in: Callable[[Application, Path], None],
    qtbot: QtBot,
    anna: Path,
) -> None:
    open_in(first, anna)
    first.case.apply(Patient(name="Anna Berg"), "Edit the patient's fields")
    first.features.case_files.saver.save()
    first.case.open(CaseRecord(Patient(name="Otto")), None)
    finish(qtbot, first)
    qtbot.wait(200)
    assert first.case.path is None
    assert not (anna.parent / LOCK).exists()


@pytest.mark.parametrize("leave", ["new_case", "open_other", "close"])
def test_a_case_that_is_left_can_be_opened(
    first: Application,
    second: Application,
    open_in: Callable[[Application, Path], None],
    qtbot: QtBot,
    anna: Path,
    leave: str,
) -> None:
    bert = anna.with_name("bert.insole")
    shutil.copy(anna, bert)
    open_in(second, anna)
    open_in(second, anna)  # again, in the window that has it
    assert (anna.parent / LOCK).exists()
    if leave == "new_case":
        choose(qtbot, second, "new_case")
    elif leave == "open_other":
        open_in(second, bert)
    else:
        second.features.case_files.guard.release()
    assert not (anna.parent / LOCK).exists()
    open_in(first, anna)
    assert first.case.path == anna
    assert not first.case.is_read_only


def test_saving_under_another_name_moves_the_lock(
    first: Application, open_in: Callable[[Application, Path], None], qtbot: QtBot, anna: Path
) -> None:
    open_in(first, anna)
    with answering(anna.with_name("bert")):
        choose(qtbot, first, "save_as")
    locks = sorted(path.name for path in anna.parent.glob(".~lock*"))
    assert locks == [".~lock.bert.insole#"]


def test_a_file_that_cannot_be_read_leaves_no_lock(
    first: Application, open_in: Callable[[Application, Path], None], anna: Path
) -> None:
    anna.write_bytes(b"cut off")
    open_in(first, anna)
    assert [path.name for path in anna.parent.iterdir()] == ["anna.insole"]
    for dialog in list(first.services.messages.dialogs):
        dialog.done(0)


@pytest.mark.parametrize("answer", ["Go on working", "Replace the file", "Save as…"])
def test_a_change_on_the_disk_is_noticed(
    first: Application,
    open_in: Callable[[Application, Path], None],
    qtbot: QtBot,
    anna: Path,
    answer: str,
) -> None:
    open_in(first, anna)
    first.case.apply(Patient(name="Anna B."), "Edit")
    choose(qtbot, first, "save")  # one's own change is none
    first.case.apply(Patient(name="Anna C."), "Edit")
    write_case(CaseRecord(Patient(name="restored from a backup")), anna)
    own = anna.with_name("own.insole")
    with answering(answer, *([own] if answer == "Save as…" else [])) as given:
        choose(qtbot, first, "save")
    assert given.asked == [f"{anna} was changed by another program since it was opened here."]
    expected = "Anna C." if answer == "Replace the file" else "restored from a backup"
    assert read_case(anna).patient.name == expected
    assert own.exists() is (answer == "Save as…")
    assert first.case.has_unsaved_changes is (answer == "Go on working")


def test_a_file_that_is_gone_is_written_again(
    first: Application, open_in: Callable[[Application, Path], None], qtbot: QtBot, anna: Path
) -> None:
    open_in(first, anna)
    anna.unlink()
    first.case.apply(Patient(name="Anna B."), "Edit")
    choose(qtbot, first, "save")
    assert read_case(anna).patient.name == "Anna B."


def chattr(change: str, path: Path) -> None:
    call = ["chattr", change, str(path)]
    if not shutil.which("chattr") or subprocess.run(call, check=False).returncode:
        pytest.skip("only root protects files, and not on every file system")


@pytest.mark.parametrize("protected", ["file", "folder"])
def test_a_protected_case_is_saved_elsewhere(
    first: Application,
    open_in: Callable[[Application, Path], None],
    qtbot: QtBot,
    tmp_path: Path,
    anna: Path,
    protected: str,
) -> None:
    place = anna if protected == "file" else anna.parent
    chattr("+i", place)
    try:
        open_in(first, anna)
        first.case.apply(Patient(name="Anna B."), "Edit")
        with answering("Save as…", tmp_path / "own.insole") as given:
            choose(qtbot, first, "save")
    finally:
        chattr("-i", place)
    assert given.asked == [
        f"{anna} cannot be written: it or its folder is protected against changes; "
        "choose another name or place."
    ]
    assert read_case(anna).patient.name == "Anna"
    assert read_case(tmp_path / "own.insole").patient.name == "Anna B."


def test_a_folder_that_takes_no_lock_has_it_elsewhere(anna: Path, tmp_path: Path) -> None:
    chattr("+i", anna.parent)
    try:
        lock = take_lock(anna, tmp_path / "locks")
        with pytest.raises(CaseInUseError, match="open in another window"):
            take_lock(anna, tmp_path / "locks")
        lock.release()
        take_lock(anna, tmp_path / "locks").release()
    finally:
        chattr("-i", anna.parent)


def test_where_nothing_takes_a_lock_the_case_opens_all_the_same(anna: Path, tmp_path: Path) -> None:
    (tmp_path / "locks").touch()
    chattr("+i", anna.parent)
    try:
        lock = take_lock(anna, tmp_path / "locks")
        lock.refresh()
        lock.release()
    finally:
        chattr("-i", anna.parent)


def lay_foreign_lock(folder: Path, age_s: float, content: str) -> Path:
    lock = folder / LOCK
    lock.write_text(content)
    then = time.time() - age_s
    os.utime(lock, (then, then))
    return lock


def test_a_lock_of_another_computer_counts_while_it_is_fresh(anna: Path, tmp_path: Path) -> None:
    lay_foreign_lock(anna.parent, STALE_MS / 2000, OTHER_HOST.format(boot="abc"))
    with pytest.raises(CaseInUseError, match="open on another computer, reception"):
        take_lock(anna, tmp_path / "locks")


def test_an_old_lock_of_another_computer_is_taken_over(anna: Path, tmp_path: Path) -> None:
    lay_foreign_lock(anna.parent, 2 * STALE_MS / 1000, OTHER_HOST.format(boot="abc"))
    take_lock(anna, tmp_path / "locks").release()


def test_a_lock_from_before_the_reboot_is_taken_over(anna: Path, tmp_path: Path) -> None:
    machine = bytes(QSysInfo.machineUniqueId().data()).decode()
    if not machine or not bytes(QSysInfo.bootUniqueId().data()):
        pytest.skip("this system does not tell when it was started")
    content = f"{os.getpid()}\npython\n{QSysInfo.machineHostName()}\n{machine}\nanother-boot\n"
    lay_foreign_lock(anna.parent, 0.0, content)
    take_lock(anna, tmp_path / "locks").release()


@pytest.mark.parametrize("content", ["", "\n\n\n", "x" * 10_000, "\x00\xff"])
def test_a_broken_lock_counts_until_it_is_old(anna: Path, tmp_path: Path, content: str) -> None:
    lay_foreign_lock(anna.parent, 2 * STALE_MS / 1000, content)
    take_lock(anna, tmp_path / "locks").release()


def test_an_open_case_refreshes_its_lock(anna: Path, tmp_path: Path) -> None:
    lock = take_lock(anna, tmp_path / "locks")
    file = anna.parent / LOCK
    os.utime(file, (0, 0))
    lock.refresh()
    assert file.stat().st_mtime > time.time() - STALE_MS / 2000
    file.unlink()
    lock.refresh()  # it is only logged
    lock.release()


WINDOW = """
    import sys
    from pathlib import Path
    from PySide6.QtCore import QTimer
    from insole_studio.app.bootstrap import build_application, qt_application
    from insole_studio.user_paths import UserPaths

    qt = qt_application()
    home = Path(sys.argv[2])
    app = build_application(qt, UserPaths(home / "settings.json", home / "autosave"))
    app.window.show()
    app.case.opened.connect(lambda: print("opened", flush=True))
    app.features.case_files.opener.open_path(Path(sys.argv[1]))
    qt.exec()
"""


@pytest.mark.slow
def test_a_case_of_a_killed_process_can_be_opened(
    first: Application,
    open_in: Callable[[Application, Path], None],
    anna: Path,
    tmp_path: Path,
) -> None:
    call = [sys.executable, "-c", textwrap.dedent(WINDOW), str(anna), str(tmp_path / "home")]
    other = subprocess.Popen(call, stdout=subprocess.PIPE, text=True)
    try:
        assert other.stdout is not None
        assert other.stdout.readline() == "opened\n"
        with answering("Do not open") as given:
            open_in(first, anna)
        assert given.asked == [f"{anna} is open in another window."]
    finally:
        other.send_signal(signal.SIGKILL)
        other.communicate()
    assert (anna.parent / LOCK).exists()
    open_in(first, anna)
    assert first.case.path == anna
    assert not first.case.is_read_only


def test_a_case_whose_scan_is_a_pipe_opens(
    first: Application,
    open_in: Callable[[Application, Path], None],
    make_foot: Callable[[Side], object],
    anna: Path,
    tmp_path: Path,
) -> None:
    pipe = tmp_path / "scan.ply"
    os.mkfifo(pipe)
    source = ScanSource("mesh", str(pipe), "0" * 64)
    foot = FootRecord.begun(make_foot(Side.LEFT), source)  # type: ignore[arg-type]
    write_case(CaseRecord.of_foot(foot), anna)
    open_in(first, anna)
    assert first.case.side is Side.LEFT
    (notice,) = first.services.notices.notices
    assert "is not there any more, or cannot be read" in notice.text
