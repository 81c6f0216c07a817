"""The pose of an unknown surface: the directions of ground and toes, and which foot it is.

Nothing is assumed. The surface is placed on every face it could stand on (of its convex hull, and
by its principal directions), turned both ways, and each time compared with the usual foot of either
side.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.errors import InputError
from insole_core.foot.levelling import OUTLINE_HEIGHT_MM
from insole_core.foot.side_similarity import lower_side, side_dissimilarity
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.sampling import area_samples
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid, rotation_about, transform

_SAMPLES = 6000
_FACES = 12
_SAME_FACE_DEG = 10.0
_YAWS_DEG = (-10.0, -5.0, 0.0, 5.0, 10.0)
_WORTH_TURNING = 1.7  # the yaw changes a dissimilarity by less than this ratio
_COVERED = (1.0, 0.85, 0.75)
_COVERED_WEIGHT = 0.2
_FRONT, _STRIPS = 0.10, 10  # share of the length, and strips in it whose widths are averaged
_OUTER = (1, 99)  # percentiles across, between which a surface is wide
_POINTED, _BLUNT, _FRONT_WEIGHT = 0.65, 0.72, 0.6
"""Widths of the front up to which it speaks for toes, and from which on against them: with toes it
is 0.23 to 0.57, of 180 feet and turned by up to 10 degrees; straight cut off behind them 0.8 to 1.
"""


@dataclass(frozen=True, eq=False)
class Pose:
    """A possible pose of a surface.

    Parameters
    ----------
    source2rough : (4, 4) float64, mm
        To toes +y, dorsal +z; accurate to some ten degrees.
    side
    side_dissimilarity
        From the usual foot of `side`; 0 is identical.
    covered
        Share of the foot's length, from the heel on, that the surface covers: less than 1 where
        the toes are missing.
    front_width
        Mean width of the front tenth of what is low, in widths of all that is low.
    """

    source2rough: FloatArray
    side: Side
    side_dissimilarity: float
    covered: float
    front_width: float

    @property
    def wrong_front(self) -> float:
        """What is added to the dissimilarity for a front that toes do not have, or only toes have.

        A broad foot is otherwise much like a longer one without toes, and a narrow foot without
        toes like a short one.
        """
        off = self.front_width - _BLUNT if self.covered >= 1 else _POINTED - self.front_width
        return _FRONT_WEIGHT * max(off, 0.0)

    @property
    def lacking(self) -> float:
        """What is added to the dissimilarity for the toes that are missing.

        Any end of a foot is somewhat like that of a longer one without toes.
        """
        return _COVERED_WEIGHT * (1 - self.covered) + self.wrong_front


def find_poses(
    mesh: TriangleMesh, points: FloatArray, dorsal: FloatArray | None = None
) -> list[Pose]:
    """Find the possible poses of a surface, the most similar to a foot first.

    Parameters
    ----------
    mesh : mm, source frame
    points : (n, 3) float64, mm, source frame
        Its `surface_points`.
    dorsal : (3,) float64, optional
        Unit vector towards the back of the foot, where it is known.

    Returns
    -------
    list of Pose
        Of both sides.

    Raises
    ------
    InputError
        When the surface is flat.
    """
    ups = _up_directions(mesh, points) if dorsal is None else [dorsal]
    rotations = [rotation for up in ups for rotation in _both_ways(points, up)]
    first = [_least_dissimilarity(points, rotation) for rotation in rotations]
    poses = [
        pose
        for rotation, dissimilarity in zip(rotations, first, strict=True)
        if dissimilarity <= _WORTH_TURNING * min(first)
        for pose in turned_poses(points, rotation)
    ]
    return sorted(poses, key=lambda pose: pose.side_dissimilarity)


def _least_dissimilarity(points: FloatArray, rotation: FloatArray) -> float:
    """Return the dissimilarity of an orientation (3, 3) before its yaw is found."""
    poses = poses_as_it_lies(points, rigid(rotation, np.zeros(3)))
    return min(pose.side_dissimilarity for pose in poses)


def surface_points(mesh: TriangleMesh) -> FloatArray:
    """Sample some thousand points (n, 3), mm, evenly over a surface."""
    return area_samples(mesh, mesh.area_mm2 / _SAMPLES)[0]


def surface_samples(mesh: TriangleMesh) -> tuple[FloatArray, FloatArray]:
    """Return the `surface_points` (n, 3), mm, and the unit normals (n, 3) there."""
    points, triangle = area_samples(mesh, mesh.area_mm2 / _SAMPLES)
    return points, TriangleMesh(mesh.vertices, mesh.triangles[triangle]).triangle_normals


def _up_directions(mesh: TriangleMesh, points: FloatArray) -> Iterator[FloatArray]:
    """Return unit vectors that may point to the back of the foot."""
    yield from _faces(mesh.vertices)
    main = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2]
    yield from main
    yield from -main


def _faces(vertices: FloatArray) -> list[FloatArray]:
    """Return inward normals of the convex hull's largest faces, nearly parallel ones merged."""
    try:
        hull = scipy.spatial.ConvexHull(vertices)
    except scipy.spatial.QhullError as error:
        raise InputError("The surface is flat, which is no foot; export the scan again.") from error
    a, b, c = (vertices[hull.simplices[:, corner]] for corner in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    normals = hull.equations[:, :3]
    faces: list[tuple[float, FloatArray]] = []
    free = areas.copy()
    while len(faces) < _FACES and free.max() > 0:
        near = normals @ normals[free.argmax()] > np.cos(np.radians(_SAME_FACE_DEG))
        total = (free * near) @ normals
        faces.append((float(free[near].sum()), -total / np.linalg.norm(total)))
        free[near] = 0.0
    return [normal for _, normal in sorted(faces, key=lambda face: -face[0])]


def _both_ways(points: FloatArray, up: FloatArray) -> Iterator[FloatArray]:
    """Return rotations (3, 3) to `up` = z, with the lower part's long axis along y, both ways."""
    height = points @ up
    low = points[height < height.min() + OUTLINE_HEIGHT_MM]
    flat = (low - low.mean(axis=0)) @ (np.eye(3) - np.outer(up, up))
    ahead = np.linalg.eigh(flat.T @ flat)[1][:, 2]
    for toes in (ahead, -ahead):
        yield np.stack([np.cross(toes, up), toes, up])


def turned_poses(points: FloatArray, rotation: FloatArray) -> Iterator[Pose]:
    """Find the best yaw about one orientation (3, 3), for either side."""
    turns = [rotation_about(np.array([0.0, 0.0, 1.0]), yaw) @ rotation for yaw in _YAWS_DEG]
    poses = [pose for turn in turns for pose in poses_as_it_lies(points, rigid(turn, np.zeros(3)))]
    for side in Side:
        yield min(
            (pose for pose in poses if pose.side is side),
            key=lambda pose: pose.side_dissimilarity + pose.lacking,
        )


def poses_as_it_lies(points: FloatArray, source2rough: FloatArray) -> Iterator[Pose]:
    """Rate a pose that is known but for its origin as left or right foot, with and without toes.

    Parameters
    ----------
    points : (n, 3) float64, mm, source frame
    source2rough : (4, 4) float64, mm
        To toes +y, dorsal +z.

    Yields
    ------
    Pose
        One for every side and share of the length that is covered.
    """
    low = transform(source2rough, points)
    low = low[low[:, 2] < low[:, 2].min() + OUTLINE_HEIGHT_MM]
    low = low - np.array([low[:, 0].mean(), low[:, 1].min(), low[:, 2].min()])
    front_width = _front_width(low)
    for covered in _COVERED:
        drawn = lower_side(low, float(np.ptp(low[:, 1])) / covered)
        for side in Side:
            yield Pose(source2rough, side, side_dissimilarity(drawn, side), covered, front_width)


def _front_width(low: FloatArray) -> float:
    """Return how wide the front of what is low (n, 3) is, in widths of all of it."""
    x, y = low[:, 0], low[:, 1]
    first, last = np.percentile(x, _OUTER)
    strip = (y.max() - y) / max(float(np.ptp(y)), 1.0) / _FRONT * _STRIPS
    fronts = [x[(strip >= number) & (strip < number + 1)] for number in range(_STRIPS)]
    widths = [float(np.ptp(front)) if len(front) else 0.0 for front in fronts]
    return float(np.mean(widths)) / max(float(last - first), 1.0)
