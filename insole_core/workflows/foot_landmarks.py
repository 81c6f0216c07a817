"""Landmarks of the open foot: detected from its shape, and corrected manually."""

from __future__ import annotations

from dataclasses import replace
from typing import Protocol

import numpy as np

from insole_core.cases.case_record import Annotations, CaseRecord, KeyPoint
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import NAMES, Landmark, find_landmarks, with_places
from insole_core.geometry.arrays import FloatArray

METATARSAL_LINE = ("metatarsal_head_2", "metatarsal_head_3", "metatarsal_head_4")
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

    A key point with the name of a landmark replaces the detected one.
    """
    if record.foot is None:
        return {}
    by_hand = {p.name: p.position_mm for p in record.annotations.key_points if p.name in NAMES}
    return with_places(record.foot, find_landmarks(record.foot), by_hand)


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
    """Return the annotations with all displayed landmarks as if set manually."""
    annotations = record.annotations
    for name, landmark in landmarks_of(record).items():
        if name in SHOWN:
            x, y, z = (round(float(value), 2) for value in landmark.point)
            annotations = annotations.with_key_point(KeyPoint(name, (x, y, z)))
    return annotations


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
    return np.array([landmarks[name].point for name in METATARSAL_LINE])
