"""The real libusb and the real asynchronous engine, on an emulated usbfs (level 2)."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from emulated_usbfs import HERE, EmulatedUsbfs, describe_kinect, emulated_usbfs, require_usbfs
from kinect_samples import FRAMES, MOST, SERIALS, Footage, Images, in_turn, make_calibration

from kinect_v1.calibration import RGB_DISTANCE_CM
from kinect_v1.models import Model
from kinect_v1.modes import DEPTH_11
from kinect_v1.recordings import read_depth, read_received, read_recording
from tests.patience import PATIENCE_S

pytestmark = pytest.mark.slow

WANTED = 4
CLIENT = HERE / "driver_client.py"


@pytest.fixture(autouse=True)
def _usbfs() -> None:
    require_usbfs()


@pytest.fixture
def three(tmp_path: Path, footage: Footage) -> list[dict[str, Any]]:
    """One sensor of each model, each on a controller of its own."""
    return [
        describe_kinect(tmp_path, model, serial, footage, seed=i, controller=i + 1)
        for i, (model, serial) in enumerate(zip(Model, SERIALS, strict=True))
    ]


def run_driver(
    usbfs: EmulatedUsbfs, verb: str, request: dict[str, Any], folder: Path
) -> dict[str, Any]:
    (folder / "request.json").write_text(json.dumps(request), encoding="utf-8")
    done = usbfs.run(sys.executable, CLIENT, verb, folder / "request.json", folder)
    assert done.returncode == 0, done.stderr
    assert not done.stderr
    answer: dict[str, Any] = json.loads((folder / "result.json").read_text(encoding="utf-8"))
    return answer


def find(image: np.ndarray, sent: list[np.ndarray]) -> int:
    """Tell which of the sent pictures this is; -1 where it is none."""
    return next((i for i, other in enumerate(sent) if np.array_equal(image, other)), -1)


OTHERS = (
    {"depth": "depth-10", "video": "bayer-640x480"},
    {"depth": "depth-11", "video": "ir-640x488"},
    {"video": "ir-1280x1024"},
)


def test_every_frame_of_three_sensors_is_what_was_sent(
    three: list[dict[str, Any]], tmp_path: Path, images: Images
) -> None:
    """All with the most data, then in different modes, until each has had all."""
    turns = [dict.fromkeys(SERIALS, MOST), *in_turn(OTHERS)]
    with emulated_usbfs(tmp_path, *three) as usbfs:
        found = run_driver(usbfs, "stream", {"frames": WANTED, "turns": turns}, tmp_path)
    for turn, modes_of in enumerate(turns):
        for serial, modes in modes_of.items():
            assert found[serial]["discarded"][turn] == dict.fromkeys(modes, 0)
            for kind, mode in modes.items():
                delivered = np.load(tmp_path / f"{serial}-{turn}-{kind}.npy")
                numbers = [find(image, images[serial][mode]) for image in delivered]
                first = numbers[0]  # a busy computer may be late for those before, as with a sensor
                assert first >= 0
                assert numbers == [(first + i) % FRAMES for i in range(WANTED)]


def test_a_device_that_is_unlike_ours_in_all_that_is_open(
    tmp_path: Path, footage: Footage, images: Images
) -> None:
    """Other descriptors, language, pauses, numbers, unknown bytes, and late replies."""
    odd = [
        describe_kinect(tmp_path, model, serial, footage, seed=i, controller=i + 1, flaw="odd")
        for i, (model, serial) in enumerate(zip(Model, SERIALS, strict=True))
    ]
    request = {"frames": 2, "turns": [dict.fromkeys(SERIALS, MOST)]}
    with emulated_usbfs(tmp_path, *odd) as usbfs:
        found = run_driver(usbfs, "stream", request, tmp_path)
    for i, serial in enumerate(SERIALS):
        assert found[serial]["calibration"]["constant_shift"] == make_calibration(i).constant_shift
        assert found[serial]["discarded"] == [{"depth": 0, "video": 0}]
        for kind, mode in MOST.items():
            delivered = np.load(tmp_path / f"{serial}-0-{kind}.npy")
            first, second = (find(image, images[serial][mode]) for image in delivered)
            assert first >= 0
            assert second == (first + 1) % FRAMES


def test_models_and_calibration_of_each_sensor(three: list[dict[str, Any]], tmp_path: Path) -> None:
    with emulated_usbfs(tmp_path, *three) as usbfs:
        request = {"frames": 0, "turns": [{serial: {} for serial in SERIALS}]}
        found = run_driver(usbfs, "stream", request, tmp_path)
    for i, (model, serial) in enumerate(zip(Model, SERIALS, strict=True)):
        expected = make_calibration(i).as_dict()
        expected["zero_plane"]["rgb_distance_cm"] = RGB_DISTANCE_CM
        assert found[serial]["model"] == model.value
        assert found[serial]["calibration"] == expected


def test_damage_on_the_way_and_in_the_commands(
    tmp_path: Path, footage: Footage, images: Images
) -> None:
    serial = SERIALS[2]
    first = DEPTH_11.packets - DEPTH_11.packets // 2
    faults = [
        {
            "kind": kind,
            "where": "depth",
            "at": first + frame * DEPTH_11.packets + at,
            "count": count,
        }
        for kind, frame, at, count in [
            ("lost", 1, 9, 1),
            ("lost", 3, 0, 1),
            ("lost", 5, 241, 1),
            ("lost", 7, 80, 20),
            ("packet magic", 9, 100, 1),
            ("flag", 11, 100, 1),
            ("short", 13, 100, 1),
            ("repeated", 15, 100, 1),
        ]
    ]
    faults.append({"kind": "full reply", "at": 5, "count": 3})
    kinect = describe_kinect(tmp_path, Model.WINDOWS, serial, footage, faults=faults)
    with emulated_usbfs(tmp_path, kinect) as usbfs:
        request = {"frames": 10, "turns": [{serial: {"depth": "depth-11"}}]}
        found = run_driver(usbfs, "stream", request, tmp_path)
    sent = images[serial]["depth-11"]
    numbers = [find(image, sent) for image in np.load(tmp_path / f"{serial}-0-depth.npy")]
    assert numbers == [number % FRAMES for number in (0, 2, 4, 6, 8, 10, 12, 14, 16, 17)]
    assert found[serial]["discarded"] == [{"depth": 8}]


@pytest.mark.parametrize("kind", ["stall", "no reply"])
def test_a_dead_command_channel(kind: str, tmp_path: Path) -> None:
    serial = SERIALS[0]
    faults = [{"kind": kind, "at": 0, "count": 1 << 40}]
    kinect = describe_kinect(tmp_path, Model.XBOX_1414, serial, {}, faults=faults)
    with emulated_usbfs(tmp_path, kinect) as usbfs:
        done = usbfs.run(sys.executable, "-m", "kinect_v1", "info")
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert done.stderr.endswith("plug it in again.\n")


def test_two_sensors_share_a_controller_one_after_the_other(
    tmp_path: Path, footage: Footage, images: Images
) -> None:
    pair = [
        describe_kinect(tmp_path, Model.XBOX_1414, serial, footage, controller=3)
        for serial in SERIALS[:2]
    ]
    with emulated_usbfs(tmp_path, *pair) as usbfs:
        modes = {"depth": "depth-11", "video": "bayer-640x480"}
        request = {"serials": SERIALS[:2], "modes": modes}
        found = run_driver(usbfs, "share_controller", request, tmp_path)
    kind, text = found["together"]
    assert kind == "BandwidthError"
    assert "bus 3" in text
    assert "PCIe" in text
    assert find(np.load(tmp_path / "alone.npy"), images[SERIALS[1]]["depth-11"]) == 0


def test_unplug_while_streaming_and_replug(
    tmp_path: Path, footage: Footage, images: Images
) -> None:
    serial = SERIALS[0]
    kinect = describe_kinect(tmp_path, Model.XBOX_1414, serial, footage, controller=2)
    (tmp_path / "request.json").write_text(json.dumps({"serials": [serial]}), encoding="utf-8")
    with emulated_usbfs(tmp_path, kinect) as usbfs:
        arguments = ("survive_unplug", tmp_path / "request.json", tmp_path)
        with usbfs.start(sys.executable, CLIENT, *arguments) as client:
            assert client.stdout
            assert client.stdin
            assert client.stdout.readline() == "streaming\n"
            usbfs.tell("unplug", serial)
            assert client.stdout.readline() == "lost\n"
            usbfs.tell("plug", serial)
            client.stdin.write("plugged\n")
            client.stdin.flush()
            assert client.wait(PATIENCE_S) == 0
    found = json.loads((tmp_path / "result.json").read_text(encoding="utf-8"))
    assert found["lost"][0] == "UnpluggedError"
    sent = images[serial]["depth-11"]
    assert all(find(image, sent) >= 0 for image in np.load(tmp_path / "before.npy"))
    assert find(np.load(tmp_path / "after.npy"), sent) == 0


def test_a_second_program_is_told_and_a_killed_one_leaves_nothing_behind(
    tmp_path: Path, footage: Footage, images: Images
) -> None:
    """Three processes on one sensor: one streams, one is refused, one follows the killed first."""
    serial = SERIALS[0]
    kinect = describe_kinect(tmp_path, Model.XBOX_1414, serial, footage)
    request = {"serials": [serial], "frames": 2, "turns": [{serial: {"depth": "depth-11"}}]}
    (tmp_path / "request.json").write_text(json.dumps(request), encoding="utf-8")
    with emulated_usbfs(tmp_path, kinect) as usbfs:
        arguments = (CLIENT, "hold", tmp_path / "request.json", tmp_path)
        with usbfs.start(sys.executable, *arguments) as first:
            assert first.stdout
            assert first.stdout.readline() == "streaming\n"
            refused = usbfs.run(sys.executable, "-m", "kinect_v1", "info")
            listed = usbfs.run(sys.executable, "-m", "kinect_v1", "list")
            first.kill()
        usbfs.tell("end", serial)
        found = run_driver(usbfs, "stream", request, tmp_path)
    assert refused.returncode == 1
    assert refused.stderr.count("\n") == 1
    assert "is used by another program; close that program first." in refused.stderr
    assert listed.stdout.startswith(serial)
    assert "used by another program" in listed.stdout
    sent = images[serial]["depth-11"]
    assert [find(image, sent) for image in np.load(tmp_path / f"{serial}-0-depth.npy")] == [0, 1]
    assert found[serial]["discarded"] == [{"depth": 0}]


def test_every_model_tilts_and_tells_how_it_stands(
    three: list[dict[str, Any]], tmp_path: Path
) -> None:
    with emulated_usbfs(tmp_path, *three) as usbfs:
        found = run_driver(usbfs, "move", {"serials": SERIALS}, tmp_path)
    assert [found[serial]["tilt_deg"] for serial in SERIALS] == [-7.0] * 3
    assert [found[serial]["acceleration_g"] for serial in SERIALS] == [[0.0, 1.0, 0.0]] * 3


def test_the_command_line_on_the_real_libusb(three: list[dict[str, Any]], tmp_path: Path) -> None:
    with emulated_usbfs(tmp_path, *three) as usbfs:
        listed = usbfs.run(sys.executable, "-m", "kinect_v1", "list")
        info = usbfs.run(sys.executable, "-m", "kinect_v1", "info", "--serial", SERIALS[2])
    assert [line.split("\t")[:2] for line in listed.stdout.splitlines()] == [
        [serial, model.value] for serial, model in zip(SERIALS, Model, strict=True)
    ]
    assert json.loads(info.stdout)["serial"] == SERIALS[2]


@pytest.mark.parametrize(
    ("color", "kind", "mode"),
    [
        ("640x480", "b", "bayer-640x480"),
        ("1280x1024", "b", "bayer-1280x1024"),
        ("ir", "i", "ir-640x488"),
    ],
)
def test_recording_on_the_real_libusb(
    color: str, kind: str, mode: str, tmp_path: Path, footage: Footage, images: Images
) -> None:
    serial = SERIALS[1]
    kinect = describe_kinect(tmp_path, Model.XBOX_1473, serial, footage)
    call = ("record", tmp_path / "recording", "--frames", "4", "--color", color)
    with emulated_usbfs(tmp_path, kinect) as usbfs:
        done = usbfs.run(sys.executable, "-m", "kinect_v1", *call)
    assert done.returncode == 0, done.stderr
    recording = read_recording(tmp_path / "recording")
    assert (recording.serial, recording.model) == (serial, "1473")
    depth = [find(read_depth(f), images[serial]["depth-11"]) for f in recording.of_kind("d")]
    assert depth == [i % FRAMES for i in range(4)]
    received = [find(read_received(f), images[serial][mode]) for f in recording.of_kind(kind)]
    assert received
    assert received == [i % FRAMES for i in range(len(received))]


def test_no_sensor_is_said_in_one_sentence(tmp_path: Path) -> None:
    with emulated_usbfs(tmp_path) as usbfs:
        done = usbfs.run(sys.executable, "-m", "kinect_v1", "list")
    assert done.returncode == 1
    assert done.stderr == ("No Kinect is plugged in; plug in its USB cable and its 12 V supply.\n")
