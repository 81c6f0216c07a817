"""Surfaces of known form that can be placed: balls, cylinders, and scans of rigid bodies."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol, Self, TypeVar

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.sampling import area_samples, boundary_points
from insole_core.geometry.transforms import inverse, rigid, transform

_SAMPLES = 3000
_SCAN_SAMPLE_MM2 = 1.0
_BESIDE_EDGE_MM = 2.0
_ROUNDS = 20
_FITTED = 5000
"""Points that are enough for a fit: errors of neighbours are alike."""
_SETTLED_MM = 1e-5


class KnownForm(Protocol):
    """A surface of known form in some place."""

    @property
    def size_mm(self) -> float:
        """Diameter; of a scan its longest extent."""
        ...

    @property
    def centre_mm(self) -> FloatArray:
        """(3,) middle of the surface, or a point of its axis."""
        ...

    def errors(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Measure how far outside the surface points lie.

        Parameters
        ----------
        points : (n, 3) float64, mm

        Returns
        -------
        errors : (n,) float64, mm
            Negative inside; NaN beside an open edge.
        normals : (n, 3) float64
            Outward unit normals at the nearest places of the surface.
        """
        ...

    def moved(self, motion: FloatArray) -> Self:
        """Return the form after a rigid motion (4, 4), mm."""
        ...

    def of_size(self, size_mm: float) -> Self:
        """Return the form in the same place with another size."""
        ...

    def samples(self, seen: FloatArray) -> FloatArray:
        """Spread points evenly over the surface, as far along an axis as was seen.

        Parameters
        ----------
        seen : (n, 3) float64, mm
            Points that were measured on it.

        Returns
        -------
        (m, 3) float64, mm
        """
        ...


_Form = TypeVar("_Form", bound=KnownForm)


@dataclass(frozen=True, eq=False)
class Ball:
    """A sphere.

    Parameters
    ----------
    centre_mm : (3,) float64, mm
    size_mm
        Diameter.
    """

    centre_mm: FloatArray
    size_mm: float

    def errors(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """See `KnownForm`."""
        away = points - self.centre_mm
        distance = np.linalg.norm(away, axis=-1)
        return distance - self.size_mm / 2, away / np.maximum(distance, 1e-9)[..., None]

    def moved(self, motion: FloatArray) -> Ball:
        """See `KnownForm`."""
        return replace(self, centre_mm=transform(motion, self.centre_mm))

    def of_size(self, size_mm: float) -> Ball:
        """See `KnownForm`."""
        return replace(self, size_mm=size_mm)

    def samples(self, seen: FloatArray) -> FloatArray:
        """See `KnownForm`; a spiral (Vogel 1979) spreads them evenly."""
        number = np.arange(_SAMPLES) + 0.5
        height = 1 - 2 * number / _SAMPLES
        turn = np.pi * (1 + 5**0.5) * number
        ring = np.sqrt(1 - height**2)
        unit = np.stack([ring * np.cos(turn), ring * np.sin(turn), height], axis=1)
        return np.asarray(self.centre_mm + self.size_mm / 2 * unit)


@dataclass(frozen=True, eq=False)
class Cylinder:
    """The lateral surface of a cylinder, without end.

    Parameters
    ----------
    centre_mm : (3,) float64, mm
        On the axis.
    axis : (3,) float64
        Unit vector.
    size_mm
        Diameter.
    """

    centre_mm: FloatArray
    axis: FloatArray
    size_mm: float

    def errors(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """See `KnownForm`."""
        away = points - self.centre_mm
        away = away - (away @ self.axis)[..., None] * self.axis
        distance = np.linalg.norm(away, axis=-1)
        return distance - self.size_mm / 2, away / np.maximum(distance, 1e-9)[..., None]

    def moved(self, motion: FloatArray) -> Cylinder:
        """See `KnownForm`."""
        centre = transform(motion, self.centre_mm)
        return replace(self, centre_mm=centre, axis=motion[:3, :3] @ self.axis)

    def of_size(self, size_mm: float) -> Cylinder:
        """See `KnownForm`."""
        return replace(self, size_mm=size_mm)

    def samples(self, seen: FloatArray) -> FloatArray:
        """See `KnownForm`; it ends where one in a hundred points lies farther out."""
        low, high = np.quantile((seen - self.centre_mm) @ self.axis, (0.01, 0.99))
        side = np.linalg.svd(self.axis[None])[2][1:]
        number = np.arange(_SAMPLES) + 0.5
        turn = np.pi * (1 + 5**0.5) * number
        around = np.cos(turn)[:, None] * side[0] + np.sin(turn)[:, None] * side[1]
        along = low + (high - low) * number / _SAMPLES
        return np.asarray(self.centre_mm + self.size_mm / 2 * around + along[:, None] * self.axis)


@dataclass(frozen=True, eq=False)
class Scan:
    """What another scanner measured of a rigid body, prepared for many questions.

    Parameters
    ----------
    mesh : mm
        In its own frame.
    judged : (m,) bool, optional
        The triangles whose errors count; by default all.
    """

    mesh: TriangleMesh
    judged: BoolArray | None = None

    @property
    def samples(self) -> tuple[FloatArray, FloatArray]:
        """(n, 3) points spread evenly and densely over it, and their unit normals."""
        points, triangle = self._sampled
        return points, self.mesh.triangle_normals[triangle]

    def is_judged(self, points: FloatArray) -> BoolArray:
        """Return whether errors count where points (n, 3), mm, lie."""
        if self.judged is None:
            return np.ones(len(points), dtype=bool)
        return np.asarray(self.judged[self._sampled[1][self._tree.query(points)[1]]])

    @cached_property
    def _sampled(self) -> tuple[FloatArray, IntArray]:
        return area_samples(self.mesh, _SCAN_SAMPLE_MM2)

    @cached_property
    def middle_mm(self) -> FloatArray:
        """(3,) middle of its bounds."""
        return np.asarray(self.mesh.bounds_mm.mean(axis=0))

    @cached_property
    def extent_mm(self) -> float:
        """Its longest extent."""
        points = self.mesh.vertices - self.middle_mm
        axes = np.linalg.eigh(points.T @ points)[1]
        return float(np.ptp(points @ axes[:, -1]))

    @cached_property
    def _tree(self) -> scipy.spatial.cKDTree:
        return scipy.spatial.cKDTree(self.samples[0])

    @cached_property
    def _is_at_edge(self) -> BoolArray:
        """(n,) which samples lie beside an open edge."""
        edge = boundary_points(self.mesh, _BESIDE_EDGE_MM / 2)
        points = self.samples[0]
        if not len(edge):
            return np.zeros(len(points), dtype=bool)
        return np.asarray(scipy.spatial.cKDTree(edge).query(points)[0] < _BESIDE_EDGE_MM)

    def errors(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """See `KnownForm`; the surface is flat around each of its samples."""
        places, normals = self.samples
        nearest = self._tree.query(points)[1]
        errors = np.einsum("nc,nc->n", points - places[nearest], normals[nearest])
        return np.where(self._is_at_edge[nearest], np.nan, errors), normals[nearest]


@dataclass(frozen=True, eq=False)
class ScannedBody:
    """A rigid body that another scanner has measured, in some place.

    Parameters
    ----------
    scan
    scan2place : (4, 4) float64, mm
        Rigid.
    scale
        By which the scan is enlarged, about its middle.
    """

    scan: Scan
    scan2place: FloatArray
    scale: float = 1.0

    @property
    def size_mm(self) -> float:
        """See `KnownForm`."""
        return self.scale * self.scan.extent_mm

    @property
    def centre_mm(self) -> FloatArray:
        """See `KnownForm`."""
        return transform(self.scan2place, self.scan.middle_mm)

    def errors(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """See `KnownForm`."""
        middle = self.scan.middle_mm
        own = (transform(inverse(self.scan2place), points) - middle) / self.scale + middle
        errors, normals = self.scan.errors(own)
        return self.scale * errors, normals @ self.scan2place[:3, :3].T

    def moved(self, motion: FloatArray) -> ScannedBody:
        """See `KnownForm`."""
        return replace(self, scan2place=motion @ self.scan2place)

    def of_size(self, size_mm: float) -> ScannedBody:
        """See `KnownForm`."""
        return replace(self, scale=size_mm / self.scan.extent_mm)

    def samples(self, seen: FloatArray) -> FloatArray:
        """See `KnownForm`."""
        points = self.scan.samples[0]
        points = points[:: max(1, len(points) // _SAMPLES)] - self.scan.middle_mm
        return transform(self.scan2place, self.scan.middle_mm + self.scale * points)


def fitted(form: _Form, points: FloatArray, weights: FloatArray, *, size: bool = False) -> _Form:
    """Move a form to where it fits points best, by least squares of the errors along its normals.

    Parameters
    ----------
    form
        Near the points.
    points : (n, 3) float64, mm
    weights : (n,) float64
        The area that each stands for.
    size
        Whether its size is fitted too; otherwise it stays.
    """
    every = slice(None, None, max(1, len(points) // _FITTED))
    points, root = points[every], np.sqrt(weights[every])
    for _ in range(_ROUNDS):
        errors, normals = form.errors(points)
        known = np.isfinite(errors)
        away = points[known] - form.centre_mm
        columns = [normals[known], np.cross(away, normals[known])]
        if size:
            columns.append(_growth(form, away, normals[known]))
        scaled = np.concatenate(columns, axis=1) * root[known, None]
        # Of least norm, so a form stays where the points do not say where along it they lie.
        step = np.asarray(
            np.linalg.lstsq(scaled, errors[known] * root[known], rcond=1e-9)[0], float
        )
        form = _stepped(form, step)
        if np.abs(step[:3]).max() < _SETTLED_MM and np.abs(step[6:]).max(initial=0) < _SETTLED_MM:
            break
    return form


def _growth(form: KnownForm, away: FloatArray, normals: FloatArray) -> FloatArray:
    """Return by how much the surface moves outwards (n, 1) when its size grows by 1 mm."""
    if isinstance(form, ScannedBody):
        return np.asarray(np.einsum("nc,nc->n", away, normals)[:, None] / form.size_mm)
    return np.full((len(away), 1), 0.5)


def _stepped(form: _Form, step: FloatArray) -> _Form:
    turn = scipy.spatial.transform.Rotation.from_rotvec(step[3:6]).as_matrix()
    centre = form.centre_mm
    form = form.moved(rigid(turn, centre + step[:3] - turn @ centre))
    return form.of_size(form.size_mm + step[6]) if len(step) > 6 else form
