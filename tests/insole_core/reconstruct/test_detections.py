from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import inverse, rigid, rotation_about, transform
from insole_core.reconstruct.markers.blobs import Blobs
from insole_core.reconstruct.markers.detections import locate_blobs
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor

SENSOR = Sensor(
    "kinect-v1",
    "A1",
    PinholeCamera(640, 480, 585.0, 585.0, 316.0, 247.0),
    PinholeCamera(1280, 1024, 1034.0, 1034.0, 640.0, 528.0, (0.14, -0.24, 0.0, 0.0, 0.0)),
    rigid(rotation_about(np.array([0.0, 1, 0]), 1.0), np.array([-25.0, 1.0, 2.0])),
    LinearInverseDisparity(3.33, -0.00307),
)
CENTER = np.array([60.0, -90.0, 780.0])
"""Of a face, depth camera frame; left, right, up and down all differ."""


def wall(distance_mm: float) -> FloatArray:
    return np.full((480, 640), distance_mm)


def blob_at(center: FloatArray, half_px: int) -> Blobs:
    """A square blob round the place of a point in the colour image."""
    pixel = SENSOR.color_pixels(center)
    u, v = np.rint(pixel).astype(int)
    labels = np.full((1024, 1280), -1, dtype=np.int32)
    labels[v - half_px : v + half_px + 1, u - half_px : u + half_px + 1] = 0
    return Blobs(pixel[None], np.array([(2.0 * half_px + 1) ** 2]), labels)


def test_places_a_blob_where_it_is() -> None:
    found = locate_blobs(blob_at(CENTER, 10), SENSOR.points(wall(780.0)), SENSOR)
    # The face is square to the depth camera, so its distance varies by 1 degree over 16 mm.
    np.testing.assert_allclose(found.points, [CENTER], atol=0.2)


def test_what_lies_far_behind_does_not_pull() -> None:
    points = SENSOR.points(wall(780.0))
    seen = SENSOR.color_pixels(points)
    left_of_face = seen[..., 0] < SENSOR.color_pixels(CENTER)[0] - 10
    behind = np.where(left_of_face, 1200.0, 780.0)
    found = locate_blobs(blob_at(CENTER, 10), SENSOR.points(behind), SENSOR)
    np.testing.assert_allclose(found.points, [CENTER], atol=0.3)


def test_the_steps_of_the_sensor_average_out() -> None:
    steps = np.where(np.arange(640) % 4 == 0, 782.0, 780.0)
    found = locate_blobs(blob_at(CENTER, 10), SENSOR.points(wall(1.0) * steps), SENSOR)
    in_color = transform(SENSOR.depth2color, found.points)
    expected = transform(SENSOR.depth2color, CENTER)[2] + 0.5
    np.testing.assert_allclose(in_color[0, 2], expected, atol=0.2)


def test_a_blob_without_depth_has_no_place() -> None:
    assert len(locate_blobs(blob_at(CENTER, 10), SENSOR.points(wall(np.nan)), SENSOR)) == 0


def test_a_blob_that_is_too_large_or_small_in_mm_is_no_marker() -> None:
    for half_px, distance_mm in ((40, 780.0), (3, 780.0)):
        center = transform(inverse(np.eye(4)), CENTER)
        points = SENSOR.points(wall(distance_mm))
        assert len(locate_blobs(blob_at(center, half_px), points, SENSOR)) == 0
