"""Reference systems as JSON, and checks whether they determine a sensor's pose well."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path

import numpy as np

from insole_core.files.atomic import write_text
from insole_core.geometry.absolute_orientation import absolute_orientation
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.transforms import rotation_angle_deg, transform
from insole_core.json_object import JsonObject
from insole_core.messages import Message
from insole_core.recording.manifest_json import parse_reference_system, reference_system_json
from insole_core.recording.session import Marker, ReferenceSystem

_LEAST_MARKERS = 4
_SYMMETRY_MM = 8.0
"""Nearer to itself than this after a turn, a face is ambiguous."""
_LEAST_TURN_DEG = 20.0
"""Least angle of a turn that counts; after a smaller one every face looks like itself."""
_SAME_MM = 25.0
_SAME_AREA = 0.5
_MATCHED_SHARE = 0.75
"""Share of the markers that a turn must bring near to another marker."""
_MARKER_MM = 16.0
_LEAST_CLEAR_DEG = 20.0
"""Deviation of a sensor that is set up by eye from its intended direction."""
_MOST_TILT_DEG = 60
_LEAST_RELIEF_MM = 5.0
_NEAREST_MM = 20.0


def load_reference_system(path: Path) -> ReferenceSystem:
    """Read a reference system.

    Raises
    ------
    InputError
        Naming the key of the first violation.
    """
    root = JsonObject.read(path)
    system = parse_reference_system(root)
    if len(system.markers) < _LEAST_MARKERS:
        raise root.fail(
            "markers", "has {count} markers, but at least 4 are needed", count=len(system.markers)
        )
    return system


def save_reference_system(system: ReferenceSystem, path: Path) -> None:
    """Write a reference system.

    Raises
    ------
    InputError
        If it could not be read again as it is.
    OutputError
        If the path cannot be written.
    """
    text = json.dumps(reference_system_json(system), indent=1) + "\n"
    parse_reference_system(JsonObject.parse(path.name, text.encode()))
    write_text(text, path)


@dataclass(frozen=True)
class FaceCheck:
    """How well the markers of one face determine the pose of a sensor.

    Parameters
    ----------
    symmetry_mm
        Root mean square distance of the markers from themselves after the turn, about any axis,
        that comes nearest to mapping the face onto itself: large is good.
    symmetry_turn_deg
        The angle of that turn.
    relief_mm
        Depth of the face across its best plane; a flat face determines a tilt poorly.
    nearest_mm
        Distance of its two nearest markers.
    seen_from
        Unit vector, reference frame, towards the sensor that sees the face best: across its plane,
        away from the markers of the other faces (or the origin), between which the foot is.
    clear_to_deg
        How far a sensor may be off that direction, to any side, before two of the markers hide
        each other.
    problems
        Sentences; empty if the face is fit for use.
    """

    face: str
    markers: int
    symmetry_mm: float
    symmetry_turn_deg: float
    relief_mm: float
    nearest_mm: float
    seen_from: tuple[float, float, float]
    clear_to_deg: float
    problems: tuple[str, ...]


def check_reference_system(system: ReferenceSystem) -> tuple[FaceCheck, ...]:
    """Check every face: enough markers, asymmetric, not flat, and not too close together."""
    faces = dict.fromkeys(marker.face for marker in system.markers)
    return tuple(
        _check_face(
            face,
            positions(system.facing((face,))),
            positions([marker for marker in system.markers if marker.face != face]),
        )
        for face in faces
    )


def positions(markers: Sequence[Marker]) -> FloatArray:
    """Return the positions of markers, (n, 3) float64, mm, reference frame."""
    return np.array([marker.position_mm for marker in markers], dtype=float).reshape(-1, 3)


def _check_face(face: str, points: FloatArray, others: FloatArray) -> FaceCheck:
    if len(points) < _LEAST_MARKERS:
        problem = Message(
            "the face has {count} markers, but at least {least} are needed",
            count=len(points),
            least=_LEAST_MARKERS,
        )
        return FaceCheck(face, len(points), 0.0, 0.0, 0.0, 0.0, (0.0, 0.0, 0.0), 0.0, (problem,))
    (symmetry, turn), relief = _symmetry(points), _relief_mm(points)
    nearest = min(float(np.linalg.norm(a - b)) for a, b in combinations(points, 2))
    normal = _towards_sensor(points, others)
    clear = _clear_to_deg(points, normal)
    problems: list[str] = []
    if symmetry < _SYMMETRY_MM:
        problems.append(
            Message(
                "turned by {turn_deg:.0f}°, it looks like itself within {apart_mm:.1f} mm; move "
                "some markers by a few studs so that it is less regular",
                turn_deg=turn,
                apart_mm=symmetry,
            )
        )
    if relief < _LEAST_RELIEF_MM:
        problems.append(
            Message(
                "its markers lie within {relief_mm:.1f} mm of one plane; raise some of them by a "
                "brick",
                relief_mm=relief,
            )
        )
    if nearest < _NEAREST_MM:
        problems.append(
            Message(
                "two of its markers are only {apart_mm:.0f} mm apart; move them apart",
                apart_mm=nearest,
            )
        )
    elif clear < _LEAST_CLEAR_DEG:
        problems.append(
            Message(
                "two of its markers hide each other when it is seen from {turn_deg:.0f}° aside; "
                "move them apart across the face",
                turn_deg=clear,
            )
        )
    x, y, z = normal.tolist()
    return FaceCheck(
        face, len(points), symmetry, turn, relief, nearest, (x, y, z), clear, tuple(problems)
    )


def _relief_mm(points: FloatArray) -> float:
    return float(np.ptp((points - points.mean(0)) @ _across(points)))


def _across(points: FloatArray) -> FloatArray:
    """Return the normal (3,) of the best-fitting plane."""
    return np.asarray(np.linalg.svd(points - points.mean(0))[2][2])


def _towards_sensor(points: FloatArray, others: FloatArray) -> FloatArray:
    normal, behind = _across(points), others.mean(0) if len(others) else np.zeros(3)
    return normal if normal @ (points.mean(0) - behind) > 0 else -normal


def _clear_to_deg(points: FloatArray, normal: FloatArray) -> float:
    """Tilt the view until the nearest two markers, as seen from there, come within a marker."""
    first = np.linalg.svd(normal[None])[2][1]
    sides = [
        np.cos(a) * first + np.sin(a) * np.cross(normal, first)
        for a in np.radians(np.arange(0, 360, 15))
    ]
    between = np.array([a - b for a, b in combinations(points, 2)])
    for tilt in range(0, _MOST_TILT_DEG + 1, 5):
        a = np.radians(tilt)
        looks = np.array([np.cos(a) * normal + np.sin(a) * side for side in sides])
        apart = np.linalg.norm(np.cross(between[:, None], looks[None]), axis=-1)
        if apart.min() < _MARKER_MM:
            return float(max(tilt - 5, 0))
    return float(_MOST_TILT_DEG)


def _symmetry(points: FloatArray) -> tuple[float, float]:
    """Find the turn about any axis that best maps the markers onto themselves: mm and degrees.

    Every such turn takes the widest triangle to three markers with the same distances; each of
    those is tried.
    """
    centred, across = points - points.mean(0), _across(points)
    base = _widest_triangle(centred)
    best, best_turn = np.inf, 0.0
    for triple in _congruent(centred, base):
        turned = transform(absolute_orientation(centred[base], centred[triple]).a2b, centred)
        nearest = np.linalg.norm(turned[:, None] - centred[None], axis=-1).argmin(1)
        if len(np.unique(nearest)) < _MATCHED_SHARE * len(points):
            continue
        fitted = absolute_orientation(centred, centred[nearest]).a2b
        turn = rotation_angle_deg(fitted[:3, :3])
        if turn < _LEAST_TURN_DEG or (fitted[:3, :3] @ across) @ across < 0:
            continue  # too small a turn, or one that turns the face away from its sensor
        distance = np.linalg.norm(transform(fitted, centred)[:, None] - centred[None], axis=-1).min(
            1
        )
        rms = float(np.sqrt((distance**2).mean()))
        if rms < best:
            best, best_turn = rms, turn
    return best, best_turn


def _widest_triangle(points: FloatArray) -> IntArray:
    triples = np.array(list(combinations(range(len(points)), 3)))
    return np.asarray(triples[np.argmax(_areas(points, triples))])


def _congruent(points: FloatArray, base: IntArray) -> IntArray:
    """Return ordered triples (k, 3) of markers with approximately the distances of the base."""
    distance = np.linalg.norm(points[:, None] - points[None], axis=-1)
    i, j, k = base
    close = [np.abs(distance - distance[p, q]) < _SAME_MM for p, q in ((i, j), (j, k), (i, k))]
    triples = np.argwhere(close[0][:, :, None] & close[1][None] & close[2][:, None])
    # Three collinear markers determine no turn.
    return np.asarray(triples[_areas(points, triples) > _SAME_AREA * _areas(points, base[None])])


def _areas(points: FloatArray, triples: IntArray) -> FloatArray:
    a, b, c = (points[triples[:, corner]] for corner in range(3))
    return np.asarray(np.linalg.norm(np.cross(b - a, c - a), axis=-1) / 2)


@dataclass(frozen=True)
class BumpCheck:
    """Comparison of measured marker positions with the stored reference system.

    Parameters
    ----------
    rms_mm
        Of the markers after the best rigid fit to the stored positions.
    moved
        Names of the markers that moved, with the distance in mm.
    """

    rms_mm: float
    moved: dict[str, float]

    @property
    def bumped(self) -> bool:
        """Whether any marker moved."""
        return bool(self.moved)


def check_for_bump(
    system: ReferenceSystem, measured_mm: dict[str, FloatArray], limit_mm: float = 1.0
) -> BumpCheck:
    """Compare measured marker positions (any frame) with the stored ones.

    Markers that moved must not distort the comparison, so the fit is repeated without the worst
    marker until the rest agrees.

    Parameters
    ----------
    measured_mm : marker id to (3,) float64, mm
        In any one frame; markers that are missing are not compared.
    limit_mm
        A marker further off than this counts as moved.

    Raises
    ------
    ReconstructionError
        If fewer than three of its markers were measured.
    """
    known = [marker for marker in system.markers if marker.id in measured_mm]
    stored = positions(known)
    seen = np.array([measured_mm[marker.id] for marker in known], dtype=float).reshape(-1, 3)
    weight = np.ones(len(known))
    while True:
        seen2reference = absolute_orientation(seen, stored, weight).a2b
        off = np.linalg.norm(transform(seen2reference, seen) - stored, axis=1)
        worst = int(np.argmax(np.where(weight > 0, off, -1)))
        if off[worst] <= limit_mm or weight.sum() <= _LEAST_MARKERS:
            break
        weight[worst] = 0
    moved = {
        marker.id: float(distance)
        for marker, distance in zip(known, off, strict=True)
        if distance > limit_mm
    }
    return BumpCheck(float(np.sqrt((off**2).mean())), moved)
