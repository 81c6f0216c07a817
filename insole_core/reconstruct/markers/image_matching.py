"""Match blobs to markers in the colour image alone, without depth."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.transforms import rigid
from insole_core.messages import Message
from insole_core.reconstruct.markers.marker_matching import MarkerMatch, looks_at_foot
from insole_core.reconstruct.poses.pose_batch import (
    LEAST_EXPLAINED,
    PoseBatch,
    Sight,
    improved,
    matches,
)
from insole_core.sensing.pinhole_camera import PinholeCamera

_KEPT = 300
_ROUNDS = 6
_SETTLING_ROUNDS = 5
_TABLE = 256


@dataclass(frozen=True)
class ImageMatchLimits:
    """When a matching is trusted.

    Parameters
    ----------
    distance_mm
        Smallest and largest distance of the camera from the markers.
    steepest
        Cosine of the largest angle between the rays and the markers' normal.
    largest_size_ratio
        Largest ratio of the areas, in the image, of the markers of one triangle.
    rough_share, near_px
        Largest distance of a blob from the marker that it explains: first as a share of the
        pattern's size, finally in pixels of an image 1280 wide.
    least_markers, least_share
        Least number (or all, when the system has fewer) and least share of markers explained.
    noise_px
        Standard deviation of a blob's centre.
    margin
        Least excess of the sum of squared distances of any other pose, in variances of a blob's
        centre; a marker without a blob counts with the distance `near_px`.
    elsewhere_deg
        Angle from which on a pose is a different one.
    stray_px, strays
        A blob farther off than `stray_px`, in pixels of an image 1280 wide, and than `strays`
        times the median distance is still the marker, but only partly visible; it counts neither
        for nor against the pose.
    doubted_px
        Distance of a blob that counts half in the pose, in pixels of an image 1280 wide.
    largest_rms_px
        Largest root mean square of the final reprojection errors, strays left out.
    triples
        Number of triangles of markers that are tried.
    """

    distance_mm: tuple[float, float] = (400.0, 1500.0)
    steepest: float = 0.4
    largest_size_ratio: float = 3.0
    rough_share: float = 0.06
    near_px: float = 3.0
    least_markers: int = 6
    least_share: float = 0.5
    noise_px: float = 0.2
    margin: float = 50.0
    elsewhere_deg: float = 2.0
    stray_px: float = 1.0
    strays: float = 4.0
    doubted_px: float = 0.5
    largest_rms_px: float = 0.8
    triples: int = 60


@dataclass(frozen=True, eq=False)
class ImageMarkerMatch:
    """Pairs of blobs and markers, and the pose that explains them.

    Parameters
    ----------
    pairs
        Indices of blobs and markers.
    reference2color : (4, 4) float64, mm
    rms_px
        Root mean square of the reprojection errors.
    """

    pairs: MarkerMatch
    reference2color: FloatArray
    rms_px: float


def match_in_image(
    pixels: FloatArray,
    areas: FloatArray,
    markers: FloatArray,
    camera: PinholeCamera,
    limits: ImageMatchLimits = ImageMatchLimits(),
) -> ImageMarkerMatch:
    """Find the camera pose that explains most markers by blobs, and match the two.

    Three blobs that are three given markers determine the camera under weak perspective up to a
    mirror image in depth (Alter 1994). All triangles of blobs are compared with a fixed choice of
    triangles of markers, so that the result does not depend on chance; the poses that explain most
    markers are refined under full perspective on all that they explain.

    Parameters
    ----------
    pixels : (n, 2) float64, px
        Centres of blobs, not all of which need be markers.
    areas : (n,) float64, px²
    markers : (m, 3) float64, mm, reference frame
        Those that this camera can see; some may be hidden.
    camera
        The colour camera.
    limits

    Returns
    -------
    ImageMarkerMatch

    Raises
    ------
    ReconstructionError
        When too few markers are explained, or when another pose explains almost as many.
    """
    scale_px = camera.fx
    near = limits.near_px * camera.width / 1280 / scale_px
    sight = Sight(camera.normalised(pixels), markers)
    poses = _search(sight, areas, limits, near)
    if len(poses) == 0:
        raise ReconstructionError(_too_few(0, len(pixels), len(markers), limits))
    pairs, explained, squared = matches(poses, sight, near)
    missed = np.where(explained, squared, near**2).sum(1)
    best = int(missed.argmin())
    found = np.flatnonzero(explained[best])
    whole = _whole(squared[best, found], limits.stray_px * near / limits.near_px, limits)
    most = int(whole.sum())
    if most < _needed(len(markers), limits):
        raise ReconstructionError(_too_few(most, len(pixels), len(markers), limits))
    variance = float(squared[best, found[whole]].mean())
    rms_px = scale_px * float(np.sqrt(variance))
    if rms_px > limits.largest_rms_px:
        raise ReconstructionError(
            "the blue spots lie {rms_px:.1f} px from where the markers should be seen; check that "
            "it is the right reference system and the right calibration",
            rms_px=rms_px,
        )
    variance = max(variance, (limits.noise_px / scale_px) ** 2)
    rival = _elsewhere(poses, best, limits) & (missed - missed[best] < limits.margin * variance)
    if rival.any():
        raise ReconstructionError(
            "the blue spots fit the markers in two ways, {most} and {rivals} of them; see that "
            "more markers are in view",
            most=most,
            rivals=explained[rival].sum(1).max(),
        )
    return ImageMarkerMatch(
        MarkerMatch(pairs[best, found], found, whole),
        rigid(poses.rotations[best], poses.translations[best]),
        rms_px,
    )


def _whole(squared: FloatArray, near: float, limits: ImageMatchLimits) -> BoolArray:
    """Return which pairs (k,) agree with most others, from their squared distances."""
    usual = np.median(squared) if len(squared) else 0.0
    return np.asarray(squared <= max(near**2, limits.strays**2 * usual))


def _needed(markers: int, limits: ImageMatchLimits) -> int:
    share = int(np.ceil(limits.least_share * markers))
    return max(min(limits.least_markers, markers), share)


def _too_few(most: int, blobs: int, markers: int, limits: ImageMatchLimits) -> str:
    return Message(
        "only {most} of the {spots} blue spots fit the {markers} markers, and {needed} are "
        "needed; check that it is the right reference system, that its pictures are not "
        "mirrored and that most markers are seen",
        most=most,
        spots=blobs,
        markers=markers,
        needed=_needed(markers, limits),
    )


def _elsewhere(poses: PoseBatch, best: int, limits: ImageMatchLimits) -> BoolArray:
    trace = np.einsum("tij,ij->t", poses.rotations, poses.rotations[best])
    return np.asarray(trace < 1 + 2 * np.cos(np.radians(limits.elsewhere_deg)))


def _search(sight: Sight, areas: FloatArray, limits: ImageMatchLimits, near: float) -> PoseBatch:
    """Return the best candidate poses, refined; none when none explains four markers."""
    triangles = _blob_triangles(areas, limits)
    if len(triangles) == 0 or len(sight.markers) < LEAST_EXPLAINED:
        return PoseBatch.none()
    size = np.linalg.norm(np.ptp(sight.markers, axis=0))
    table = _DistanceTable.of(sight.blobs)
    corners = np.ascontiguousarray(np.moveaxis(sight.blobs[triangles], 0, 2))
    found: list[PoseBatch] = []
    scores: list[FloatArray] = []
    for chosen in _marker_triangles(sight.markers, limits.triples):
        poses = _weak_perspective(sight, corners, chosen, limits)
        tolerance = limits.rough_share * size / np.maximum(poses.translations[:, 2], 1)
        distance = table.look_up(poses.project(sight.markers)) / tolerance[:, None]
        score = np.where(distance < 1, 1 - 0.5 * distance**2, 0).sum(1)
        best = np.argsort(-score)[:_KEPT]
        found.append(poses.take(best))
        scores.append(score[best])
    order = np.argsort(-np.concatenate(scores), kind="stable")[:_KEPT]
    poses = PoseBatch.joined(found).take(order)
    widest = limits.rough_share * size / limits.distance_mm[0]
    for tolerance in np.geomspace(widest, near, _ROUNDS):
        poses = improved(poses, sight, float(tolerance))
    for _ in range(_SETTLING_ROUNDS):
        poses = improved(poses, sight, near, near * limits.doubted_px / limits.near_px)
    return poses


def _blob_triangles(areas: FloatArray, limits: ImageMatchLimits) -> IntArray:
    """Return all ordered triples (t, 3) of blobs of similar size."""
    count = len(areas)
    i, j, k = np.indices((count,) * 3).reshape(3, -1)
    differ = (i != j) & (j != k) & (k != i)
    triangles = np.stack([i, j, k], axis=1)[differ]
    size = areas[triangles]
    return np.asarray(triangles[size.max(1) <= limits.largest_size_ratio * size.min(1)])


def _marker_triangles(markers: FloatArray, count: int) -> IntArray:
    """Choose wide triangles (c, 3) of markers so that each marker is in about as many of them."""
    every = np.array(list(combinations(range(len(markers)), 3)))
    a, b, c = np.moveaxis(markers[every], 1, 0)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    wide = every[area > 0.3 * area.max()]
    wide = wide[np.argsort(-area[area > 0.3 * area.max()], kind="stable")]
    used = np.zeros(len(markers))
    left = np.ones(len(wide), dtype=bool)
    chosen: list[IntArray] = []
    while left.any() and len(chosen) < count:
        burden = np.where(left, (used[wide] ** 2).sum(1), np.inf)
        next_one = int(burden.argmin())
        left[next_one] = False
        used[wide[next_one]] += 1
        chosen.append(wide[next_one])
    return np.array(chosen)


def _weak_perspective(
    sight: Sight, corners: FloatArray, chosen: IntArray, limits: ImageMatchLimits
) -> PoseBatch:
    """Compute the poses that map three markers to triangles of blobs, up to two for each.

    Parameters
    ----------
    corners : (3, 2, t) float64
        Of the triangles: corner, axis, triangle.
    """
    origin, *others = sight.markers[chosen]
    basis, in_plane = _plane_basis(*(other - origin for other in others))
    edges = (corners[1:] - corners[0]).reshape(2, -1)
    linear = (np.linalg.inv(in_plane).T @ edges).reshape(2, 2, -1)  # direction in the plane, axis
    total = (linear**2).sum((0, 1))
    determinant = linear[0, 0] * linear[1, 1] - linear[1, 0] * linear[0, 1]
    largest = (total + np.sqrt(np.maximum(total**2 - 4 * determinant**2, 0))) / 2
    scale = np.sqrt(largest)
    low, high = limits.distance_mm
    possible = (scale > 1 / high) & (scale < 1 / low)
    possible &= np.abs(determinant) > limits.steepest * largest
    scale, center = scale[possible], corners[..., possible].mean(0)
    first, second = linear[..., possible] / scale
    out = np.sqrt(np.maximum(1 - first**2 - second**2, 0))
    out[1] *= np.where(first[0] * first[1] + second[0] * second[1] > 0, -1, 1)
    level = first[0] * second[1] - second[0] * first[1]
    ahead = np.stack([*center, np.ones_like(scale)], axis=1) / scale[:, None]
    poses = []
    for x, y in (out, -out):
        rows = [
            [first[0], second[0], x],
            [first[1], second[1], y],
            [second[0] * y - x * second[1], x * first[1] - first[0] * y, level],
        ]
        aslant = np.moveaxis(np.array(rows), 2, 0).reshape(-1, 3)
        rotations = (aslant @ basis).reshape(-1, 3, 3)
        middle = rotations @ sight.markers[chosen].mean(0)
        forward = looks_at_foot(np.swapaxes(rotations, 1, 2))
        poses.append(PoseBatch(rotations[forward], (ahead - middle)[forward]))
    return PoseBatch.joined(poses)


def _plane_basis(first: FloatArray, second: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return orthonormal rows (3, 3), two in the plane of two edges, and the edges in it (2, 2)."""
    along = first / np.linalg.norm(first)
    normal = np.cross(first, second)
    normal /= np.linalg.norm(normal)
    basis = np.stack([along, np.cross(normal, along), normal])
    return basis, np.stack([basis[:2] @ first, basis[:2] @ second], axis=1)


@dataclass(frozen=True, eq=False)
class _DistanceTable:
    """The distance to the nearest blob, tabulated on a lattice over the image.

    Parameters
    ----------
    low, step : (2,) float64
        Place of the first node, and from node to node.
    distance : (n, n) float64
        With an infinite one round the lattice.
    """

    low: FloatArray
    step: FloatArray
    distance: FloatArray

    @staticmethod
    def of(blobs: FloatArray) -> _DistanceTable:
        margin = 0.05
        low, high = blobs.min(0) - margin, blobs.max(0) + margin
        step = (high - low) / (_TABLE - 1)
        axes = [low[axis] + step[axis] * np.arange(_TABLE) for axis in (0, 1)]
        squared = [(axes[axis][:, None] - blobs[:, axis]) ** 2 for axis in (0, 1)]
        nearest = np.full((_TABLE, _TABLE), np.inf)
        for blob in range(len(blobs)):
            np.minimum(nearest, squared[0][:, None, blob] + squared[1][None, :, blob], out=nearest)
        return _DistanceTable(low, step, np.pad(np.sqrt(nearest), 1, constant_values=np.inf))

    def look_up(self, places: FloatArray) -> FloatArray:
        """Return the distances (...,) at positions (..., 2); infinite outside of the table."""
        index = np.rint((places - self.low) / self.step) + 1
        row, column = np.moveaxis(np.fmax(np.fmin(index, _TABLE + 1), 0).astype(np.int64), -1, 0)
        return np.asarray(self.distance.reshape(-1).take(row * (_TABLE + 2) + column))
