"""Reports of errors in the program itself: written without patients' data, offered at the start."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from PySide6.QtWidgets import QPushButton

from insole_studio.app.bootstrap import Application
from insole_studio.app.crash_reports import CrashReports, ReportDialog, report_of


def failed(name: str) -> Exception:
    try:
        raise ValueError(f"no foot in /clinic/{name}.insole")
    except ValueError as error:
        return error


def test_a_report_tells_where_and_neither_what_nor_whose() -> None:
    report = report_of(failed("Gustava Berg"))
    assert "builtins.ValueError" in report
    assert "test_crash_reports.py" in report
    assert "in failed" in report
    assert "Gustava" not in report
    assert str(Path(__file__).parents[3]) not in report


def test_a_report_is_offered_looked_at_and_removed(app: Application, tmp_path: Path) -> None:
    reports = CrashReports(tmp_path / "crashes")
    reports.offer(app.services)
    assert button(app, "Look at the report") is None
    reports.write(failed("Gustava Berg"))
    reports.offer(app.services)
    look = button(app, "Look at the report")
    assert look is not None
    look.click()
    dialog = next(d for d in app.window.findChildren(ReportDialog) if d.isVisible())
    assert "ValueError" in dialog.text.toPlainText()
    dialog.removed.click()
    assert reports.left() == []
    assert not dialog.isVisible()


@pytest.mark.parametrize("gone", [1, 2])
def test_reports_that_another_window_removes_while_they_are_offered(
    app: Application, tmp_path: Path, gone: int
) -> None:
    reports = CrashReports(tmp_path)
    for name in ("Gustava Berg", "Anna Holm"):
        reports.write(failed(name))
    reports.offer(app.services)
    for path in reports.left()[:gone]:
        path.unlink()
    look = button(app, "Look at the report")
    assert look is not None
    look.click()
    shown = [d for d in app.window.findChildren(ReportDialog) if d.isVisible()]
    assert [d.text.toPlainText().count("ValueError") for d in shown] == [1] * (2 - gone)
    said = app.window.statusBar().currentMessage()
    assert said == ("" if shown else "The report was removed by another window.")


def button(app: Application, text: str) -> QPushButton | None:
    found = (b for b in app.window.findChildren(QPushButton) if b.text() == text)
    return next(found, None)


def test_a_crash_of_a_library_leaves_a_report_and_a_good_end_does_not(tmp_path: Path) -> None:
    begin = (
        "from pathlib import Path; import sys, faulthandler;"
        "from insole_studio.app.crash_reports import CrashReports;"
        "reports = CrashReports(Path(sys.argv[1])); reports.begin();"
    )
    good = [sys.executable, "-c", begin + "reports.end()", str(tmp_path)]
    assert subprocess.run(good, check=False).returncode == 0
    assert list(tmp_path.iterdir()) == []
    bad = [sys.executable, "-c", begin + "faulthandler._sigsegv()", str(tmp_path)]
    assert subprocess.run(bad, check=False, stderr=subprocess.DEVNULL).returncode != 0
    left = CrashReports(tmp_path).left()
    assert len(left) == 1
    assert "Fatal Python error" in left[0].read_text(encoding="utf-8")


def test_a_folder_that_cannot_be_written_costs_only_the_report(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    reports = CrashReports(tmp_path / "file" / "crashes")
    reports.begin()
    reports.write(failed("x"))
    reports.end()
    assert reports.left() == []


def test_a_report_that_another_window_has_just_removed_is_passed_over(tmp_path: Path) -> None:
    reports = CrashReports(tmp_path)
    reports.write(failed("Gustava Berg"))
    for name in ("fault-1.log", "error-1.txt"):
        (tmp_path / name).symlink_to(tmp_path / "gone")  # listed, and then not there
    (left,) = reports.left()
    assert "ValueError" in left.read_text()
