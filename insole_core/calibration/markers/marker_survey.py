"""True marker positions of a built reference system, from many pictures (bundle adjustment).

All faces are measured in one adjustment where something links them: pictures that show enough
markers of both, or sensors that did not move relative to each other while the system was turned in
front of them. Faces without a link are measured separately.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from insole_core.calibration.markers.marker_bundle import (
    Adjusted,
    Faces,
    KnownLength,
    MarkerView,
    adjust_bundle,
    linked_faces,
)
from insole_core.calibration.markers.reference_file import BumpCheck, check_for_bump, positions
from insole_core.errors import CalibrationError
from insole_core.geometry.absolute_orientation import absolute_orientation
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import transform
from insole_core.messages import Message, joined
from insole_core.recording.session import Marker, ReferenceSystem

__all__ = ["KnownLength", "MarkerSurvey", "MarkerView", "check_survey", "survey_markers"]
_LEAST_SEEN = 4
_LEAST_VIEWS = 3


@dataclass(frozen=True, eq=False)
class MarkerSurvey:
    """A measured reference system.

    Parameters
    ----------
    system
        As it was built, in the frame of the plan.
    deviation_mm : marker id to (3,) float64
        Standard deviations of the position, within the faces that were measured together; zero
        for a marker that was not surveyed.
    largest_change_mm
        Greatest distance of a marker from the plan.
    unseen
        Markers that were not measured; they keep their planned position.
    together
        Faces that were measured in one adjustment, one tuple for each adjustment.
    left_out : face to reason
        Faces that could not be measured at all.
    """

    system: ReferenceSystem
    deviation_mm: dict[str, FloatArray]
    rms_px: float
    largest_change_mm: float
    unseen: tuple[str, ...]
    together: tuple[Faces, ...]
    left_out: dict[str, str]

    @property
    def measured_mm(self) -> dict[str, FloatArray]:
        """Positions of the surveyed markers, (3,) mm, in the frame of the plan."""
        return {
            marker.id: np.array(marker.position_mm)
            for marker in self.system.markers
            if marker.id not in self.unseen
        }

    @property
    def sentences(self) -> tuple[str, ...]:
        """Sentences on what was measured, and what stays as planned."""
        said: list[str] = [
            Message("The faces {faces} were measured together.", faces=joined(faces, " and "))
            for faces in self.together
            if len(faces) > 1
        ]
        said += [
            Message(
                "The face {face} was not measured and stays as planned: {reason}",
                face=face,
                reason=why,
            )
            for face, why in self.left_out.items()
        ]
        if len(self.together) > 1:
            said.append(
                Message(
                    "Nothing links {groups}: each was measured on its own, and their place to each "
                    "other stays as planned.",
                    groups=joined((joined(faces, " with ") for faces in self.together), " and "),
                )
            )
        return tuple(said)


def survey_markers(
    plan: ReferenceSystem, views: Sequence[MarkerView], lengths: Sequence[KnownLength]
) -> MarkerSurvey:
    """Measure the true positions of the markers of a built system.

    Parameters
    ----------
    plan
        The planned positions.
    views
        Pictures from many sides; each shows four markers or more.
    lengths
        Measured by hand: one for each group of linked faces.

    Returns
    -------
    MarkerSurvey
        In the frame of the plan, mm.

    Raises
    ------
    CalibrationError
        If there are too few pictures or markers, or a length is between markers that were not
        seen, or between faces without a link.
    """
    sighted = [view for view in views if len(_ids(plan) & view.pixels.keys()) >= _LEAST_SEEN]
    groups = linked_faces(plan, sighted)
    _check_lengths(plan, sighted, lengths, groups)
    parts: dict[Faces, _Part] = {}
    left_out: dict[str, str] = {}
    for faces in groups:
        part = _Part(replace(plan, markers=plan.facing(faces)), sighted, lengths)
        if why := part.problem():
            left_out |= dict.fromkeys(faces, why)
        else:
            parts[faces] = part
    if not parts:
        raise CalibrationError(next(iter(left_out.values())))
    return _joined(plan, {faces: part.measured() for faces, part in parts.items()}, left_out)


def check_survey(plan: ReferenceSystem, survey: MarkerSurvey, limit_mm: float = 1.0) -> BumpCheck:
    """Find markers that have moved, each relative to the faces measured together with its own.

    Parameters
    ----------
    plan
        The stored positions.
    limit_mm
        A marker further off than this counts as moved.
    """
    squares, count, moved = 0.0, 0, dict[str, float]()
    for faces in survey.together:
        part = replace(plan, markers=plan.facing(faces))
        measured = {name: p for name, p in survey.measured_mm.items() if name in _ids(part)}
        check = check_for_bump(part, measured, limit_mm)
        squares, count = squares + check.rms_mm**2 * len(measured), count + len(measured)
        moved |= check.moved
    return BumpCheck(float(np.sqrt(squares / count)), moved)


@dataclass(frozen=True, eq=False)
class _Measured:
    """Markers of faces that were measured together, with their accuracy."""

    markers: dict[str, Marker]
    std: dict[str, FloatArray]
    errors_px: FloatArray
    changes_mm: FloatArray


class _Part:
    """Faces that are measured together, with the pictures and lengths that show them."""

    def __init__(
        self, plan: ReferenceSystem, views: Sequence[MarkerView], lengths: Sequence[KnownLength]
    ) -> None:
        ids = _ids(plan)
        own = [replace(v, pixels={k: p for k, p in v.pixels.items() if k in ids}) for v in views]
        self._views = [view for view in own if len(view.pixels) >= _LEAST_SEEN]
        counts = {name: sum(name in view.pixels for view in self._views) for name in ids}
        self._known = [marker for marker in plan.markers if counts[marker.id] >= 2]
        self._lengths = [one for one in lengths if {one.first, one.second} <= ids]

    def problem(self) -> str:
        """Return why these faces cannot be measured; empty if they can."""
        if len(self._views) < _LEAST_VIEWS or len(self._known) < _LEAST_SEEN:
            return Message(
                "{pictures} pictures show enough markers and {markers} markers are seen twice; "
                "take at least {least} pictures (better 15) from all sides.",
                pictures=len(self._views),
                markers=len(self._known),
                least=_LEAST_VIEWS,
            )
        if not self._lengths:
            return "no length between two of its markers was given; measure one by hand."
        return ""

    def measured(self) -> _Measured:
        planned = positions(self._known)
        names = [marker.id for marker in self._known]
        solution = adjust_bundle(
            dict(zip(names, planned, strict=True)), self._known_views(names), self._lengths
        )
        placed = transform(absolute_orientation(solution.points, planned).a2b, solution.points)
        return self._measured(solution, placed, np.linalg.norm(placed - planned, axis=1))

    def _known_views(self, names: Sequence[str]) -> list[MarkerView]:
        """Drop markers that are seen once, and pictures that then show too few."""
        known = set(names)
        kept = [
            replace(view, pixels={k: p for k, p in view.pixels.items() if k in known})
            for view in self._views
        ]
        return [view for view in kept if len(view.pixels) >= _LEAST_SEEN]

    def _measured(
        self, solution: Adjusted, placed: FloatArray, changes_mm: FloatArray
    ) -> _Measured:
        names = [marker.id for marker in self._known]
        moved = [_moved(marker, at) for marker, at in zip(self._known, placed, strict=True)]
        return _Measured(
            dict(zip(names, moved, strict=True)),
            dict(zip(names, solution.std, strict=True)),
            solution.errors_px,
            changes_mm,
        )


def _joined(
    plan: ReferenceSystem, parts: dict[Faces, _Measured], left_out: dict[str, str]
) -> MarkerSurvey:
    markers = {name: marker for part in parts.values() for name, marker in part.markers.items()}
    std = {name: sd for part in parts.values() for name, sd in part.std.items()}
    errors = np.concatenate([part.errors_px for part in parts.values()])
    return MarkerSurvey(
        system=replace(plan, markers=tuple(markers.get(m.id, m) for m in plan.markers)),
        deviation_mm={m.id: std.get(m.id, np.zeros(3)) for m in plan.markers},
        rms_px=float(np.sqrt((errors**2).mean() * 2)),
        largest_change_mm=float(max(part.changes_mm.max() for part in parts.values())),
        unseen=tuple(m.id for m in plan.markers if m.id not in markers),
        together=tuple(parts),
        left_out=left_out,
    )


def _ids(system: ReferenceSystem) -> set[str]:
    return {marker.id for marker in system.markers}


def _moved(marker: Marker, place: FloatArray) -> Marker:
    x, y, z = place.tolist()
    return replace(marker, position_mm=(x, y, z))


def _check_lengths(
    plan: ReferenceSystem,
    views: Sequence[MarkerView],
    lengths: Sequence[KnownLength],
    groups: Sequence[Faces],
) -> None:
    face = {marker.id: marker.face for marker in plan.markers}
    together = {one: number for number, faces in enumerate(groups) for one in faces}
    for length in lengths:
        ends = (length.first, length.second)
        if not length.length_mm > 0 or length.first == length.second:
            raise CalibrationError("Give the known length in mm, between two different markers.")
        seldom = [
            end for end in ends
            if end not in face or (views and sum(end in view.pixels for view in views) < 2)
        ]  # fmt: skip
        if seldom:
            raise CalibrationError(
                "The known length ends at {markers}, which the pictures do not show twice; take "
                "more pictures or measure between other markers.",
                markers=joined(sorted(seldom)),
            )
        first, second = (face[end] for end in ends)
        if together[first] != together[second]:
            raise CalibrationError(
                "The known length goes from {first} on face {first_face} to {second} on face "
                "{second_face}, but nothing links these faces; measure between two markers of one "
                "face, or take pictures that show four markers of both.",
                first=length.first,
                first_face=first,
                second=length.second,
                second_face=second,
            )
