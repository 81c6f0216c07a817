"""Best fit of one surface to another: by closest points, or by points picked or found on both."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import permutations, product
from pathlib import Path

import numpy as np
import scipy

from insole_core.compare.seen_surface import SurfacePoints
from insole_core.errors import InputError, ReconstructionError
from insole_core.geometry.absolute_orientation import absolute_orientation
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rigid, transform
from insole_core.json_object import JsonObject
from insole_core.progress import SILENT, Progress

_TUKEY = 4.685 * 1.4826
_LEAST_SPREAD_MM = 0.004
_COARSE_POINTS = 600
_COARSE_ROUNDS, _FINE_ROUNDS = 25, 80
_FIRST_ROUNDS, _LIKELY = 8, 6
"""Of many initial poses: rounds that show which are likely, and how many of those go on."""
_SETTLED_MM = 1e-6
_START_REACH_MM = 25.0
_LEAST_REACH_MM = 2.0
_LEAST_PAIRS = 30
_LEAST_SHARE = 0.1
DOTS = 4
"""Number of black dots on a mould, thesis 8.2."""
_DARK = 0.45  # of the usual brightness
_DOT_EXTENT_MM = (2.0, 20.0)
_LEAST_ROUNDNESS = 0.4
_LUMA = (0.299, 0.587, 0.114)


@dataclass(frozen=True, eq=False)
class Fit:
    """The pose of surface b in the frame of surface a.

    Parameters
    ----------
    b2a : (4, 4) float64, mm
    residual_mm
        Median distance of b's points from a's surface; of picked points the root mean square.
    share
        Share of b's points with a partner on a.
    """

    b2a: FloatArray
    residual_mm: float
    share: float


def best_fit(
    a: SurfacePoints, b: SurfacePoints, progress: Progress = SILENT, *, thorough: bool = False
) -> Fit | None:
    """Find the rigid motion that fits b to a, from any initial pose (ICP, point to plane).

    Parameters
    ----------
    a, b : mm
        The sides to compare, each in its own frame.
    thorough
        Whether b may show only a part of a, so that their main axes need not correspond; all
        orders of the axes are tried then, which takes five times as long.

    Returns
    -------
    Fit or None
        None if less than a tenth of b meets a.
    """
    progress.step(0.0, "Trying poses")
    target = _Target(a)
    coarse = b.every(max(1, len(b.points) // _COARSE_POINTS))
    starts = _starts(a, b, thorough)
    if thorough:
        tried = (_refine(target, coarse, start, _FIRST_ROUNDS) for start in starts)
        likely = sorted((fit for fit in tried if fit is not None), key=badness)
        starts = [fit.b2a for fit in likely[:_LIKELY]]
    fits = [_refine(target, coarse, start, _COARSE_ROUNDS) for start in starts]
    found = [fit for fit in fits if fit is not None]
    if not found:
        return None
    progress.step(0.5, "Fitting one surface to the other")
    fine = _refine(target, b, min(found, key=badness).b2a, _FINE_ROUNDS)
    return fine if fine is not None and fine.share >= _LEAST_SHARE else None


def badness(fit: Fit) -> float:
    """Score a fit: low if much of b lies near a; the 0.05 mm let the earlier fit win a tie."""
    return (fit.residual_mm + 0.05) / fit.share**2


class _Target:
    """Surface a with its search tree."""

    def __init__(self, a: SurfacePoints) -> None:
        self.surface = a
        self.tree = scipy.spatial.KDTree(a.points)

    def partners(self, b: SurfacePoints, reach_mm: float) -> tuple[IntArray, IntArray]:
        """Return indices into b and a of points that face each other within reach."""
        distance, nearest = self.tree.query(b.points, distance_upper_bound=reach_mm)
        of_b = np.flatnonzero(np.isfinite(distance))
        of_a = np.asarray(nearest)[of_b]
        normal = self.surface.normals[of_a]
        parallel = np.abs((normal * b.normals[of_b]).sum(axis=1)) > 0.7
        return of_b[parallel], of_a[parallel]


def _refine(target: _Target, b: SurfacePoints, start: FloatArray, rounds: int) -> Fit | None:
    """Iterate from an initial pose; None if too few points meet."""
    b2a, reach = start, _START_REACH_MM
    for _ in range(rounds):
        moved = b.transformed(b2a)
        of_b, of_a = target.partners(moved, reach)
        if len(of_b) < _LEAST_PAIRS:
            return None
        points, normals = moved.points[of_b], target.surface.normals[of_a]
        distance = ((points - target.surface.points[of_a]) * normals).sum(axis=1)
        spread = max(float(np.median(np.abs(distance))), _LEAST_SPREAD_MM)
        step = _step(points, normals, distance, _tukey(distance, _TUKEY * spread))
        b2a = step @ b2a
        reach = max(_LEAST_REACH_MM, min(reach * 0.8, 6 * spread + 2))
        if np.abs(step - np.eye(4)).max() < _SETTLED_MM:
            break
    return Fit(b2a, float(np.median(np.abs(distance))), len(of_b) / len(b.points))


def _tukey(distance: FloatArray, limit: float) -> FloatArray:
    return np.asarray(np.clip(1 - (distance / limit) ** 2, 0, None) ** 2)


def _step(
    points: FloatArray, normals: FloatArray, distance: FloatArray, weights: FloatArray
) -> FloatArray:
    """Return the small motion (4, 4) about the centroid that reduces weighted distances most."""
    centre = points.mean(axis=0)
    jacobian = np.concatenate([np.cross(points - centre, normals), normals], axis=1)
    weighted = jacobian * weights[:, None]
    normal_matrix = weighted.T @ jacobian
    damping = 1e-9 * np.trace(normal_matrix) * np.eye(6)
    motion = -np.linalg.solve(normal_matrix + damping, weighted.T @ distance)
    rotation = scipy.spatial.transform.Rotation.from_rotvec(motion[:3]).as_matrix()
    return rigid(rotation, centre + motion[3:] - rotation @ centre)


def _starts(a: SurfacePoints, b: SurfacePoints, thorough: bool) -> list[FloatArray]:
    """Return the identity, centroid on centroid, and all alignments of b's main axes with a's."""
    mean_a, mean_b = a.points.mean(axis=0), b.points.mean(axis=0)
    axes_a, axes_b = _axes(a), _axes(b)
    turns = [np.eye(3)]
    for order in permutations(range(3)) if thorough else [(0, 1, 2)]:
        for signs in product((1, -1), repeat=2):
            swap = np.eye(3)[list(order)] * [[signs[0]], [signs[1]], [1]]
            swap[2] *= np.linalg.det(swap)
            turns.append(axes_a @ swap @ axes_b.T)
    return [np.eye(4), *(rigid(turn, mean_a - turn @ mean_b) for turn in turns)]


def _axes(surface: SurfacePoints) -> FloatArray:
    """Return the main axes as columns (3, 3), right-handed."""
    centred = surface.points - surface.points.mean(axis=0)
    axes = np.linalg.eigh(centred.T @ centred)[1][:, ::-1].copy()
    axes[:, 2] *= np.sign(np.linalg.det(axes))
    return axes


def read_picked_points(path: Path) -> tuple[FloatArray, FloatArray]:
    """Read points picked on a and on b: ``{"a": [[x, y, z], …], "b": [[x, y, z], …]}``, mm.

    Returns
    -------
    a, b : (n, 3) float64, mm
        Row i of one corresponds to row i of the other.

    Raises
    ------
    InputError
        Naming the file and what is wrong with it.
    """
    root = JsonObject.read(path)
    a, b = (np.array(root.vectors(key, 3)).reshape(-1, 3) for key in ("a", "b"))
    if len(a) != len(b):
        raise InputError(
            "{path} holds {count_a} points of a and {count_b} of b; pick each point on both.",
            path=path,
            count_a=len(a),
            count_b=len(b),
        )
    return a, b


def fit_points(a: FloatArray, b: FloatArray) -> Fit:
    """Fit points of b to their partners on a by Horn's method (thesis 3.2).

    Parameters
    ----------
    a, b : (n, 3) float64, mm
        Row i of one corresponds to row i of the other.

    Raises
    ------
    InputError
        If there are fewer than three points, or all on one line.
    """
    try:
        b2a = absolute_orientation(b, a).a2b
    except ReconstructionError as error:
        raise InputError(
            "The picked points cannot place one surface on the other: {reason}", reason=str(error)
        ) from error
    away = np.linalg.norm(transform(b2a, b) - a, axis=1)
    return Fit(b2a, float(np.sqrt((away**2).mean())), 1.0)


def fit_dots(a: FloatArray, b: FloatArray) -> Fit:
    """Fit dots of b to those of a without known correspondence, by trying every order.

    Parameters
    ----------
    a, b : (4, 3) float64, mm

    Raises
    ------
    InputError
        If the dots lie on one line.
    """
    fits = (fit_points(a, b[list(order)]) for order in permutations(range(len(b))))
    return min(fits, key=lambda fit: fit.residual_mm)


def find_dots(mesh: TriangleMesh, name: str) -> FloatArray:
    """Find the four black dots on a coloured surface.

    Parameters
    ----------
    name
        Of the surface, for messages.

    Returns
    -------
    (4, 3) float64, mm
        Their centres.

    Raises
    ------
    InputError
        If the surface has no colours, or not exactly four dots.
    """
    if mesh.colors is None:
        raise InputError(
            "{name} has no colours, so no dots can be found; pick the points instead.", name=name
        )
    brightness = mesh.colors @ np.array(_LUMA)
    dark = np.flatnonzero(brightness < _DARK * np.median(brightness))
    _, piece = scipy.sparse.csgraph.connected_components(
        mesh.links.adjacency[dark][:, dark], directed=False
    )
    spots = [dark[piece == number] for number in range(piece.max(initial=-1) + 1)]
    dots = [spot for spot in spots if _is_dot(mesh.vertices[spot])]
    if len(dots) != DOTS:
        raise InputError(
            "{count} black dots were found on {name} and four are needed; pick the points instead.",
            count=len(dots),
            name=name,
        )
    areas = mesh.vertex_areas
    return np.array([areas[dot] @ mesh.vertices[dot] / areas[dot].sum() for dot in dots])


def _is_dot(spot: FloatArray) -> bool:
    if len(spot) < 3:
        return False
    length, width, _ = np.linalg.svd(
        spot - spot.mean(axis=0), compute_uv=False, full_matrices=False
    )
    extent = np.ptp(spot, axis=0).max()
    return bool(
        _DOT_EXTENT_MM[0] <= extent <= _DOT_EXTENT_MM[1] and width >= _LEAST_ROUNDNESS * length
    )
