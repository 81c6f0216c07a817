"""The ways in which a surface can be a foot."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from insole_core.formats.units import Unit, UnitReading
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.sampling import EvenSurface
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid
from insole_core.messages import Message

Point = tuple[float, float, float]

CLEAR = 1.25
"""Least ratio of the dissimilarities from both sides at which the shape determines the side."""
CLEAR_WITHOUT_TOES = 1.4
"""The same where no single toes are seen: an oblique stump slopes as the toes of the other foot."""
NO_FOOT = 0.6
"""Dissimilarity from which on a surface is not a foot."""


@dataclass(frozen=True)
class PoseClicks:
    """Three points of a scan that a user has clicked, mm, source frame.

    Parameters
    ----------
    heel
        The rearmost end of the heel.
    toe
        The tip of a toe.
    sole
        Under the sole, as at the ball.
    """

    heel: Point
    toe: Point
    sole: Point

    def scaled(self, factor: float) -> PoseClicks:
        """Return the points of the scan that was made larger about its origin."""
        heel, toe, sole = (
            (x * factor, y * factor, z * factor) for x, y, z in (self.heel, self.toe, self.sole)
        )
        return PoseClicks(heel, toe, sole)

    def moved(self, by: FloatArray) -> PoseClicks:
        """Return the points of the scan that was moved by a way (3,), mm."""
        heel, toe, sole = (
            (x + by[0], y + by[1], z + by[2]) for x, y, z in (self.heel, self.toe, self.sole)
        )
        return PoseClicks(heel, toe, sole)


@dataclass(frozen=True)
class CutLeg:
    """The lower leg that was cut off a foot.

    Parameters
    ----------
    height_mm
        Over the sole, of the cut on the leg's axis.
    ankle_deg
        Between the axis of the leg and the sole, seen from the side: 90 in standing, more where the
        foot is pointed.
    end
        Where the cut crosses the axis of the leg, mm, insole frame.
    axis
        Unit vector up the leg, insole frame.
    """

    height_mm: float
    ankle_deg: float
    end: Point
    axis: Point


@dataclass(frozen=True, eq=False)
class FootCandidate:
    """One way in which a surface can be a foot.

    Parameters
    ----------
    side
    source2insole : (4, 4) float64, mm
    length_mm
        Heel to the tip of the longest toe; an estimate where `covered` is less than 1.
    dissimilarity
        From the usual foot of that side; 0 is identical.
    covered
        Share of the foot's length, from the heel on, that the surface covers.
    second_toe_found
        Whether the tip of the 2nd toe defines the axis; otherwise its usual position does.
    leg
        What was cut off; None for nothing.
    """

    side: Side
    source2insole: FloatArray
    length_mm: float
    dissimilarity: float
    covered: float = 1.0
    second_toe_found: bool = True
    leg: CutLeg | None = None

    @property
    def clear(self) -> float:
        """Least ratio of the other side's dissimilarity to its own at which this side is told."""
        return CLEAR if self.second_toe_found else CLEAR_WITHOUT_TOES

    @property
    def is_length_known(self) -> bool:
        """Whether the surface reaches from the heel to the toes."""
        return self.covered >= 1

    @property
    def surface_mm(self) -> float:
        """Length of what was scanned of the foot."""
        return self.length_mm * self.covered

    @property
    def part_mm(self) -> float | None:
        """What was scanned of a foot whose length is a guess; None where the length is known."""
        return None if self.is_length_known else self.surface_mm

    @property
    def length_text(self) -> Message:
        """The length, or what is known of it."""
        if self.is_length_known:
            return Message("{length_mm:.0f} mm long", length_mm=self.length_mm)
        return Message(
            "{surface_mm:.0f} mm of it scanned, without toes", surface_mm=self.surface_mm
        )


@dataclass(frozen=True, eq=False)
class FoundFoot:
    """A foot in a scan, and how it may lie.

    Parameters
    ----------
    mesh : mm, source frame
        Facing outwards, without small pieces beside it; of an imprint the positive.
    steady : mm, source frame
        The mesh without the noise of its scan; the mesh itself where there is little.
    even : mm, source frame
        Its evenly spread points.
    candidates
        The most likely first; at least one.
    doubts
        What is to be asked, a sentence each; none where the first candidate is sure.
    notes
        What was concluded or left out, a sentence each.
    warnings
        What the user has to know of it although nothing has to be decided, a sentence each.
    path
        Its file, where the scan is a folder; None for the file that was examined.
    unit
        Of its file, as given or concluded; None where a known size gave the scale.
    unit_readings
        The units in which its file may be, where that has to be asked; the likeliest first.
    clicks
        The points that were clicked in its file, on it or on the other foot there.
    """

    mesh: TriangleMesh
    steady: TriangleMesh
    even: EvenSurface
    candidates: tuple[FootCandidate, ...]
    doubts: tuple[Message, ...] = ()
    notes: tuple[str, ...] = ()
    warnings: tuple[Message, ...] = ()
    path: Path | None = None
    unit: Unit | None = None
    unit_readings: tuple[UnitReading, ...] = ()
    clicks: PoseClicks | None = None

    @property
    def told_side(self) -> Side | None:
        """The side that the shape tells; None where it does not tell left from right."""
        nearest = self.candidates[0]
        other = self.best(nearest.side.other)
        if other is None or other.dissimilarity >= nearest.clear * nearest.dissimilarity:
            return nearest.side
        return None

    def moved(self, by: FloatArray) -> FoundFoot:
        """Return the foot in the scan that was moved by a way (3,), mm."""
        there, back = rigid(np.eye(3), by), rigid(np.eye(3), -by)
        mesh = self.mesh.transformed(there)
        return replace(
            self,
            mesh=mesh,
            steady=mesh if self.steady is self.mesh else self.steady.transformed(there),
            even=self.even.transformed(there),
            candidates=tuple(
                replace(one, source2insole=one.source2insole @ back) for one in self.candidates
            ),
        )

    def best(self, side: Side) -> FootCandidate | None:
        """Return the most likely candidate of a side; None when there is none."""
        return next((one for one in self.candidates if one.side is side), None)
