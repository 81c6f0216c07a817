"""Acceptance with an artefact in the manner of VDI/VDE 2634: spheres and a plane.

It follows the guideline's quantities (probing error, sphere spacing, flatness) but is no certified
test. As a range grows with the number of points, the 95 % value is given beside each.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from insole_core.errors import InputError
from insole_core.geometry.arrays import FloatArray

_DROPPED = 0.003
"""Share of the points that the guideline allows to discard."""
_ROUNDS = 30
_LEAST_POINTS = 50


@dataclass(frozen=True, eq=False)
class SphereFit:
    """A sphere of free radius fitted to measured points, mm.

    Parameters
    ----------
    center_mm : (3,) float64, frame of the points
    form_mm
        Probing error, form: range of the radial residuals without three per mille of them.
    form_95_mm
        The range that holds 95 % of them.
    """

    center_mm: FloatArray
    radius_mm: float
    form_mm: float
    form_95_mm: float

    def size_error_mm(self, true_diameter_mm: float) -> float:
        """Return the probing error, size: measured minus true diameter."""
        return 2 * self.radius_mm - true_diameter_mm


@dataclass(frozen=True)
class PlaneFit:
    """Flatness: range of the distances from the best-fitting plane, mm."""

    form_mm: float
    form_95_mm: float
    rms_mm: float


@dataclass(frozen=True)
class ArtefactEvaluation:
    """The worst values over all positions, mm."""

    probing_form_mm: float
    probing_form_95_mm: float
    probing_size_mm: float
    spacing_mm: float
    flatness_mm: float
    flatness_95_mm: float


def fit_sphere(points: FloatArray) -> SphereFit:
    """Fit centre and radius by least squares of the radial residuals.

    Parameters
    ----------
    points : (n, 3) float64, mm

    Raises
    ------
    InputError
        If there are fewer than 50 points, or they lie on no sphere.
    """
    _check(points, "sphere")
    # Start from the algebraic sphere, which is linear in the centre and r² - |c|².
    columns = np.column_stack([2 * points, np.ones(len(points))])
    solved = np.linalg.lstsq(columns, (points**2).sum(1), rcond=None)[0]
    center, radius = solved[:3], np.sqrt(max(solved[3] + solved[:3] @ solved[:3], 1e-12))
    for _ in range(_ROUNDS):
        away = points - center
        distance = np.linalg.norm(away, axis=1)
        jacobian = np.column_stack([-away / distance[:, None], -np.ones(len(points))])
        step = np.linalg.lstsq(jacobian, radius - distance, rcond=None)[0]
        center, radius = center + step[:3], radius + step[3]
    off = np.linalg.norm(points - center, axis=1) - radius
    if not (np.isfinite(radius) and radius < 1e4):
        raise InputError("The points of a sphere lie on no sphere; select the sphere alone.")
    return SphereFit(center, float(radius), _range(off, _DROPPED), _range(off, 0.05))


def fit_plane(points: FloatArray) -> PlaneFit:
    """Fit a plane by total least squares to points (n, 3), mm.

    Raises
    ------
    InputError
        If there are fewer than 50 points.
    """
    _check(points, "plane")
    centred = points - points.mean(0)
    off = centred @ np.linalg.eigh(centred.T @ centred)[1][:, 0]
    return PlaneFit(_range(off, _DROPPED), _range(off, 0.05), float(np.sqrt((off**2).mean())))


def evaluate_artefact(
    sphere_pairs: Sequence[tuple[FloatArray, FloatArray]],
    planes: Sequence[FloatArray],
    true_diameter_mm: float,
    true_spacing_mm: float,
) -> ArtefactEvaluation:
    """Evaluate a two-sphere bar at several positions and a plate at several positions.

    Parameters
    ----------
    sphere_pairs
        For each position of the bar the points (n, 3), mm, of its two spheres.
    planes
        For each position of the plate its points (n, 3), mm.
    true_diameter_mm, true_spacing_mm
        Calibrated values of the bar.

    Raises
    ------
    InputError
        If there is no position of the bar or of the plate.
    """
    if not sphere_pairs or not planes:
        raise InputError("Measure the bar and the plate at one position at least.")
    pairs = [(fit_sphere(a), fit_sphere(b)) for a, b in sphere_pairs]
    spheres = [sphere for pair in pairs for sphere in pair]
    plates = [fit_plane(points) for points in planes]
    spacings = [
        float(np.linalg.norm(a.center_mm - b.center_mm)) - true_spacing_mm for a, b in pairs
    ]
    return ArtefactEvaluation(
        probing_form_mm=max(sphere.form_mm for sphere in spheres),
        probing_form_95_mm=max(sphere.form_95_mm for sphere in spheres),
        probing_size_mm=max((s.size_error_mm(true_diameter_mm) for s in spheres), key=abs),
        spacing_mm=max(spacings, key=abs),
        flatness_mm=max(plate.form_mm for plate in plates),
        flatness_95_mm=max(plate.form_95_mm for plate in plates),
    )


def _range(values: FloatArray, dropped: float) -> float:
    low, high = np.quantile(values, [dropped / 2, 1 - dropped / 2])
    return float(high - low)


def _check(points: FloatArray, what: str) -> None:
    if len(points) < _LEAST_POINTS or not np.isfinite(points).all():
        raise InputError(
            "A {part} has only {count} usable points, but {least} are needed; move the sensor "
            "nearer and measure again.",
            part=what,
            count=len(points),
            least=_LEAST_POINTS,
        )
