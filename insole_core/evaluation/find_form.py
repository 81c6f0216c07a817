"""Find a body of known form in a measured surface that also shows what holds it.

A pair of surface points with their normals determines a ball, or a cylinder (Schnabel, Wahl & Klein
2007); the one that most of the surface lies on is taken.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import numpy as np

from insole_core.compare.best_fit import best_fit
from insole_core.compare.seen_surface import SurfacePoints
from insole_core.errors import CalibrationError
from insole_core.evaluation.known_form import (
    Ball,
    Cylinder,
    KnownForm,
    Scan,
    ScannedBody,
    fitted,
)
from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.sampling import area_samples
from insole_core.geometry.transforms import inverse

_TRIES, _JUDGES = 1000, 500
_LEAST_POINTS = 300
_SIZES = (0.6, 1.6)
"""Sizes that are searched for, relative to the one said: other balls are found, but no plates."""
_NEAR_MM, _NEAR_COSINE = 2.5, 0.94
_LEAST_SINE = 0.1
_LEAST_SHARE = 0.12
"""Of the surface that must lie on the body: holder and plate are less than the rest."""
_BAND_MM, _AROUND_MM = 6.0, 20.0
_FACING = 0.5
_FORM_MEDIAN_MM = 1.5
_FIT_ROUNDS = 4
_SCAN_MEDIAN_MM, _SCAN_SHARE = 0.9, 0.3
_SAMPLE_MM2 = 25.0


def find_ball(surface: TriangleMesh, diameter_mm: float) -> Ball:
    """Find a ball of about a diameter; its own is fitted.

    Raises
    ------
    CalibrationError
        When there is none.
    """
    return _most_supported(surface, diameter_mm, _balls, "ball")


def find_cylinder(surface: TriangleMesh, diameter_mm: float) -> Cylinder:
    """Find a cylinder of about a diameter; its own is fitted.

    Raises
    ------
    CalibrationError
        When there is none.
    """
    return _most_supported(surface, diameter_mm, _cylinders, "cylinder")


def find_scan(surface: TriangleMesh, scan: Scan, name: str) -> ScannedBody:
    """Lay the scan of a body onto the surface that was measured of it.

    Parameters
    ----------
    surface : mm
    scan
    name
        Of the scan's file.

    Raises
    ------
    CalibrationError
        When it is the scan of another body, of the other side, or in another unit.
    """
    _check_points(surface)
    found = _laid(surface, scan)
    if found is not None and is_laid_on(found, surface):
        return found
    grown = None if found is None else _grown(found, surface)
    if found is not None and grown is not None and is_laid_on(grown, surface):
        raise CalibrationError(
            "{scan} is {size_mm:.0f} mm long, but would have to be {found_mm:.0f} mm long to fit "
            "what was captured; check its unit, and that it is of the same body.",
            scan=name,
            size_mm=found.size_mm,
            found_mm=grown.size_mm,
        )
    mirrored = _laid(surface, Scan(scan.mesh.mirrored()))
    if mirrored is not None and is_laid_on(mirrored, surface):
        raise CalibrationError(
            "{scan} fits what was captured only as its mirror image; name the scan of the same "
            "side, and check that neither is flipped.",
            scan=name,
        )
    raise CalibrationError(
        "{scan} does not fit what was captured, wherever it is laid; name the scan of the same "
        "body, and check its unit.",
        scan=name,
    )


def on_form(form: KnownForm, points: FloatArray, normals: FloatArray) -> BoolArray:
    """Return which oriented points (n, 3) belong to a form in its place, as far as it is near."""
    errors, outward = form.errors(points)
    facing = np.einsum("nc,nc->n", normals, outward) > _FACING
    return np.asarray((np.abs(errors) < _BAND_MM) & facing)


def is_laid_on(body: ScannedBody, surface: TriangleMesh) -> bool:
    """Return whether a body in its place lies on what was measured of it."""
    used = on_form(body, surface.vertices, surface.vertex_normals)
    errors = body.errors(surface.vertices[used])[0]
    area = surface.vertex_areas
    return bool(
        used.sum() >= _LEAST_POINTS
        and area[used].sum() > _SCAN_SHARE * area.sum()
        and np.median(np.abs(errors)) < _SCAN_MEDIAN_MM
    )


def _check_points(surface: TriangleMesh) -> None:
    count = int(np.count_nonzero(surface.vertex_areas))
    if count < _LEAST_POINTS:
        raise CalibrationError(
            "Only {count} points were measured in the volume of interest, too few to find the "
            "object; put it in the middle of the volume, where the sensors see it.",
            count=count,
        )


_Form = TypeVar("_Form", Ball, Cylinder)


def _most_supported(
    surface: TriangleMesh,
    diameter_mm: float,
    propose: Callable[[SurfacePoints, SurfacePoints], list[_Form]],
    what: str,
) -> _Form:
    """Return the form that most of a surface lies on, in its best place and of its best size."""
    _check_points(surface)
    areas = surface.vertex_areas
    whole = SurfacePoints(surface.vertices, surface.vertex_normals)
    rng = np.random.default_rng(1)
    share = areas / areas.sum()
    judges = _chosen(whole, rng.choice(len(areas), _JUDGES, p=share))
    first, second = rng.choice(len(areas), (2, _TRIES), p=share)
    forms = [
        form
        for form in propose(_chosen(whole, first), _chosen(whole, second))
        if _SIZES[0] < form.size_mm / diameter_mm < _SIZES[1]
    ]
    support = [_support(form, judges) for form in forms]
    if forms and max(support) >= _LEAST_SHARE:
        form = forms[int(np.argmax(support))]
        for _ in range(_FIT_ROUNDS):
            used = on_form(form, whole.points, whole.normals)
            form = fitted(form, whole.points[used], areas[used], size=True)
        if _is_form(form, whole):
            return form
    raise CalibrationError(
        "No {what} of about {diameter_mm:.0f} mm was found in the volume of interest; put it in "
        "the middle of the volume, and check what was said of it.",
        what=what,
        diameter_mm=diameter_mm,
    )


def _balls(first: SurfacePoints, second: SurfacePoints) -> list[Ball]:
    turned, apart = first.normals - second.normals, first.points - second.points
    with np.errstate(divide="ignore", invalid="ignore"):
        radius = (apart * turned).sum(1) / (turned**2).sum(1)
    centres = (first.points + second.points) / 2
    centres = centres - radius[:, None] * (first.normals + second.normals) / 2
    return [
        Ball(centre, 2 * size)
        for centre, size in zip(centres, radius, strict=True)
        if np.isfinite(size) and size > 0
    ]


def _cylinders(first: SurfacePoints, second: SurfacePoints) -> list[Cylinder]:
    axes = np.cross(first.normals, second.normals)
    length = np.linalg.norm(axes, axis=1)
    found = length > _LEAST_SINE
    axes = axes[found] / length[found, None]
    one, other = first.points[found], second.points[found]
    turned = (first.normals - second.normals)[found]
    radius = ((one - other) * turned).sum(1) / (turned**2).sum(1)
    middle = (one + other) / 2 - radius[:, None] * (first.normals + second.normals)[found] / 2
    return [
        Cylinder(centre, axis, 2 * size)
        for centre, axis, size in zip(middle, axes, radius, strict=True)
        if size > 0
    ]


def _chosen(surface: SurfacePoints, index: IntArray) -> SurfacePoints:
    return SurfacePoints(surface.points[index], surface.normals[index])


def _support(form: KnownForm, judges: SurfacePoints) -> float:
    """Return the share of points that lie on a form and face as it does."""
    errors, outward = form.errors(judges.points)
    cosine = np.einsum("nc,nc->n", judges.normals, outward)
    return float(np.mean((np.abs(errors) < _NEAR_MM) & (cosine > _NEAR_COSINE)))


def _is_form(form: KnownForm, whole: SurfacePoints) -> bool:
    """Return whether what lies around a form lies on it, as of another body it does not."""
    errors, outward = form.errors(whole.points)
    facing = np.einsum("nc,nc->n", whole.normals, outward) > _FACING
    around = facing & (np.abs(errors) < _AROUND_MM)
    return bool(around.any() and np.median(np.abs(errors[around])) < _FORM_MEDIAN_MM)


def _thin(mesh: TriangleMesh) -> SurfacePoints:
    points, triangle = area_samples(mesh, _SAMPLE_MM2)
    return SurfacePoints(points, mesh.triangle_normals[triangle])


def _laid(surface: TriangleMesh, scan: Scan) -> ScannedBody | None:
    """Lay a scan onto a surface, from any pose; None where they meet nowhere."""
    fit = best_fit(_thin(scan.mesh), _thin(surface), thorough=True)
    if fit is None:
        return None
    body = ScannedBody(scan, inverse(fit.b2a))
    for _ in range(_FIT_ROUNDS):
        used = on_form(body, surface.vertices, surface.vertex_normals)
        if used.sum() < _LEAST_POINTS:
            return None
        body = fitted(body, surface.vertices[used], surface.vertex_areas[used])
    return body


def _grown(body: ScannedBody, surface: TriangleMesh) -> ScannedBody:
    for _ in range(_FIT_ROUNDS):
        used = on_form(body, surface.vertices, surface.vertex_normals)
        if used.sum() < _LEAST_POINTS:
            break
        body = fitted(body, surface.vertices[used], surface.vertex_areas[used], size=True)
    return body
