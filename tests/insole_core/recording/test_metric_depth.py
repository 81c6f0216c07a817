"""Sessions of version 3: sensors that deliver millimetres, alone and beside a Kinect."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from insole_core.errors import InputError
from insole_core.geometry.side import BOTH, Side
from insole_core.geometry.transforms import rigid
from insole_core.reconstruct.result import ViewResult
from insole_core.reconstruct.warnings import warnings_of
from insole_core.recording.reader import read_session
from insole_core.recording.session import (
    FootPlace,
    FrameTimes,
    InfraredPictures,
    Session,
    View,
)
from insole_core.recording.writer import write_session
from insole_core.sensing.correction import CorrectionRecord, DisparityCorrection
from insole_core.sensing.family import ACTIVE_STEREO, DIRECT_DEPTH, KINECT_V1
from insole_core.sensing.metric_depth import PlainDepth, StereoDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera

Json = dict[str, Any]
SIZE = (96, 64)


def stereo_view(session: Session, name: str, serial: str) -> View:
    """A camera with 0.1 mm of depth, its infrared pair, and a correction of half a pixel."""
    width, height = SIZE
    rows, columns = np.mgrid[:height, :width]
    depth = (5000 + rows + columns).astype(np.uint16)
    depth[:, :4] = 0
    color = np.stack([rows, columns, rows * 0], axis=-1).astype(np.uint8)
    offset_px = np.full((height, width), 0.5, np.float32)
    record = CorrectionRecord(serial, "2026-11-20T10:00:00Z", "smooth map", unit="px")
    sensor = replace(
        session.views[0].sensor,
        model="realsense-d415",
        serial=serial,
        depth_camera=PinholeCamera(width, height, 920.0, 920.0, 48.0, 32.0),
        color_camera=PinholeCamera(width, height, 1370.0, 1370.0, 48.0, 32.0),
        disparity=StereoDisparity(920.0, 55.0),
        correction=DisparityCorrection(-8 * offset_px, record=record),
        calibration=(),
        depth_unit_mm=0.1,
        baseline_mm=55.0,
    )
    pair = {
        f"infrared_{side}": InfraredPictures(1, lambda _, one=one: one, bits)
        for side, bits, one in (("left", 8, depth % 200), ("right", 16, depth))
    }
    times = FrameTimes((0.0, 33.3), (1.0,))
    return View(name, sensor, 2, 1, lambda _: depth, lambda _: color, pair, times)


@pytest.fixture(scope="module")
def mixed(session: Session) -> Session:
    """A stereo camera below, a Kinect behind."""
    views = (stereo_view(session, "left", "SIM1"), session.views[1])
    return replace(session, views=views)


@pytest.fixture(scope="module")
def kept(mixed: Session, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("metric") / "session"
    write_session(mixed, path)
    return path


@pytest.fixture
def metric_folder(kept: Path, tmp_path: Path) -> Path:
    return shutil.copytree(kept, tmp_path / "session")


def edit(path: Path, change: Callable[[Json], object]) -> None:
    values = json.loads(path.read_text(encoding="utf-8"))
    change(values)
    path.write_text(json.dumps(values), encoding="utf-8")


def test_views_of_both_kinds_come_back_as_they_were(kept: Path, mixed: Session) -> None:
    again = read_session(kept)
    stereo, kinect = again.views
    assert json.loads((kept / "manifest.json").read_text())["version"] == 3
    assert (stereo.sensor.family, kinect.sensor.family) == (ACTIVE_STEREO, KINECT_V1)
    assert stereo.sensor.depth_camera == mixed.views[0].sensor.depth_camera
    assert stereo.sensor.disparity == mixed.views[0].sensor.disparity
    np.testing.assert_array_equal(stereo.read_depth(1), mixed.views[0].read_depth(1))
    assert stereo.times == mixed.views[0].times
    for name, pictures in mixed.views[0].infrared.items():
        assert stereo.infrared[name].bits == pictures.bits
        np.testing.assert_array_equal(stereo.infrared[name].read(0), pictures.read(0))


def test_a_correction_is_in_pixels_and_is_subtracted_from_the_disparity(kept: Path) -> None:
    stored = np.load(kept / "views" / "left" / "correction.npz")["offset"]
    assert stored == pytest.approx(0.5)
    sensor = read_session(kept).views[0].sensor
    seen_mm = np.full(SIZE[::-1], 500.0)
    corrected_mm = sensor.depth_mm(sensor.disparity.raw(seen_mm))
    assert corrected_mm == pytest.approx(920 * 55 / (920 * 55 / 500 - 0.5))


def test_a_copy_of_kinects_alone_is_of_the_older_version(kept: Path, tmp_path: Path) -> None:
    session = read_session(kept)
    of_kinect = replace(session.manifest, views=("top",))
    write_session(replace(session, manifest=of_kinect, views=session.views[1:]), tmp_path / "k")
    assert json.loads((tmp_path / "k" / "manifest.json").read_text())["version"] == 1


def test_both_feet_are_captured_with_cameras_of_millimetres(mixed: Session, tmp_path: Path) -> None:
    system, box = mixed.manifest.reference_system, mixed.manifest.volume_of_interest
    assert box is not None
    places = tuple(
        FootPlace(side, (x, 0.0, 0.0), box) for side, x in zip(Side, (-120.0, 120.0), strict=True)
    )
    manifest = replace(
        mixed.manifest,
        side=BOTH,
        reference_system=replace(system, feet=places),
        volume_of_interest=None,
    )
    write_session(replace(mixed, manifest=manifest), tmp_path / "both")
    assert json.loads((tmp_path / "both" / "manifest.json").read_text())["version"] == 3
    assert len(read_session(tmp_path / "both").feet) == 2


def test_a_camera_without_a_baseline_has_plain_millimetres(metric_folder: Path) -> None:
    sensor_file = metric_folder / "views" / "left" / "sensor.json"
    edit(sensor_file, lambda s: (s.pop("stereo"), s.pop("disparity_correction")))
    view = read_session(metric_folder).views[0]
    assert view.sensor.family is DIRECT_DEPTH
    assert view.sensor.disparity == PlainDepth()
    assert not view.infrared


BAD: dict[str, tuple[Callable[[Json], object], str]] = {
    "unit of metres": (lambda s: s.update(depth_unit_mm=0.001), "depth_unit_mm is 0.001, but must"),
    "both kinds": (
        lambda s: s.update(disparity={"model": "tangent"}),
        'that delivers raw numbers; take out the one that is wrong',
    ),
    "neither kind": (lambda s: s.pop("depth_unit_mm"), "disparity is missing"),
    "correction without a baseline": (
        lambda s: s.pop("stereo"),
        'there is no "stereo" with the baseline',
    ),
    "size of a Kinect": (
        lambda s: s["depth_camera"].update(width=640, height=480),
        "must hold 480×640 finite numbers",
    ),
    "huge picture": (
        lambda s: s["depth_camera"].update(width=4096, height=4096),
        "more than the pictures of a sensor have",
    ),
    "times of other frames": (
        lambda s: s["frame_times_ms"].update(depth=[1.0]),
        "frame_times_ms.depth has 1 numbers, but must have 2",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_what_contradicts_itself_is_refused_in_one_sentence(metric_folder: Path, name: str) -> None:
    change, expected = BAD[name]
    edit(metric_folder / "views" / "left" / "sensor.json", change)
    with pytest.raises(InputError) as caught:
        read_session(metric_folder)
    assert expected in str(caught.value)
    assert str(caught.value).endswith(".")


def test_a_session_of_version_1_holds_no_camera_of_millimetres(metric_folder: Path) -> None:
    edit(metric_folder / "manifest.json", lambda m: m.update(version=1))
    with pytest.raises(InputError, match=r'"version" in manifest.json .* make the version 3'):
        read_session(metric_folder)


def test_a_correction_of_a_kinect_is_refused(metric_folder: Path, written: Path) -> None:
    view = metric_folder / "views" / "left"
    shutil.copy(written / "views" / "left" / "correction.npz", view / "correction.npz")
    with pytest.raises(InputError, match="corrects another kind of sensor than this one"):
        read_session(metric_folder)


def test_two_cameras_of_one_serial_are_refused(mixed: Session, tmp_path: Path) -> None:
    first = mixed.views[0]
    other = replace(first.sensor, depth_camera=replace(first.sensor.depth_camera, fx=915.0))
    views = (first, replace(first, name="top", sensor=other))
    write_session(replace(mixed, views=views), tmp_path / "twice")
    with pytest.raises(InputError, match="the views left and top name one sensor, SIM1, but two"):
        read_session(tmp_path / "twice")


def placed(name: str, x_mm: float) -> ViewResult:
    return ViewResult(name, True, sensor2reference=rigid(np.eye(3), np.array([x_mm, 0.0, 0.0])))


@pytest.mark.parametrize(
    ("x_mm", "times", "is_told"),
    [
        (300.0, None, True),
        (300.0, FrameTimes((20.0,), (20.0,)), True),
        (300.0, FrameTimes((9000.0, 9033.0), (9000.0,)), False),  # moved by hand meanwhile
        (1.0, None, False),  # a second burst
    ],
)
def test_one_camera_in_two_places_is_told(
    mixed: Session, x_mm: float, times: FrameTimes | None, is_told: bool
) -> None:
    first = mixed.views[0]
    twice = replace(mixed, views=(first, replace(first, name="top", times=times)))
    told = warnings_of(twice, [placed("left", 0.0), placed("top", x_mm)], {})
    sentence = "The views left and top name one camera, SIM1, in two places; unless it was moved"
    assert any(warning.startswith(sentence) for warning in told) is is_told


def test_an_infrared_picture_of_another_size_is_refused(metric_folder: Path) -> None:
    picture = np.zeros((48, 64), np.uint8)
    cv2.imwrite(str(metric_folder / "views" / "left" / "infrared_right_000.png"), picture)
    with pytest.raises(InputError, match="must be 96×64 8-bit grey or 96×64 16-bit grey"):
        read_session(metric_folder)
