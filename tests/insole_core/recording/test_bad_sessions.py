"""Every violation of the format is one sentence that names the file and the key."""

from __future__ import annotations

import json
import re
import struct
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from insole_core.errors import InputError
from insole_core.recording.reader import read_session

Json = dict[str, Any]


def edit(path: Path, change: Callable[[Json], object]) -> None:
    values = json.loads(path.read_text())
    change(values)
    path.write_text(json.dumps(values))


def read_all(path: Path) -> None:
    for view in read_session(path).views:
        for index in range(view.depth_count):
            view.read_depth(index)


def error_of(path: Path) -> str:
    with pytest.raises(InputError) as caught:
        read_all(path)
    message = str(caught.value)
    assert message.endswith(".")
    assert "\n" not in message
    return message


MANIFEST: dict[str, tuple[Callable[[Json], object], str]] = {
    "other format": (lambda m: m.update(format="dicom"), 'manifest.json: format is .dicom., but'),
    "newer": (lambda m: m.update(version=4), "version 4, which is newer than this program"),
    "no version": (lambda m: m.pop("version"), "manifest.json: version is missing"),
    "version zero": (lambda m: m.update(version=0), "version is 0, but must lie between 1 and 3"),
    "side": (lambda m: m.update(side="both"), 'version is 1, .* one foot, but "side" is "both"'),
    "no side": (lambda m: m.pop("side"), "side is missing"),
    "date": (lambda m: m.update(recorded_at="yesterday"), 'recorded_at is "yesterday"'),
    "views": (lambda m: m.update(views=["Left!"]), "views names 'Left!', but a view has"),
    "no views": (lambda m: m.update(views=[]), "views must name at least one view"),
    "view twice": (lambda m: m.update(views=["left", "left"]), "and none twice"),
    "view that is not there": (
        lambda m: m["views"].append("right"),
        "views/right/sensor.json is missing, but manifest.json names the view right",
    ),
    "marker position": (
        lambda m: m["reference_frame"]["markers"][1].update(position_mm=[1, 2]),
        r"reference_frame.markers\[1\].position_mm has 2 numbers, but must have 3",
    ),
    "marker NaN": (
        lambda m: m["reference_frame"]["markers"][0].update(position_mm=[1, float("nan"), 2]),
        r"markers\[0\].position_mm\[1\] is nan, but must be a finite number",
    ),
    "marker twice": (
        lambda m: m["reference_frame"]["markers"][1].update(id="S1"),
        "names the same marker id twice",
    ),
    "no markers": (lambda m: m["reference_frame"].update(markers=[]), "markers is empty"),
    "box": (
        lambda m: m["volume_of_interest_mm"].update(min=[0, 0, 900]),
        "volume_of_interest_mm must have min below max",
    ),
    "condition": (
        lambda m: m["capture_condition"].update(weight_bearing="heavy"),
        'capture_condition.weight_bearing is "heavy"',
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", MANIFEST)
def test_manifest(folder: Path, name: str) -> None:
    change, expected = MANIFEST[name]
    edit(folder / "manifest.json", change)
    assert re.search(expected, error_of(folder)), error_of(folder)


def _turn(rotation: list[list[float]]) -> Callable[[Json], object]:
    return lambda s: s["depth2color"].update(rotation=rotation)


SENSOR: dict[str, tuple[Callable[[Json], object], str]] = {
    "no camera": (lambda s: s.pop("depth_camera"), "sensor.json: depth_camera is missing"),
    "focal length": (
        lambda s: s["depth_camera"].update(fx=-585),
        "depth_camera.fx is -585, but must lie between",
    ),
    "text for a number": (
        lambda s: s["color_camera"].update(cx="middle"),
        'color_camera.cx is "middle", but must be a number',
    ),
    "NaN": (lambda s: s["color_camera"].update(cy=float("nan")), "color_camera.cy is nan"),
    "depth size": (
        lambda s: s["depth_camera"].update(width=320, height=240),
        "height are 320×240, but must be 640×480",
    ),
    "mirrored": (
        _turn([[-1, 0, 0], [0, 1, 0], [0, 0, 1]]),
        "depth2color.rotation is mirrored; its rows must be right-handed",
    ),
    "lens that turns back": (
        lambda s: s["depth_camera"].update(distortion=[-1, 0, 0, 0, 0]),
        "depth_camera.distortion bends the edges of the picture more than a lens does",
    ),
    "huge rotation": (_turn([[1, 1e308, 0], [0, 1, 0], [0, 0, 1]]), "rotation is no rotation"),
    "sheared": (_turn([[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]), "rotation is no rotation"),
    "NaN rotation": (
        _turn([[1, 0, 0], [0, float("nan"), 0], [0, 0, 1]]),
        "depth2color.rotation.1..1. is nan, but must be a finite number",
    ),
    "rotation shape": (_turn([[1, 0, 0]]), "rotation must be a 3×3 matrix"),
    "disparity model": (
        lambda s: s["disparity"].update(model="magic"),
        'disparity.model is "magic", but must be',
    ),
    "disparity number": (lambda s: s["disparity"].pop("baseline_mm"), "baseline_mm is missing"),
    "faces": (lambda s: s.update(faces=["dorsum"]), 'faces names "dorsum", which no marker'),
    "no faces": (lambda s: s.update(faces=[]), "faces must name at least one marker group"),
    "correction elsewhere": (
        lambda s: s.update(disparity_correction="../../x.npz"),
        "disparity_correction must name a file beside sensor.json",
    ),
    "correction missing": (
        lambda s: s.update(disparity_correction="other.npz"),
        "views/left/other.npz is missing, but sensor.json names it",
    ),
}


@pytest.mark.parametrize("name", SENSOR)
def test_sensor(folder: Path, name: str) -> None:
    change, expected = SENSOR[name]
    edit(folder / "views/left/sensor.json", change)
    message = error_of(folder)
    assert "views/left" in message
    assert re.search(expected, message), message


def _png(image: np.ndarray[Any, Any]) -> bytes:
    return cv2.imencode(".png", image)[1].tobytes()


FRAMES: dict[str, tuple[Callable[[bytes], bytes], str]] = {
    "truncated": (lambda png: png[: len(png) // 2], "depth_001.png is truncated or damaged"),
    "one byte wrong": (
        lambda png: png[:500] + bytes([png[500] ^ 1]) + png[501:],
        "depth_001.png is truncated or damaged",
    ),
    "empty": (lambda _: b"", "depth_001.png is not a PNG image"),
    "JPEG": (lambda _: b"\xff\xd8\xff\xe0 and so on", "is not a PNG image"),
    "8 bit": (
        lambda _: _png(np.zeros((480, 640), np.uint8)),
        "is 640×480 8-bit grey, but must be 640×480 16-bit grey",
    ),
    "size": (lambda _: _png(np.zeros((240, 320), np.uint16)), "is 320×240 16-bit grey, but must"),
    "colour": (lambda _: _png(np.zeros((480, 640, 3), np.uint16)), "is 640×480 16-bit RGB"),
    "millimetres": (
        lambda _: _png(np.full((480, 640), 30_000, np.uint16)),
        "holds the number 30000, but the sensor's raw numbers end at 2047",
    ),
}


@pytest.mark.parametrize("name", FRAMES)
def test_frames(folder: Path, name: str) -> None:
    change, expected = FRAMES[name]
    frame = folder / "views/left/depth_001.png"
    frame.write_bytes(change(frame.read_bytes()))
    assert expected in error_of(folder)


def test_gap_in_the_numbering(folder: Path) -> None:
    (folder / "views/left/depth_000.png").unlink()
    assert "views/left/depth_000.png is missing, but later frames are there" in error_of(folder)


@pytest.mark.parametrize("kind", ["depth", "color"])
def test_no_frames(folder: Path, kind: str) -> None:
    (folder / f"views/top/{kind}_000.png").unlink()
    assert f"views/top holds no {kind}_000.png" in error_of(folder)


@pytest.mark.parametrize(
    ("array", "value"),
    [
        ("offset", np.zeros((640, 480), np.float32)),
        ("offset", np.full((480, 640), np.nan, np.float32)),
        ("shift", np.zeros((480, 640), np.float32)),
    ],
)
def test_correction(folder: Path, array: str, value: np.ndarray[Any, Any]) -> None:
    np.savez(folder / "views/left/correction.npz", **{array: value})
    assert "calibrate the sensor again" in error_of(folder)


def test_correction_that_is_no_archive(folder: Path) -> None:
    (folder / "views/left/correction.npz").write_bytes(b"nothing of the kind")
    assert 'holds no readable array "offset"' in error_of(folder)


def test_broken_json(folder: Path) -> None:
    (folder / "manifest.json").write_text("{")
    assert "manifest.json is not valid JSON" in error_of(folder)
    (folder / "manifest.json").write_text("[]")
    assert "must hold one JSON object" in error_of(folder)


def test_not_a_session(tmp_path: Path) -> None:
    assert "holds no manifest.json" in error_of(tmp_path)
    assert "does not exist" in error_of(tmp_path / "nowhere")
    (tmp_path / "x.zip").write_bytes(b"PK but not really")
    assert "not a readable zip archive" in error_of(tmp_path / "x.zip")


@pytest.mark.parametrize("name", ["../outside.png", "/etc/passwd", "views/../../x", "C:\\x"])
def test_path_traversal(tmp_path: Path, name: str) -> None:
    archive = tmp_path / "s.zip"
    with zipfile.ZipFile(archive, "w") as opened:
        opened.writestr("manifest.json", "{}")
        opened.writestr(name, "x")
    assert "leads out of the archive" in error_of(archive)


@pytest.mark.parametrize("stated", [80 * 2**20, 10])
def test_bomb(tmp_path: Path, stated: int) -> None:
    archive = tmp_path / "s.zip"
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as opened:
        opened.writestr("manifest.json", bytes(80 * 2**20))
    content = bytearray(archive.read_bytes())
    struct.pack_into("<I", content, content.rindex(b"PK\1\2") + 24, stated)
    archive.write_bytes(content)
    assert "manifest.json is larger than 64 MB" in error_of(archive)


def test_an_archive_of_far_more_files_than_a_session_has(tmp_path: Path) -> None:
    archive = tmp_path / "s.zip"
    entry = struct.pack("<4s6H3L5H2L", b"PK\1\2", 20, 20, *[0] * 7, 6, *[0] * 6)
    files = b"".join(entry + b"%06d" % index for index in range(100_001))
    archive.write_bytes(files + struct.pack("<4s4H2LH", b"PK\5\6", 0, 0, 1, 1, len(files), 0, 0))
    assert "100001 files, far more than a session has" in error_of(archive)


def test_damaged_member(session_archive: Path) -> None:
    content = bytearray(session_archive.read_bytes())
    middle = content.find(b"views/left/sensor.json") + 200
    content[middle] ^= 0xFF
    session_archive.write_bytes(content)
    assert "is damaged; copy the archive again" in error_of(session_archive)
