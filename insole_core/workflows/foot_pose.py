"""Change the pose of a foot together with its annotations and prescriptions."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from insole_core.cases.case_record import Annotations, CaseRecord, FootRecord, KeyPoint
from insole_core.foot.alignment import PoseAngles, levelled, quarter_turned, turned
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import inverse, transform
from insole_core.insole.fields import Place
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.mirroring import moved
from insole_core.workflows.foot_landmarks import confirmed, landmarks_of


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
    points = tuple(KeyPoint(p.name, _point(step, p.position_mm)) for p in annotations.key_points)
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
