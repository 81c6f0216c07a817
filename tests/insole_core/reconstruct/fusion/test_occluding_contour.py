"""Where the outline of a foot lies in a picture, to a fraction of a pixel, however it is shaded."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
import pytest

from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.occluding_contour import find_occluding_contour
from insole_core.reconstruct.fusion.silhouette import Silhouette
from insole_core.sensing.sensor import nominal_kinect

MIDDLE, RADIUS_PX = np.array([640.3, 511.8]), 120.4
SKIN, BACKGROUND = np.array([200.0, 140.0, 115.0]), 28.0
FINER = 8


def shown(at_edge: float, over_px: float) -> DepthView:
    """A disc of skin that darkens to a share of its colour over the last pixels, blurred.

    As a round thing in the light does, it darkens the more, the nearer its edge is.
    """
    sensor = nominal_kinect("A1")
    camera = replace(sensor.color_camera, distortion=(0.0,) * 5)
    half = 160
    fine = (np.arange(2 * half * FINER) + 0.5) / FINER - 0.5 - half
    corner = np.rint(MIDDLE).astype(int)
    across, down = np.meshgrid(fine + corner[0] - MIDDLE[0], fine + corner[1] - MIDDLE[1])
    depth = RADIUS_PX - np.hypot(across, down)
    bright = np.sqrt(np.clip(depth / over_px, 0.0, 1.0))
    share = (at_edge + (1 - at_edge) * bright) * (depth > 0)
    share = cv2.GaussianBlur(share, (0, 0), 0.7 * FINER)
    share = share.reshape(2 * half, FINER, 2 * half, FINER).mean(axis=(1, 3))[..., None]
    picture = np.full((camera.height, camera.width, 3), BACKGROUND)
    part = picture[corner[1] - half : corner[1] + half, corner[0] - half : corner[0] + half]
    part += share * (SKIN - BACKGROUND)
    return DepthView(
        "left",
        replace(sensor, color_camera=camera),
        np.eye(4),
        (0, 0),
        np.full((4, 4), np.nan),
        np.rint(picture).astype(np.uint8),
    )


@pytest.mark.parametrize("traced_px", [-1.5, 0.0, 1.0])
@pytest.mark.parametrize(
    ("at_edge", "over_px"), [(1.0, 1.0), (0.7, 5.0), (0.35, 5.0), (0.15, 8.0), (0.5, 40.0)]
)
def test_shade_does_not_move_the_outline(at_edge: float, over_px: float, traced_px: float) -> None:
    """Nor does it matter how well the outline was known before to a pixel or two."""
    view = shown(at_edge, over_px)
    camera = view.sensor.color_camera
    across, down = np.meshgrid(
        np.arange(camera.width) - MIDDLE[0], np.arange(camera.height) - MIDDLE[1]
    )
    outside = (np.hypot(across, down) - RADIUS_PX - traced_px).astype(np.float32)
    contour = find_occluding_contour(view, Silhouette((0, 0), outside, outside > 3))

    assert contour is not None
    away_px = np.hypot(*(contour.pixels - MIDDLE).T) - RADIUS_PX
    assert len(away_px) > 600
    assert np.median(away_px) == pytest.approx(0.1, abs=0.15)
    assert np.abs(away_px).max() < 0.5


def test_noise_of_a_dark_background_is_not_taken_for_an_edge() -> None:
    view = shown(0.1, 8.0)
    camera = view.sensor.color_camera
    noise = np.random.default_rng(1).normal(0, 5, view.color.shape)
    noisy = replace(view, color=np.clip(view.color + noise, 0, 255).astype(np.uint8))
    across, down = np.meshgrid(
        np.arange(camera.width) - MIDDLE[0], np.arange(camera.height) - MIDDLE[1]
    )
    outside = (np.hypot(across, down) - RADIUS_PX).astype(np.float32)
    contour = find_occluding_contour(noisy, Silhouette((0, 0), outside, outside > 3))

    assert contour is not None
    away_px = np.hypot(*(contour.pixels - MIDDLE).T) - RADIUS_PX
    assert len(away_px) > 670, "none is left out"
    assert np.quantile(away_px, [0.01, 0.99]) == pytest.approx([0.0, 0.0], abs=0.6)
