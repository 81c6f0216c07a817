"""Bundle adjustment of markers and of the poses of pictures and sensors; which faces it links."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import cv2
import numpy as np

from insole_core.calibration.least_squares import Blocks, least_squares, pose, pose_vector
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.transforms import inverse, rigid, transform
from insole_core.recording.session import ReferenceSystem
from insole_core.sensing.pinhole_camera import PinholeCamera

_OUTLIER_PX = 1.5
_LENGTH_WEIGHT = 10.0
_FRAME_WEIGHT = 100.0
"""The frame is a convention: it must add nothing to the standard deviations of the markers."""
Faces = tuple[str, ...]
_LEAST_OF_FACE = 4
_LEAST_CAPTURES = 3
_LEAST_TURN_DEG = 10.0


@dataclass(frozen=True, eq=False)
class MarkerView:
    """The markers detected in one picture.

    Parameters
    ----------
    name
        Of the picture.
    pixels : marker id to (2,) float64, px
    camera
        That took the picture.
    sensor, capture
        Of a rig of sensors that do not move relative to each other: the sensor, and the position of
        the system, the same for all sensors. Empty for a sensor on its own.
    """

    name: str
    pixels: dict[str, FloatArray]
    camera: PinholeCamera
    sensor: str = ""
    capture: str = ""


@dataclass(frozen=True)
class KnownLength:
    """A measured distance between two markers, which defines the scale."""

    first: str
    second: str
    length_mm: float


@dataclass(frozen=True, eq=False)
class Adjusted:
    """Marker positions estimated from the pictures.

    Parameters
    ----------
    points, std : (n, 3) float64, mm, near the frame of the plan
        Positions and their standard deviations.
    errors_px : (k,) float64
        All coordinates, detected minus projected.
    """

    points: FloatArray
    std: FloatArray
    errors_px: FloatArray


def adjust_bundle(
    planned: dict[str, FloatArray], views: Sequence[MarkerView], lengths: Sequence[KnownLength]
) -> Adjusted:
    """Estimate the marker positions that explain all pictures best.

    Parameters
    ----------
    planned : marker id to (3,) float64, mm
        All markers to estimate.
    views
        Each shows four of them or more.
    lengths
        Between markers to estimate; one or more.

    Returns
    -------
    Adjusted
        In the order of `planned`.
    """
    bundle = _Bundle(planned, views, lengths)
    solution = least_squares(bundle.residuals, bundle.start(), bundle.blocks(), robust=_OUTLIER_PX)
    count = 3 * len(planned)
    return Adjusted(
        solution.values[:count].reshape(-1, 3),
        solution.std[:count].reshape(-1, 3),
        solution.residuals[: bundle.image_residuals],
    )


def planned_pose(planned: dict[str, FloatArray], view: MarkerView) -> FloatArray:
    """Estimate the pose ``reference2camera`` (4, 4), mm, of one picture from the planned markers.

    Parameters
    ----------
    planned : marker id to (3,) float64, mm
    """
    names = [name for name in view.pixels if name in planned]
    rays = view.camera.normalised(np.array([view.pixels[name] for name in names], dtype=float))
    points = np.array([planned[name] for name in names])
    _, turn, shift = cv2.solvePnP(points, rays, np.eye(3), None, flags=cv2.SOLVEPNP_SQPNP)
    return rigid(cv2.Rodrigues(turn)[0], shift.ravel())


@dataclass(frozen=True, eq=False)
class _Picture:
    """One picture with the indices of its markers and of its sensor."""

    seen: IntArray
    pixels: FloatArray
    camera: PinholeCamera
    sensor: int


class _Bundle:
    """The bundle adjustment problem: markers, poses of further sensors of the rig, and of captures.

    A picture of a sensor on its own is a capture of its own. Six conditions hold the frame at the
    plan, one for each known length the scale.
    """

    def __init__(
        self,
        planned: dict[str, FloatArray],
        views: Sequence[MarkerView],
        lengths: Sequence[KnownLength],
    ) -> None:
        place = {name: i for i, name in enumerate(planned)}
        self._ends = np.array([[place[one.first], place[one.second]] for one in lengths])
        self._lengths = np.array([one.length_mm for one in lengths])
        points = np.array(list(planned.values()))
        # The plan is first scaled to the known lengths; the frame stays that of the plan.
        scale = self._lengths.sum() / self._spans(points).sum()
        self._plan = points * scale
        poses = [planned_pose({k: p * scale for k, p in planned.items()}, view) for view in views]
        self._rig, self._captures = _place_sensors(views, poses)
        numbers = {sensor: i for i, sensor in enumerate(self._rig)}
        captures = [_capture_of(i, view, numbers) for i, view in enumerate(views)]
        self._pictures: list[list[_Picture]] = [[] for _ in self._captures]
        order = {capture: i for i, capture in enumerate(self._captures)}
        for view, capture in zip(views, captures, strict=True):
            names = [name for name in view.pixels if name in place]
            pixels = np.array([view.pixels[name] for name in names], dtype=float)
            seen, sensor = np.array([place[name] for name in names]), numbers.get(view.sensor, 0)
            self._pictures[order[capture]].append(_Picture(seen, pixels, view.camera, sensor))

    @property
    def image_residuals(self) -> int:
        return sum(2 * len(picture.seen) for listed in self._pictures for picture in listed)

    @property
    def _marked(self) -> int:
        return 3 * len(self._plan)

    @property
    def _shared(self) -> int:
        return self._marked + 6 * max(len(self._rig) - 1, 0)

    def start(self) -> FloatArray:
        rig = [pose_vector(one) for one in list(self._rig.values())[1:]]
        captures = [pose_vector(one) for one in self._captures.values()]
        return np.concatenate([self._plan.ravel(), *rig, *captures])

    def residuals(self, unknowns: FloatArray) -> FloatArray:
        points = unknowns[: self._marked].reshape(-1, 3)
        rig = [pose(vector) for vector in unknowns[self._marked : self._shared].reshape(-1, 6)]
        base2sensor = [np.eye(4), *rig]
        parts = []
        captures = unknowns[self._shared :].reshape(-1, 6)
        for vector, listed in zip(captures, self._pictures, strict=True):
            reference2base = pose(vector)
            for one in listed:
                inside = transform(base2sensor[one.sensor] @ reference2base, points[one.seen])
                parts.append((one.pixels - one.camera.project(inside)).ravel())
        return np.concatenate([*parts, self._conditions(points)])

    def blocks(self) -> Blocks:
        lengths = [sum(2 * len(one.seen) for one in listed) for listed in self._pictures]
        # The conditions depend on no pose, so they close the last block.
        lengths[-1] += 6 + len(self._lengths)
        return Blocks(tuple(lengths), self._shared)

    def _conditions(self, points: FloatArray) -> FloatArray:
        change = points - self._plan
        turn = np.cross(self._plan - self._plan.mean(0), change).mean(0) / 100
        scale = (self._spans(points) - self._lengths) * _LENGTH_WEIGHT
        return np.concatenate([change.mean(0) * _FRAME_WEIGHT, turn * _FRAME_WEIGHT, scale])

    def _spans(self, points: FloatArray) -> FloatArray:
        a, b = points[self._ends[:, 0]], points[self._ends[:, 1]]
        return np.asarray(np.linalg.norm(a - b, axis=1))


def _place_sensors(
    views: Sequence[MarkerView], poses: Sequence[FloatArray]
) -> tuple[dict[str, FloatArray], dict[str, FloatArray]]:
    """Return ``base2sensor`` of every sensor of the rig, base first, and initial capture poses.

    The base is the sensor with the most pictures; one that shares no capture with it is treated as
    a sensor on its own.
    """
    joint = [(view, placed) for view, placed in zip(views, poses, strict=True) if view.capture]
    named = [view.sensor for view, _ in joint]
    rig: dict[str, FloatArray] = {}
    if named:
        base = max(dict.fromkeys(named), key=named.count)
        seen_by_base = {v.capture: placed for v, placed in joint if v.sensor == base}
        rig[base] = np.eye(4)
        for view, placed in joint:
            if view.capture in seen_by_base and view.sensor not in rig:
                rig[view.sensor] = placed @ inverse(seen_by_base[view.capture])
    captures: dict[str, FloatArray] = {}
    for i, (view, placed) in enumerate(zip(views, poses, strict=True)):
        base2sensor = rig[view.sensor] if view.capture and view.sensor in rig else np.eye(4)
        captures.setdefault(_capture_of(i, view, rig), inverse(base2sensor) @ placed)
    return rig, captures


def _capture_of(number: int, view: MarkerView, rig: dict[str, FloatArray] | dict[str, int]) -> str:
    shared = view.capture and view.sensor in rig
    return f"capture {view.capture}" if shared else f"picture {number}"


def linked_faces(system: ReferenceSystem, views: Sequence[MarkerView]) -> tuple[Faces, ...]:
    """Partition the faces into groups that are connected by links.

    A picture links the faces of which it shows four markers each. Two sensors that did not move
    relative to each other, each in front of its own face, link these faces if the system was turned
    between the captures about two axes: then the same pose between the sensors must explain all
    captures (as in a hand-eye calibration).

    Parameters
    ----------
    system
        As planned.
    views
        All pictures of it.

    Returns
    -------
    tuple of Faces
        Each group in the order of the system's faces.
    """
    group = {marker.face: marker.face for marker in system.markers}
    for a, b in [*_seen_together(system, views), *_by_rig(system, views)]:
        old, new = group[b], group[a]
        group = {face: new if first == old else first for face, first in group.items()}
    members: dict[str, list[str]] = defaultdict(list)
    for face, first in group.items():
        members[first].append(face)
    return tuple(tuple(faces) for faces in members.values())


def _seen_together(
    system: ReferenceSystem, views: Sequence[MarkerView]
) -> Iterator[tuple[str, str]]:
    for view in views:
        yield from combinations(_faces_of(system, view), 2)


def _by_rig(system: ReferenceSystem, views: Sequence[MarkerView]) -> Iterator[tuple[str, str]]:
    planned = {marker.id: np.array(marker.position_mm) for marker in system.markers}
    captures: dict[str, list[MarkerView]] = defaultdict(list)
    for view in views:
        if view.capture:
            captures[view.capture].append(view)
    turns: dict[tuple[str, str, str, str], list[FloatArray]] = defaultdict(list)
    for listed in captures.values():
        for a, b in combinations(sorted(listed, key=lambda view: view.sensor), 2):
            for one in _faces_of(system, a):
                for other in _faces_of(system, b):
                    if a.sensor != b.sensor and one != other:
                        turn = planned_pose(planned, a)[:3, :3]
                        turns[a.sensor, one, b.sensor, other].append(turn)
    for (_, one, _, other), poses in turns.items():
        if _turned_about_two_axes(poses):
            yield one, other


def _faces_of(system: ReferenceSystem, view: MarkerView) -> Faces:
    seen = [marker.face for marker in system.markers if marker.id in view.pixels]
    return tuple(face for face in dict.fromkeys(seen) if seen.count(face) >= _LEAST_OF_FACE)


def _turned_about_two_axes(poses: Sequence[FloatArray]) -> bool:
    if len(poses) < _LEAST_CAPTURES:
        return False
    turns = [cv2.Rodrigues(poses[0].T @ one)[0].ravel() for one in poses[1:]]
    # The second singular value measures the turns about the axis with the second most of them.
    return bool(np.linalg.svd(np.array(turns))[1][1] > np.radians(_LEAST_TURN_DEG))
