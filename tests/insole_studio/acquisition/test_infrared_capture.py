"""Infrared pictures of the pose of each view, by sensors whose pattern of dots is known."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from capture_samples import ASSIGNMENT, FRAMES, Bench, color_mosaic, depth_frames

from insole_core.geometry.arrays import RawArray
from insole_core.progress import Cancelled
from insole_core.recording.reader import read_session
from insole_core.recording.session import DotPictures, InfraredPictures
from insole_core.recording.writer import write_session
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.infrared_reference import InfraredReference, ReferenceRecord
from insole_core.sensing.sensor import nominal_kinect
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.acquisition.capture_plan import make_plan
from insole_studio.acquisition.draft import Draft
from insole_studio.acquisition.infrared_series import PICTURES, InfraredSeries
from insole_studio.acquisition.messages import CaptureStatus
from insole_studio.acquisition.sensor_port import DepthFrame, SensorError
from insole_studio.acquisition.view_frames import Series
from insole_studio.cli.main import run
from kinect_v1.emulation.playback import make_footage

PLAN = make_plan(ASSIGNMENT, frames=FRAMES)
SHIFT_PX = (4.8, 3.9)


def pattern(serial: str) -> InfraredReference:
    """A small pattern of dots, as learnt from pictures that are shifted against the depth."""
    flat = np.zeros((480, 640), np.float32)
    record = ReferenceRecord(serial, "2026-11-27T10:00:00+00:00", {}, SHIFT_PX)
    return InfraredReference(flat + 1, 0, 1, DisparityCorrection(flat), record)


def infrared_pictures(seed: int, rows: int = 488) -> list[RawArray]:
    """Six pictures of dots, each of its own."""
    rng = np.random.default_rng(seed)
    return [rng.integers(60, 900, (rows, 640), dtype=np.uint16) for _ in range(PICTURES)]


@pytest.fixture
def store(tmp_path: Path) -> SensorStore:
    """Every sensor is calibrated; the patterns of the first two are known."""
    made = SensorStore(tmp_path / "sensors")
    for _view, serial in ASSIGNMENT:
        made.save(nominal_kinect(serial))
    for serial in ("A1", "B2"):
        made.keep_reference(pattern(serial))
    return made


@pytest.fixture
def bench(make: Callable[..., Bench], store: SensorStore) -> Bench:
    """Three sensors that send infrared pictures."""
    made = make()
    made.setup = replace(made.setup, stored=store)
    for seed, kinect in enumerate(made.kinects.values()):
        kinect.camera.footage = make_footage(
            depth_frames(seed), [color_mosaic(seed)], infrared_pictures(seed)
        )
    return made


def when_infrared(act: Callable[[], None], view: str) -> Callable[[CaptureStatus], None]:
    """Do something once the infrared pictures of a view are being taken."""

    def look(status: CaptureStatus) -> None:
        if status.sentence == f"Taking infrared pictures of view {view}":
            act()

    return look


def test_sensors_with_a_pattern_take_infrared_of_the_same_pose(bench: Bench) -> None:
    assert bench.capture(PLAN) == ()
    session = read_session(bench.draft.folder)
    left, right, top = session.views
    assert [view.depth_count for view in session.views] == [FRAMES] * 3
    assert top.dots is None
    assert {path.name for path in (bench.draft.folder / "views" / "top").iterdir()} == {
        *(f"depth_{index:03d}.png" for index in range(FRAMES)), "color_000.png", "sensor.json",
    }  # fmt: skip
    for seed, view in enumerate((left, right)):
        assert view.dots is not None
        assert view.dots.pictures is not None
        assert view.dots.reference is not None
        assert not view.dots.fault
        assert view.dots.shift_px == SHIFT_PX
        assert view.dots.moved_raw == 0
        assert view.dots.reference.record.serial == view.sensor.serial
        read = [view.dots.pictures.read(index) for index in range(view.dots.pictures.count)]
        sent = [picture[:480] for picture in infrared_pictures(seed)]
        assert len(read) == PICTURES
        assert all(any(np.array_equal(one, other) for other in sent) for one in read)
    assert "View top is on the disk" in {status.sentence for status in bench.told}


def test_pulling_the_plug_before_the_infrared_keeps_the_finished_views(bench: Bench) -> None:
    pull = when_infrared(lambda: bench.emulated.unplug(bench.kinects["B2"]), "right")
    with pytest.raises(SensorError, match=r"unplugged or lost its power.*Kept so far: left\."):
        bench.capture(PLAN, report=pull)
    bench.draft.close()
    (left,) = read_session(bench.draft.folder).views
    assert left.dots is not None
    assert not list(bench.draft.folder.glob(".taking-*"))


def test_a_capture_cancelled_between_depth_and_infrared_goes_on_later(bench: Bench) -> None:
    told: list[None] = []
    with pytest.raises(Cancelled):
        bench.capture(
            PLAN,
            report=when_infrared(lambda: told.append(None), "right"),
            is_cancelled=lambda: bool(told),
        )
    assert bench.draft.views == ("left",)
    bench.draft.close()
    bench.draft = Draft.reopen(bench.draft.folder, PLAN.views)
    bench.capture(PLAN.only(["right", "top"]))
    left, right, top = read_session(bench.draft.folder).views
    assert [view.dots is not None for view in (left, right, top)] == [True, True, False]


def test_a_pattern_that_cannot_be_used_is_told_and_depth_is_taken(
    bench: Bench, store: SensorStore
) -> None:
    (store.folder_of("A1") / "reference.npz").write_bytes(b"no pattern")
    pattern("C3").save(store.folder_of("B2") / "reference.npz")
    warnings = bench.capture(PLAN)
    assert len(warnings) == 2
    assert "holds no readable infrared reference pattern" in warnings[0]
    assert "is the pattern of sensor C3" in warnings[1]
    assert all("its own depth is used" in warning for warning in warnings)
    assert all(view.dots is None for view in read_session(bench.draft.folder).views)


def taken(
    depth: Sequence[RawArray], after: Sequence[RawArray], picture: RawArray
) -> InfraredSeries:
    """Depth before and with the infrared pictures of a view."""
    before = SimpleNamespace(depth=list(depth), shot=SimpleNamespace(view="left"))
    made = InfraredSeries(cast("Series", before), 10.0)
    made.take_depth(DepthFrame(np.full((480, 640), 2047, np.uint16), 9.9, 0))  # of before
    for frame in after:
        made.take_depth(DepthFrame(frame, 10.1, 0))
    frame = cast("Any", SimpleNamespace(dots=lambda: picture))
    while not made.complete:
        made.take_picture(frame)
    return made


@pytest.mark.parametrize(
    ("further", "brightness", "told"),
    [
        (0, 300, ""),
        (1, 300, ""),
        (2, 300, "Something moved between depth and infrared of view left, so its infrared"),
        (0, 5, "View left: the infrared pictures are black; see that the emitter is on. The"),
        (0, 1023, "View left: the infrared pictures are saturated; lower their brightness"),
    ],
)
def test_movement_and_pictures_without_dots_are_told(
    further: int, brightness: int, told: str
) -> None:
    still = depth_frames(0)
    moved = [np.where(frame < 2047, frame + further, frame).astype(np.uint16) for frame in still]
    picture = np.full((480, 640), brightness, np.uint16)
    warnings = taken(still, moved, picture).check()
    assert len(warnings) == bool(told)
    assert all(warning.startswith(told) for warning in warnings)


def test_how_far_depth_moved_before_the_pictures_is_known() -> None:
    """Of a foot, a twentieth of the picture, beside which a stripe flickers."""
    still = depth_frames(0)
    rows, columns = slice(200, 280), slice(300, 500)

    def after(further: int) -> list[RawArray]:
        frames = [frame.copy() for frame in still]
        for number, frame in enumerate(frames):
            frame[rows, columns] += np.uint16(further)
            frame[rows, 300:308] = 300 if number % 2 else 2047
        return frames

    picture = np.full((480, 640), 300, np.uint16)
    series = [taken(still, after(further), picture) for further in (0, 1, 2)]
    assert [one.moved_raw for one in series] == [0, 1, 2]
    assert [bool(one.check()) for one in series] == [False, False, True]


def test_an_emulated_session_delivers_its_infrared_bit_for_bit(
    small_session: Path, tmp_path: Path
) -> None:
    session = read_session(small_session)
    view, sent = session.views[0], infrared_pictures(5, rows=480)
    dots = DotPictures(
        InfraredPictures(PICTURES, lambda index: sent[index], 16),
        pattern(view.sensor.serial),
        (1.0, 2.0),
    )
    original = tmp_path / "original"
    write_session(replace(session, views=(replace(view, dots=dots), *session.views[1:])), original)
    out = tmp_path / "out"
    assert run(["capture", "--emulate", str(original), "--out", str(out)]) == 0
    names = [f"infrared_{index:03d}.png" for index in range(PICTURES)]
    for name in (*names, "reference.npz", "sensor.json"):
        kept = out / "views" / view.name / name
        if name == "reference.npz":
            found = read_session(out).views[0].dots
            assert found is not None
            assert found.reference is not None
            assert found.shift_px == (1, 2)
            assert np.array_equal(found.reference.pattern, pattern("").pattern)
        elif name == "sensor.json":
            values = json.loads(kept.read_text())
            assert 0 <= values.pop("infrared_moved_raw") < 0.35
            assert values == json.loads((original / "views" / view.name / name).read_text())
        else:
            assert kept.read_bytes() == (original / "views" / view.name / name).read_bytes()
    assert not list(out.glob(f"views/{session.views[1].name}/infrared*"))
