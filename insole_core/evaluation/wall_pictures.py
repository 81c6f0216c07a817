"""Depth maps of walls before and after correction (thesis figures 10 and 12)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from matplotlib.figure import Figure

from insole_core.calibration.walls.captures import WallCapture
from insole_core.evaluation.report import Plot
from insole_core.evaluation.wall import Correction, wall_deviation_mm
from insole_core.geometry.arrays import FloatArray
from insole_core.sensing.disparity import DisparityModel
from insole_core.sensing.pinhole_camera import PinholeCamera

_SHOWN = 3


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
    corrections
        By name, which is the title of a picture.
    camera
        The depth camera.
    disparity
        Converts raw numbers to depth.

    Raises
    ------
    CalibrationError
        If a capture shows no wall.
    """
    chosen = np.unique(np.linspace(0, len(captures) - 1, _SHOWN).round().astype(int)).tolist()
    plots = []
    for capture in (captures[i] for i in chosen):
        images = {
            name: wall_deviation_mm(capture, correction, camera, disparity)
            for name, correction in corrections.items()
        }
        title = f"{capture.name}: distance from a flat wall, mm"
        plots.append(Plot(title, partial(_draw, images=images)))
    return tuple(plots)


def _draw(figure: Figure, images: Mapping[str, FloatArray]) -> None:
    limit = max(float(np.nanpercentile(np.abs(image), 98)) for image in images.values())
    panels = np.atleast_1d(figure.subplots(1, len(images), sharey=True))
    for axes, (name, image) in zip(panels, images.items(), strict=True):
        shown = axes.imshow(image, vmin=-limit, vmax=limit, cmap="RdBu_r")
        axes.set_title(name)
    figure.colorbar(shown, ax=list(panels), shrink=0.7)
