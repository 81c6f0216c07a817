"""Error of a flat wall over distance, corrected or not, with pictures (thesis 5.2, figure 11)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Protocol

import numpy as np
from matplotlib.figure import Figure

from insole_core.calibration.walls.captures import WallCapture, check_same_device
from insole_core.calibration.walls.distortion import correction_of_walls
from insole_core.calibration.walls.thesis_maps import cubic_map, mean_map
from insole_core.calibration.walls.wall_plane import fit_wall, plane_rows
from insole_core.errors import CalibrationError
from insole_core.evaluation.report import Plot
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.progress import SILENT, Progress
from insole_core.sensing.disparity import DisparityModel
from insole_core.sensing.pinhole_camera import PinholeCamera

_FAR_OFF_MM = 30.0
_ROUNDS = 4
_COARSE_STEP = 4
_LEAST_POINTS = 100
_CENTRE = (slice(238, 243), slice(318, 323))
_SHOWN = 3
_LEAST_WALLS = 5
"""Algorithm 2 fits a cubic, which takes four other walls."""


class Correction(Protocol):
    """A correction that converts raw numbers to depths."""

    def depth_mm(self, raw: FloatArray, disparity: DisparityModel) -> FloatArray:
        """Return the corrected depth (480, 640), mm, of a raw image of that shape."""
        ...


@dataclass(frozen=True)
class NoCorrection:
    """The uncorrected sensor."""

    def depth_mm(self, raw: FloatArray, disparity: DisparityModel) -> FloatArray:
        """Return the depth (480, 640), mm, by the disparity model alone."""
        return disparity.depth_mm(raw)


@dataclass(frozen=True)
class WallError:
    """Deviation of one corrected capture of a wall from flat, mm.

    Parameters
    ----------
    distance_mm
        Depth of the fitted plane at the image centre.
    mean_abs_mm
        Thesis (19) over the valid pixels, against the fitted plane.
    mean_abs_raw
        Thesis (18), raw units.
    perpendicular_mean_abs_mm
        Thesis (19) as printed: against the distance at the image centre, which holds for a
        perpendicular wall only.
    pixels
        Number of valid pixels.
    """

    distance_mm: float
    mean_abs_mm: float
    rms_mm: float
    p95_mm: float
    mean_abs_raw: float
    perpendicular_mean_abs_mm: float
    pixels: int


def wall_error(
    capture: WallCapture, correction: Correction, camera: PinholeCamera, disparity: DisparityModel
) -> WallError:
    """Measure a corrected capture against its best-fitting plane.

    Parameters
    ----------
    camera
        The depth camera.
    disparity
        Converts raw numbers to depth.

    Raises
    ------
    CalibrationError
        If too few pixels remain.
    """
    depth = correction.depth_mm(capture.raw, disparity)
    rows = plane_rows(camera)
    plane_depth, valid = _fitted_depth(depth, rows, capture.name)
    error = (depth - plane_depth)[valid]
    raw_error = (disparity.raw(depth) - disparity.raw(plane_depth))[valid]
    centre = np.nanmean(depth[_CENTRE]) if np.isfinite(depth[_CENTRE]).any() else np.nan
    return WallError(
        distance_mm=float(plane_depth[240, 320]),
        mean_abs_mm=float(np.abs(error).mean()),
        rms_mm=float(np.sqrt((error**2).mean())),
        p95_mm=float(np.percentile(np.abs(error), 95)),
        mean_abs_raw=float(np.abs(raw_error).mean()),
        perpendicular_mean_abs_mm=float(np.abs(depth[valid] - centre).mean()),
        pixels=int(valid.sum()),
    )


def wall_deviation_mm(
    capture: WallCapture, correction: Correction, camera: PinholeCamera, disparity: DisparityModel
) -> FloatArray:
    """Compute how far each pixel lies behind the best-fitting plane of a capture (figure 10).

    Parameters
    ----------
    camera
        The depth camera.
    disparity
        Converts raw numbers to depth.

    Returns
    -------
    (480, 640) float64, mm
        NaN off the wall.

    Raises
    ------
    CalibrationError
        If too few pixels remain.
    """
    depth = correction.depth_mm(capture.raw, disparity)
    plane_depth, valid = _fitted_depth(depth, plane_rows(camera), capture.name)
    return np.where(valid, depth - plane_depth, np.nan)


def wall_errors(
    captures: Iterable[WallCapture],
    corrections: Mapping[str, Correction],
    camera: PinholeCamera,
    disparity: DisparityModel,
) -> dict[str, list[WallError]]:
    """Measure every capture with every correction: the curves of figure 11.

    Parameters
    ----------
    corrections
        By name.
    camera
        The depth camera.
    disparity
        Converts raw numbers to depth.

    Returns
    -------
    dict
        The errors in the order of `captures`, by the name of the correction.

    Raises
    ------
    CalibrationError
        If too few pixels of a capture remain.
    """
    listed = list(captures)
    return {
        name: [wall_error(capture, correction, camera, disparity) for capture in listed]
        for name, correction in corrections.items()
    }


def _fitted_depth(depth: FloatArray, rows: FloatArray, name: str) -> tuple[FloatArray, BoolArray]:
    """Return the depth of the total least squares plane at every pixel, and the pixels on it."""
    points = rows * depth[..., None]
    # Every fourth pixel suffices to find those on the wall; the plane is then fitted to all.
    coarse = points[::_COARSE_STEP, ::_COARSE_STEP]
    near = np.isfinite(coarse[..., 2])
    for _ in range(_ROUNDS):
        centre, normal = _plane(coarse[near], name, _LEAST_POINTS // _COARSE_STEP**2)
        near = np.abs((coarse - centre) @ normal) < _FAR_OFF_MM
    centre, normal = _plane(points[np.abs((points - centre) @ normal) < _FAR_OFF_MM], name)
    valid = np.abs((points - centre) @ normal) < _FAR_OFF_MM
    return np.asarray((centre @ normal) / (rows @ normal)), valid


def _plane(
    points: FloatArray, name: str, least: int = _LEAST_POINTS
) -> tuple[FloatArray, FloatArray]:
    """Return centre and normal of the plane through points (n, 3), at least `least` of them."""
    if len(points) < least:
        raise CalibrationError(
            "{name} has no flat surface left to evaluate; capture a flat wall.", name=name
        )
    centre = points.mean(0)
    apart = points - centre
    return centre, np.linalg.eigh(apart.T @ apart)[1][:, 0]


def wall_pictures(
    captures: Sequence[WallCapture],
    corrections: Mapping[str, Correction],
    camera: PinholeCamera,
    disparity: DisparityModel,
) -> tuple[Plot, ...]:
    """Plot the first, the middle and the last capture, each with every correction.

    A wall is shown by its distance from its best-fitting plane; the scale is the same in all
    pictures of a capture, and white is flat.

    Parameters
    ----------
    captures
        Of walls.
    corrections
        By name, which is the title of a picture.
    camera
        The depth camera.
    disparity
        Converts raw numbers to depth.
    """

    def draw(figure: Figure, capture: WallCapture) -> None:
        images = {
            name: wall_deviation_mm(capture, correction, camera, disparity)
            for name, correction in corrections.items()
        }
        _draw(figure, images)

    chosen = np.unique(np.linspace(0, len(captures) - 1, _SHOWN).round().astype(int)).tolist()
    return tuple(
        # Fitted only once a file shows it: most reports are numbers alone.
        Plot(f"{capture.name}: distance from a flat wall, mm", partial(draw, capture=capture))
        for capture in (captures[i] for i in chosen)
    )


def _draw(figure: Figure, images: Mapping[str, FloatArray]) -> None:
    limit = max(float(np.nanpercentile(np.abs(image), 98)) for image in images.values())
    panels = np.atleast_1d(figure.subplots(1, len(images), sharey=True))
    for axes, (name, image) in zip(panels, images.items(), strict=True):
        shown = axes.imshow(image, vmin=-limit, vmax=limit, cmap="RdBu_r")
        axes.set_title(name)
    figure.colorbar(shown, ax=list(panels), shrink=0.7)


def leave_one_out(
    captures: Sequence[WallCapture],
    camera: PinholeCamera,
    disparity: DisparityModel,
    progress: Progress = SILENT,
) -> dict[str, list[WallError]]:
    """Correct every capture by a fit to all the others, and measure the remaining error.

    Parameters
    ----------
    captures
        Of one device.
    camera
        The depth camera.
    disparity
        Converts raw numbers to depth.

    Returns
    -------
    dict
        The errors in the order of `captures`, by correction: raw, the two algorithms of the
        thesis (given the fitted plane, because walls need not be perpendicular), the default.

    Raises
    ------
    CalibrationError
        If there are fewer than five captures.
    """
    if len(captures) < _LEAST_WALLS:
        raise CalibrationError(
            "Leaving one wall out needs captures at {least} distances or more, but there are "
            "{count}; capture more.",
            least=_LEAST_WALLS,
            count=len(captures),
        )
    check_same_device(captures)
    rows = plane_rows(camera)
    walls = [fit_wall(capture, rows, disparity) for capture in captures]
    errors: dict[str, list[WallError]] = {}
    for i, capture in enumerate(captures):
        progress.step(i / len(captures), "Calibrating without {capture}", capture=capture.name)
        others = [*walls[:i], *walls[i + 1 :]]
        corrections: dict[str, Correction] = {
            "raw": NoCorrection(),
            "algorithm 1": mean_map(others),
            "algorithm 2": cubic_map(others, disparity),
            "default": correction_of_walls(others, camera),
        }
        for name, correction in corrections.items():
            error = wall_error(capture, correction, camera, disparity)
            errors.setdefault(name, []).append(error)
    return errors
