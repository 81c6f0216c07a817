"""How far the correction moved the surface, on planes with known errors."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rigid
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.prepared_view import PreparedView, corrections_mm, smooth_depth
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor

DISTANCE_MM = 800.0
CAMERA = PinholeCamera(640, 480, 580.0, 580.0, 320.0, 240.0)
DISPARITY = LinearInverseDisparity(a=3.1, b=-0.00285)
SENSOR = Sensor("kinect-v1", "T", CAMERA, CAMERA, np.eye(4), DISPARITY)
POSE = rigid(np.eye(3), np.array([0.0, 0.0, -DISTANCE_MM]))
BLACK = np.zeros((480, 640, 3), np.uint8)


def _seen(slope: float, error_raw: float) -> tuple[TriangleMesh, PreparedView]:
    """Return a plane z = slope · x that faces a sensor below it, and its corrected view."""
    line_mm = np.linspace(-40, 40, 9)
    x, y = (axis.ravel() for axis in np.meshgrid(line_mm, line_mm))
    index = np.arange(81).reshape(9, 9)
    a, b = index[:-1, :-1].ravel(), index[:-1, 1:].ravel()
    triangles = np.concatenate([np.stack([a, b + 9, b], -1), np.stack([a, a + 9, b + 9], -1)])
    plane = TriangleMesh(np.stack([x, y, slope * x], -1), triangles.astype(np.int32))
    blank = DepthView("view", SENSOR, POSE, (250, 180), np.zeros((120, 140)), BLACK)
    depth_mm = DISTANCE_MM / (1 - slope * blank.rays[..., 0])
    true = blank.with_raw(DISPARITY.raw(depth_mm))
    within = true.with_raw(true.raw + error_raw)
    return plane, PreparedView(within, within, true, None, smooth_depth(true))


@pytest.mark.parametrize("error_raw", [-1.0, 0.0, 0.5])
def test_a_facing_surface_moves_by_the_whole_error(error_raw: float) -> None:
    plane, view = _seen(0.0, error_raw)
    moved = corrections_mm(plane, [view])
    # A greater number is farther away: without its error the surface lies nearer, thus outwards.
    far = DISPARITY.depth_mm(DISPARITY.raw(np.array(DISTANCE_MM)) + error_raw)
    np.testing.assert_allclose(moved, far - DISTANCE_MM, atol=0.02)


def test_a_slope_moves_by_less_along_its_normal() -> None:
    plane, view = _seen(1.0, 1.0)
    moved = corrections_mm(plane, [view])
    along_ray = 1.0 / view.reading.raw_per_mm(np.array(DISTANCE_MM))
    assert moved[40] == pytest.approx(float(along_ray) * np.cos(np.radians(45)), rel=0.03)


def test_views_are_averaged_and_unseen_places_are_unknown() -> None:
    plane, one = _seen(0.0, 1.0)
    _, other = _seen(0.0, 0.0)
    alone = corrections_mm(plane, [one])
    np.testing.assert_allclose(corrections_mm(plane, [one, other]), alone / 2, atol=1e-6)
    assert corrections_mm(plane, [replace(one, within=None)]) is None, "nothing was corrected"
    aside = TriangleMesh(plane.vertices + np.array([500, 0, 0]), plane.triangles)
    assert np.isnan(corrections_mm(aside, [one])).all()
