"""What all corrections have in common.

A correction is declared once, by a class of its own: `Correction.__init_subclass__` keeps it by its
type, and general code reads, limits, shows, prints, compares, mirrors and applies it.
"""

from __future__ import annotations

import uuid
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar, Self, TypeVar

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.side import Side
from insole_core.insole.design_warning import DesignWarning
from insole_core.insole.fields import Line, Part, Place, Spot, declared
from insole_core.insole.grips import Grip, Pull
from insole_core.insole.judged import Judged
from insole_core.insole.primitives.height_field import HeightField
from insole_core.messages import Message

CORRECTION_TYPES: dict[str, type[Correction]] = {}
"""All corrections, by their types."""
STAGES = ("turn", "sole", "pad", "body")
_Part = TypeVar("_Part", bound=Part)


def new_id() -> str:
    """Return an id that no correction has."""
    return uuid.uuid4().hex[:12]


@dataclass(frozen=True, eq=False)
class Sole:
    """What a correction of the whole surface shapes.

    Parameters
    ----------
    surface
        Insole frame, mm.
    measured : (ny, nx) bool
        Nodes where the foot was measured.
    side, length_mm
        Of the foot.
    has_finish
        Whether the surface gets a designed rim afterwards.
    beside_mm
        Returns for a number of rows, counted from the heel, how far their nodes lie beside the
        measured sole, and how far the edge does: two arrays (rows, nx), mm.
    """

    surface: HeightField
    measured: BoolArray
    side: Side
    length_mm: float
    has_finish: bool
    beside_mm: Callable[[int], tuple[FloatArray, FloatArray]]


@dataclass(frozen=True, kw_only=True)
class Correction(Part):
    """Fields common to all corrections.

    Parameters
    ----------
    id
        Stays the same while the correction is edited.
    enabled
        A correction that is switched off stays in the prescription and changes nothing.
    author, created_at
        Who prescribed it and when (ISO 8601, UTC); empty if unknown.
    """

    type: ClassVar[str] = ""
    """Its name in files."""
    name: ClassVar[str] = ""
    """What it is called."""
    tip: ClassVar[str] = ""
    """What it does, in one sentence; without one it is no entry of the window's menu, but laid by a
    tool."""
    stage: ClassVar[str] = ""
    """What it changes: "turn" the sole as a whole, "sole" its heights, "pad" (what lies on it, in
    the order of the design) or "body" (what is made below)."""
    order: ClassVar[int] = 0
    """Its place among those of its stage, whatever their order in the design."""
    is_seen: ClassVar[bool] = False
    """Whether its lines are drawn while it is not selected too, and a click on them selects it."""

    id: str = field(default_factory=new_id)
    enabled: bool = True
    author: str = ""
    created_at: str = ""

    def __init_subclass__(cls) -> None:
        CORRECTION_TYPES[cls.type] = cls

    @classmethod
    def usual(cls) -> Self:
        """Return it with the values that it has when it is added by the menu."""
        return cls()

    @property
    def title(self) -> str:
        """What this one is called, as the heading of its values."""
        return self.name

    @property
    def noun(self) -> str:
        """The same within a sentence."""
        return self.title[:1].lower() + self.title[1:]

    @property
    def is_of_one_foot(self) -> bool:
        """Whether it means nothing on another foot, so that no finding proposes it."""
        return False

    def for_any_foot(self) -> Correction:
        """Return it without what is of one foot alone: its maker and its place."""
        return replace(self, id=new_id(), author="", created_at="")

    def copied(self) -> Self:
        """Return a copy for the same foot."""
        return replace(self, id=new_id())

    def brief(self) -> Message:
        """Return the values that tell it in a list."""
        raise NotImplementedError

    def check(self, where: str) -> None:
        """Check what the ranges of its values do not say.

        Raises
        ------
        DesignError
            Naming the key.
        """

    def raised_mm(self, share: FloatArray) -> FloatArray:
        """Return by how much it lifts whole sections, at shares (n,) of the length."""
        return np.zeros_like(share)

    def shaped(self, sole: Sole) -> FloatArray:
        """Return the heights (ny, nx), mm, of a sole that one of the stage "sole" shapes."""
        raised = self.raised_mm(sole.surface.y_mm / sole.length_mm)
        return np.asarray(sole.surface.heights_mm + raised[:, None])

    @property
    def rim_depth_mm(self) -> float | None:
        """The depth that it gives a heel cup, also that of a designed rim; None if it says none."""
        return None

    @property
    def spreads(self) -> bool:
        """Whether one of the stage "pad" reads the heights beside it, and so hands on changes."""
        return False

    def laid(self, surface: HeightField, arch_apex_mm: Place) -> Correction:
        """Return what one of the stage "pad" amounts to on a surface: a pad or a stroke.

        Parameters
        ----------
        arch_apex_mm
            The apex of the foot's own medial arch.
        """
        return self

    def turned_deg(self, share: FloatArray) -> FloatArray:
        """Return by how much one of the stage "turn" raises the medial edge at shares (n,)."""
        raise NotImplementedError

    @property
    def turns_rim(self) -> bool:
        """Whether one of the stage "turn" turns the whole surface, and not the sole alone."""
        return True

    def rise_mm(self, foot: Foot, field: HeightField) -> FloatArray:
        """Return by how much one of the stage "body" asks the underside to rise, (ny, nx), mm."""
        raise NotImplementedError

    @classmethod
    def rule(cls, mine: Sequence[Self], judged: Judged) -> Iterator[DesignWarning]:
        """Check all active ones of this type against the clinic's limits.

        Parameters
        ----------
        mine
            In the order of the design; none if the design has none.
        """
        yield from ()

    def lines(self, foot: Foot) -> tuple[FloatArray, ...]:
        """Return the lines (n, 2), mm, insole frame, that are drawn while it is selected."""
        return ()

    def grips(self, foot: Foot) -> tuple[Grip, ...]:
        """Return where it can be grabbed while it is selected."""
        return ()

    @property
    def has_grips(self) -> bool:
        """Whether it can be grabbed at all."""
        return type(self).grips is not Correction.grips

    def pulled(self, grip: str, pull: Pull, foot: Foot) -> Self:
        """Return it as it becomes when one of its grips is pulled."""
        raise NotImplementedError

    def settled(self, heads_mm: FloatArray, behind_heads_mm: float) -> Self:
        """Return it as moved by the hand, drawn to a usual place that is near.

        Parameters
        ----------
        heads_mm : (3, 2)
            Metatarsal heads 2 to 4, insole frame.
        behind_heads_mm
            The usual distance of a pad's front edge behind them, by the clinic's rules.
        """
        return self

    def turned_by(self, yaw_deg: float) -> Correction:
        """Return it as it lies on a foot that was turned, its places left as they are."""
        return self

    def mirrored(self) -> Correction:
        """Return it for the other foot; angles and borders are medial and lateral already."""
        return reflected(self)


def in_order() -> tuple[type[Correction], ...]:
    """Return all corrections in the order in which they change an insole."""
    kinds = CORRECTION_TYPES.values()
    return tuple(sorted(kinds, key=lambda kind: (STAGES.index(kind.stage), kind.order)))


def with_places(part: _Part, move: Callable[[Place], Place]) -> _Part:
    """Return a part with all its places on the foot moved.

    Parameters
    ----------
    move
        Maps a place (x, y) in mm to another.
    """
    return _with_moved(part, move, mirrors=False)


def reflected(part: _Part) -> _Part:
    """Return a part with all its places and lines mirrored in the plane x = 0."""
    return _with_moved(part, lambda place: (-place[0], place[1]), mirrors=True)


def _with_moved(part: _Part, move: Callable[[Place], Place], *, mirrors: bool) -> _Part:
    changes: dict[str, object] = {}
    for name, found in declared(type(part)).items():
        value = getattr(part, name)
        if value is None:
            continue
        if isinstance(found, Spot):
            changes[name] = move(value)
        elif isinstance(found, Line) and (found.is_mirrored if mirrors else found.is_on_foot):
            changes[name] = tuple(move(place) for place in value)
    return replace(part, **changes) if changes else part  # type: ignore[type-var]
