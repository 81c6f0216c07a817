"""Comparison of two surfaces: align one with the other, then measure how far they differ."""

from __future__ import annotations

from typing import Literal, TypeAlias

import numpy as np

from insole_core.compare.best_fit import Fit, badness, best_fit
from insole_core.compare.difference import Difference, measure_difference
from insole_core.compare.picked_points import find_dots, fit_dots, fit_points
from insole_core.compare.seen_surface import SeenMesh, facing
from insole_core.errors import InputError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.progress import SILENT, Progress

PickedPoints: TypeAlias = tuple[FloatArray, FloatArray]
Alignment: TypeAlias = Literal["best", "none", "dots"] | PickedPoints

_FIXED_PITCH_MM, _MOVED_PITCH_MM = 1.0, 2.0
_GOOD_SHARE = 0.75


def compare_surfaces(
    a: TriangleMesh,
    b: TriangleMesh,
    alignment: Alignment = "best",
    *,
    median_pixels: int = 1,
    progress: Progress = SILENT,
) -> Difference:
    """Measure the difference of two surfaces, a minus b, in the frame of a.

    Parameters
    ----------
    a, b : mm
        Each in its own frame.
    alignment
        "best" fits b to a; "none" takes both as they lie; "dots" uses four black dots found on
        both; or points picked on a and on b.
    median_pixels
        Kernel of the spatial median filter; 1 for none, 6 as in thesis 8.3.

    Returns
    -------
    Difference
        In the frame of a, mm.

    Raises
    ------
    InputError
        If the two do not overlap or cannot be aligned.
    """
    progress.step(0.0, "Looking at both surfaces")
    seen_a, seen_b = SeenMesh(a), SeenMesh(b)
    fit, looks_b = _aligned(seen_a, seen_b, alignment, progress.part(0.1, 0.8))
    progress.step(0.8, "Measuring the difference")
    return measure_difference(seen_a, seen_b, fit, looks_b, median_pixels=median_pixels)


def _aligned(
    a: SeenMesh, b: SeenMesh, alignment: Alignment, progress: Progress
) -> tuple[Fit, FloatArray]:
    """Return the fit of b to a, and the viewing direction of b's seen side, in b's frame."""
    if alignment == "best":
        return _best(a, b, progress)
    if alignment == "none":
        return Fit(np.eye(4), float("nan"), 1.0), facing(b.mesh)
    if alignment == "dots":
        return fit_dots(
            find_dots(a.mesh, "the first surface"), find_dots(b.mesh, "the second surface")
        ), facing(b.mesh)
    return fit_points(*alignment), facing(b.mesh)


def _best(a: SeenMesh, b: SeenMesh, progress: Progress) -> tuple[Fit, FloatArray]:
    """Fit the seen sides; if they meet poorly, try b from all sides: its frame may be foreign."""
    target = a.points(facing(a.mesh), _FIXED_PITCH_MM)
    fits: list[tuple[Fit, FloatArray]] = []
    for number, looks in enumerate([facing(b.mesh), *np.eye(3), *-np.eye(3)]):
        part = progress.part(number / 7, (number + 1) / 7)
        fit = best_fit(target, b.points(looks, _MOVED_PITCH_MM), part)
        if fit is not None:
            fits.append((fit, looks))
        if number == 0 and fit is not None and fit.share >= _GOOD_SHARE:
            break
    if not fits:
        raise InputError(
            "The two surfaces do not overlap in any pose, so they cannot be compared;"
            " check that both show the same side of the same foot."
        )
    return min(fits, key=lambda found: badness(found[0]))
