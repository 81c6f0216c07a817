"""Match points in space to markers by nothing but the distances between them."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from insole_core.errors import ReconstructionError
from insole_core.geometry.absolute_orientation import rotation_from_covariance
from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.transforms import MIRROR

_REFINEMENTS = 3
_CHUNK = 2000
_REFINED = 1000


@dataclass(frozen=True)
class MarkerMatchLimits:
    """When a matching is trusted.

    Parameters
    ----------
    near_mm
        Largest distance of a point from the marker that it explains.
    found_mm
        Largest distance of a point that is still that marker, but measured too poorly to be used.
    least_markers, least_share
        Least number and least share of markers explained.
    margin
        Number of markers that the best pose must explain more than any different one.
    least_width_mm
        Least spread (standard deviation) of the explained markers across their main direction.
    narrowest_triple_mm
        Height of the flattest triangle of markers that the search starts from.
    elsewhere_mm
        Mean displacement of the markers from which on a pose is a different one.
    most_triples
        Number of triangles of markers that the search starts from. Of the 2024 of 24 markers half
        of which are hidden, an eighth are seen whole, so a fifth of them suffices.
    """

    near_mm: float = 6.0
    found_mm: float = 12.0
    least_markers: int = 4
    least_share: float = 0.5
    margin: int = 2
    least_width_mm: float = 15.0
    narrowest_triple_mm: float = 20.0
    elsewhere_mm: float = 15.0
    most_triples: int = 400


@dataclass(frozen=True, eq=False)
class MarkerMatch:
    """Pairs of points and markers.

    Parameters
    ----------
    points, markers : (k,) int64
        Index of each pair's point and of its marker.
    used : (k,) bool
        Whether the pair agrees well enough to determine the pose.
    """

    points: IntArray
    markers: IntArray
    used: BoolArray


@dataclass(frozen=True, eq=False)
class _Poses:
    """Candidate poses along the first axis, with the markers that each explains."""

    rotations: FloatArray
    translations: FloatArray
    nearest: IntArray  # (t, m) the point nearest to every marker
    explained: BoolArray  # (t, m)
    squared: FloatArray  # (t, m) mm²

    @property
    def counts(self) -> IntArray:
        return np.asarray(self.explained.sum(1))

    @property
    def rms_mm(self) -> FloatArray:
        total = np.where(self.explained, self.squared, 0).sum(1)
        return np.asarray(np.sqrt(total / np.maximum(self.counts, 1)))

    def take(self, index: IntArray | BoolArray) -> _Poses:
        return _Poses(
            self.rotations[index],
            self.translations[index],
            self.nearest[index],
            self.explained[index],
            self.squared[index],
        )


def match_markers(
    points: FloatArray,
    markers: FloatArray,
    limits: MarkerMatchLimits = MarkerMatchLimits(),
) -> MarkerMatch:
    """Find the pose in which most markers have a point near them, and match the two.

    Every triangle of markers is compared with every triangle of points of the same side lengths;
    each agreement gives a pose (Horn), and the pose that explains most markers, then the one with
    the least error, is refined on all that it explains. The search is exhaustive up to 14 markers,
    and starts from a fixed choice of triangles with more, so the result does not depend on chance;
    a mirrored arrangement cannot be rotated onto the markers and is refused.

    Parameters
    ----------
    points : (n, 3) float64, mm, depth camera frame
        Marker candidates, not all of which need be markers.
    markers : (m, 3) float64, mm, reference frame
        The markers that this view can see; some may be hidden.
    limits

    Returns
    -------
    MarkerMatch
        In the order of the markers.

    Raises
    ------
    ReconstructionError
        When too few markers are explained, or when another pose explains almost as many.
    """
    poses = _candidate_poses(points, markers, limits)
    most = int(poses.counts.max(initial=0))
    _check_mirrored(points, markers, most, limits)
    _check_enough(most, len(points), len(markers), limits)
    best = poses.take(np.lexsort((poses.rms_mm, -poses.counts))[:1])
    _check_width(markers[best.explained[0]], limits)
    _check_rivals(poses.counts[_elsewhere(poses, best, markers, limits)], most, limits)
    found = _explain(best.rotations, best.translations, points, markers, limits.found_mm)
    pairs = np.flatnonzero(found.explained[0])
    return MarkerMatch(found.nearest[0, pairs], pairs, best.explained[0, pairs])


def _candidate_poses(points: FloatArray, markers: FloatArray, limits: MarkerMatchLimits) -> _Poses:
    """Return refined candidate poses, those that explain most markers."""
    three_points, three_markers = _congruent_triples(points, markers, limits)
    parts = []
    for start in range(0, max(len(three_points), 1), _CHUNK):
        chunk = slice(start, start + _CHUNK)
        source, target = points[three_points[chunk]], markers[three_markers[chunk]]
        rotations, translations = _fit(source, target, np.ones(source.shape[:2]))
        forward = looks_at_foot(rotations)
        rotations, translations = rotations[forward], translations[forward]
        parts.append(_explain(rotations, translations, points, markers, limits.near_mm))
    poses = _joined(parts)
    poses = poses.take(np.argsort(-poses.counts, kind="stable")[:_REFINED])
    for _ in range(_REFINEMENTS):
        poses = poses.take(poses.counts >= 3)
        rotations, translations = _fit(
            points[poses.nearest],
            np.broadcast_to(markers, (len(poses.counts), *markers.shape)),
            poses.explained.astype(float),
        )
        poses = _explain(rotations, translations, points, markers, limits.near_mm)
    return poses


def _joined(parts: list[_Poses]) -> _Poses:
    return _Poses(
        *(
            np.concatenate([getattr(part, name) for part in parts])
            for name in ("rotations", "translations", "nearest", "explained", "squared")
        )
    )


def looks_at_foot(rotations: FloatArray) -> BoolArray:
    """Return which poses look towards +z or +y, as every sensor that sees the markers' faces does.

    Parameters
    ----------
    rotations : (..., 3, 3) float64
        Camera frame to reference frame.

    Returns
    -------
    (...,) bool
    """
    axis = rotations[..., :, 2]
    return np.asarray(np.maximum(axis[..., 1], axis[..., 2]) > 0.3)


def _congruent_triples(
    points: FloatArray, markers: FloatArray, limits: MarkerMatchLimits
) -> tuple[IntArray, IntArray]:
    """Return indices (t, 3) of points and of markers whose triangles have the same sides."""
    between_points = np.linalg.norm(points[:, None] - points[None], axis=2)
    between_markers = np.linalg.norm(markers[:, None] - markers[None], axis=2)
    fits = np.abs(between_points - between_markers[..., None, None]) < limits.near_mm
    three_points, three_markers = [np.empty((0, 3), np.int64)], [np.empty((0, 3), np.int64)]
    triples = np.array(list(combinations(range(len(markers)), 3)), dtype=np.int64).reshape(-1, 3)
    wide = triples[_heights(markers[triples]) >= limits.narrowest_triple_mm]
    if len(wide) > limits.most_triples:
        # A fixed choice, so that the result does not depend on chance.
        wide = np.random.default_rng(0).permutation(wide)[: limits.most_triples]
    for k, l, p in wide:  # noqa: E741
        first, second = np.nonzero(fits[k, l])
        pair, third = np.nonzero(fits[k, p][first] & fits[l, p][second])
        found = np.stack([first[pair], second[pair], third], axis=1)
        three_points.append(found)
        three_markers.append(np.broadcast_to([k, l, p], found.shape))
    return np.concatenate(three_points), np.concatenate(three_markers)


def _heights(triangles: FloatArray) -> FloatArray:
    """Compute the smallest heights (t,) of triangles (t, 3, 3)."""
    sides = np.linalg.norm(triangles - np.roll(triangles, 1, axis=1), axis=2)
    a, b, c = np.moveaxis(triangles, 1, 0)
    doubled_area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return np.asarray(doubled_area / np.maximum(sides.max(1), 1e-9))


def _fit(
    source: FloatArray, target: FloatArray, weight: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Fit many weighted point sets (t, k, 3) at once (Horn); return rotations and translations."""
    share = (weight / weight.sum(1, keepdims=True))[..., None]
    mean_source, mean_target = (share * source).sum(1), (share * target).sum(1)
    covariance = np.swapaxes(share * (source - mean_source[:, None]), 1, 2) @ (
        target - mean_target[:, None]
    )
    rotations = rotation_from_covariance(covariance)
    return rotations, mean_target - np.einsum("tij,tj->ti", rotations, mean_source)


def _explain(
    rotations: FloatArray,
    translations: FloatArray,
    points: FloatArray,
    markers: FloatArray,
    near_mm: float,
) -> _Poses:
    """Find which markers have a point near them; a point explains one marker at most."""
    moved = points @ np.swapaxes(rotations, 1, 2) + translations[:, None]
    squared = _squared_distances(moved, markers)
    if len(points) == 0:
        squared = np.full((len(rotations), 1, len(markers)), np.inf)
    nearest, nearest_marker = squared.argmin(1), squared.argmin(2)
    own = np.take_along_axis(nearest_marker, nearest, axis=1) == np.arange(len(markers))
    least = squared.min(1)
    return _Poses(rotations, translations, nearest, own & (least < near_mm**2), least)


def _squared_distances(points: FloatArray, markers: FloatArray) -> FloatArray:
    """Return (t, n, m), mm², of points (t, n, 3) from markers (m, 3).

    Coordinate by coordinate: along an axis of three, sums take several times as long.
    """
    x, y, z = ((points[:, :, None, axis] - markers[:, axis]) ** 2 for axis in range(3))
    return np.asarray(x + y + z)


def _elsewhere(
    poses: _Poses, best: _Poses, markers: FloatArray, limits: MarkerMatchLimits
) -> BoolArray:
    """Return which poses (t,) place the points of the markers elsewhere than the best does."""
    seen = (markers - best.translations[0]) @ best.rotations[0]
    moved = seen @ np.swapaxes(poses.rotations, 1, 2) + poses.translations[:, None]
    return np.asarray(np.linalg.norm(moved - markers, axis=2).mean(1) > limits.elsewhere_mm)


def _check_mirrored(
    points: FloatArray, markers: FloatArray, most: int, limits: MarkerMatchLimits
) -> None:
    if most >= min(len(points), len(markers)):
        return
    mirrored = _candidate_poses(points * MIRROR, markers, limits)
    if int(mirrored.counts.max(initial=0)) >= max(_needed(len(markers), limits), most + 1):
        raise ReconstructionError(
            "the blue spots are the mirror image of the markers; check whether the pictures of "
            "this view were flipped; as they stand they fit no pose"
        )


def _needed(markers: int, limits: MarkerMatchLimits) -> int:
    return max(limits.least_markers, int(np.ceil(limits.least_share * markers)))


def _check_enough(most: int, points: int, markers: int, limits: MarkerMatchLimits) -> None:
    needed = _needed(markers, limits)
    if most < needed:
        raise ReconstructionError(
            "only {most} of the {spots} blue spots fit the {markers} markers, and {needed} are "
            "needed; check that it is the right reference system and that most markers are seen",
            most=most,
            spots=points,
            markers=markers,
            needed=needed,
        )


def _check_rivals(rivals: IntArray, most: int, limits: MarkerMatchLimits) -> None:
    if int(rivals.max(initial=0)) > most - limits.margin:
        raise ReconstructionError(
            "the blue spots fit the markers in two ways, {most} and {rivals} of them; see that "
            "more markers are in view",
            most=most,
            rivals=rivals.max(),
        )


def _check_width(markers: FloatArray, limits: MarkerMatchLimits) -> None:
    spread = np.linalg.svd(markers - markers.mean(0), compute_uv=False) / np.sqrt(len(markers))
    if spread[1] < limits.least_width_mm:
        raise ReconstructionError(
            "the markers that are seen lie almost on one line, so the sensor's place is uncertain"
        )
