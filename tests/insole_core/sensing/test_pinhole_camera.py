"""The camera against OpenCV, and there and back."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from insole_core.sensing.pinhole_camera import PinholeCamera

KINECT_COLOR = PinholeCamera(
    1280, 1024, 1034.4, 1034.3, 640.2, 528.0, (0.14, -0.24, 0.0008, -0.0004, 0.01)
)


def test_projection_equals_opencv() -> None:
    points = np.random.default_rng(1).uniform([-300, -250, 600], [300, 250, 1000], (200, 3))
    camera = KINECT_COLOR
    matrix = np.array([[camera.fx, 0, camera.cx], [0, camera.fy, camera.cy], [0, 0, 1]])
    expected, _ = cv2.projectPoints(
        points, np.zeros(3), np.zeros(3), matrix, np.array(camera.distortion)
    )
    np.testing.assert_allclose(camera.project(points), expected[:, 0], atol=1e-9)


@given(st.floats(0, 1279), st.floats(0, 1023), st.floats(-2, 2))
def test_pixel_to_ray_and_back(u: float, v: float, skew: float) -> None:
    camera = PinholeCamera(1280, 1024, 1034, 1035, 640, 528, KINECT_COLOR.distortion, skew)
    x, y = camera.normalised(np.array([u, v]))
    np.testing.assert_allclose(camera.project(np.array([x, y, 1.0])), [u, v], atol=1e-3)


def test_skew_moves_u_with_y() -> None:
    camera = PinholeCamera(640, 480, 500, 500, 320, 240, skew=10)
    np.testing.assert_allclose(camera.project(np.array([0, 0.1, 1.0])), [321, 290])


def test_rays_of_all_pixels() -> None:
    camera = PinholeCamera(640, 480, 585, 586, 316, 247)
    rays = camera.pixel_rays()
    assert rays.shape == (480, 640, 2)
    assert rays[247, 316] == pytest.approx([0, 0])
    assert rays[0, 0] == pytest.approx([-316 / 585, -247 / 586])
