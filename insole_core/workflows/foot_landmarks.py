"""The landmarks of the open foot: found by its shape, and put right by hand."""

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
"""Those that the thesis and the prescription ask for; all can be shown."""


class Marked(Protocol):
    """A foot with what was marked on it: one of a case, or the one at hand."""

    @property
    def foot(self) -> Foot | None:
        """The foot, once there is one."""
        ...

    @property
    def annotations(self) -> Annotations:
        """What was marked on it."""
        ...


def landmarks_of(record: Marked) -> dict[str, Landmark]:
    """Give the landmarks of a foot; empty before there is one.

    A key point with the name of a landmark is that landmark, set by hand.
    """
    if record.foot is None:
        return {}
    by_hand = {p.name: p.position_mm for p in record.annotations.key_points if p.name in NAMES}
    return with_places(record.foot, find_landmarks(record.foot), by_hand)


def confirmed(record: CaseRecord) -> Annotations:
    """Take all landmarks as they are shown, as if each had been set by hand."""
    annotations = record.annotations
    for name, landmark in landmarks_of(record).items():
        if name in SHOWN:
            x, y, z = (round(float(value), 2) for value in landmark.point)
            annotations = annotations.with_key_point(KeyPoint(name, (x, y, z)))
    return annotations


def found_anew(annotations: Annotations) -> Annotations:
    """Forget what was set by hand; free points stay."""
    kept = tuple(point for point in annotations.key_points if point.name not in NAMES)
    return replace(annotations, key_points=kept)


def metatarsal_line(record: CaseRecord) -> FloatArray | None:
    """Give the line of the heads 2 – 4 on the sole, (3, 3) mm; None before there is a foot."""
    landmarks = landmarks_of(record)
    if not landmarks:
        return None
    return np.array([landmarks[name].point for name in METATARSAL_LINE])
