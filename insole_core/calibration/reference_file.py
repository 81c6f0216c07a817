"""Reference systems as JSON, and whether one is fit to tell where a sensor stands."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path

import numpy as np

from insole_core.errors import InputError
from insole_core.export.atomic import replacing_file
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.horn import absolute_orientation
from insole_core.geometry.transforms import transform
from insole_core.json_object import JsonObject
from insole_core.recording.session import Marker, ReferenceSystem

_LEAST_MARKERS = 4
_SYMMETRY_MM = 8.0
"""Nearer to itself than this after a half or quarter turn, a face could be taken the wrong way."""
_LEAST_RELIEF_MM = 5.0
_NEAREST_MM = 20.0


def load_reference_system(path: Path) -> ReferenceSystem:
    """Read a reference system.

    Raises
    ------
    InputError
        Names the key of the first violation.
    """
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path} cannot be read ({error.strerror}); name the file.") from error
    root = JsonObject.parse(path.name, content)
    markers = tuple(_marker(item) for item in root.objects("markers"))
    if len({marker.id for marker in markers}) < len(markers):
        raise root.fail("markers", "names the same marker id twice")
    if len(markers) < _LEAST_MARKERS:
        raise root.fail("markers", f"has {len(markers)} markers, but at least 4 are needed")
    return ReferenceSystem(root.text("name"), markers)


def save_reference_system(system: ReferenceSystem, path: Path) -> None:
    """Write a reference system.

    Raises
    ------
    OutputError
    """
    values = {
        "name": system.name,
        "markers": [
            {"id": m.id, "position_mm": list(m.position_mm), "face": m.face} for m in system.markers
        ],
    }
    with replacing_file(path) as beside:
        beside.write_text(json.dumps(values, indent=1) + "\n", encoding="utf-8")


@dataclass(frozen=True)
class FaceCheck:
    """How well the markers of one face tell where a sensor stands.

    Parameters
    ----------
    face
    markers
    symmetry_mm
        Root mean square distance of the markers from themselves after the turn that comes nearest
        to mapping the face onto itself: large is good.
    relief_mm
        Depth of the face across its best plane; a flat face tells a tilt poorly.
    nearest_mm
        Distance of its two nearest markers.
    problems
        Sentences; empty when the face is fit.
    """

    face: str
    markers: int
    symmetry_mm: float
    relief_mm: float
    nearest_mm: float
    problems: tuple[str, ...]


def check_reference_system(system: ReferenceSystem) -> tuple[FaceCheck, ...]:
    """Check every face: enough markers, asymmetric enough, not flat, not too near together."""
    faces = dict.fromkeys(marker.face for marker in system.markers)
    return tuple(_check_face(face, positions(system.facing((face,)))) for face in faces)


def positions(markers: Sequence[Marker]) -> FloatArray:
    """(n, 3) float64, mm, reference frame."""
    return np.array([marker.position_mm for marker in markers], dtype=float).reshape(-1, 3)


def _marker(item: JsonObject) -> Marker:
    x, y, z = item.numbers("position_mm", 3)
    return Marker(item.text("id"), (x, y, z), item.text("face"))


def _check_face(face: str, points: FloatArray) -> FaceCheck:
    if len(points) < _LEAST_MARKERS:
        problem = f"the face has {len(points)} markers, but at least {_LEAST_MARKERS} are needed"
        return FaceCheck(face, len(points), 0.0, 0.0, 0.0, (problem,))
    symmetry, relief = _symmetry_mm(points), _relief_mm(points)
    nearest = min(float(np.linalg.norm(a - b)) for a, b in combinations(points, 2))
    problems = []
    if symmetry < _SYMMETRY_MM:
        problems.append(
            f"turned, it looks like itself within {symmetry:.1f} mm; move some markers by a few "
            "studs so that it is less regular"
        )
    if relief < _LEAST_RELIEF_MM:
        problems.append(
            f"its markers lie within {relief:.1f} mm of one plane; raise some of them by a brick"
        )
    if nearest < _NEAREST_MM:
        problems.append(f"two of its markers are only {nearest:.0f} mm apart; move them apart")
    return FaceCheck(face, len(points), symmetry, relief, nearest, tuple(problems))


def _relief_mm(points: FloatArray) -> float:
    centred = points - points.mean(0)
    off = centred @ np.linalg.svd(centred)[2][2]
    return float(np.ptp(off))


def _symmetry_mm(points: FloatArray) -> float:
    """Turn the face in its plane by 90, 180 and 270 degrees and match it with itself."""
    centred = points - points.mean(0)
    axes = np.linalg.svd(centred)[2]
    flat = centred @ axes.T
    worst = np.inf
    for turn in (90, 180, 270):
        a = np.radians(turn)
        turned = flat @ np.array([[np.cos(a), np.sin(a), 0], [-np.sin(a), np.cos(a), 0], [0, 0, 1]])
        distance = np.linalg.norm(turned[:, None] - flat[None], axis=-1)
        worst = min(worst, float(np.sqrt((distance.min(1) ** 2).mean())))
    return worst


@dataclass(frozen=True)
class BumpCheck:
    """Whether the reference system still is what it was.

    Parameters
    ----------
    rms_mm
        Of the markers after the best rigid fit to what is stored.
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

    Markers that moved must not spoil the comparison, so the fit is repeated without the worst
    marker until the rest agrees.

    Raises
    ------
    ReconstructionError
        When fewer than three of its markers were measured.
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
