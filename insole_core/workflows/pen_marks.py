"""Pen marks on the skin of the current foot, and the landmarks they may stand for."""

from __future__ import annotations

from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from insole_core.cases.case_record import CaseRecord
from insole_core.foot.foot import Foot
from insole_core.foot.skin_marks import SkinMark, skin_marks
from insole_core.workflows.foot_landmarks import SHOWN, landmarks_of

MEANINGS = 2
"""Number of nearest landmarks offered for a mark."""


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
            PenMark(mark, tuple(_nearest(mark.point, places)[:MEANINGS])) for mark in marks
        )


def _nearest(point: np.ndarray, places: dict[str, np.ndarray]) -> list[str]:
    return sorted(places, key=lambda name: float(np.linalg.norm(places[name] - point)))
