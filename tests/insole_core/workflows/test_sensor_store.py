from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from insole_core.errors import CalibrationError, InputError, OutputError, UsageError
from insole_core.geometry.transforms import rigid, rotation_about
from insole_core.sensing.correction import CorrectionRecord, DisparityCorrection
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor
from insole_core.workflows.calibration.sensor_store import SensorStore

SENSOR = Sensor(
    model="kinect-v1",
    serial="A00362A00127049A",
    depth_camera=PinholeCamera(640, 480, 585.6, 586.1, 316.0, 247.6),
    color_camera=PinholeCamera(1280, 1024, 1034.4, 1034.3, 640.2, 528.0, (0.14, -0.24, 0, 0, 0)),
    depth2color=rigid(rotation_about(np.array([1.0, 2, 3]), 1.5), np.array([-25.0, 0.4, -1.2])),
    disparity=LinearInverseDisparity(3.33, -0.00307),
    correction=DisparityCorrection(
        np.arange(480 * 640, dtype=np.float32).reshape(480, 640) / 1e5,
        record=CorrectionRecord(serial="A00362A00127049A", made_at="2026-11-20T10:00:00+00:00"),
    ),
    faces=("sole",),
)


def test_a_saved_sensor_comes_back(tmp_path: Path) -> None:
    store = SensorStore(tmp_path / "not" / "there yet")
    assert store.serials() == []
    assert store.load(SENSOR.serial) is None
    store.save(SENSOR)
    assert store.serials() == [SENSOR.serial]
    found = store.load(SENSOR.serial)
    assert found is not None
    assert found.color_camera == SENSOR.color_camera
    assert found.disparity == SENSOR.disparity
    np.testing.assert_allclose(found.depth2color, SENSOR.depth2color, atol=1e-12)
    assert found.correction is not None
    assert SENSOR.correction is not None
    np.testing.assert_array_equal(found.correction.offset, SENSOR.correction.offset)
    assert found.correction.record == SENSOR.correction.record


def test_other_files_stay_and_reports_are_attached(tmp_path: Path) -> None:
    store = SensorStore(tmp_path)
    folder = store.save(SENSOR, lambda beside: (beside / "color.html").write_text("a") and None)
    store.save(replace(SENSOR, correction=None))
    assert sorted(path.name for path in folder.iterdir()) == ["before", "color.html", "sensor.json"]


def test_the_last_step_is_undone_and_done_again(tmp_path: Path) -> None:
    store = SensorStore(tmp_path)
    assert not store.can_undo(SENSOR.serial)
    with pytest.raises(UsageError, match="Nothing is kept of sensor"):
        store.undo(SENSOR.serial)
    folder = store.save(SENSOR, lambda beside: (beside / "color.html").write_text("a") and None)
    (folder / "pictures").mkdir()
    first = files_of(folder)
    store.save(replace(SENSOR, correction=None), lambda beside: (beside / "stereo.pdf").touch())
    second = files_of(folder)
    for now, before in ((first, second), (second, first)):
        assert store.undo(SENSOR.serial)
        assert files_of(folder) == now
        assert files_of(folder / "before") == before
        assert (folder / "pictures").is_dir()


def test_a_calibration_that_cannot_be_read_has_a_way_back(tmp_path: Path) -> None:
    store = SensorStore(tmp_path)
    folder = store.save(SENSOR)
    text = (folder / "sensor.json").read_text().replace("-0.00307", "0.00307")
    (folder / "sensor.json").write_text(text)
    with pytest.raises(InputError, match=r"undo its last step .* calibrate undo --serial A0.*"):
        store.load(SENSOR.serial)
    assert not store.undo(SENSOR.serial)  # there was none before
    assert store.load(SENSOR.serial) is None
    store.save(SENSOR)
    assert store.load(SENSOR.serial) is not None


@pytest.mark.parametrize(
    "wrong",
    [
        {"disparity": LinearInverseDisparity(-0.009, 0.0031)},
        {"disparity": LinearInverseDisparity(float("nan"), -0.003)},
        {"depth_camera": PinholeCamera(640, 480, -585.6, 586.1, 316.0, 247.6)},
        {"depth2color": np.diag([1.0, 1.0, -1.0, 1.0])},
        {"correction": DisparityCorrection(np.full((480, 640), np.nan, np.float32))},
        {"correction": DisparityCorrection(np.zeros((4, 6), np.float32))},
    ],
    ids=["reversed", "no number", "focal length", "mirrored", "map", "size of the map"],
)
def test_what_could_not_be_read_again_is_not_saved(wrong: dict, tmp_path: Path) -> None:
    store = SensorStore(tmp_path)
    folder = store.save(SENSOR)
    before = files_of(folder)
    with pytest.raises(CalibrationError, match="Nothing was saved, because sensor A00362A"):
        store.save(replace(SENSOR, **wrong))
    assert files_of(folder) == before
    assert store.load(SENSOR.serial) is not None


def files_of(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


def test_a_failed_save_leaves_the_old_calibration(tmp_path: Path) -> None:
    store = SensorStore(tmp_path)
    store.save(SENSOR)

    def fail(_folder: Path) -> None:
        raise InputError("no report")

    with pytest.raises(InputError):
        store.save(replace(SENSOR, correction=None), fail)
    found = store.load(SENSOR.serial)
    assert found is not None
    assert found.correction is not None
    assert [path.name for path in tmp_path.iterdir()] == [SENSOR.serial]


def test_a_place_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match="cannot be written"):
        SensorStore(tmp_path / "file" / "sensors").save(SENSOR)


@pytest.mark.parametrize("serial", ["", "../up", "a b", "ü"])
def test_what_is_no_serial_number(tmp_path: Path, serial: str) -> None:
    with pytest.raises(UsageError, match="no serial number"):
        SensorStore(tmp_path).load(serial)


def test_a_folder_of_another_sensor(tmp_path: Path) -> None:
    SensorStore(tmp_path).save(SENSOR).rename(tmp_path / "B1")
    with pytest.raises(InputError, match="holds the calibration of sensor A00362"):
        SensorStore(tmp_path).load("B1")


def test_what_a_killed_program_left_is_no_sensor(tmp_path: Path) -> None:
    SensorStore(tmp_path).save(SENSOR).rename(tmp_path / ".insole-studio-77-0123456789ab")
    assert SensorStore(tmp_path).serials() == []


@pytest.mark.parametrize("place", ["/dev/zero", "sensor.json"])
@pytest.mark.parametrize("name", ["sensor.json", "before/sensor.json", "notes.txt"])
def test_what_has_no_end_is_not_copied(tmp_path: Path, name: str, place: str) -> None:
    store = SensorStore(tmp_path)
    store.save(SENSOR)
    folder = store.save(replace(SENSOR, correction=None))
    path = folder / name
    path.unlink(missing_ok=True)
    path.symlink_to(place if place == "/dev/zero" else path.name)
    before = sorted(path.relative_to(tmp_path) for path in tmp_path.rglob("*"))
    with pytest.raises(InputError, match="cannot be read"):
        store.undo(SENSOR.serial)
    assert sorted(path.relative_to(tmp_path) for path in tmp_path.rglob("*")) == before
