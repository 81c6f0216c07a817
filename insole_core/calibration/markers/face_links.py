"""Which faces of a reference system can be measured together."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from itertools import combinations

import cv2
import numpy as np

from insole_core.calibration.markers.marker_bundle import MarkerView, planned_pose
from insole_core.geometry.arrays import FloatArray
from insole_core.recording.session import ReferenceSystem

Faces = tuple[str, ...]
_LEAST_OF_FACE = 4
_LEAST_CAPTURES = 3
_LEAST_TURN_DEG = 10.0


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
