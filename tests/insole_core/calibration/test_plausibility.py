"""A calibrated sensor that no Kinect can be is told, with what is likely wrong."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.calibration.plausibility import (
    USUAL_DEPTH,
    Distances,
    Kind,
    find_camera_misfit,
    find_depth_misfit,
    find_misfit,
    find_shift_misfit,
    unusual_distances,
)
from insole_core.calibration.walls.disparity_fit import fit_linear_inverse, fit_tangent
from insole_core.errors import CalibrationError
from insole_core.geometry.transforms import rigid, rotation_about
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor, nominal_kinect

FLAT = DisparityCorrection(np.zeros((480, 640), np.float32))
SENSOR = replace(nominal_kinect("A1"), correction=FLAT)


def as_fitted(given_mm: float, true_mm: float) -> tuple[Sensor, LinearInverseDisparity]:
    """What a board gives a sensor when its squares are given too large or too small."""
    scale = given_mm / true_mm
    depth = LinearInverseDisparity(USUAL_DEPTH.a / scale, USUAL_DEPTH.b / scale)
    depth2color = SENSOR.depth2color.copy()
    depth2color[:3, 3] *= scale
    return replace(SENSOR, disparity=depth, depth2color=depth2color), depth


def test_a_usual_sensor_fits() -> None:
    assert find_misfit(SENSOR, 30.0, USUAL_DEPTH) == ""
    assert find_misfit(SENSOR, 30.0, None) == ""


@pytest.mark.parametrize(
    ("a", "b"),
    [(3.112, -0.0028525), (3.153, -0.002894), (3.155, -0.002878)],
    ids=["Herrera", "device", "board_1"],
)
def test_what_real_sensors_were_found_to_have_fits(a: float, b: float) -> None:
    assert find_misfit(SENSOR, 30.0, LinearInverseDisparity(a, b)) == ""


def test_a_square_of_another_side_is_told_with_its_likely_one() -> None:
    sensor, depth = as_fitted(30.0, 37.4)
    said = find_misfit(sensor, 30.0, depth)
    assert said == (
        "The result does not fit a Kinect v1: a of the depth is 3.905 (usual: 3.038 to 3.226), "
        "b of the depth is -0.00358 (usual: -0.00296 to -0.00279); the square of the board is more "
        "likely 37.4 mm than 30 mm, so measure it and give its true side."
    )


@pytest.mark.parametrize(
    ("given_mm", "fits"), [(30.8, True), (31.2, False), (29.2, True), (28.8, False)]
)
def test_three_per_cent_are_let_pass(given_mm: float, fits: bool) -> None:
    sensor, depth = as_fitted(given_mm, 30.0)
    assert (find_misfit(sensor, given_mm, depth) == "") is fits


def test_pictures_alone_tell_the_square_by_the_distance_of_the_cameras() -> None:
    sensor, _ = as_fitted(30.0, 39.0)
    assert "the distance between the cameras is 19.2 mm (usual: 20.0 to 28.0)" in find_misfit(
        sensor, 30.0, None
    )
    assert "more likely 39 mm than 30 mm" in find_misfit(sensor, 30.0, None)


def test_every_number_of_the_cameras_counts() -> None:
    turned = rigid(rotation_about(np.array([0.0, 1.0, 0.0]), 2.4), SENSOR.depth2color[:3, 3])
    wrong = {
        "the focal length of the depth camera is 610.8 px": replace(
            SENSOR, depth_camera=PinholeCamera(640, 480, 610.8, 587.6, 324.8, 225.3)
        ),
        "the focal length of the colour camera is 500.0 px": replace(
            SENSOR, color_camera=PinholeCamera(640, 480, 525.0, 500.0, 319.5, 239.5)
        ),
        "the angle between the cameras is 2.4°": replace(SENSOR, depth2color=turned),
    }
    for finding, sensor in wrong.items():
        said = find_misfit(sensor, 30.0, USUAL_DEPTH)
        assert finding in said
        assert "pictures of different positions" in said
        uncorrected = find_misfit(replace(sensor, correction=None), 30.0, USUAL_DEPTH)
        assert "the distortion of the depth was not corrected yet" in uncorrected


@pytest.mark.parametrize(
    ("camera", "kind", "finding"),
    [
        (PinholeCamera(640, 480, 525.0, 526.0, 319.5, 239.5), "color", ""),
        (PinholeCamera(640, 480, 525.0, 480.0, 319.5, 239.5), "color", "the focal length of the c"),
        (PinholeCamera(640, 480, 585.0, 585.0, 400.0, 239.5), "depth", "cx of the depth camera is"),
        (PinholeCamera(1280, 1024, 1050, 1050, 640, 100), "color", "cy of the colour camera is 10"),
    ],
)
def test_a_camera_alone(camera: PinholeCamera, kind: Kind, finding: str) -> None:
    said = find_camera_misfit(camera, kind)
    assert finding in said
    assert bool(said) is bool(finding)


def test_a_shift_that_fits_nothing() -> None:
    color = SENSOR.color_camera
    assert find_shift_misfit(color, 10.0) == ""
    assert "the largest offset that is left is 40.0 px" in find_shift_misfit(color, 40.0)
    assert "cx of the colour camera" in find_shift_misfit(replace(color, cx=900.0), 1.0)


WALLS_MM = np.array([500.0, 600.0, 700.0, 850.0, 1000.0])


@pytest.mark.parametrize("fit", [fit_linear_inverse, fit_tangent])
@pytest.mark.parametrize(
    ("given_mm", "finding", "advised"),
    [
        (WALLS_MM, "", False),
        (WALLS_MM - 12, "", False),
        (WALLS_MM * 0.95, "", True),
        (WALLS_MM * 1.1, "mm was given, so measure again from the front of the sensor", True),
        (WALLS_MM[::-1], "in another order than the captures", False),
        (WALLS_MM[[0, 2, 1, 3, 4]], "in another order than the captures", False),
        (np.add(WALLS_MM, [0, 0, 60, 0, 0]), "c is about 700 mm away, but 760 mm was given", False),
    ],
    ids=["true", "front", "Burrus", "behind", "reversed", "exchanged", "misread"],
)
def test_distances_of_walls(fit, given_mm: np.ndarray, finding: str, advised: bool) -> None:
    raw = USUAL_DEPTH.raw(WALLS_MM)
    measured = Distances("abcde", raw, given_mm)
    said = find_depth_misfit(fit(raw, given_mm).model, measured)
    assert finding in said
    assert bool(said) is bool(finding)
    assert bool(unusual_distances(measured)) is advised


def test_walls_of_one_distance_give_no_scale() -> None:
    with pytest.raises(CalibrationError, match="at the same distance"):
        fit_linear_inverse(np.array([650.0, 650.0]), np.array([600.0, 900.0]))


def test_a_depth_that_no_square_explains() -> None:
    odd = LinearInverseDisparity(USUAL_DEPTH.a * 1.05, USUAL_DEPTH.b)
    said = find_misfit(SENSOR, 30.0, odd)
    assert "a of the depth is 3.289" in said
    assert "square" not in said
