"""Everything a case contains, as immutable values; the window changes a case by replacing them.

All positions are in the insole frame: mm, +y from heel to toes, +z dorsal.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from insole_core.cases.order_note import OrderNote
from insole_core.cases.sample import SAMPLE_PSEUDONYM
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rotation_about
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.template import Template
from insole_core.pressure.laid_map import PlantarLayers

Point = tuple[float, float, float]
FIRST_NAME = "A"
"""Name of the first variant; later ones continue through the alphabet."""


@dataclass(frozen=True)
class Patient:
    """The fields of the patient panel, and what the workshop knows the patient by.

    Parameters
    ----------
    born, visit
        ISO 8601, from cases written before dates were checked any text: see `doubtful_days`.
    pseudonym
        Or order number; in place of the name in all that goes to the workshop.
    """

    name: str = ""
    born: str = ""
    visit: str = ""
    notes: str = ""
    pseudonym: str = ""

    @property
    def is_sample(self) -> bool:
        """Whether this is the invented patient, who must be taken for nobody."""
        return self.pseudonym == SAMPLE_PSEUDONYM


@dataclass(frozen=True)
class Found:
    """How surely a landmark had been found by the shape of the foot: as of `Landmark`."""

    confidence: float
    deviation_mm: float | None = None
    is_coarse: bool = False


@dataclass(frozen=True)
class KeyPoint:
    """A named point on the foot's skin, mm, insole frame.

    Parameters
    ----------
    found
        Of a landmark that was confirmed where it was found; None of a point set by hand.
    """

    name: str
    position_mm: Point
    found: Found | None = None


@dataclass(frozen=True)
class ReferencePlane:
    """A plane to view the foot against; it has no effect on the insole.

    Parameters
    ----------
    pitch_deg
        Rotation about x; positive lifts the toe end.
    roll_deg
        Rotation about the foot axis; positive lifts the side of -x.
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
    """Marks on the foot apart from the prescription."""

    key_points: tuple[KeyPoint, ...] = ()
    plane: ReferencePlane | None = None

    def key_point(self, name: str) -> KeyPoint | None:
        """Find a key point by its name; None when there is none."""
        return next((point for point in self.key_points if point.name == name), None)

    def with_key_point(self, point: KeyPoint) -> Annotations:
        """Add a key point, in place of one with the same name."""
        if self.key_point(point.name) is None:
            return replace(self, key_points=(*self.key_points, point))
        points = tuple(point if p.name == point.name else p for p in self.key_points)
        return replace(self, key_points=points)


@dataclass(frozen=True)
class Variant:
    """One of several prescriptions for the same foot, with a unique name.

    Parameters
    ----------
    identity
        Stays while the variant is renamed or changed; another one of its name has its own.
    """

    name: str
    design: InsoleDesign
    identity: object = field(default_factory=object, compare=False, repr=False)


@dataclass(frozen=True, eq=False)
class FootRecord:
    """One foot of a case and its prescriptions.

    Parameters
    ----------
    variants
        At least one; their names differ.
    chosen
        Name of the variant that is shown, checked and made.
    earlier
        The prescription on the previous scan, to be repeated on this one.
    plantar
        A map of pressures and a picture that lie under the foot.
    """

    foot: Foot
    source: ScanSource
    variants: tuple[Variant, ...]
    chosen: str
    annotations: Annotations = Annotations()
    earlier: Template | None = None
    plantar: PlantarLayers = field(default_factory=PlantarLayers)

    @classmethod
    def begun(
        cls, foot: Foot, source: ScanSource, design: InsoleDesign | None = None, **more: Any
    ) -> FootRecord:
        """Return a record with one variant.

        Parameters
        ----------
        design : optional
            Of the variant; without it, a design without corrections.
        more
            Further fields of the record.
        """
        first = Variant(FIRST_NAME, design or InsoleDesign(side=foot.side))
        return cls(foot, source, (first,), first.name, **more)

    @property
    def side(self) -> Side:
        """Which foot."""
        return self.foot.side

    @property
    def design(self) -> InsoleDesign:
        """The chosen prescription."""
        return self.chosen_variant.design

    @property
    def chosen_variant(self) -> Variant:
        """The variant that is shown, checked and made."""
        return self.variant(self.chosen)

    def variant(self, name: str) -> Variant:
        """Return the variant of a name, which must exist."""
        return next(variant for variant in self.variants if variant.name == name)

    def with_design(self, design: InsoleDesign) -> FootRecord:
        """Replace the design of the chosen variant."""
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
            When it has no name, or that of another variant.
        """
        self._check_new(variant.name)
        return replace(self, variants=(*self.variants, variant), chosen=variant.name)

    def without_variant(self, name: str) -> FootRecord:
        """Remove a variant; when it was the chosen one, choose its neighbour.

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
        """Rename a variant.

        Parameters
        ----------
        name
            Of the variant now.

        Raises
        ------
        DesignError
            When the new name is empty or that of another variant.
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
    """One case: a patient and up to two feet, one of which is the current one.

    Parameters
    ----------
    feet
        The left one first; at most one for each side.
    at_hand
        Side of the current foot, which is shown and worked on; None only without feet.
    order
        What was exported last, and what the shop is to be told.
    """

    patient: Patient = Patient()
    feet: tuple[FootRecord, ...] = ()
    at_hand: Side | None = None
    order: OrderNote = field(default_factory=OrderNote)

    @classmethod
    def of_foot(cls, foot: FootRecord, patient: Patient | None = None) -> CaseRecord:
        """Return a case of one foot, for `patient` or for one without data."""
        return cls(patient or Patient(), (foot,), foot.side)

    def of_side(self, side: Side) -> FootRecord | None:
        """Return the left or the right foot; None when the case has none."""
        return next((foot for foot in self.feet if foot.side is side), None)

    @property
    def current(self) -> FootRecord | None:
        """The current foot."""
        return None if self.at_hand is None else self.of_side(self.at_hand)

    @property
    def other(self) -> FootRecord | None:
        """The other foot, if there are two."""
        return None if self.at_hand is None else self.of_side(self.at_hand.other)

    def with_foot(self, foot: FootRecord) -> CaseRecord:
        """Set the foot of its side, and make it the current one."""
        others = tuple(f for f in self.feet if f.side is not foot.side)
        feet = (foot, *others) if foot.side is Side.LEFT else (*others, foot)
        return replace(self, feet=feet, at_hand=foot.side)

    def at(self, side: Side) -> CaseRecord:
        """Make the foot of a side the current one; without such a foot, return the same record."""
        if side is self.at_hand or self.of_side(side) is None:
            return self
        return replace(self, at_hand=side)

    def holds_the_same(self, other: CaseRecord) -> bool:
        """Return whether patient, feet and order are the same; the current side may differ."""
        is_same = self.patient is other.patient and self.feet is other.feet
        return is_same and self.order == other.order

    @property
    def side(self) -> Side | None:
        """Side of the current foot; None without feet."""
        return self.at_hand

    @property
    def foot(self) -> Foot | None:
        """Surface of the current foot."""
        return None if self.current is None else self.current.foot

    @property
    def source_paths(self) -> tuple[Path, ...]:
        """Return where the scans of all feet were read from."""
        return tuple(Path(foot.source.path) for foot in self.feet)

    @property
    def source(self) -> ScanSource | None:
        """Scan that the current foot was made from."""
        return None if self.current is None else self.current.source

    @property
    def design(self) -> InsoleDesign | None:
        """Chosen prescription of the current foot."""
        return None if self.current is None else self.current.design

    @property
    def annotations(self) -> Annotations:
        """Marks on the current foot."""
        return Annotations() if self.current is None else self.current.annotations

    @property
    def plantar(self) -> PlantarLayers:
        """What lies under the current foot."""
        return PlantarLayers() if self.current is None else self.current.plantar
