"""Proof of the whole chain, with a captured object of known form, with and without correction.

The object was captured like a foot and reconstructed like one: poses, correction of the depth,
fusion. The true form is laid onto the surface, in its best place but of its true size, and what is
left is the error of the chain. A body that carries its own markers stays in its place among them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import astuple, dataclass
from typing import Literal

import numpy as np
import scipy

from insole_core.errors import CalibrationError
from insole_core.evaluation.find_form import on_form
from insole_core.evaluation.known_form import KnownForm, fitted
from insole_core.evaluation.known_object import KnownObject, moved_by
from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import pieces
from insole_core.geometry.transforms import inverse, transform
from insole_core.geometry.weighted import weighted_quantile
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.prepared_view import prepare
from insole_core.reconstruct.result import Reconstruction
from insole_core.reconstruct.volume import is_inside
from insole_core.recording.box import Box

Correction = Literal["none", "learnt"]
CORRECTIONS: tuple[Correction, Correction] = ("none", "learnt")
SLANTS_DEG = (0.0, 20.0, 35.0, 45.0, 55.0, 90.0)
DISTANCE_STEP_MM = 50.0
PARTS = ("right", "left", "toe side", "heel side", "top", "sole side")
"""Names of the parts of an object that face +x, -x, +y, -y, +z and -z, reference frame."""
_BAND_MM = 10.0
"""Farther from the true surface no reading of it lies, corrected or not."""
_HOLDER_MM = 12.0
"""Width of the sensor's window: nearer to what holds the object, both are measured together."""
_LEAST_HOLDER_MM2 = 300.0
_OWN_MM = 3.0
_COVERED_MM = 3.0
_SEEABLE_DEG = 60.0
_BEFORE_MM = 15.0
_EDGE_MM = 3.0
_EDGE_PX = 8
_LEAST_POINTS = 500
_LEAST_READINGS = 1000
"""Fewer show too little of the object to tell its size."""


@dataclass(frozen=True, eq=False)
class Capture:
    """A captured object, reconstructed without and with the correction.

    Parameters
    ----------
    name
        For display.
    reconstructed
        By the correction; with the depth views.
    depth_points : view -> (480, 640, 3) float64, mm, depth camera frame
        Of the whole depth image.
    volume
        Of interest, reference frame.
    """

    name: str
    reconstructed: Mapping[Correction, Reconstruction]
    depth_points: Mapping[str, FloatArray]
    volume: Box


@dataclass(frozen=True)
class Errors:
    """Errors along the normals of the true surface, over an area.

    Parameters
    ----------
    share
        Of the whole area.
    mean_abs_mm, rms_mm, p95_mm
    signed_mm
        Mean; positive where the surface lies outside of the true one.
    """

    share: float
    mean_abs_mm: float
    rms_mm: float
    p95_mm: float
    signed_mm: float


@dataclass(frozen=True, eq=False)
class SurfaceErrors:
    """The errors of the vertices that belong to the object, of one capture or of several.

    Parameters
    ----------
    errors_mm, areas_mm2, slants_deg, distances_mm : (n,) float64
        Slant and distance from the sensor that sees it least slantingly.
    views, parts : (n,) int64
        Index of that sensor's view, and in `PARTS`.
    places_mm : (n, 3) float64, mm
        From the middle of the object, reference frame.
    """

    errors_mm: FloatArray
    areas_mm2: FloatArray
    slants_deg: FloatArray
    distances_mm: FloatArray
    views: IntArray
    parts: IntArray
    places_mm: FloatArray

    def over(self, chosen: BoolArray) -> Errors | None:
        """Summarise the vertices chosen by a mask (n,); None where there is hardly one."""
        if chosen.sum() < 30:
            return None
        share = self.areas_mm2[chosen].sum() / self.areas_mm2.sum()
        return _summary(self.errors_mm[chosen], self.areas_mm2[chosen], float(share))

    @property
    def all(self) -> Errors:
        """The errors of the whole object."""
        return _summary(self.errors_mm, self.areas_mm2, 1.0)


@dataclass(frozen=True)
class SensorErrors:
    """Single readings of one sensor against the true form in the best place for them alone.

    Parameters
    ----------
    readings
        Number.
    errors
        None where there are too few.
    size_error_mm
        Fitted minus true size.
    off_mm
        Distance of that place from the place in the joined surface.
    """

    view: str
    serial: str
    readings: int
    errors: Errors | None = None
    size_error_mm: float = float("nan")
    off_mm: float = float("nan")


@dataclass(frozen=True)
class BestPlace:
    """Where a body whose place is known would lie best on what was measured of it.

    Parameters
    ----------
    mean_abs_mm
        The error that is left there.
    away_mm, turn_deg
        From the place that is known.
    """

    mean_abs_mm: float
    away_mm: float
    turn_deg: float


@dataclass(frozen=True, eq=False)
class ChainErrors:
    """The result with one correction, over all captures.

    Parameters
    ----------
    surface
    size_mm, true_size_mm
        Fitted, and the true one it was compared with; means over the captures.
    missing_share
        Share of what the sensors could see that the surface lacks.
    sensors
        Of every capture.
    best_place
        Of an object whose place is known; means over the captures.
    """

    surface: SurfaceErrors
    size_mm: float
    true_size_mm: float
    missing_share: float
    sensors: tuple[SensorErrors, ...]
    best_place: BestPlace | None = None

    @property
    def size_error_mm(self) -> float:
        """Bias of the size."""
        return self.size_mm - self.true_size_mm


@dataclass(frozen=True, eq=False)
class ChainEvaluation:
    """A proof of the chain.

    Parameters
    ----------
    known
        What was said of the object.
    captures
        Their names.
    views
        Names of the views, in the order of `SurfaceErrors.views`.
    results
        By the correction.
    """

    known: KnownObject
    captures: tuple[str, ...]
    views: tuple[str, ...]
    results: Mapping[Correction, ChainErrors]


def evaluate_chain(known: KnownObject, captures: Sequence[Capture]) -> ChainEvaluation:
    """Measure the errors of the chain with captures of one object by the same sensors.

    Parameters
    ----------
    known
    captures
        At least one.

    Raises
    ------
    CalibrationError
        When the object is not found, of another size than said, or hardly measured.
    """
    used = (view for one in captures for view in one.reconstructed["none"].depth_views)
    views = tuple(dict.fromkeys(view.name for view in used))
    placed = [_Placed.of(known, capture) for capture in captures]
    results: dict[Correction, ChainErrors] = {}
    for correction in CORRECTIONS:
        results[correction] = _joined([one.errors(correction, views) for one in placed])
    return ChainEvaluation(known, tuple(one.name for one in captures), views, results)


@dataclass(frozen=True, eq=False)
class _Placed:
    """A capture with the object found in it; without the correction, which may be a wrong one.

    Parameters
    ----------
    form
        Of its true size.
    holder
        Tree of the surface points that do not belong to the object; None without any.
    """

    known: KnownObject
    capture: Capture
    form: KnownForm
    holder: scipy.spatial.cKDTree | None

    @classmethod
    def of(cls, known: KnownObject, capture: Capture) -> _Placed:
        surface = capture.reconstructed["none"].mesh
        found = known.find(surface)
        own = on_form(found, surface.vertices, surface.vertex_normals)
        form = found.of_size(known.true_size_mm(found.size_mm))
        best = fitted(form, surface.vertices[own], surface.vertex_areas[own])
        others = _large_pieces(surface.part(~own))
        tree = scipy.spatial.cKDTree(others) if len(others) else None
        return cls(known, capture, known.reference_form(form, best), tree)

    def errors(self, correction: Correction, views: tuple[str, ...]) -> ChainErrors:
        """Measure the errors with one correction."""
        result = self.capture.reconstructed[correction]
        mesh = result.mesh
        chosen = self._belongs(mesh)
        if chosen.sum() < _LEAST_POINTS:
            raise CalibrationError(
                "Only {count} points of {capture} lie on the object and away from what holds it; "
                "put it in the middle of the volume, on a smaller holder.",
                count=int(chosen.sum()),
                capture=self.capture.name,
            )
        points, areas = mesh.vertices[chosen], mesh.vertex_areas[chosen]
        size_mm = fitted(self.form, points, areas, size=True).size_mm
        true_mm = self.known.true_size_mm(size_mm)
        best = fitted(self.form.of_size(true_mm), points, areas)
        form = self.known.reference_form(self.form, best)
        surface = self._surface(form, result.depth_views, points, areas, views)
        sensors = tuple(self._sensor(view, form, correction) for view in result.depth_views)
        missing = self._missing_share(form, points)
        laid = None
        if form is not best:
            left = self._surface(best, result.depth_views, points, areas, views).all
            laid = BestPlace(left.mean_abs_mm, *moved_by(form, best))
        return ChainErrors(surface, size_mm, true_mm, missing, sensors, laid)

    def _belongs(self, mesh: TriangleMesh) -> BoolArray:
        errors, _ = self.form.errors(mesh.vertices)
        near = np.abs(errors) < _BAND_MM
        judged = self.known.is_judged(mesh.vertices)
        return np.asarray(near & self._is_free(mesh.vertices) & judged)

    def _is_free(self, points: FloatArray) -> BoolArray:
        """Return which points (n, 3) lie away from what holds the object."""
        if self.holder is None:
            return np.ones(len(points), dtype=bool)
        return np.asarray(np.isinf(self.holder.query(points, distance_upper_bound=_HOLDER_MM)[0]))

    def _surface(
        self,
        form: KnownForm,
        depth_views: Sequence[DepthView],
        points: FloatArray,
        areas: FloatArray,
        views: tuple[str, ...],
    ) -> SurfaceErrors:
        errors, outward = form.errors(points)
        slants = np.full((len(depth_views), len(points)), np.inf)
        for number, view in enumerate(depth_views):
            near = np.isfinite(view.distance_mm(points, _OWN_MM))
            slants[number] = np.where(near, _slant_deg(view, points, outward), np.inf)
        best = slants.argmin(axis=0)
        distances = np.stack([view.depth_along(points) for view in depth_views])
        every = np.arange(len(points))
        axis = np.abs(outward).argmax(axis=1)
        index = np.array([views.index(view.name) for view in depth_views])
        known = np.isfinite(errors) & np.isfinite(slants[best, every])
        whole = (
            errors, areas, slants[best, every], distances[best, every], index[best],
            2 * axis + (outward[every, axis] < 0), points - form.centre_mm,
        )  # fmt: skip
        return SurfaceErrors(*(values[known] for values in whole))

    def _sensor(self, view: DepthView, form: KnownForm, correction: Correction) -> SensorErrors:
        reading = prepare(view, corrected=correction == "learnt").reading
        points = reading.surface_points
        errors, outward = form.errors(points)
        slant = _slant_deg(view, points, outward)
        used = (np.abs(errors) < _BAND_MM) & (slant < SLANTS_DEG[-1]) & self._is_free(points)
        serial = view.sensor.serial
        if used.sum() < _LEAST_READINGS:
            return SensorErrors(view.name, serial, int(used.sum()))
        points, weights = points[used], np.ones(int(used.sum()))
        own = fitted(form, points, weights)
        left = own.errors(points)[0]
        known = np.isfinite(left)
        size_mm = fitted(own, points, weights, size=True).size_mm
        return SensorErrors(
            view.name,
            serial,
            int(known.sum()),
            _summary(left[known], weights[known], 1.0),
            size_mm - form.size_mm,
            float(np.linalg.norm(own.centre_mm - form.centre_mm)),
        )

    def _missing_share(self, form: KnownForm, points: FloatArray) -> float:
        """Return which share of what the sensors could see lies away from the surface."""
        samples = form.samples(points)
        _, outward = form.errors(samples)
        low, high = np.array(self.capture.volume.min_mm), np.array(self.capture.volume.max_mm)
        inner = Box(tuple(low + _EDGE_MM), tuple(high - _EDGE_MM))
        free = is_inside(samples, inner) & self._is_free(samples) & self.known.is_judged(samples)
        seeable = np.zeros(len(samples), dtype=bool)
        for view in self.capture.reconstructed["none"].depth_views:
            slant = _slant_deg(view, samples, outward)
            seeable |= (slant < _SEEABLE_DEG) & self._is_open(view, samples)
        wanted = samples[free & seeable]
        if not len(wanted):
            return 1.0
        distance = scipy.spatial.cKDTree(points).query(wanted)[0]
        return float(np.mean(distance > _COVERED_MM))

    def _is_open(self, view: DepthView, points: FloatArray) -> BoolArray:
        """Return which points (n, 3) lie in a view's image, with nothing before them."""
        seen = transform(inverse(view.sensor2reference), points)
        camera = view.sensor.depth_camera
        pixels = np.rint(camera.project(seen)).astype(np.int64)
        size = np.array([camera.width, camera.height])
        inside = ((pixels >= _EDGE_PX) & (pixels < size - _EDGE_PX)).all(axis=1)
        u, v = np.clip(pixels, 0, size - 1).T
        depth = self.capture.depth_points[view.name][v, u, 2]
        return np.asarray(inside & ~(depth < seen[:, 2] - _BEFORE_MM))


def _large_pieces(others: TriangleMesh) -> FloatArray:
    """Return the points (n, 3) of what holds the object, among those that do not lie on it.

    Small pieces, such as the web that sensors see between toes, are errors of the surface.
    """
    count, piece = pieces(others)
    area_mm2 = np.bincount(piece, others.vertex_areas, minlength=count)
    return np.asarray(others.vertices[area_mm2[piece] > _LEAST_HOLDER_MM2])


def _slant_deg(view: DepthView, points: FloatArray, outward: FloatArray) -> FloatArray:
    """Return the angle (n,) between the line of sight and the normals."""
    away = view.origin_mm - points
    cosine = np.einsum("nc,nc->n", away, outward) / np.linalg.norm(away, axis=1)
    return np.asarray(np.degrees(np.arccos(np.clip(cosine, -1, 1))))


def _summary(errors: FloatArray, weights: FloatArray, share: float) -> Errors:
    size, total = np.abs(errors), weights.sum()
    return Errors(
        share,
        float(size @ weights / total),
        float(np.sqrt(errors**2 @ weights / total)),
        weighted_quantile(size, weights, 0.95),
        float(errors @ weights / total),
    )


def _joined(results: Sequence[ChainErrors]) -> ChainErrors:
    """Put the results of several captures together."""
    surfaces = [vars(result.surface) for result in results]
    together = {key: np.concatenate([one[key] for one in surfaces]) for key in surfaces[0]}
    return ChainErrors(
        SurfaceErrors(**together),
        float(np.mean([result.size_mm for result in results])),
        float(np.mean([result.true_size_mm for result in results])),
        float(np.mean([result.missing_share for result in results])),
        tuple(sensor for result in results for sensor in result.sensors),
        _mean_place([result.best_place for result in results if result.best_place is not None]),
    )


def _mean_place(places: Sequence[BestPlace]) -> BestPlace | None:
    if not places:
        return None
    mean = np.mean([astuple(place) for place in places], axis=0)
    return BestPlace(*map(float, mean))
