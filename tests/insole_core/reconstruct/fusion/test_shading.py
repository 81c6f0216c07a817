"""How dark places are against their surroundings, looked up where the colour camera shows them."""

from __future__ import annotations

import numpy as np
import pytest

from insole_core.geometry.transforms import rigid, rotation_about
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.neighbourhood import find_shading, shading_of
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor

DISPARITY = LinearInverseDisparity(a=1090 / 348, b=-1 / 348)
DEPTH_MM = 800.0


def _groove(level: float, groove: float) -> np.ndarray:
    levels = np.full((61, 81), level)
    levels[:, 39:42] = groove
    return levels


def test_a_groove_is_dark_and_the_rest_about_even() -> None:
    shading = shading_of(_groove(150, 60), np.ones((61, 81), bool))

    assert (shading[:, 40] < -0.35).all()
    assert np.abs(shading[:, :15]).max() < 0.01
    assert 0 < shading[:, 36].mean() < 0.2


def test_a_brighter_picture_has_nearly_the_same_shading() -> None:
    known = np.ones((61, 81), bool)
    one, other = shading_of(_groove(100, 40), known), shading_of(_groove(200, 80), known)

    np.testing.assert_allclose(one, other, atol=0.06)


def test_what_is_not_foot_does_not_count() -> None:
    known = np.zeros((61, 81), bool)
    known[10:50, 20:60] = True
    shading = shading_of(np.where(known, 120.0, 0.0), known)

    assert np.abs(shading).max() < 1e-5
    assert not shading_of(_groove(120, 60), np.zeros((61, 81), bool)).any()


@pytest.mark.parametrize(("spot", "size"), [((31, 17), (1280, 1024)), ((12, 40), (640, 480))])
def test_the_picture_is_looked_up_where_the_colour_camera_sees_the_place(
    spot: tuple[int, int], size: tuple[int, int]
) -> None:
    """A dark spot is painted where a reading projects to: there, and nowhere else, it is dark."""
    width, height = size
    color = PinholeCamera(width, height, 0.82 * width, 0.82 * width, width / 2, height / 2)
    turn = rotation_about(np.array([0.0, 1.0, 0.0]), 1.5)
    sensor = Sensor(
        "kinect-v1",
        "0",
        PinholeCamera(640, 480, 580.0, 580.0, 320.0, 240.0),
        color,
        rigid(turn, np.array([-25.0, 1.0, 2.0])),
        DISPARITY,
    )
    raw = np.full((61, 51), float(DISPARITY.raw(np.array(DEPTH_MM))))
    picture = np.full((height, width, 3), 160, np.uint8)
    pose = rigid(rotation_about(np.array([1.0, 0.0, 0.0]), 160.0), np.array([5.0, 9.0, 700.0]))
    reading = DepthView("view", sensor, pose, (300, 200), raw, picture)
    ahead = np.add(spot, np.subtract(reading.corner, (320, 240))) / 580
    place = DEPTH_MM * np.array([*ahead, 1.0])
    u, v = color.project((sensor.depth2color[:3, :3] @ place + sensor.depth2color[:3, 3])[None])[0]
    radius = width // 400
    picture[
        round(v) - radius : round(v) + radius + 1, round(u) - radius : round(u) + radius + 1
    ] = 30

    shading = find_shading(reading)

    row, column = np.unravel_index(shading.argmin(), shading.shape)
    assert abs(row - spot[1]) <= 1
    assert abs(column - spot[0]) <= 1
    assert shading.min() < -0.2
    away = np.hypot(*(np.mgrid[:61, :51] - np.array([spot[1], spot[0]])[:, None, None]))
    assert np.abs(shading[away > 20]).max() < 0.01


def test_what_lies_beside_the_picture_is_not_dark() -> None:
    """The picture ends across the foot, and its grey is even up to there."""
    camera = PinholeCamera(640, 480, 580.0, 580.0, 320.0, 240.0)
    cut = PinholeCamera(320, 480, 580.0, 580.0, 320.0, 240.0)
    raw = np.full((61, 51), float(DISPARITY.raw(np.array(DEPTH_MM))))
    picture = np.full((480, 320, 3), 160, np.uint8)
    sensor = Sensor("kinect-v1", "0", camera, cut, np.eye(4), DISPARITY)

    shading = find_shading(DepthView("view", sensor, np.eye(4), (295, 200), raw, picture))

    assert np.abs(shading).max() < 0.01
