"""``insole-studio self-test``: passes here, and names the step that does not."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication

from insole_core import resources
from insole_studio.cli import self_test_steps
from insole_studio.cli.main import run
from insole_studio.cli.self_test_steps import SelfTest, StepResult
from insole_studio.user_paths import UserPaths
from tests.patience import PATIENCE_S


def lines(report: Path) -> dict[str, str]:
    """Return the first word of the line of each step, by what follows the time."""
    found = {}
    for line in report.read_text(encoding="utf-8").splitlines()[1:-1]:
        found[line[18:].split(":")[0]] = line.split()[0]
    return found


def quick(monkeypatch: pytest.MonkeyPatch, *names: str) -> None:
    """Leave out the steps that take long and are not what a test is about."""
    for name in names:
        monkeypatch.setattr(SelfTest, name, lambda _self: None)


def unexpected(result: StepResult) -> None:
    raise AssertionError(result.line)


@pytest.mark.slow
@pytest.mark.usefixtures("quick_passphrases")
def test_all_steps_pass_and_nothing_of_the_user_is_touched(
    qapp: QApplication, small_session: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def touched() -> UserPaths:
        raise AssertionError("the user's own files")

    monkeypatch.setattr(UserPaths, "of_user", touched)
    report, out = tmp_path / "report.txt", tmp_path / "out put ö"
    call = ["self-test", "--session", str(small_session), "--report", str(report)]
    with pytest.raises(SystemExit) as ended:
        run([*call, "--out", str(out)])
    assert ended.value.code == 0, report.read_text(encoding="utf-8")
    states = lines(report)
    assert len(states) == 14
    assert set(states.values()) == {"passed"}
    assert (out / "comparison.pdf").read_bytes().startswith(b"%PDF")


def test_a_missing_resource_is_named_and_what_needs_it_is_not_tried(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, small_session: Path
) -> None:
    monkeypatch.setattr(resources, "_PACKAGE", tmp_path)
    quick(monkeypatch, "_play")
    report = tmp_path / "report.txt"
    with pytest.raises(SystemExit) as ended:
        run(["self-test", "--session", str(small_session), "--report", str(report)])
    assert ended.value.code == 1
    states = lines(report)
    assert states["find the program's files"] == "failed"
    assert states["record a session"] == "passed"
    assert states["open the window"] == "-"
    text = report.read_text(encoding="utf-8")
    assert "the resource example/example.insole is missing from this installation" in text
    assert text.endswith("first at “find the program's files”.\n")


def test_a_folder_that_cannot_be_made_is_told_in_a_sentence(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    results: list[StepResult] = []
    SelfTest(tmp_path / "file" / "out", None, results.append, unexpected).run()
    failed = [result for result in results if result.seconds is not None and result.problem]
    assert [result.name for result in failed] == ["make the folder"]
    assert str(tmp_path / "file") in failed[0].problem
    assert not failed[0].trace


def test_a_full_disk_fails_the_step_that_writes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(path: Path) -> None:
        raise OSError(28, "No space left on device", str(path))

    monkeypatch.setattr(self_test_steps, "record_simulated", full)
    quick(monkeypatch, "_open_window", "_open_example")
    results: list[StepResult] = []
    SelfTest(tmp_path / "out", None, results.append, unexpected).run()
    failed = [result for result in results if result.seconds is not None and result.problem]
    assert [result.name for result in failed] == ["record a session"]
    assert "the disk is full" in failed[0].problem


def test_an_error_in_the_program_is_told_with_its_trace(
    tmp_path: Path, small_session: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(_self: SelfTest) -> None:
        raise ZeroDivisionError("division by zero")

    quick(monkeypatch, "_play", "_open_example")
    monkeypatch.setattr(SelfTest, "_open_window", broken)
    results: list[StepResult] = []
    SelfTest(tmp_path / "out", small_session, results.append, unexpected).run()
    failed = next(result for result in results if result.problem)
    assert failed.name == "open the window"
    assert "ZeroDivisionError" in failed.problem
    assert "in broken" in failed.trace


def test_a_step_that_does_not_end_is_told_with_where_it_stands(tmp_path: Path) -> None:
    report = tmp_path / "report.txt"
    code = (
        "import sys, time\n"
        "from insole_studio.cli import self_test_steps\n"
        "from insole_studio.cli.main import run\n"
        "def hang(_self): time.sleep(60)\n"
        "self_test_steps.MOST_SECONDS = 0.5\n"
        "self_test_steps.SelfTest._find_files = hang\n"
        "run(sys.argv[1:])\n"
    )
    call = [sys.executable, "-c", code, "self-test", "--report", str(report)]
    environment = {**os.environ, "TMPDIR": str(tmp_path)}
    ended = subprocess.run(
        call, env=environment, capture_output=True, timeout=PATIENCE_S, check=False
    )
    assert ended.returncode == 1, ended.stderr
    text = report.read_text(encoding="utf-8")
    assert "find the program's files: it did not end within" in text
    assert "in hang" in text
    assert text.endswith("given up at “find the program's files”.\n")
    assert list(tmp_path.iterdir()) == [report]
