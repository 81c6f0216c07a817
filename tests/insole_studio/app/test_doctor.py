"""What `doctor` finds on a computer, and the dialog that shows it."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from insole_core.records.author import Author
from insole_core.records.person import Person
from insole_core.records.place import DATABASE_FILE, RecordsPlace
from insole_core.records.records import open_records
from insole_studio.acquisition.examined_sensors import ExaminedSensor
from insole_studio.acquisition.messages import DetectedSensor
from insole_studio.acquisition.sensor_port import SensorError
from insole_studio.app.bootstrap import Application
from insole_studio.app.doctor import Diagnosis, Doctor, FindSensors, report_lines
from insole_studio.app.graphics import Graphics
from insole_studio.app.help_actions import DoctorDialog
from insole_studio.cli.main import run
from insole_studio.user_paths import UserPaths

GOOD = Graphics((4, 6), "Radeon")


def none() -> tuple[ExaminedSensor, ...]:
    return ()


def examined(
    paths: UserPaths, graphics: Graphics | None = GOOD, sensors: FindSensors = none
) -> dict[str, list[Diagnosis]]:
    found: dict[str, list[Diagnosis]] = {}
    for diagnosis in Doctor(paths, graphics, sensors).examine():
        found.setdefault(diagnosis.topic, []).append(diagnosis)
    return found


def sensor(serial: str, bus: int, problem: str | None = None) -> ExaminedSensor:
    return ExaminedSensor(DetectedSensor(serial, "1473", bus, f"{bus}-1", problem), "1.14", True)


@pytest.mark.parametrize(
    ("graphics", "advice"),
    [
        (GOOD, ""),
        (Graphics((4, 5), "llvmpipe (LLVM 15)"), "The processor draws"),
        (Graphics((2, 1), "Old card"), "The 3-D views need OpenGL 3.2"),
        (Graphics(None), "LIBGL_ALWAYS_SOFTWARE=1"),
    ],
)
def test_each_fault_of_the_graphics_has_its_advice(
    paths: UserPaths, graphics: Graphics, advice: str
) -> None:
    found = examined(paths, graphics)["Graphics"][0].advice
    assert advice in found
    assert bool(advice) == bool(found)


def test_sensors_that_share_a_controller_are_told(paths: UserPaths) -> None:
    three = (sensor("A1", 1), sensor("A2", 1), sensor("A3", 2, "It has no power."))
    found = examined(paths, sensors=lambda: three)["Sensors"]
    assert found[0].state == "A1, model 1473, device 1.14, USB controller 1"
    assert "shares USB controller 1" in found[0].advice
    assert "shares USB controller 1" in found[1].advice
    assert found[2].advice == "It has no power."


def test_a_bus_that_cannot_be_read_does_not_end_the_examination(paths: UserPaths) -> None:
    def broken() -> tuple[ExaminedSensor, ...]:
        raise SensorError("libusb is missing.")

    found = examined(paths, sensors=broken)
    assert found["Sensors"] == [Diagnosis("Sensors", "cannot be examined", "libusb is missing.")]
    assert found["Record"][0].state == "none yet"


def test_damaged_settings_are_told_and_stay_as_they_are(paths: UserPaths) -> None:
    paths.settings_folder.mkdir(parents=True, exist_ok=True)
    paths.settings_file.write_text('{"theme": 7}')
    found = examined(paths)["Settings"][0]
    assert found.state == "damaged in part"
    assert paths.settings_file.read_text() == '{"theme": 7}'
    assert not list(paths.settings_folder.glob("*broken*"))


def test_a_damaged_record_is_told_and_a_whole_one_is_not(paths: UserPaths) -> None:
    open_records(RecordsPlace.local(paths.records_folder), Author("anna", "desk")).close()
    assert examined(paths)["Record"][0].advice == ""
    database = paths.records_folder / DATABASE_FILE
    for beside in paths.records_folder.glob(f"{DATABASE_FILE}-*"):
        beside.unlink()
    content = bytearray(database.read_bytes())
    content[4096:] = b"\xff" * (len(content) - 4096)
    database.write_bytes(content)
    assert examined(paths)["Record"][0].advice
    database.write_bytes(b"no database" * 1000)
    assert examined(paths)["Record"][0].state == "cannot be examined"
    database.write_bytes(b"")
    assert examined(paths)["Record"][-1].state == "cannot be opened"
    database.unlink()
    assert "is missing, but the files" in str(examined(paths)["Record"][-1].advice)


def test_no_name_of_a_patient_is_in_the_report(
    paths: UserPaths, monkeypatch: pytest.MonkeyPatch
) -> None:
    home = paths.settings_folder.parent
    monkeypatch.setenv("HOME", str(home))
    records = open_records(RecordsPlace.local(paths.records_folder), Author("anna", "desk"))
    records.persons.add(Person("Gustava Berg"))
    records.close()
    paths.settings_folder.mkdir(parents=True, exist_ok=True)
    paths.settings_file.write_text('{"recent": ["/clinic/Gustava Berg.insole"]}')
    report = "\n".join(report_lines(Doctor(paths, GOOD, none).examine()))
    assert "Gustava" not in report
    assert str(home) not in report


def test_the_command_prints_and_writes_the_same(
    paths: UserPaths, qapp: QApplication, tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.setattr(UserPaths, "of_user", lambda: paths)
    report = tmp_path / "report.txt"
    assert run(["doctor", "--report", str(report)]) == 0
    assert report.read_text(encoding="utf-8") == capsys.readouterr().out
    assert "Disk" in report.read_text(encoding="utf-8")


def test_the_dialog_shows_and_copies_what_is_found(
    app: Application, qtbot: QtBot, qapp: QApplication
) -> None:
    app.window.actions_by_key["doctor"].trigger()
    dialog = next(d for d in app.window.findChildren(DoctorDialog) if d.isVisible())
    qtbot.waitUntil(dialog.copy.isEnabled)
    assert "Disk" in dialog.text.toPlainText()
    dialog.copy.click()
    assert "Disk: " in qapp.clipboard().text()
    dialog.close()


def test_a_dialog_that_is_closed_at_once_is_no_error(app: Application, qtbot: QtBot) -> None:
    app.window.actions_by_key["doctor"].trigger()
    dialog = next(d for d in app.window.findChildren(DoctorDialog) if d.isVisible())
    with qtbot.waitSignal(dialog.destroyed):
        dialog.close()
    qtbot.waitUntil(lambda: not app.jobs.is_running())
    assert app.services.messages.dialogs == []
