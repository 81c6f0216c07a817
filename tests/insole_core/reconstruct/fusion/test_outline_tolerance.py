"""How far outside an outline a place may lie before a view shows that it is no foot."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.geometry.transforms import transform
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.silhouette import Silhouette, is_beside
from insole_core.sensing.sensor import nominal_kinect

FAR_MM = 750.0


@pytest.mark.parametrize(
    ("width", "height", "within_mm", "beyond_mm"), [(1280, 1024, 0.6, 1.2), (640, 480, 1.2, 2.4)]
)
def test_a_small_picture_cuts_less_closely(
    width: int, height: int, within_mm: float, beyond_mm: float
) -> None:
    sensor = nominal_kinect("A1")
    camera = replace(
        sensor.color_camera,
        width=width,
        height=height,
        fx=sensor.color_camera.fx * width / 1280,
        fy=sensor.color_camera.fy * width / 1280,
        cx=width / 2,
        cy=height / 2,
        distortion=(0.0,) * 5,
    )
    view = DepthView(
        "left",
        replace(sensor, color_camera=camera),
        np.eye(4),
        (0, 0),
        np.full((4, 4), np.nan),
        np.zeros((height, width, 3), np.uint8),
    )
    across = np.arange(width, dtype=np.float32) - width // 2
    outside_px = np.broadcast_to(across, (height, width))
    outline = Silhouette((0, 0), outside_px, np.ones((height, width), bool))
    places = np.array([[way_mm, 0.0, FAR_MM] for way_mm in (within_mm, beyond_mm)])

    beside = is_beside(transform(view.color2reference, places), view, outline)

    assert list(beside) == [False, True]
