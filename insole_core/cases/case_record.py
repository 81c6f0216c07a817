"""Everything a case holds, as immutable values; the window changes a case by replacing them.

All places are in the insole frame: mm, +y from heel to toes, +z dorsal.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rotation_about
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.template import Template

Point = tuple[float, float, float]
FIRST_NAME = "A"
"""Of the first variant; those that are added go on through the alphabet."""


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
class ScanSource:
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


@dataclass(frozen=True)
class Variant:
    """One of several prescriptions for the same foot, by a name that is its own."""

    name: str
    design: InsoleDesign


@dataclass(frozen=True, eq=False)
class FootRecord:
    """One foot of a case, and what is prescribed for it.

    Parameters
    ----------
    foot
    source
    variants
        At least one; their names differ.
    chosen
        Name of the variant that is shown, checked and made.
    annotations
    earlier
        What was prescribed on the scan before this one, to be repeated on it.
    """

    foot: Foot
    source: ScanSource
    variants: tuple[Variant, ...]
    chosen: str
    annotations: Annotations = Annotations()
    earlier: Template | None = None

    @classmethod
    def begun(
        cls, foot: Foot, source: ScanSource, design: InsoleDesign | None = None, **more: Any
    ) -> FootRecord:
        """Begin with one variant: that of `design`, or one without corrections."""
        first = Variant(FIRST_NAME, design or InsoleDesign(side=foot.side))
        return cls(foot, source, (first,), first.name, **more)

    @property
    def side(self) -> Side:
        """Which foot."""
        return self.foot.side

    @property
    def design(self) -> InsoleDesign:
        """The chosen prescription."""
        return self.variant(self.chosen).design

    def variant(self, name: str) -> Variant:
        """Find a variant by its name."""
        return next(variant for variant in self.variants if variant.name == name)

    def with_design(self, design: InsoleDesign) -> FootRecord:
        """Change the chosen prescription."""
        kept = (replace(v, design=design) if v.name == self.chosen else v for v in self.variants)
        return replace(self, variants=tuple(kept))

    def with_chosen(self, name: str) -> FootRecord:
        """Choose a variant."""
        return replace(self, chosen=self.variant(name).name)

    def with_variant(self, variant: Variant) -> FootRecord:
        """Add a variant after the others, and choose it.

        Raises
        ------
        DesignError
            When another has its name.
        """
        self._check_new(variant.name)
        return replace(self, variants=(*self.variants, variant), chosen=variant.name)

    def without_variant(self, name: str) -> FootRecord:
        """Leave a variant out; of the chosen one, its neighbour is chosen.

        Raises
        ------
        DesignError
            When it is the only one.
        """
        if len(self.variants) == 1:
            raise DesignError("The only variant of a foot cannot be deleted; empty it instead.")
        place = self.variants.index(self.variant(name))
        kept = self.variants[:place] + self.variants[place + 1 :]
        chosen = kept[max(place - 1, 0)].name if name == self.chosen else self.chosen
        return replace(self, variants=kept, chosen=chosen)

    def with_name(self, name: str, new: str) -> FootRecord:
        """Call a variant by another name.

        Raises
        ------
        DesignError
            When another has it.
        """
        if new == name:
            return self
        self._check_new(new)
        named = (replace(v, name=new) if v.name == name else v for v in self.variants)
        chosen = new if name == self.chosen else self.chosen
        return replace(self, variants=tuple(named), chosen=chosen)

    def _check_new(self, name: str) -> None:
        if not name:
            raise DesignError("A variant needs a name; type one.")
        if any(variant.name == name for variant in self.variants):
            raise DesignError(
                "There is a variant {name} already; give this one another name.", name=name
            )


@dataclass(frozen=True, eq=False)
class CaseRecord:
    """One case: a patient, and up to two feet, of which one is at hand.

    Parameters
    ----------
    patient
    feet
        The left one first; at most one of a side.
    at_hand
        The foot that is shown and worked on; None exactly before there is one.
    """

    patient: Patient = Patient()
    feet: tuple[FootRecord, ...] = ()
    at_hand: Side | None = None

    @classmethod
    def of_foot(cls, foot: FootRecord, patient: Patient | None = None) -> CaseRecord:
        """Make a case of one foot."""
        return cls(patient or Patient(), (foot,), foot.side)

    def of_side(self, side: Side) -> FootRecord | None:
        """Give the left or the right foot, if the case has it."""
        return next((foot for foot in self.feet if foot.side is side), None)

    @property
    def current(self) -> FootRecord | None:
        """The foot at hand."""
        return None if self.at_hand is None else self.of_side(self.at_hand)

    @property
    def other(self) -> FootRecord | None:
        """The foot that is not at hand, if there are two."""
        return None if self.at_hand is None else self.of_side(self.at_hand.other)

    def with_foot(self, foot: FootRecord) -> CaseRecord:
        """Put a foot into its place, and take it to hand."""
        others = tuple(f for f in self.feet if f.side is not foot.side)
        feet = (foot, *others) if foot.side is Side.LEFT else (*others, foot)
        return replace(self, feet=feet, at_hand=foot.side)

    def at(self, side: Side) -> CaseRecord:
        """Take the foot of a side to hand; the same record where there is none."""
        if side is self.at_hand or self.of_side(side) is None:
            return self
        return replace(self, at_hand=side)

    def holds_the_same(self, other: CaseRecord) -> bool:
        """Whether nothing but the foot at hand differs: the values are the very same ones."""
        return self.patient is other.patient and self.feet is other.feet

    @property
    def side(self) -> Side | None:
        """Which foot is at hand; None before there is one."""
        return self.at_hand

    @property
    def foot(self) -> Foot | None:
        """The surface of the foot at hand."""
        return None if self.current is None else self.current.foot

    @property
    def source(self) -> ScanSource | None:
        """Where the foot at hand came from."""
        return None if self.current is None else self.current.source

    @property
    def design(self) -> InsoleDesign | None:
        """The chosen prescription of the foot at hand."""
        return None if self.current is None else self.current.design

    @property
    def annotations(self) -> Annotations:
        """What was marked on the foot at hand."""
        return Annotations() if self.current is None else self.current.annotations
