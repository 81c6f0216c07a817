"""fakenect folders: written, read, played by the driver and by Debian's fakenect."""

from __future__ import annotations

import ctypes.util
import json
import os
import subprocess
from pathlib import Path

import cv2
import numpy as np
import pytest
from emulated_usbfs import HERE, SYSTEM_PYTHON, require_libfreenect
from kinect_samples import SERIALS, Images, make_calibration

from kinect_v1.emulation.bus import EmulatedBus
from kinect_v1.emulation.playback import recorded_kinect
from kinect_v1.errors import RecordingError
from kinect_v1.kinect_camera import open_camera
from kinect_v1.modes import BAYER_640, BAYER_1280, DEPTH_11, IR_640, StreamMode
from kinect_v1.motor import Posture
from kinect_v1.pixels import demosaic
from kinect_v1.recordings import (
    RecordingWriter,
    read_color,
    read_depth,
    read_posture,
    read_received,
    read_recording,
    recording_folder,
)
from kinect_v1.streams import Frame
from kinect_v1.usb_bus import UsbBus
from tests.patience import PATIENCE_S

POSTURE = Posture((0.5, -1.0, 0.25), 10.5, True)


def make_frame(image: np.ndarray, mode: StreamMode, time_s: float) -> Frame:
    return Frame(image, mode, 0, round(time_s * 6e7), time_s, 0)


def record_all(writer: RecordingWriter, *frames: Frame) -> None:
    for frame in frames:
        writer.add(frame)


@pytest.fixture
def folder(tmp_path: Path, images: Images) -> Path:
    """Two depth frames and one of each kind of picture."""
    mine = images[SERIALS[1]]
    with recording_folder(tmp_path / "recording") as writer:
        writer.add_posture(POSTURE)
        writer.add(make_frame(mine["depth-11"][0], DEPTH_11, 1.0))
        writer.add(make_frame(mine["bayer-640x480"][0], BAYER_640, 1.01))
        writer.add(make_frame(mine["depth-11"][1], DEPTH_11, 1.033))
        writer.add(make_frame(mine["bayer-1280x1024"][0], BAYER_1280, 1.05))
        writer.add(make_frame(mine["ir-640x488"][0], IR_640, 1.06))
        writer.finish(SERIALS[1], "1473", make_calibration(1))
    return tmp_path / "recording"


def test_every_frame_comes_back_as_received(folder: Path, images: Images) -> None:
    mine = images[SERIALS[1]]
    recording = read_recording(folder)
    assert (recording.serial, recording.model) == (SERIALS[1], "1473")
    first, second = recording.of_kind("d")
    assert np.array_equal(read_depth(first), mine["depth-11"][0])
    assert np.array_equal(read_depth(second), mine["depth-11"][1])
    assert second.host_time_s - first.host_time_s == pytest.approx(0.033, abs=1e-5)
    assert second.device_time == 61_980_000
    (color,) = recording.of_kind("r")
    assert np.array_equal(read_color(color), demosaic(mine["bayer-640x480"][0]))
    small, large = recording.of_kind("b")
    assert np.array_equal(read_received(small), mine["bayer-640x480"][0])
    assert np.array_equal(read_received(large), mine["bayer-1280x1024"][0])
    (infrared,) = recording.of_kind("i")
    assert np.array_equal(read_received(infrared), mine["ir-640x488"][0])
    (posture,) = recording.of_kind("a")
    assert read_posture(posture).tilt_deg == POSTURE.tilt_deg
    assert read_posture(posture).acceleration_g == pytest.approx(POSTURE.acceleration_g, abs=1e-3)


def test_the_calibration_survives_but_for_unused_numbers(folder: Path) -> None:
    calibration = read_recording(folder).calibration
    assert calibration is not None
    sent = make_calibration(1)
    assert calibration.zero_plane == sent.zero_plane
    assert calibration.constant_shift == sent.constant_shift
    assert calibration.registration.dydydy_start == sent.registration.dydydy_start
    assert len(json.loads((folder / "device.json").read_text())["reg_info"]) == 24 + 2


def test_the_index_is_fakenects(folder: Path) -> None:
    lines = (folder / "INDEX.txt").read_text().splitlines()
    assert [line[0] for line in lines] == ["a", "d", "r", "d"]
    depth = (folder / lines[1]).read_bytes()
    assert depth.startswith(b"P5 640 480 65535\n")
    assert len(depth) == 17 + 2 * 640 * 480
    assert (folder / lines[2]).read_bytes().startswith(b"P6 640 480 255\n")


def test_a_recording_plays_as_a_live_sensor(folder: Path, images: Images) -> None:
    bus = UsbBus(EmulatedBus([recorded_kinect(folder)], speed=10))
    with open_camera(SERIALS[1], bus=bus) as camera:
        assert camera.model.value == "1473"
        depth = camera.start_depth()
        for i in (0, 1, 0):
            assert np.array_equal(depth.read().image, images[SERIALS[1]]["depth-11"][i])
        video = camera.start_video(BAYER_640)
        assert np.array_equal(video.read().image, images[SERIALS[1]]["bayer-640x480"][0])


def test_debians_fakenect_plays_it(folder: Path, images: Images, tmp_path: Path) -> None:
    require_libfreenect()
    library = ctypes.util.find_library("freenect")
    places = Path("/usr/lib").glob(f"*/fakenect/{library}")
    fakenect = next(places, None)
    if fakenect is None:
        pytest.skip("fakenect is absent (apt install libfreenect0.5)")
    done = subprocess.run(
        [SYSTEM_PYTHON, str(HERE / "fakenect_client.py"), str(fakenect), str(tmp_path)],
        env={**os.environ, "FAKENECT_PATH": str(folder), "FAKENECT_LOOP": "0"},
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert (tmp_path / "depth-1").exists(), done.stderr
    for i in range(2):
        theirs = np.fromfile(tmp_path / f"depth-{i}", np.uint16).reshape(480, 640)
        assert np.array_equal(theirs, images[SERIALS[1]]["depth-11"][i])
    color = np.fromfile(tmp_path / "video-0", np.uint8).reshape(480, 640, 3)
    assert np.array_equal(color, demosaic(images[SERIALS[1]]["bayer-640x480"][0]))


def test_a_failed_recording_leaves_nothing(tmp_path: Path, images: Images) -> None:
    frame = make_frame(images[SERIALS[0]]["depth-11"][0], DEPTH_11, 1.0)
    unfit = make_frame(np.zeros((480, 640), np.complex128), IR_640, 1.0)
    with pytest.raises(cv2.error), recording_folder(tmp_path / "new") as writer:
        record_all(writer, frame, unfit)
    assert list(tmp_path.iterdir()) == []


def test_an_existing_folder_is_not_touched(folder: Path) -> None:
    before = sorted(folder.iterdir())
    with pytest.raises(RecordingError, match="there already"), recording_folder(folder):
        pytest.fail("must not begin")
    assert sorted(folder.iterdir()) == before


def test_a_place_that_cannot_be_written(tmp_path: Path) -> None:
    with (
        pytest.raises(RecordingError, match="cannot be written"),
        recording_folder(tmp_path / "no" / "such"),
    ):
        pytest.fail("must not begin")


@pytest.mark.parametrize("number", ["NaN", "7" * 400, "1e400", '"5"', "true", "null", "[]", "-1"])
def test_numbers_of_the_device_are_checked(folder: Path, number: str) -> None:
    path = folder / "device.json"
    device = json.loads(path.read_text())
    device["reg_info"]["zero_plane_info"]["reference_distance"] = "here"
    path.write_text(json.dumps(device).replace('"here"', number))
    with pytest.raises(RecordingError, match=r"calibration in device\.json is incomplete"):
        read_recording(folder)


def test_bad_recordings_are_named(folder: Path, tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match=r"INDEX\.txt cannot be read"):
        read_recording(tmp_path)
    index = folder / "INDEX.txt"
    (depth, *_) = read_recording(folder).of_kind("d")
    whole = depth.path.read_bytes()
    for damaged in (whole[:-1], b"P5 640 480\n" + whole[17:], b"P5 a b 65535\n" + whole[17:]):
        depth.path.write_bytes(damaged)
        with pytest.raises(RecordingError, match="damaged"):
            read_depth(depth)
    (folder / "device.json").write_text("{")
    with pytest.raises(RecordingError, match=r"device\.json is damaged"):
        read_recording(folder)
    (folder / "device.json").write_text('{"reg_info": {}}')
    with pytest.raises(RecordingError, match="incomplete"):
        read_recording(folder)
    for damaged in ("[]", '{"serial": 5}', '{"model": []}', '{"a": 1, "a": 2}', "[" * 100_000):
        (folder / "device.json").write_text(damaged)
        with pytest.raises(RecordingError, match=r"device\.json is damaged"):
            read_recording(folder)
    (folder / "device.json").unlink()
    assert read_recording(folder).calibration is None
    index.write_text("d-1.0-5.pgm\n")
    with pytest.raises(RecordingError, match=r"names d-1\.0-5\.pgm"):
        read_recording(folder)
    index.write_text("")
    with pytest.raises(RecordingError, match="no depth"):
        recorded_kinect(folder)
