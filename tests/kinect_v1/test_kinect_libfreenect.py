"""An independent witness: Debian's unmodified libfreenect on the same emulated bus (level 3).

What it gets shows that the emulated device speaks the protocol, and that it would notice if not.
"""

from __future__ import annotations

import json
import subprocess
from itertools import pairwise
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from emulated_usbfs import (
    HERE,
    SYSTEM_PYTHON,
    describe_kinect,
    emulated_usbfs,
    require_libfreenect,
)
from kinect_samples import FRAMES, MOST, SERIALS, Footage, Images, in_turn, make_calibration

from insole_studio.acquisition.driver_values import factory_sensor
from kinect_v1.calibration import RGB_DISTANCE_CM
from kinect_v1.emulation.playback import make_footage
from kinect_v1.models import Model
from kinect_v1.modes import MODES
from kinect_v1.pixels import demosaic, mosaic

pytestmark = pytest.mark.slow

WANTED = 3
FARTHEST_MM = 10_000
"""Beyond, its table holds wrapped numbers."""
CLIENT = HERE / "freenect_client.py"


@pytest.fixture(autouse=True)
def _libfreenect() -> None:
    require_libfreenect()


def run_client(
    folder: Path, kinects: list[dict[str, Any]], request: dict[str, Any]
) -> subprocess.CompletedProcess[str]:
    (folder / "request.json").write_text(json.dumps(request), encoding="utf-8")
    with emulated_usbfs(folder, *kinects) as usbfs:
        return usbfs.run(SYSTEM_PYTHON, CLIENT, folder / "request.json", folder)


def ask_libfreenect(
    folder: Path, kinects: list[dict[str, Any]], request: dict[str, Any]
) -> dict[str, Any]:
    done = run_client(folder, kinects, request)
    assert done.returncode == 0, done.stderr
    result: dict[str, Any] = json.loads((folder / "result.json").read_text(encoding="utf-8"))
    return result


def received(folder: Path, serial: str, turn: int, kind: str, mode: str) -> list[np.ndarray]:
    """The first frames that libfreenect passed on."""
    shape = (MODES[mode].height, MODES[mode].width)
    dtype = np.uint8 if mode.startswith("bayer") else np.uint16
    found = folder.glob(f"{serial}-{turn}-{kind}-[0-9]*")
    files = sorted(found, key=lambda f: int(f.name.split("-")[-1]))
    return [np.fromfile(file, dtype).reshape(shape) for file in files][:WANTED]


OTHERS = (
    {"depth": "depth-10", "video": "bayer-640x480"},
    {"video": "ir-640x488"},
    {"video": "ir-1280x1024"},
)


def test_it_gets_every_frame_and_the_calibration(
    tmp_path: Path, footage: Footage, images: Images
) -> None:
    """Of all with the most data, then in different modes, until each has had all."""
    kinects = [
        describe_kinect(tmp_path, model, serial, footage, seed=i, controller=i + 1)
        for i, (model, serial) in enumerate(zip(Model, SERIALS, strict=True))
    ]
    turns = [dict.fromkeys(SERIALS, MOST), *in_turn(OTHERS)]
    result = ask_libfreenect(tmp_path, kinects, {"frames": WANTED, "turns": turns})
    for i, serial in enumerate(SERIALS):
        for turn, modes_of in enumerate(turns):
            for kind, mode in modes_of[serial].items():
                sent = images[serial][mode]
                got = received(tmp_path, serial, turn, kind, mode)
                numbers = [
                    next((n for n, image in enumerate(sent) if np.array_equal(image, frame)), -1)
                    for frame in got
                ]
                assert len(numbers) == WANTED
                assert -1 not in numbers
                assert all((b - a) % FRAMES == 1 for a, b in pairwise(numbers))
        expected = make_calibration(i)
        plane = expected.zero_plane
        found = result[serial]
        assert found["info"] == list(vars(expected.registration).values())
        assert found["const_shift"] == expected.constant_shift
        assert found["zero_plane"] == [
            plane.emitter_distance_cm,
            float(np.float32(RGB_DISTANCE_CM)),
            plane.reference_distance_cm,
            plane.reference_pixel_cm,
        ]


def test_our_depth_is_its_depth_for_random_calibrations(tmp_path: Path) -> None:
    serials = [f"A{number:015d}A"[:16] for number in range(100, 106)]
    kinects = [
        describe_kinect(tmp_path, Model.XBOX_1414, serial, {}, seed=50 + i, controller=i + 1)
        for i, serial in enumerate(serials)
    ]
    ask_libfreenect(tmp_path, kinects, {"turns": [{serial: {} for serial in serials}]})
    for i, serial in enumerate(serials):
        theirs = np.fromfile(tmp_path / f"{serial}-raw_to_mm", "u2").astype(float)
        ours = factory_sensor(make_calibration(50 + i), serial, ()).depth_mm(np.arange(2048.0))
        valid = ours < FARTHEST_MM
        assert valid.sum() > 900
        # Its table holds whole millimetres, cut off.
        assert np.all(np.abs(ours[valid] - theirs[valid] - 0.5) <= 0.5 + 1e-6)


def make_color_card() -> np.ndarray:
    """A smooth picture, red to the left and blue to the right, bright below."""
    v, u = np.mgrid[:480, :640]
    return np.stack([220 - u // 4, 60 + v // 6, 40 + u // 4], axis=-1).astype(np.uint8)


@pytest.mark.parametrize("swapped", [False, True], ids=["right", "rows swapped"])
def test_colours_are_where_it_expects_them(swapped: bool, tmp_path: Path) -> None:
    card = make_color_card()
    bayer = mosaic(card)
    if swapped:
        bayer = np.roll(bayer, 1, axis=0)
    serial = SERIALS[0]
    footage = {serial: make_footage(mosaics=[bayer])}
    kinect = describe_kinect(tmp_path, Model.XBOX_1414, serial, footage)
    turns = [{serial: {"video": "rgb-640x480"}}]
    ask_libfreenect(tmp_path, [kinect], {"turns": turns, "frames": 1})
    theirs = np.fromfile(tmp_path / f"{serial}-0-video-0", np.uint8).reshape(480, 640, 3)
    inner = (slice(4, -4), slice(4, -4))
    error = np.abs(theirs[inner].astype(int) - card[inner]).mean()
    assert (error > 20) == swapped
    if not swapped:
        ours = demosaic(bayer).astype(int)
        assert np.abs(ours[inner] - theirs[inner]).max() <= 2


def reverse_bits(frames: list[bytes]) -> list[bytes]:
    """Pack least significant bit first."""
    flipped = np.packbits(np.unpackbits(np.arange(256, dtype=np.uint8)[:, None], axis=1)[:, ::-1])
    return [cv2.LUT(np.frombuffer(frame, np.uint8), flipped).tobytes() for frame in frames]


@pytest.mark.parametrize(
    "flaw",
    ["none", "odd", "bit order", "payload", "flag", "sequence", "calibration offset", "reply tag"],
)
def test_it_notices_planted_errors(
    flaw: str, tmp_path: Path, footage: Footage, images: Images
) -> None:
    serial = SERIALS[0]
    frames = footage[serial]["depth-11"]
    sent = {"depth-11": reverse_bits(frames) if flaw == "bit order" else frames}
    kinect = describe_kinect(tmp_path, Model.XBOX_1414, serial, {serial: sent}, seed=3, flaw=flaw)
    request = {"turns": [{serial: {"depth": "depth-11"}}], "frames": 1, "limit_s": 1.5}
    done = run_client(tmp_path, [kinect], request)
    assert noticed(done, tmp_path, serial, images) == (flaw not in ("none", "odd"))


def noticed(
    done: subprocess.CompletedProcess[str], folder: Path, serial: str, images: Images
) -> bool:
    """Whether it complained, or got something other than what was sent."""
    if done.returncode != 0:
        return True
    plane = json.loads((folder / "result.json").read_text(encoding="utf-8"))[serial]["zero_plane"]
    expected = make_calibration(3).zero_plane
    got = received(folder, serial, 0, "depth", "depth-11")
    right_plane = plane[0] == expected.emitter_distance_cm
    sent = images[serial]["depth-11"]
    right_frames = bool(got) and all(
        any(np.array_equal(frame, image) for image in sent) for frame in got
    )
    return not (right_plane and right_frames)
