"""The pair of infrared pictures of a stereo camera, matched anew on the surface."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
import pytest

from insole_core.errors import InputError
from insole_core.geometry.arrays import RawArray
from insole_core.reconstruct.views.infrared_pictures import infrared_view
from insole_core.recording.session import InfraredPictures, View
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.metric_depth import StereoDisparity, binned_camera, finer_camera
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor

WIDTH, HEIGHT = 320, 80
CAMERA = PinholeCamera(WIDTH, HEIGHT, 920.0, 920.0, 160.0, 40.0)
DISPARITY_PX = 97.3
"""At 520 mm."""


def pictures(image: RawArray) -> InfraredPictures:
    return InfraredPictures(2, lambda _: image, 8)


def view(left: RawArray, right: RawArray, correction: DisparityCorrection | None = None) -> View:
    """Return a view as it is measured: its readings are squares of two by two pixels."""
    lattice = Sensor(
        model="realsense-d415", serial="D1", depth_camera=binned_camera(CAMERA, 2),
        color_camera=CAMERA, depth2color=np.eye(4), disparity=StereoDisparity(920.0, 55.0),
        correction=correction, depth_unit_mm=0.1, baseline_mm=55.0,
    )  # fmt: skip
    pair = {"infrared_left": pictures(left), "infrared_right": pictures(right)}

    def unread(_index: int) -> RawArray:
        raise AssertionError("only the infrared pictures are read")

    return View("left", lattice, 1, 1, unread, unread, pair)


@pytest.fixture(scope="module")
def pair() -> tuple[RawArray, RawArray]:
    """Pictures of dots, those of the left one farther to the right by the disparity."""
    noise = np.random.default_rng(1).random((HEIGHT, WIDTH + 200)).astype(np.float32)
    dots = 100 + 500 * (cv2.GaussianBlur(noise, (0, 0), 1.5) - 0.5)
    move = np.array([[1, 0, DISPARITY_PX], [0, 1, 0]])
    moved = cv2.warpAffine(dots, move, (WIDTH + 200, HEIGHT), flags=cv2.INTER_CUBIC)
    left, right = (image[:, 100:-100].clip(0, 255).astype(np.uint16) for image in (moved, dots))
    return left, right


@pytest.mark.parametrize("error_px", [0.0, 0.4])
def test_the_right_picture_is_what_the_left_one_shows_at_the_disparity(
    pair: tuple[RawArray, RawArray], error_px: float
) -> None:
    """What the walls have shown of the camera is in its pictures too."""
    lattice = np.full((HEIGHT // 2, WIDTH // 2), -8 * error_px, np.float32)
    correction = DisparityCorrection(lattice) if error_px else None
    seen = infrared_view(view(*pair, correction))
    assert seen is not None
    assert (seen.finer, seen.picture.shape) == (2, (HEIGHT, WIDTH))
    likeness = {}
    for off_px in (-0.3, 0.0, 0.3):
        raw = np.full((HEIGHT, WIDTH), 2047 - 8 * (DISPARITY_PX - error_px + off_px))
        shown, _ = seen.reference.shown(seen.reference.distorted(raw))
        part = np.s_[:, 120:-20]
        likeness[off_px] = np.corrcoef(shown[part].ravel(), seen.picture[part].ravel())[0, 1]
    assert likeness[0.0] > 0.95
    assert max(likeness, key=lambda off_px: likeness[off_px]) == 0.0


def test_black_or_saturated_pictures_are_told(pair: tuple[RawArray, RawArray]) -> None:
    left, right = pair
    with pytest.raises(InputError, match="the infrared pictures are black"):
        infrared_view(view(left, np.zeros_like(right)))
    with pytest.raises(InputError, match="the infrared pictures are saturated"):
        infrared_view(view(np.full_like(left, 255), right))


def test_one_picture_is_no_pair(pair: tuple[RawArray, RawArray]) -> None:
    seen = view(*pair)
    alone = {"infrared_left": seen.infrared["infrared_left"]}
    assert infrared_view(replace(seen, infrared=alone)) is None


def test_pixels_lie_in_the_squares_of_their_readings() -> None:
    assert finer_camera(binned_camera(CAMERA, 2), 2) == CAMERA
