"""True marker positions of a built reference system, from many pictures (bundle adjustment)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np

from insole_core.calibration.adjustment import Blocks, adjust, pose, pose_vector
from insole_core.calibration.reference_file import positions
from insole_core.errors import CalibrationError
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.horn import absolute_orientation
from insole_core.geometry.transforms import rigid, transform
from insole_core.recording.session import Marker, ReferenceSystem
from insole_core.sensing.camera import Camera

_LEAST_SEEN = 4
_LEAST_VIEWS = 3
_OUTLIER_PX = 1.5


@dataclass(frozen=True, eq=False)
class MarkerView:
    """The markers that one picture shows.

    Parameters
    ----------
    name
        Of the picture.
    pixels : marker id to (2,) float64, px
    camera
        That took it.
    """

    name: str
    pixels: dict[str, FloatArray]
    camera: Camera


@dataclass(frozen=True)
class KnownLength:
    """A measured distance between two markers, which gives the scale."""

    first: str
    second: str
    length_mm: float


@dataclass(frozen=True, eq=False)
class MarkerSurvey:
    """A measured reference system.

    Parameters
    ----------
    system
        As it was built, in the frame of the plan.
    deviation_mm : marker id to (3,) float64
        Standard deviations of the position; zero for a marker that was not surveyed.
    rms_px
    largest_change_mm
        How far a marker lies from the plan at most.
    unseen
        Markers that too few pictures show; they keep their place in the plan.
    """

    system: ReferenceSystem
    deviation_mm: dict[str, FloatArray]
    rms_px: float
    largest_change_mm: float
    unseen: tuple[str, ...]

    @property
    def measured_mm(self) -> dict[str, FloatArray]:
        """The surveyed markers' own positions, (3,) mm, in the frame of the plan."""
        return {
            marker.id: np.array(marker.position_mm)
            for marker in self.system.markers
            if marker.id not in self.unseen
        }


def survey_markers(
    plan: ReferenceSystem, views: Sequence[MarkerView], length: KnownLength
) -> MarkerSurvey:
    """Measure where the markers of a built system really are.

    Parameters
    ----------
    plan
        Where they should be.
    views
        Pictures from many sides; each shows four markers or more.
    length
        A length measured by hand.

    Raises
    ------
    CalibrationError
        With too few pictures or markers, or a length between markers that were not seen.
    """
    planned = {marker.id for marker in plan.markers}
    sighted = [view for view in views if len(planned & view.pixels.keys()) >= _LEAST_SEEN]
    counts = {m.id: sum(m.id in view.pixels for view in sighted) for m in plan.markers}
    known = [marker for marker in plan.markers if counts[marker.id] >= 2]
    _check(len(sighted), known, length)
    problem = _Problem([m.id for m in known], sighted, length)
    start = problem.start(positions(known))
    found = adjust(problem.residuals, start, problem.blocks(), robust=_OUTLIER_PX)
    free = found.values[: 3 * len(known)].reshape(-1, 3)
    own2plan = absolute_orientation(free, positions(known)).a2b
    placed = transform(own2plan, free)
    deviation = found.deviations[: 3 * len(known)].reshape(-1, 3)
    moved = {m.id: point for m, point in zip(known, placed, strict=True)}
    image = found.residuals[: problem.image_residuals]
    return MarkerSurvey(
        system=replace(
            plan, markers=tuple(_moved(marker, moved.get(marker.id)) for marker in plan.markers)
        ),
        deviation_mm={m.id: np.zeros(3) for m in plan.markers}
        | {m.id: one for m, one in zip(known, deviation, strict=True)},
        rms_px=float(np.sqrt((image**2).mean() * 2)),
        largest_change_mm=float(np.linalg.norm(placed - positions(known), axis=1).max()),
        unseen=tuple(marker.id for marker in plan.markers if marker.id not in moved),
    )


class _Problem:
    """Unknowns: all marker positions, then a pose of the camera for every picture.

    Three weak conditions hold the frame near the plan, one strong one the scale.
    """

    def __init__(self, ids: list[str], views: Sequence[MarkerView], length: KnownLength) -> None:
        place = {name: i for i, name in enumerate(ids)}
        self._seen: list[IntArray] = []
        self._pixels: list[FloatArray] = []
        for view in views:
            names = [name for name in view.pixels if name in place]
            self._seen.append(np.array([place[name] for name in names]))
            self._pixels.append(np.array([view.pixels[name] for name in names], dtype=float))
        self._cameras, self._count = [view.camera for view in views], len(ids)
        self._ends = [place[length.first], place[length.second]]
        self._length = length.length_mm
        self._plan = np.zeros((len(ids), 3))

    @property
    def image_residuals(self) -> int:
        return sum(2 * len(pixels) for pixels in self._pixels)

    def start(self, planned: FloatArray) -> FloatArray:
        a, b = planned[self._ends]
        # The plan is scaled to the known length first; the frame stays that of the plan.
        self._plan = planned * (self._length / np.linalg.norm(a - b))
        poses = [
            _picture_pose(self._plan[seen], pixels, camera)
            for seen, pixels, camera in zip(self._seen, self._pixels, self._cameras, strict=True)
        ]
        return np.concatenate([self._plan.ravel(), *[pose_vector(one) for one in poses]])

    def residuals(self, unknowns: FloatArray) -> FloatArray:
        points = unknowns[: 3 * self._count].reshape(-1, 3)
        poses = unknowns[3 * self._count :].reshape(-1, 6)
        parts = []
        seen_by = zip(self._seen, self._pixels, self._cameras, poses, strict=True)
        for seen, pixels, camera, vector in seen_by:
            inside = transform(pose(vector), points[seen])
            parts.append((pixels - camera.project(inside)).ravel())
        return np.concatenate([*parts, self._conditions(points)])

    def blocks(self) -> Blocks:
        lengths = [2 * len(pixels) for pixels in self._pixels]
        # The conditions depend on no pose: they close the last block.
        lengths[-1] += 7
        return Blocks(tuple(lengths), 3 * self._count)

    def _conditions(self, points: FloatArray) -> FloatArray:
        change = points - self._plan
        turn = np.cross(self._plan - self._plan.mean(0), change).mean(0) / 100
        a, b = points[self._ends]
        scale = (np.linalg.norm(a - b) - self._length) * 10
        return np.concatenate([change.mean(0), turn, [scale]])


def _picture_pose(points: FloatArray, pixels: FloatArray, camera: Camera) -> FloatArray:
    rays = camera.normalised(pixels)
    _, turn, shift = cv2.solvePnP(points, rays, np.eye(3), None, flags=cv2.SOLVEPNP_SQPNP)
    return rigid(cv2.Rodrigues(turn)[0], shift.ravel())


def _moved(marker: Marker, place: FloatArray | None) -> Marker:
    if place is None:
        return marker
    x, y, z = place.tolist()
    return replace(marker, position_mm=(x, y, z))


def _check(views: int, known: Sequence[Marker], length: KnownLength) -> None:
    if views < _LEAST_VIEWS or len(known) < _LEAST_SEEN:
        raise CalibrationError(
            f"{views} pictures show enough markers and {len(known)} markers are seen twice; take "
            f"at least {_LEAST_VIEWS} pictures (better 15) from all sides."
        )
    missing = {length.first, length.second} - {marker.id for marker in known}
    if missing:
        raise CalibrationError(
            f"The known length ends at {', '.join(sorted(missing))}, which the pictures do not "
            "show twice; take more pictures or measure between other markers."
        )
    if not length.length_mm > 0 or length.first == length.second:
        raise CalibrationError("Give the known length in mm, between two different markers.")
