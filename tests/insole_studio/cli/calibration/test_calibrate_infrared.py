"""``insole-studio calibrate infrared`` on walls of a device whose dots are known."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from simulated_device import DISPARITY, SimulatedDevice, smooth_distortion, wall
from simulated_folders import SENSOR
from simulated_infrared import (
    dots,
    infrared_picture,
    write_infrared,
    write_infrared_walls,
    write_sensor_beside,
)

from insole_core.geometry.arrays import Float32Array
from insole_core.recording.reader import read_session
from insole_core.recording.session import DotPictures, InfraredPictures
from insole_core.recording.writer import write_session
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.infrared_reference import InfraredReference, load_reference
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.cli.main import run

PLANES = (wall(620, 3, -2), wall(690, -4, 1), wall(740, 0, 4), wall(810, 2, -3), wall(880, -2, 2))
DEVICE = SimulatedDevice(smooth_distortion(3, 3.0), disparity=DISPARITY)


@dataclass(frozen=True)
class Learnt:
    """What was recorded once, and what was learnt from it."""

    pattern: Float32Array
    walls: Path
    sensor: Path
    sensors: Path
    out: Path

    def copied(self, folder: Path) -> Path:
        return Path(shutil.copytree(self.walls, folder / "walls"))

    def learning(self, walls: Path, out: Path) -> list[str]:
        return [
            "calibrate",
            "infrared",
            str(walls),
            "--sensor",
            str(self.sensor),
            "--out",
            str(out),
        ]

    def checking(self, walls: Path, reference: Path) -> list[str]:
        call = ["calibrate", "infrared", str(walls), "--sensor", str(self.sensor)]
        return [*call, "--check", str(reference)]


def other_dots(pattern: Float32Array, number: int) -> Float32Array:
    """Dots that have nothing in common with those of the pattern in the same rows."""
    return np.roll(pattern, 60 * number, axis=0)


@pytest.fixture(scope="module")
def learnt(tmp_path_factory: pytest.TempPathFactory) -> Learnt:
    folder = tmp_path_factory.mktemp("infrared")
    pattern = dots(1)
    correction = DisparityCorrection(DEVICE.distortion_raw.astype(np.float32))
    made = Learnt(
        pattern,
        write_infrared_walls(folder / "walls", DEVICE, pattern, PLANES),
        write_sensor_beside(folder / "sensor", replace(SENSOR, correction=correction)),
        folder / "sensors",
        folder / "reference.npz",
    )
    SensorStore(made.sensors).save(SENSOR)
    kept = ["--keep", "--sensors", str(made.sensors)]
    assert run([*made.learning(made.walls, made.out), *kept]) == 0
    return made


@pytest.fixture(scope="module")
def reference(learnt: Learnt) -> InfraredReference:
    return load_reference(learnt.out)


def test_the_pattern_is_learnt_finer_than_a_pixel(
    learnt: Learnt, reference: InfraredReference
) -> None:
    v = slice(40, 440)
    columns = np.arange(120 * reference.fine, 640 * reference.fine)
    places = np.rint((columns / reference.fine + reference.first_px) * 8).astype(int)
    seen, true = reference.pattern[v, columns], learnt.pattern[v, places]

    assert np.corrcoef(seen.ravel(), true.ravel())[0, 1] > 0.97
    assert reference.record.serial == "SIM1"
    assert reference.record.figures["walls"] == 5
    assert reference.record.figures["residual_raw"] < 0.35


def test_the_distortion_of_the_device_is_that_of_its_infrared_pictures(
    reference: InfraredReference,
) -> None:
    raw = np.full((480, 640), 600.0)
    true = DEVICE.distortion_raw * np.exp(-DEVICE.decay * (raw - 650))
    error = (reference.correction.offset_at(raw) - true)[24:-24, 24:-24]

    assert np.sqrt(np.mean((error - error.mean()) ** 2)) < 0.3


def test_one_wall_says_whether_the_pattern_still_holds(
    learnt: Learnt,
    capsys: pytest.CaptureFixture[str],
    last_line: Callable[[], str],
    tmp_path: Path,
) -> None:
    assert run(learnt.checking(learnt.walls, learnt.out)) == 0
    said = capsys.readouterr().out
    assert "By infrared_00.png the pattern still holds" in said
    assert "A shift along the rows that is the same on all of the wall cannot be seen" in said

    drifted = learnt.copied(tmp_path)
    _half(drifted, learnt.pattern)  # another wall than that of the check
    raw = DEVICE.distorted(PLANES[0]) + 0.8  # a tenth of a pixel
    write_infrared(drifted / "infrared_00.png", 64 * infrared_picture(learnt.pattern, raw, 9))
    assert run(learnt.checking(drifted, learnt.out)) == 1
    assert "infrared_00.png: The pattern has drifted by 0.1" in last_line()

    low = cv2.warpAffine(
        learnt.pattern, np.array([[1, 0, 0], [0, 1, 0.15]]), learnt.pattern.shape[::-1]
    )
    raw = DEVICE.distorted(PLANES[0])
    write_infrared(drifted / "infrared_00.png", 64 * infrared_picture(low, raw, 9))
    assert run(learnt.checking(drifted, learnt.out)) == 1
    assert "infrared_00.png: The pattern has drifted by 0.1" in last_line()

    other = 64 * infrared_picture(other_dots(learnt.pattern, 1), raw, 9)
    write_infrared(drifted / "infrared_00.png", other)
    assert run(learnt.checking(drifted, learnt.out)) == 1
    assert "shows another pattern" in last_line()


@pytest.mark.parametrize("distance_mm", [530, 980])
def test_a_wall_beyond_those_learnt_from_tells_no_drift(
    distance_mm: float, learnt: Learnt, last_line: Callable[[], str], tmp_path: Path
) -> None:
    plane = wall(distance_mm, 1, 1)
    walls = write_infrared_walls(tmp_path / "walls", DEVICE, learnt.pattern, [plane])

    assert run(learnt.checking(walls, learnt.out)) == 1
    said = last_line()
    assert f"infrared_00.png shows a wall {distance_mm} mm away" in said
    assert "learnt from walls at 620 to 880 mm" in said


def test_a_shift_of_pattern_and_depth_along_the_rows_stays_unseen(
    learnt: Learnt, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    shifted = learnt.copied(tmp_path)
    device = SimulatedDevice(DEVICE.distortion_raw + 0.8, disparity=DISPARITY)
    seen = infrared_picture(learnt.pattern, device.distorted(PLANES[0]), 9)
    write_infrared(shifted / "infrared_00.png", 64 * seen)
    (frame,) = device.frames(PLANES[0], 1)
    write_depth(shifted / "depth_00.png", frame)

    assert run(learnt.checking(shifted, learnt.out)) == 0
    assert "cannot be seen" in capsys.readouterr().out


def test_a_kept_pattern_is_put_into_the_sessions_of_its_sensor(
    learnt: Learnt, small_session: Path, tmp_path: Path, last_line: Callable[[], str]
) -> None:
    session = read_session(small_session)
    black = np.zeros((480, 640), np.uint16)
    dots = DotPictures(InfraredPictures(1, lambda _: black, 16), shift_px=(4.8, 3.9))
    given = replace(session.views[0], sensor=replace(SENSOR, faces=("sole",)), dots=dots)
    manifest = replace(session.manifest, views=(given.name,))
    write_session(replace(session, manifest=manifest, views=(given,)), tmp_path / "session")
    copy = ["calibrate", "session", str(tmp_path / "session"), "--out", str(tmp_path / "copy")]
    assert run([*copy, "--sensors", str(learnt.sensors)]) == 0

    (view,) = read_session(tmp_path / "copy").views
    assert view.dots is not None
    assert view.dots.fault == ""
    assert view.dots.shift_px == (4.8, 3.9)
    assert view.dots.reference is not None
    assert view.dots.reference.record.serial == "SIM1"

    assert run([*learnt.learning(learnt.walls, tmp_path / "out.npz"), "--keep", "--sensors",
                str(tmp_path)]) == 1  # fmt: skip
    assert "Sensor SIM1 was never calibrated here" in last_line()
    store = SensorStore(Path(shutil.copytree(learnt.sensors, tmp_path / "sensors")))
    assert store.undo("SIM1")
    assert store.reference("SIM1") is None


def test_walls_may_be_shifted_against_their_depth(
    learnt: Learnt, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """A check of shifted pictures, with the shift in sensor.json, finds the pattern in place."""
    walls, sensor = learnt.copied(tmp_path), tmp_path / "sensor.json"
    shutil.copytree(learnt.sensor.parent, tmp_path, dirs_exist_ok=True)
    values = json.loads(sensor.read_text())
    sensor.write_text(json.dumps({**values, "infrared_shift_px": [5, 4]}))
    picture = infrared_picture(learnt.pattern, DEVICE.distorted(PLANES[0]), 0)
    write_infrared(walls / "infrared_00.png", 64 * np.roll(picture, (4, 5), (0, 1)))

    call = ["calibrate", "infrared", str(walls), "--sensor", str(sensor)]
    assert run([*call, "--check", str(learnt.out)]) == 0
    assert "the pattern still holds" in capsys.readouterr().out


def _fewer(walls: Path, _pattern: Float32Array) -> None:
    for number in (3, 4):
        (walls / f"infrared_{number:02d}.png").unlink()


def _without_depth(walls: Path, _pattern: Float32Array) -> None:
    (walls / "depth_02.png").unlink()


def _half(walls: Path, _pattern: Float32Array) -> None:
    path = walls / "infrared_02.png"
    path.write_bytes(path.read_bytes()[:100])


def _small(walls: Path, _pattern: Float32Array) -> None:
    write_infrared(walls / "infrared_02.png", np.full((240, 320), 5000.0))


def _saturated(walls: Path, _pattern: Float32Array) -> None:
    write_infrared(walls / "infrared_02.png", np.full((480, 640), 65535.0))


def _dark(walls: Path, _pattern: Float32Array) -> None:
    write_infrared(walls / "infrared_02.png", np.full((480, 640), 520.0))


def _of_another(walls: Path, _pattern: Float32Array) -> None:
    write_sensor_beside(walls / "other", replace(SENSOR, serial="SIM2")).rename(
        walls / "sensor.json"
    )


def _no_plane(walls: Path, _pattern: Float32Array) -> None:
    hill = 40 * np.exp(-((np.mgrid[-1:1:480j, -1:1:640j] * 2) ** 2).sum(0))
    raw = DEVICE.distorted(PLANES[0])
    for number in (2, 3):
        curved = np.round(raw + hill).astype(np.uint16)
        write_depth(walls / f"depth_{number:02d}.png", curved)


def _all_unlike(walls: Path, pattern: Float32Array) -> None:
    for number in range(len(PLANES)):
        raw = DEVICE.distorted(PLANES[number])
        picture = 64 * infrared_picture(other_dots(pattern, number), raw, number)
        write_infrared(walls / f"infrared_{number:02d}.png", picture)


def write_depth(path: Path, raw: np.ndarray) -> None:
    write_infrared(path, raw.astype(float))


@pytest.mark.parametrize(
    ("spoil", "sentence"),
    [
        (_fewer, "Only 3 walls can be used"),
        (_without_depth, "depth_02.png is missing beside infrared_02.png"),
        (_half, "infrared_02.png is no readable image"),
        (_small, "infrared_02.png is no infrared picture of 640×480"),
        (_saturated, "infrared_02.png is saturated"),
        (_dark, "infrared_02.png is almost dark"),
        (_of_another, "were recorded with sensor SIM2"),
        (_no_plane, "infrared_02.png: it shows no plane"),
        (_all_unlike, "infrared_02.png: it shows another pattern than the other walls."),
    ],
)
def test_walls_that_teach_no_pattern_are_told_in_a_sentence(
    spoil: Callable[[Path, Float32Array], None],
    sentence: str,
    learnt: Learnt,
    tmp_path: Path,
    last_line: Callable[[], str],
) -> None:
    walls, out = learnt.copied(tmp_path), tmp_path / "reference.npz"
    spoil(walls, learnt.pattern)

    assert run(learnt.learning(walls, out)) == 1
    assert sentence in last_line()
    assert not out.exists()


def test_walls_that_show_too_little_or_lie_at_one_distance_are_refused(
    learnt: Learnt, tmp_path: Path, last_line: Callable[[], str]
) -> None:
    walls, out = tmp_path / "walls", tmp_path / "reference.npz"
    near = [wall(700 + step, 2 * step, -step) for step in (0, 1, 2, 3)]
    write_infrared_walls(walls, DEVICE, learnt.pattern, near)

    assert run(learnt.learning(walls, out)) == 1
    assert "All walls lie between" in last_line()


def test_a_spoilt_or_foreign_reference_is_refused(
    learnt: Learnt, reference: InfraredReference, tmp_path: Path, last_line: Callable[[], str]
) -> None:
    half, newer, foreign = (tmp_path / name for name in ("half.npz", "newer.npz", "foreign.npz"))
    half.write_bytes(learnt.out.read_bytes()[:100_000])
    replace(reference, record=replace(reference.record, version=2)).save(newer)
    replace(reference, record=replace(reference.record, serial="SIM2")).save(foreign)

    for path, sentence in (
        (half, "half.npz holds no readable infrared reference pattern"),
        (newer, "newer.npz is of version 2"),
        (foreign, "The reference pattern is of sensor SIM2"),
    ):
        assert run(learnt.checking(learnt.walls, path)) == 1
        assert sentence in last_line()


def test_a_sensor_is_named_by_its_file_or_its_folder(
    learnt: Learnt, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    other = learnt.walls / "infrared_00.png"
    for named in (other, tmp_path, tmp_path / "sensor.json"):
        call = ["calibrate", "infrared", str(learnt.walls), "--sensor", str(named)]
        assert run([*call, "--check", str(learnt.out)]) == 1
        told = capsys.readouterr().err
        assert f"{named} is no sensor: name a sensor.json, or the folder that holds one." in told
    for named in (learnt.sensor, learnt.sensor.parent):
        call = ["calibrate", "infrared", str(learnt.walls), "--sensor", str(named)]
        assert run([*call, "--check", str(learnt.out)]) == 0


def test_a_stereo_camera_has_no_such_pattern(
    learnt: Learnt, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    stereo = replace(SENSOR, model="realsense-d415", depth_unit_mm=0.1, correction=None)
    sensor = write_sensor_beside(tmp_path / "sensor", stereo)
    words = ["calibrate", "infrared", str(learnt.walls), "--sensor", str(sensor)]
    for what in (["--out", str(tmp_path / "new.npz")], ["--check", str(learnt.out)]):
        assert run([*words, *what]) == 1
        assert "a realsense-d415, whose cameras and scale its" in capsys.readouterr().err
    assert not (tmp_path / "new.npz").exists()
