"""A small session with known content, as a value and on disk."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid, rotation_about
from insole_core.recording.box import Box
from insole_core.recording.session import (
    CaptureCondition,
    Manifest,
    Marker,
    ReferenceSystem,
    Session,
    View,
)
from insole_core.recording.writer import write_session
from insole_core.sensing.correction import CorrectionRecord, DisparityCorrection
from insole_core.sensing.disparity import FactoryDisparity, LinearInverseDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import CalibrationRecord, Sensor


def make_correction(serial: str) -> DisparityCorrection:
    ramp = np.linspace(-3, 3, 480 * 640, dtype=np.float32).reshape(480, 640)
    record = CorrectionRecord(serial, "2026-11-01T09:00:00+00:00", "smooth map", {"rms": 0.5})
    coverage = np.full((480, 640), 6, np.uint8)
    return DisparityCorrection(
        ramp,
        slope=ramp / 1000,
        reference_raw=650.0,
        decay=0.002,
        raw_range=(500.0, 900.0),
        coverage=coverage,
        record=record,
    )


def make_sensor(serial: str, face: str, corrected: bool) -> Sensor:
    return Sensor(
        model="kinect-v1",
        serial=serial,
        depth_camera=PinholeCamera(640, 480, 585.6, 585.5, 316.0, 247.6),
        color_camera=PinholeCamera(
            640, 480, 517.0, 516.0, 320.0, 264.0, (0.14, -0.24, 0.001, 0, 0), 0.2
        ),
        depth2color=rigid(
            rotation_about(np.array([0.0, 1, 0]), 0.5), np.array([-25.0, 0.25, 0.125])
        ),
        disparity=FactoryDisparity(1200.0, 1.042, 75.0, 200.0)
        if corrected
        else LinearInverseDisparity(3.33, -0.00307),
        correction=make_correction(serial) if corrected else None,
        faces=(face,),
        calibration=(CalibrationRecord("camera", "2026-11-01T09:00:00Z", 0.31, "px"),)
        if corrected
        else (),
    )


def make_view(name: str, sensor: Sensor, depth_count: int) -> View:
    rows, columns = np.mgrid[:480, :640]
    depth = np.stack([400 + rows + i for i in range(depth_count)]).astype(np.uint16)
    depth[:, :, 632:] = 2047
    color = np.stack([rows % 256, columns % 256, 0 * rows + len(name)], axis=-1)[None]
    color = color.astype(np.uint8)
    return View(name, sensor, depth_count, 1, depth.__getitem__, color.__getitem__)


@pytest.fixture(scope="package")
def session() -> Session:
    markers = (
        Marker("S1", (-80.0, -110.0, -9.6), "sole"),
        Marker("S2", (80.0, 100.0, 9.6), "sole"),
        Marker("A1", (-72.0, -150.0, 40.0), "achilles"),
    )
    manifest = Manifest(
        recorded_at="2026-11-20T10:00:00Z",
        side=Side.RIGHT,
        reference_system=ReferenceSystem("three", markers),
        views=("left", "top"),
        volume_of_interest=Box((-70, -150, -40), (70, 150, 160)),
        capture_condition=CaptureCondition("semi", True, "sat upright – höger fot"),
        extra={"clinic": {"room": 3}},
    )
    views = (
        make_view("left", make_sensor("A1", "sole", corrected=True), 2),
        make_view("top", make_sensor("B2", "achilles", corrected=False), 1),
    )
    return Session(manifest, views, "memory")


@pytest.fixture(scope="package")
def written(session: Session, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("written") / "session"
    write_session(session, path)
    return path


@pytest.fixture
def folder(written: Path, tmp_path: Path) -> Path:
    """The session as a folder of its own, free to be damaged."""
    return shutil.copytree(written, tmp_path / "session")


@pytest.fixture
def session_archive(session: Session, tmp_path: Path) -> Path:
    path = tmp_path / "session.zip"
    write_session(session, path)
    return path
