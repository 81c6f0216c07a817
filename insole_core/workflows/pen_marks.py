"""What a pen drew on the skin of the foot at hand, and what it may mean."""

from __future__ import annotations

from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from insole_core.cases.case_record import CaseRecord
from insole_core.foot.foot import Foot
from insole_core.foot.skin_marks import SkinMark, skin_marks
from insole_core.workflows.foot_landmarks import SHOWN, landmarks_of

MEANINGS = 2
"""So many of the nearest landmarks are offered for a mark."""


@dataclass(frozen=True, eq=False)
class PenMark:
    """A mark and the names of the landmarks it may stand for, the nearest first."""

    mark: SkinMark
    meanings: tuple[str, ...]


class PenMarks:
    """Finds the marks once for each foot: that takes a moment."""

    def __init__(self) -> None:
        self._found: WeakKeyDictionary[Foot, tuple[SkinMark, ...]] = WeakKeyDictionary()

    def of(self, record: CaseRecord) -> tuple[PenMark, ...]:
        """Give the marks on the foot at hand, the largest first."""
        if record.foot is None:
            return ()
        landmarks = landmarks_of(record)
        found = self._found.get(record.foot)
        if found is None:
            found = self._found[record.foot] = skin_marks(record.foot, landmarks)
        places = {name: mark.point for name, mark in landmarks.items() if name in SHOWN}
        return tuple(
            PenMark(mark, tuple(_nearest(mark.point, places)[:MEANINGS])) for mark in found
        )


def _nearest(point: np.ndarray, places: dict[str, np.ndarray]) -> list[str]:
    return sorted(places, key=lambda name: float(np.linalg.norm(places[name] - point)))
