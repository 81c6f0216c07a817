"""Landmarks of the open foot and its pose: detected from its shape, corrected by hand."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol
from weakref import WeakKeyDictionary

import numpy as np

from insole_core.cases.case_record import (
    Annotations,
    CaseRecord,
    FootRecord,
    Found,
    KeyPoint,
)
from insole_core.foot.alignment import PoseAngles, levelled, quarter_turned, turned
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import NAMES, Landmark, find_landmarks, with_places
from insole_core.foot.skin_marks import SkinMark, skin_marks
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import inverse, transform
from insole_core.insole.fields import Place
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.template import moved

_METATARSAL_LINE = ("metatarsal_head_2", "metatarsal_head_3", "metatarsal_head_4")
SHOWN = (
    "pternion",
    "heel_centre",
    "metatarsal_head_1",
    "metatarsal_head_2",
    "metatarsal_head_5",
    "toe_tip_1",
    "toe_tip_2",
    "arch_apex",
    "achilles_lower",
    "achilles_upper",
    "calcaneus_lower",
    "calcaneus_upper",
)
"""Landmarks that the thesis and the prescription need; all of them can be displayed."""
_MEANINGS = 2
"""Number of nearest landmarks offered for a mark."""


class Marked(Protocol):
    """A foot with annotations: that of a record, or the current one of a case."""

    @property
    def foot(self) -> Foot | None:
        """The foot; None before there is one."""
        ...

    @property
    def annotations(self) -> Annotations:
        """Marks on the foot."""
        ...


def landmarks_of(record: Marked) -> dict[str, Landmark]:
    """Return the landmarks of a foot by name; empty before there is a foot.

    A key point with the name of a landmark replaces the detected one; where that was only
    confirmed, it is as sure as it was.
    """
    if record.foot is None:
        return {}
    points = [point for point in record.annotations.key_points if point.name in NAMES]
    by_hand = {point.name: point.position_mm for point in points if point.found is None}
    confirmed_ones = {
        point.name: Landmark(np.array(point.position_mm), **vars(point.found))
        for point in points
        if point.found is not None
    }
    return with_places(record.foot, find_landmarks(record.foot), by_hand) | confirmed_ones


def with_landmarks(record: CaseRecord) -> CaseRecord:
    """Find the landmarks of all feet of a record, which keep them; for whoever reads it in a job.

    Returns
    -------
    CaseRecord
        The same record.
    """
    for foot in record.feet:
        landmarks_of(foot)
    return record


def confirmed(record: CaseRecord) -> Annotations:
    """Return the annotations with all displayed landmarks fixed, each as sure as it was."""
    annotations = record.annotations
    for name, landmark in landmarks_of(record).items():
        if name in SHOWN:
            x, y, z = (round(float(value), 2) for value in landmark.point)
            point = KeyPoint(name, (x, y, z), _found(landmark))
            annotations = annotations.with_key_point(point)
    return annotations


def _found(landmark: Landmark) -> Found | None:
    if landmark.origin == "hand":
        return None
    return Found(landmark.confidence, landmark.deviation_mm, landmark.is_coarse)


def found_anew(annotations: Annotations) -> Annotations:
    """Remove the landmarks that were set manually; other key points stay."""
    kept = tuple(point for point in annotations.key_points if point.name not in NAMES)
    return replace(annotations, key_points=kept)


def metatarsal_line(record: CaseRecord) -> FloatArray | None:
    """Return the line of the metatarsal heads 2 - 4 on the sole.

    Returns
    -------
    (3, 3) float64, mm, insole frame
        None before there is a foot.
    """
    landmarks = landmarks_of(record)
    if not landmarks:
        return None
    return np.array([landmarks[name].point for name in _METATARSAL_LINE])


def turned_record(record: CaseRecord, angles: PoseAngles) -> FootRecord:
    """Rotate the current foot to given angles; its landmarks count as confirmed.

    Parameters
    ----------
    record
        With a current foot.
    angles
        Against the frame of the landmarks; all 0 aligns the foot.

    Raises
    ------
    InputError
        When the landmarks are not plausible for a foot.
    """
    current = _current(record)
    foot = turned(current.foot, landmarks_of(record), angles)
    return lying_anew(replace(current, annotations=confirmed(record)), foot)


def quarter_turned_record(record: CaseRecord, axis: int, quarters: int) -> FootRecord:
    """Rotate the current foot by right angles; its landmarks are looked for again.

    Parameters
    ----------
    record
        With a current foot.
    axis, quarters
        As for `quarter_turned`.
    """
    current = _current(record)
    return _without_landmarks(lying_anew(current, quarter_turned(current.foot, axis, quarters)))


def levelled_record(record: CaseRecord) -> FootRecord:
    """Let the current foot rest on its sole; its landmarks are looked for again.

    Raises
    ------
    InputError
        When nothing of the foot faces the ground.
    """
    current = _current(record)
    return _without_landmarks(lying_anew(current, levelled(current.foot)))


def _current(record: CaseRecord) -> FootRecord:
    assert record.current is not None, "only a foot can be turned"
    return record.current


def _without_landmarks(record: FootRecord) -> FootRecord:
    """Forget landmarks, which were found or set on a foot that lay wrongly."""
    return replace(record, annotations=replace(record.annotations, key_points=()))


def lying_anew(record: FootRecord, foot: Foot) -> FootRecord:
    """Replace a foot by the same foot in another pose; move annotations and designs with it.

    Parameters
    ----------
    foot
        With the same source frame; its ``source2insole`` determines the motion.
    """
    step = foot.source2insole @ inverse(record.foot.source2insole)
    variants = (replace(v, design=_moved_design(v.design, step)) for v in record.variants)
    return replace(
        record,
        foot=foot,
        variants=tuple(variants),
        annotations=_moved_annotations(record.annotations, step),
        plantar=record.plantar.with_foot(step),
    )


def _moved_annotations(annotations: Annotations, step: FloatArray) -> Annotations:
    points = tuple(
        replace(p, position_mm=_point(step, p.position_mm)) for p in annotations.key_points
    )
    plane = annotations.plane
    if plane is not None:
        plane = replace(plane, origin_mm=_point(step, plane.origin_mm))
    return Annotations(points, plane)


def _moved_design(design: InsoleDesign, step: FloatArray) -> InsoleDesign:
    def move(place: Place) -> Place:
        x, y, _ = _point(step, (*place, 0.0))
        return x, y

    yaw_deg = float(np.degrees(np.arctan2(step[1, 0], step[0, 0])))
    lying = moved(design, move)
    return replace(lying, corrections=tuple(c.turned_by(yaw_deg) for c in lying.corrections))


def _point(step: FloatArray, place: tuple[float, ...]) -> tuple[float, float, float]:
    x, y, z = (round(float(v), 2) for v in transform(step, np.array([place]))[0])
    return x, y, z


@dataclass(frozen=True, eq=False)
class PenMark:
    """A mark and the names of the landmarks it may stand for, the nearest first."""

    mark: SkinMark
    meanings: tuple[str, ...]


class PenMarks:
    """Finds the marks of feet, once for each foot, since it takes a moment."""

    def __init__(self) -> None:
        self._found: WeakKeyDictionary[Foot, tuple[SkinMark, ...]] = WeakKeyDictionary()

    def of(self, record: CaseRecord) -> tuple[PenMark, ...]:
        """Return the marks on the current foot, the largest first."""
        if record.foot is None:
            return ()
        landmarks = landmarks_of(record)
        marks = self._found.get(record.foot)
        if marks is None:
            marks = self._found[record.foot] = skin_marks(record.foot, landmarks)
        places = {name: mark.point for name, mark in landmarks.items() if name in SHOWN}
        return tuple(
            PenMark(mark, tuple(_nearest(mark.point, places)[:_MEANINGS])) for mark in marks
        )


def _nearest(point: np.ndarray, places: dict[str, np.ndarray]) -> list[str]:
    return sorted(places, key=lambda name: float(np.linalg.norm(places[name] - point)))
