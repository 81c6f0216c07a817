"""``sensors``, ``capture`` and ``import-fakenect`` as another program calls them."""

from __future__ import annotations

import errno
import io
import json
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from capture_samples import color_mosaic, depth_frames

from insole_core.calibration.markers.reference_file import save_reference_system
from insole_core.errors import OutputError
from insole_core.recording.reader import read_session
from insole_studio.acquisition import draft
from insole_studio.cli.main import run
from insole_studio.stop_signals import STOP_SIGNALS
from kinect_v1.emulation.bus import EmulatedBus
from kinect_v1.emulation.device import EmulatedKinect
from kinect_v1.emulation.playback import TYPICAL_CALIBRATION, make_footage
from kinect_v1.kinect_camera import open_camera
from kinect_v1.models import Model
from kinect_v1.modes import BAYER_640
from kinect_v1.pixels import demosaic, mosaic
from kinect_v1.recordings import recording_folder
from kinect_v1.usb_bus import UsbBus


@pytest.fixture(autouse=True)
def own_places(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing of this computer's user is read or written."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.setattr(draft, "drafts_folder_of_user", lambda: tmp_path / "drafts")


def last_line(capsys: pytest.CaptureFixture[str]) -> str:
    return capsys.readouterr().err.strip().splitlines()[-1]


def test_sensors_are_listed(small_session: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["sensors", "--emulate", str(small_session)]) == 0
    lines = capsys.readouterr().out.splitlines()
    serials = [view.sensor.serial for view in read_session(small_session).views]
    assert lines == [f"{s}\t1414\tbus {i}\tready" for i, s in enumerate(serials, start=1)]


def test_sensors_as_json(small_session: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["--emulate", str(small_session), "sensors", "--json"]) == 0
    first = json.loads(capsys.readouterr().out)[0]
    assert (first["model"], first["bus"], first["state"], first["problem"]) == (
        "1414", 1, "ready", None,
    )  # fmt: skip


@pytest.mark.slow
@pytest.mark.shared
@pytest.mark.parametrize("name", ["left_a", "right_d"])
def test_a_session_comes_through_bit_for_bit(name: str, shared_data: Path, tmp_path: Path) -> None:
    """Of one burst, and of two: each sensor delivers another view after it was moved."""
    original = shared_data / "sessions" / name
    out = tmp_path / "captured"
    assert run(["capture", "--emulate", str(original), "--out", str(out)]) == 0
    sent, came = read_session(original), read_session(out)
    assert came.manifest.views == sent.manifest.views
    assert came.manifest.side is sent.manifest.side
    assert came.manifest.reference_system == sent.manifest.reference_system
    for before, after in zip(sent.views, came.views, strict=True):
        assert (after.depth_count, after.color_count) == (10, 1)
        for index in range(10):
            assert np.array_equal(after.read_depth(index), before.read_depth(index))
        assert np.array_equal(after.read_color(0), demosaic(mosaic(before.read_color(0))))
        assert (after.sensor.serial, after.sensor.faces) == (
            before.sensor.serial,
            before.sensor.faces,
        )
        assert after.sensor.disparity == before.sensor.disparity
        assert after.sensor.correction is not None
    facts = came.manifest.extra["capture"]
    assert {facts[view]["calibration"] for view in facts} == {"recording"}
    assert not (tmp_path / "drafts").exists() or not list((tmp_path / "drafts").iterdir())


def test_a_reference_system_that_is_named_is_recorded_with_emulated_sensors(
    small_session: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out, file = tmp_path / "session.zip", tmp_path / "own.json"
    system = read_session(small_session).manifest.reference_system
    save_reference_system(replace(system, name="own"), file)
    call = ["capture", "--emulate", str(small_session), "--frames", "2", "--out", str(out)]
    assert run([*call, "--reference", str(tmp_path / "nothing.json")]) != 0
    assert "nothing.json" in capsys.readouterr().err
    assert run([*call, "--reference", str(file)]) == 0
    assert read_session(out).manifest.reference_system.name == "own"


def test_plan_and_condition_are_the_callers(small_session: Path, tmp_path: Path) -> None:
    first, second, *_ = (view.sensor.serial for view in read_session(small_session).views)
    out = tmp_path / "session.zip"
    call = [
        "capture", "--emulate", str(small_session), "--out", str(out), "--views", f"heel={second}",
        f"left={first}", "--simultaneous", "--frames", "3", "--side", "right", "--held",
        "--weight-bearing", "full", "--notes", "barefoot",
    ]  # fmt: skip
    assert run(call) == 0
    session = read_session(out)
    assert session.manifest.side.value == "right"
    assert session.manifest.capture_condition is not None
    assert vars(session.manifest.capture_condition) == {
        "weight_bearing": "full", "held": True, "notes": "barefoot",
    }  # fmt: skip
    assert [(v.name, v.sensor.serial, v.depth_count) for v in session.views] == [
        ("heel", second, 3),
        ("left", first, 3),
    ]


@pytest.mark.slow
def test_what_is_missing_is_captured_as_it_was_begun(
    small_session: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """One sensor, moved by hand: the disk fills up with the second view, then there is room."""
    serial = read_session(small_session).views[0].sensor.serial
    out, write = tmp_path / "session", draft._write

    def fill(path: Path, image: np.ndarray) -> None:
        if path.parent.name.endswith("top"):
            raise OSError(errno.ENOSPC, "No space left on device")
        write(path, image)

    monkeypatch.setattr(draft, "_write", fill)
    call = ["capture", "--emulate", str(small_session), "--out", str(out)]
    views = ["--views", f"left={serial}", f"top={serial}", "--frames", "2"]
    assert run([*call, *views, "--side", "right"]) == 1
    assert not out.exists()
    told = last_line(capsys)
    assert "the disk is full" in told
    folder = told.split("--resume ")[1]
    monkeypatch.setattr(draft, "_write", write)
    assert run([*call, "--resume", folder]) == 0
    session = read_session(out)
    assert [(view.name, view.depth_count) for view in session.views] == [("left", 2), ("top", 2)]
    assert session.manifest.side.value == "right"
    assert not list((tmp_path / "drafts").iterdir())


@pytest.fixture
def own_signals() -> Iterator[None]:
    """The handlers of signals are as before afterwards."""
    before = {number: signal.getsignal(number) for number in STOP_SIGNALS}
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


@pytest.mark.slow
@pytest.mark.usefixtures("own_signals")
@pytest.mark.parametrize("number", STOP_SIGNALS, ids=lambda number: number.name)
def test_a_capture_that_is_stopped_says_how_to_go_on(
    number: signal.Signals,
    small_session: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    serial = read_session(small_session).views[0].sensor.serial
    out, write = tmp_path / "session", draft._write

    def stop(path: Path, image: np.ndarray) -> None:
        if path.parent.name.endswith("top"):
            os.kill(os.getpid(), number)
        write(path, image)

    signal.signal(number, signal.SIG_DFL)
    monkeypatch.setattr(draft, "_write", stop)
    call = ["capture", "--emulate", str(small_session), "--out", str(out)]
    views = ["--views", f"left={serial}", f"top={serial}", "--frames", "2"]
    assert run([*call, *views]) == 128 + number
    told = last_line(capsys)
    assert told.startswith("Stopped on request; the finished views are kept. Go on with --resume")
    assert not out.exists()
    monkeypatch.setattr(draft, "_write", write)
    assert run([*call, "--resume", told.split("--resume ")[1]]) == 0
    assert read_session(out).manifest.views == ("left", "top")
    assert not list((tmp_path / "drafts").iterdir())


@pytest.mark.skipif(not Path("/proc/self/fd").exists(), reason="files are named by /proc")
@pytest.mark.parametrize("name", ["session", "session.zip"])
def test_a_draft_goes_once_the_session_is_on_the_disk(
    small_session: Path, tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    synced: list[Path] = []
    gone: list[Path] = []
    fsync, rmtree = os.fsync, shutil.rmtree

    def note_sync(handle: int) -> None:
        synced.append(Path(f"/proc/self/fd/{handle}").readlink())
        fsync(handle)

    def note_removal(folder: Path, *more: object, **named: bool) -> None:
        if folder.parent == tmp_path / "drafts":
            gone.extend(synced)
        rmtree(folder, *more, **named)  # type: ignore[arg-type]

    monkeypatch.setattr(os, "fsync", note_sync)
    monkeypatch.setattr(shutil, "rmtree", note_removal)
    serial = read_session(small_session).views[0].sensor.serial
    call = ["capture", "--emulate", str(small_session), "--out", str(tmp_path / name)]
    assert run([*call, "--views", f"left={serial}", "--frames", "2"]) == 0
    assert gone[-1] == tmp_path  # the folder that holds the session, after all that is in it
    names = [path.name for path in gone]
    once = ["depth_000.png", "depth_001.png", "color_000.png", "sensor.json", "manifest.json"]
    # In the draft, when the view is done; a zip archive then is one file.
    assert all(names.count(one) >= (2 if name == "session" else 1) for one in once[:-1])
    assert not list((tmp_path / "drafts").iterdir())


@pytest.mark.parametrize("within", ["", "finished"])
def test_a_draft_is_not_published_into_itself(
    small_session: Path, tmp_path: Path, within: str
) -> None:
    kept = tmp_path / "drafts" / "a"
    shutil.unpack_archive(small_session, kept)
    text = (kept / "manifest.json").read_text()
    views = json.loads(text)["views"]
    (kept / "manifest.json").write_text(
        json.dumps({**json.loads(text), "capture": {name: {} for name in views}})
    )
    left = draft.Draft.reopen(kept)
    with closing(left), pytest.raises(OutputError, match="the folder of the unfinished capture"):
        left.publish(kept / within)
    assert read_session(kept).manifest.views == tuple(views)


def test_a_sensor_that_is_moved_by_hand_needs_a_hand(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    kinect = EmulatedKinect(
        Model.XBOX_1414, "A1", TYPICAL_CALIBRATION, make_footage(depth_frames(1), [color_mosaic(1)])
    )
    bus = UsbBus(EmulatedBus([kinect], speed=8.0))
    monkeypatch.setattr("insole_studio.acquisition.sensor_source.system_bus", lambda: bus)
    views = ["--views", "left=A1", "right=A1", "--side", "left", "--frames", "2"]
    monkeypatch.setattr("sys.stdin", io.StringIO())
    assert run(["capture", "--out", str(tmp_path / "s"), *views]) == 2
    assert "nobody can press Enter here" in last_line(capsys)
    monkeypatch.setattr("sys.stdin", io.StringIO("\n"))
    assert run(["capture", "--out", str(tmp_path / "s"), *views]) == 0
    assert "place for view right, then press Enter." in capsys.readouterr().err
    assert read_session(tmp_path / "s").manifest.views == ("left", "right")


def test_an_unknown_sensor_leaves_nothing(
    small_session: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "session"
    call = ["capture", "--emulate", str(small_session), "--out", str(out), "--views", "left=Z9"]
    assert run(call) == 1
    assert "No sensor has the number Z9" in last_line(capsys)
    program = [sys.executable, "-m", "insole_studio", *call]
    ended = subprocess.run(program, capture_output=True, text=True, check=False)
    assert ended.stderr.count("No sensor has the number Z9") == 1, "its log says it no second time"
    assert not out.exists()
    assert not (tmp_path / "drafts").exists()


def test_no_sensor_at_all(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        "insole_studio.acquisition.sensor_source.system_bus", lambda: UsbBus(EmulatedBus([]))
    )
    assert run(["sensors"]) == 1
    assert "No sensor is plugged in" in last_line(capsys)
    assert run(["capture", "--out", str(tmp_path / "s"), "--side", "left"]) == 1
    assert "No sensor is plugged in" in last_line(capsys)


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--views", "left"], "names no view and sensor"),
        (["--frames", "0"], "0 frames were asked for"),
        (["--views", "left=A", "right=A", "--simultaneous"], "both given to sensor A"),
        (["--laser-power", "5"], "--laser-power is for RealSense cameras"),
        (["--preset", "high-density"], "--preset is for RealSense cameras"),
        (["--no-infrared-pair"], "--infrared-pair is for RealSense cameras"),
    ],
)
def test_wrong_calls(
    options: list[str],
    sentence: str,
    small_session: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    out = str(tmp_path / "session")
    assert run(["capture", "--emulate", str(small_session), "--out", out, *options]) == 2
    assert sentence in last_line(capsys)


def test_a_place_without_folder_is_refused_before(
    small_session: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "nowhere" / "session"
    assert run(["capture", "--emulate", str(small_session), "--out", str(out)]) == 1
    assert "its folder does not exist" in last_line(capsys)


@pytest.fixture
def fakenect(tmp_path: Path) -> Path:
    """A folder that the driver recorded."""
    footage = make_footage(depth_frames(1)[:3], [color_mosaic(1)])
    kinect = EmulatedKinect(Model.XBOX_1414, "A1", TYPICAL_CALIBRATION, footage)
    folder = tmp_path / "recording"
    with (
        recording_folder(folder) as writer,
        open_camera("A1", bus=UsbBus(EmulatedBus([kinect], speed=8.0))) as camera,
    ):
        depth, video = camera.start_depth(), camera.start_video(BAYER_640)
        for _ in range(3):
            writer.add(depth.read())
        writer.add(video.read())
        writer.finish(camera.serial, camera.model.value, camera.calibration)
    return folder


def test_a_recording_becomes_a_session(fakenect: Path, tmp_path: Path) -> None:
    out = tmp_path / "session"
    assert run(["import-fakenect", str(fakenect), "--out", str(out), "--side", "right"]) == 0
    session = read_session(out)
    assert session.manifest.side.value == "right"
    (view,) = session.views
    assert (view.name, view.sensor.serial, view.sensor.faces) == ("left", "A1", ("sole",))
    for index, frame in enumerate(depth_frames(1)[:3]):
        assert np.array_equal(view.read_depth(index), frame)
    assert np.array_equal(view.read_color(0), demosaic(color_mosaic(1)))
    assert view.sensor.depth_camera.fx == pytest.approx(575.816, abs=1e-3)


def test_several_recordings_are_several_views(fakenect: Path, tmp_path: Path) -> None:
    out = tmp_path / "session.zip"
    call = ["import-fakenect", f"top={fakenect}", str(fakenect), "--out", str(out)]
    assert run(call) == 0
    assert [view.sensor.faces for view in read_session(out).views] == [("achilles",), ("sole",)]


def test_a_folder_that_is_no_recording(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "session"
    assert run(["import-fakenect", str(tmp_path), "--out", str(out)]) == 1
    assert "no fakenect recording" in last_line(capsys)
    assert not out.exists()


def test_a_recording_without_colour(
    fakenect: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    index = fakenect / "INDEX.txt"
    index.write_text("".join(x for x in index.read_text().splitlines(True) if x.startswith("d")))
    for picture in fakenect.glob("b-*"):
        picture.unlink()
    assert run(["import-fakenect", str(fakenect), "--out", str(tmp_path / "s")]) == 1
    assert "holds no colour pictures" in last_line(capsys)


def test_both_feet_are_captured_in_one_go(small_session: Path, tmp_path: Path) -> None:
    recorded, out = small_session.with_name("both_small.zip"), tmp_path / "session"
    call = ["capture", "--emulate", str(recorded), "--out", str(out), "--frames", "2"]
    assert run(call) == 0
    sent, came = read_session(recorded), read_session(out)
    assert json.loads((out / "manifest.json").read_text())["version"] == 2
    assert came.manifest.side == sent.manifest.side == "both"
    assert came.manifest.reference_system == sent.manifest.reference_system
    faces = {view.name: view.sensor.faces for view in came.views}
    assert faces == {view.name: view.sensor.faces for view in sent.views}
    assert faces["left_top"] == ("achilles",)


@pytest.mark.parametrize(
    ("session", "side", "sentence"),
    [
        ("left_small.zip", "both", '"lego-20" has a place for one foot only; choose a foot'),
        ("both_small.zip", "left", '"lego-40" is for both feet; capture both'),
    ],
)
def test_the_frame_must_have_a_place_for_each_foot(
    small_session: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    session: str,
    side: str,
    sentence: str,
) -> None:
    recorded, out = small_session.with_name(session), tmp_path / "session"
    call = ["capture", "--emulate", str(recorded), "--out", str(out), "--side", side]
    assert run(call) == 1
    assert sentence in last_line(capsys)
    assert not out.exists()
