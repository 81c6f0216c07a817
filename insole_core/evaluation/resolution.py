"""Spatial and depth resolution over distance, against theory (thesis 5.3, figures 13, 14)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.calibration.walls.captures import WallCapture
from insole_core.errors import CalibrationError
from insole_core.sensing.disparity import DisparityModel
from insole_core.sensing.pinhole_camera import PinholeCamera

_VIEW_DEG = (58.0, 45.0)
"""Field of view of the infrared camera used for (22) in the thesis."""
_WINDOW = (slice(200, 280), slice(270, 370))


@dataclass(frozen=True)
class Resolution:
    """Resolution at one distance, mm.

    Parameters
    ----------
    x_mm, y_mm
        Spacing of neighbouring pixels on the surface.
    theory_x_mm, theory_y_mm
        Thesis (22).
    depth_mm
        Mean difference of neighbouring depth values that occur on the surface.
    theory_depth_mm
        Depth of one raw unit by the disparity model.
    """

    distance_mm: float
    x_mm: float
    y_mm: float
    theory_x_mm: float
    theory_y_mm: float
    depth_mm: float
    theory_depth_mm: float


def evaluate_resolution(
    capture: WallCapture, camera: PinholeCamera, disparity: DisparityModel
) -> Resolution:
    """Measure the resolution in the centre of a capture of a flat surface.

    Parameters
    ----------
    camera
        The depth camera.
    disparity
        Converts raw numbers to depth.

    Raises
    ------
    CalibrationError
        If there is no reading in the centre.
    """
    window = np.full(capture.raw.shape, np.nan)
    window[_WINDOW] = capture.raw[_WINDOW]
    depth = disparity.depth_mm(window)
    known = np.isfinite(depth)
    if known.sum() < 100:
        raise CalibrationError(
            "{capture} has no reading in the middle; put a flat surface there.",
            capture=capture.name,
        )
    rays = camera.pixel_rays()
    points = rays * depth[..., None]
    # A single frame holds integer raw numbers; averaged frames are rounded to integers again.
    levels = disparity.depth_mm(np.unique(np.round(window[known])))
    distance = float(np.median(depth[known]))
    raw = disparity.raw(np.array([distance]))
    step = float((disparity.depth_mm(raw + 0.5) - disparity.depth_mm(raw - 0.5))[0])
    theory = [
        2 * distance * np.tan(np.radians(view / 2)) / size
        for view, size in zip(_VIEW_DEG, (camera.width, camera.height), strict=True)
    ]
    return Resolution(
        distance_mm=distance,
        x_mm=float(np.nanmedian(np.diff(points[..., 0], axis=1))),
        y_mm=float(np.nanmedian(np.diff(points[..., 1], axis=0))),
        theory_x_mm=float(theory[0]),
        theory_y_mm=float(theory[1]),
        depth_mm=float(np.diff(levels).mean()) if len(levels) > 1 else step,
        theory_depth_mm=step,
    )
