"""Everything a case holds, as immutable values; the window changes a case by replacing them.

All places are in the insole frame: mm, +y from heel to toes, +z dorsal.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rotation_about
from insole_core.insole.design import InsoleDesign

Point = tuple[float, float, float]


@dataclass(frozen=True)
class Patient:
    """The fields of the patient panel, as typed."""

    name: str = ""
    born: str = ""
    visit: str = ""
    notes: str = ""


@dataclass(frozen=True)
class KeyPoint:
    """A named place on the foot's skin, mm, insole frame."""

    name: str
    position_mm: Point


@dataclass(frozen=True)
class ReferencePlane:
    """A plane to look at the foot against; it changes nothing on the insole.

    Parameters
    ----------
    origin_mm
    pitch_deg
        Turn about x: > 0 lifts the toe end.
    roll_deg
        Turn about the foot axis: > 0 lifts the side of -x.
    """

    origin_mm: Point
    pitch_deg: float = 0.0
    roll_deg: float = 0.0

    @property
    def rotation(self) -> FloatArray:
        """(3, 3) rotation from the horizontal plane to this one."""
        x, y = np.eye(3)[0], np.eye(3)[1]
        return np.asarray(rotation_about(x, self.pitch_deg) @ rotation_about(y, self.roll_deg))


@dataclass(frozen=True)
class Annotations:
    """What was marked on the foot beside the prescription."""

    key_points: tuple[KeyPoint, ...] = ()
    plane: ReferencePlane | None = None

    def key_point(self, name: str) -> KeyPoint | None:
        """Find a key point, or None."""
        return next((point for point in self.key_points if point.name == name), None)

    def with_key_point(self, point: KeyPoint) -> Annotations:
        """Add a key point, or put it where the one of the same name was."""
        if self.key_point(point.name) is None:
            return replace(self, key_points=(*self.key_points, point))
        points = tuple(point if p.name == point.name else p for p in self.key_points)
        return replace(self, key_points=points)


@dataclass(frozen=True)
class Source:
    """Where the foot came from.

    Parameters
    ----------
    kind
        ``session`` or ``mesh``.
    path
    sha256
        Of the manifest of a session, of the file of a mesh or of an archive.
    recorded_at
        ISO 8601, UTC; empty where unknown.
    """

    kind: str
    path: str
    sha256: str
    recorded_at: str = ""


@dataclass(frozen=True, eq=False)
class CaseRecord:
    """One case: a patient, and from the first scan on a foot and its prescription."""

    patient: Patient = Patient()
    annotations: Annotations = Annotations()
    source: Source | None = None
    foot: Foot | None = None
    design: InsoleDesign | None = None

    @property
    def side(self) -> Side | None:
        """Which foot; None before there is one."""
        return self.foot.side if self.foot is not None else None
