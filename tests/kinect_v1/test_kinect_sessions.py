"""Recorded reference data, played by the emulated device and read by the driver."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from kinect_samples import SPEED

from kinect_v1.emulation.bus import EmulatedBus
from kinect_v1.emulation.device import EmulatedKinect
from kinect_v1.emulation.playback import TYPICAL_CALIBRATION, make_footage
from kinect_v1.kinect_camera import open_camera
from kinect_v1.models import Model
from kinect_v1.modes import BAYER_1280
from kinect_v1.pixels import demosaic, mosaic
from kinect_v1.usb_bus import UsbBus

VIEWS = ("left", "right", "top")
pytestmark = pytest.mark.shared


def read_image(path: Path) -> np.ndarray:
    return np.asarray(cv2.imread(str(path), cv2.IMREAD_UNCHANGED))


def test_a_session_comes_through_bit_for_bit(shared_data: Path) -> None:
    views = [shared_data / "sessions" / "left_a" / "views" / view for view in VIEWS]
    depth = [[read_image(file) for file in sorted(view.glob("depth_*.png"))] for view in views]
    color = [read_image(view / "color_000.png")[..., ::-1] for view in views]
    assert all(picture.shape == (1024, 1280, 3) for picture in color)
    kinects = [
        EmulatedKinect(model, f"S{i}", TYPICAL_CALIBRATION, make_footage(raw, [mosaic(rgb)]))
        for i, (model, raw, rgb) in enumerate(zip(Model, depth, color, strict=True))
    ]
    bus = UsbBus(EmulatedBus(kinects, speed=SPEED))
    for i, (sent, rgb) in enumerate(zip(depth, color, strict=True)):
        with open_camera(f"S{i}", bus=bus) as camera:
            stream = camera.start_depth()
            for raw in sent:
                assert np.array_equal(stream.read().image, raw)
            picture = demosaic(camera.start_video(BAYER_1280).read().image)
        assert np.array_equal(picture, demosaic(mosaic(rgb)))
        assert np.abs(picture.astype(int) - rgb).mean() < 10
