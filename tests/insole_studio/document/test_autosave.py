from __future__ import annotations

import ast
import itertools
import os
import shutil
import signal
import subprocess
import sys
import textwrap
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import killed_windows
import pytest
from PySide6.QtCore import QLockFile, QTimer
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import CaseRecord, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.geometry.side import Side
from insole_core.messages import Message
from insole_studio.app.bootstrap import Application, build_application
from insole_studio.document import autosave as autosave_module
from insole_studio.document.autosave import Autosave
from insole_studio.document.case import Case
from insole_studio.document.journal import (
    DAMAGED_DAYS,
    Origin,
    find_recovered,
    new_journal,
    write_journal,
)
from insole_studio.jobs import Jobs
from insole_studio.user_paths import UserPaths
from tests.patience import PATIENCE_S

PROGRAM = """
    import os, signal, sys
    from pathlib import Path
    from PySide6.QtCore import QCoreApplication
    from insole_core.cases.case_record import Patient
    from insole_studio.jobs import Jobs
    from insole_studio.document.autosave import Autosave
    from insole_studio.document.case import Case

    qt = QCoreApplication([])
    jobs, case = Jobs(), Case()
    autosave = Autosave(case, jobs, Path(sys.argv[1]))
    jobs.ended.connect(lambda channel: os.kill(os.getpid(), signal.SIGKILL))
    case.apply(Patient(name="Anna B."), "Edit")
    qt.exec()
"""


def test_a_killed_program_leaves_its_case(tmp_path: Path) -> None:
    folder = tmp_path / "autosave"
    call = [sys.executable, "-c", textwrap.dedent(PROGRAM), str(folder)]
    died = subprocess.run(call, timeout=PATIENCE_S, check=False, capture_output=True)
    assert died.returncode == -signal.SIGKILL, died.stderr.decode()
    (recovered,) = find_recovered(folder)
    assert recovered.record.patient.name == "Anna B."
    assert recovered.path is None


@pytest.mark.slow
@pytest.mark.skipif(killed_windows.binaries() is None, reason="PostgreSQL is not installed")
def test_windows_killed_while_the_database_goes_and_comes_lose_nothing_they_said_was_kept() -> None:
    """The benchmark `autosave_kills` tries hundreds; with this seed the server goes meanwhile."""
    call = [sys.executable, killed_windows.__file__, "2", "9"]
    done = subprocess.run(
        call, timeout=PATIENCE_S * 10, check=False, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr
    counts = ast.literal_eval(done.stdout.splitlines()[-1])
    assert counts["kills"] == 2
    assert counts["stops"] > 0
    assert counts["said to be kept"] > 0


@pytest.fixture
def jobs(qapp: QApplication) -> Any:
    jobs = Jobs()
    yield jobs
    jobs.close()


def test_a_running_program_keeps_its_case_to_itself(jobs: Jobs, tmp_path: Path) -> None:
    case = Case()
    autosave = Autosave(case, jobs, tmp_path)
    case.apply(Patient(name="Anna"), "Edit")
    autosave.write_now()
    assert find_recovered(tmp_path) == []
    autosave.forget()
    autosave.close()
    assert list(tmp_path.iterdir()) == []


def test_a_window_that_ends_unasked_keeps_unsaved_work(jobs: Jobs, tmp_path: Path) -> None:
    case = Case()
    autosave = Autosave(case, jobs, tmp_path)
    case.apply(Patient(name="Anna"), "Edit")
    autosave.close()
    (recovered,) = find_recovered(tmp_path)
    recovered.discard()
    assert find_recovered(tmp_path) == []


def test_saving_removes_the_copy(jobs: Jobs, tmp_path: Path) -> None:
    case = Case()
    autosave = Autosave(case, jobs, tmp_path)
    case.apply(Patient(name="Anna"), "Edit")
    autosave.write_now()
    assert list(tmp_path.glob("*.insole"))
    case.mark_saved(case.record, tmp_path / "elsewhere.insole")
    assert not list(tmp_path.glob("*.insole"))
    autosave.close()


def test_every_change_is_written_a_moment_later(jobs: Jobs, qtbot: QtBot, tmp_path: Path) -> None:
    case = Case()
    autosave = Autosave(case, jobs, tmp_path)
    case.apply(Patient(name="Anna"), "Edit")
    qtbot.waitUntil(lambda: bool(list(tmp_path.glob("[!.]*.insole"))))
    autosave.forget()
    jobs.close()
    autosave.close()


class SlowDisk:
    """Writing a case in the background stops half-way until it may go on."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.has_started = threading.Event()
        self.goes_on = threading.Event()
        monkeypatch.setattr(autosave_module, "write_journal", self.write)

    def write(self, *given: Any) -> None:
        if threading.current_thread() is not threading.main_thread():
            self.has_started.set()
            assert self.goes_on.wait(PATIENCE_S)
        write_journal(*given)


@pytest.fixture
def slow_disk(monkeypatch: pytest.MonkeyPatch) -> Iterator[SlowDisk]:
    disk = SlowDisk(monkeypatch)
    yield disk
    disk.goes_on.set()


def test_a_late_job_does_not_replace_a_newer_copy(
    jobs: Jobs, slow_disk: SlowDisk, qtbot: QtBot, tmp_path: Path
) -> None:
    case = Case()
    autosave = Autosave(case, jobs, tmp_path)
    case.apply(Patient(name="Anna"), "Edit")
    qtbot.waitUntil(slow_disk.has_started.is_set)
    case.apply(Patient(name="Anna Berg"), "Edit")
    autosave.write_now()
    slow_disk.goes_on.set()
    jobs.close()
    (copy,) = tmp_path.glob("*.insole")
    assert read_case(copy).patient.name == "Anna Berg"
    autosave.forget()
    autosave.close()


def test_a_late_job_does_not_bring_back_the_copy_of_a_saved_case(
    jobs: Jobs, slow_disk: SlowDisk, qtbot: QtBot, tmp_path: Path
) -> None:
    case = Case()
    autosave = Autosave(case, jobs, tmp_path)
    case.apply(Patient(name="Anna"), "Edit")
    qtbot.waitUntil(slow_disk.has_started.is_set)
    case.mark_saved(case.record, tmp_path / "elsewhere.insole")
    slow_disk.goes_on.set()
    jobs.close()
    assert not list(tmp_path.glob("*.insole"))
    autosave.close()


def test_a_start_leaves_what_another_window_is_writing_to_it(
    jobs: Jobs, slow_disk: SlowDisk, qtbot: QtBot, tmp_path: Path
) -> None:
    case = Case()
    autosave = Autosave(case, jobs, tmp_path)
    case.apply(Patient(name="Anna"), "Edit")
    qtbot.waitUntil(slow_disk.has_started.is_set)
    assert find_recovered(tmp_path, pytest.fail) == []
    slow_disk.goes_on.set()
    qtbot.waitUntil(lambda: autosave.is_kept)
    (copy,) = tmp_path.glob("*.insole")
    assert read_case(copy).patient.name == "Anna"
    assert not list(tmp_path.glob("*.broken-*"))
    autosave.forget()
    autosave.close()


def test_changes_that_follow_one_another_are_written_meanwhile(
    jobs: Jobs, qtbot: QtBot, tmp_path: Path
) -> None:
    case, names = Case(), itertools.count()
    autosave = Autosave(case, jobs, tmp_path)
    typing = QTimer()
    typing.timeout.connect(lambda: case.apply(Patient(name=f"{next(names)}"), "Edit"))
    typing.start(50)
    qtbot.waitUntil(lambda: bool(list(tmp_path.glob("[!.]*.insole"))))
    typing.stop()
    qtbot.waitUntil(lambda: autosave.is_kept)
    autosave.forget()
    autosave.close()


def test_a_journal_tells_by_itself_which_file_it_belongs_to(jobs: Jobs, tmp_path: Path) -> None:
    """Two files would not take their places at one moment."""
    case, path = Case(), tmp_path / "anna.insole"
    case.open(CaseRecord(), path, digest="0" * 64)
    autosave = Autosave(case, jobs, tmp_path / "autosave")
    case.apply(Patient(name="Anna"), "Edit")
    autosave.set_aside()
    (left,) = (tmp_path / "autosave").glob("*.insole")
    moved = shutil.copy(left, tmp_path / "moved.insole")
    assert read_case(Path(moved)).patient.name == "Anna"
    (recovered,) = find_recovered(tmp_path)
    assert (recovered.path, recovered.digest) == (path, "0" * 64)
    autosave.forget()
    autosave.close()


def test_a_lock_that_was_left_by_a_program_of_the_same_number_is_free(tmp_path: Path) -> None:
    """As in a container, where the program has the same number at every start."""
    write_case(CaseRecord(Patient("Anna")), tmp_path / "abc.insole")
    left = QLockFile(str(tmp_path / "other.lock"))
    assert left.tryLock(0)
    shutil.copy(tmp_path / "other.lock", tmp_path / "abc.lock")
    left.unlock()
    (recovered,) = find_recovered(tmp_path)
    assert recovered.record.patient.name == "Anna"
    recovered.discard()
    assert list(tmp_path.iterdir()) == []


def test_a_damaged_copy_is_told_and_ends(tmp_path: Path) -> None:
    (tmp_path / "abc.insole").write_bytes(b"cut off")
    told: list[Message] = []
    assert find_recovered(tmp_path, told.append) == []
    (kept,) = tmp_path.iterdir()
    assert str(told[0]) == (
        f"The copy {tmp_path / 'abc.insole'} of unsaved work is damaged; it is kept as {kept} for "
        "30 days."
    )
    assert find_recovered(tmp_path, pytest.fail) == []
    long_ago = time.time() - (DAMAGED_DAYS + 1) * 86_400
    os.utime(kept, (long_ago, long_ago))
    find_recovered(tmp_path, told.append)
    assert "is removed now" in told[1]
    assert list(tmp_path.iterdir()) == []


def test_a_copy_that_was_taken_for_damaged_but_is_whole_is_offered(tmp_path: Path) -> None:
    """Programs of before renamed what another window was writing."""
    taken = tmp_path / ".insole-studio-4711-0123456789ab.insole.broken-1"
    write_case(CaseRecord(Patient("Anna")), tmp_path / "a.insole")
    (tmp_path / "a.insole").rename(taken)
    (recovered,) = find_recovered(tmp_path, pytest.fail)
    assert recovered.record.patient.name == "Anna"
    assert not taken.exists()
    recovered.release()


def test_the_file_of_a_recovered_case_is_found_whatever_it_is_called(tmp_path: Path) -> None:
    path = tmp_path / "Eva\u00a0Ek \u202e2.insole"
    write_journal(CaseRecord(Patient("Eva")), Origin(str(path)), new_journal(tmp_path))
    (recovered,) = find_recovered(tmp_path, pytest.fail)
    assert recovered.path == path
    recovered.release()


def test_a_copy_that_may_not_be_taken_back_keeps_nobody_from_the_others(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("a.insole", "b.insole"):
        write_case(CaseRecord(Patient("Anna")), tmp_path / name)
    taken = (tmp_path / "a.insole").rename(tmp_path / "a.insole.broken-1")

    def refuse(path: Path, _target: Path) -> None:
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr(Path, "rename", refuse)
    (recovered,) = find_recovered(tmp_path, pytest.fail)
    assert recovered.copies[0] == tmp_path / "b.insole"
    assert taken.exists()
    recovered.release()


@pytest.mark.slow
def test_the_next_start_opens_the_recovered_case(
    app: Application, make_foot: Any, paths: UserPaths, qapp: QApplication
) -> None:
    app.case.open_foot(make_foot(Side.RIGHT), ScanSource("mesh", "/x.ply", "0" * 64))
    app.autosave.write_now()
    copy = next(paths.autosave_folder.glob("*.insole"))
    left = paths.autosave_folder / "left-by-the-dead.insole"
    left.write_bytes(copy.read_bytes())
    (recovered,) = find_recovered(paths.autosave_folder)
    second = build_application(qapp, paths)
    second.features.case_files.recovery.offer([recovered])
    assert second.case.side is Side.RIGHT
    assert second.case.has_unsaved_changes
    assert not left.exists()
    second.autosave.forget()
    second.close()


def test_a_copy_that_cannot_be_written_is_told_in_a_message(
    jobs: Jobs, qtbot: QtBot, tmp_path: Path
) -> None:
    folder = tmp_path / "autosave"
    case = Case()
    autosave = Autosave(case, jobs, folder)
    shutil.rmtree(folder)
    with qtbot.waitSignal(autosave.failed) as failed:
        case.apply(Patient(name="Anna"), "Edit")
    assert failed.args is not None
    (sentence,) = failed.args
    assert isinstance(sentence, Message)
    assert sentence.template == "{path} cannot be written: {reason}."
