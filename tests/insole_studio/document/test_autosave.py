from __future__ import annotations

import shutil
import signal
import subprocess
import sys
import textwrap
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import CaseRecord, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.geometry.side import Side
from insole_core.messages import Message
from insole_studio.app.bootstrap import Application, build_application
from insole_studio.document import autosave as autosave_module
from insole_studio.document.autosave import Autosave, find_recovered
from insole_studio.document.case import Case
from insole_studio.jobs import Jobs
from insole_studio.user_paths import UserPaths

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
    died = subprocess.run(call, timeout=60, check=False, capture_output=True)
    assert died.returncode == -signal.SIGKILL, died.stderr.decode()
    (recovered,) = find_recovered(folder)
    assert recovered.record.patient.name == "Anna B."
    assert recovered.path is None


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
    qtbot.waitUntil(lambda: bool(list(tmp_path.glob("[!.]*.insole"))), timeout=5000)
    autosave.forget()
    jobs.close()
    autosave.close()


class SlowDisk:
    """Writing a case in the background stops half-way until it may go on."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.has_started = threading.Event()
        self.goes_on = threading.Event()
        monkeypatch.setattr(autosave_module, "write_case", self.write)

    def write(self, record: CaseRecord, path: Path) -> str:
        if threading.current_thread() is not threading.main_thread():
            self.has_started.set()
            assert self.goes_on.wait(timeout=30)
        return write_case(record, path)


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
    qtbot.waitUntil(slow_disk.has_started.is_set, timeout=10000)
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
    qtbot.waitUntil(slow_disk.has_started.is_set, timeout=10000)
    case.mark_saved(case.record, tmp_path / "elsewhere.insole")
    slow_disk.goes_on.set()
    jobs.close()
    assert not list(tmp_path.glob("*.insole"))
    autosave.close()


def test_a_damaged_copy_is_not_offered(tmp_path: Path) -> None:
    (tmp_path / "abc.insole").write_bytes(b"cut off")
    assert find_recovered(tmp_path) == []


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
