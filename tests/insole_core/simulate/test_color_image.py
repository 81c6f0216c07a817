from __future__ import annotations

import numpy as np
import pytest

from insole_core.geometry.mesh import TriangleMesh
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.simulate.color_image import record_color
from insole_core.simulate.device import make_device
from insole_core.simulate.scene import SceneCaster, joined

AWAY_MM = 800.0


def face(pixels: np.ndarray, camera: PinholeCamera) -> TriangleMesh:
    """A white rectangle that appears between two corners, colour camera frame."""
    (left, upper), (right, lower) = camera.normalised(pixels) * AWAY_MM
    corners = [(left, upper), (right, upper), (right, lower), (left, lower)]
    return TriangleMesh(
        np.array([(x, y, AWAY_MM) for x, y in corners]),
        np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32),
        np.full((4, 3), 255, dtype=np.uint8),
    )


@pytest.mark.parametrize("beyond", [0.1, 0.4, 0.6, 0.9])
def test_pixels_see_areas(beyond: float) -> None:
    sensor = make_device("S", ("sole",), 800.0, (640, 480), np.random.default_rng(0)).sensor
    corners = np.array([[310.3, 250.3], [330.3 + beyond, 270.3 + beyond]])
    scene = face(corners, sensor.color_camera)
    recording = record_color(SceneCaster(scene), sensor, sensor.depth2color)

    level = recording.expected[..., 0] - recording.expected[0, 0, 0]
    area = float(level.sum() / level[260, 320])
    assert area == pytest.approx((20 + beyond) ** 2, rel=0.01)


def test_a_picture_may_be_full_of_edges() -> None:
    """OpenCV's remap, which was used for the rays, takes no more than 32 766 at once."""
    sensor = make_device("S", ("sole",), 800.0, (640, 480), np.random.default_rng(0)).sensor
    strips = [
        face(np.array([[left, 20.0], [left + 2.5, 460.0]]), sensor.color_camera)
        for left in np.arange(20.0, 600.0, 5.0)
    ]
    scene = SceneCaster(joined(strips))
    level = record_color(scene, sensor, sensor.depth2color).expected[..., 0]
    assert level[200, 40:580].mean() == pytest.approx((level[200].max() + level[0, 0]) / 2, rel=0.1)
