"""A Kinect v1 with nominal parameters, before any calibration."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.transforms import rigid
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor

BURRUS = LinearInverseDisparity(3.3309495, -0.0030711016)
"""Thesis (17), with the values that Burrus published."""
DEPTH_CAMERA = PinholeCamera(640, 480, 585.0, 585.0, 319.5, 239.5)
COLOR_CAMERA = PinholeCamera(1280, 1024, 1050.0, 1050.0, 639.5, 511.5)
DEPTH2COLOR = rigid(np.eye(3), np.array([-25.0, 0.0, 0.0]))


def nominal_kinect(serial: str) -> Sensor:
    """Return a Kinect v1 with the nominal parameters of its model."""
    return Sensor(
        model="kinect-v1",
        serial=serial,
        depth_camera=DEPTH_CAMERA,
        color_camera=COLOR_CAMERA,
        depth2color=DEPTH2COLOR,
        disparity=BURRUS,
        faces=("sole",),
    )
