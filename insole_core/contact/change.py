"""What a design changes of the pressure under a foot, in per cent, and how sure that is."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field, replace
from enum import IntEnum
from functools import cached_property

import numpy as np
import scipy

from insole_core.contact.load_case import LOAD_CASES, LoadCase, Posture
from insole_core.contact.pressing import Pressed
from insole_core.contact.stance import Ground, Sole, stand
from insole_core.contact.tissue import Tissue
from insole_core.errors import InputError
from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.insole.fields import Place, Range
from insole_core.messages import Message
from insole_core.pressure.laid_map import LOADED_KPA
from insole_core.pressure.regions import REGIONS
from insole_core.progress import SILENT, Progress

SENTENCE = Message(
    "Computed by a model, in per cent, for one posture; no measurement and no promise: what a "
    "patient's foot does in the shoe only a measurement in the shoe tells."
)
"""Stands under every picture, table and print of a change."""
HEADS = tuple(f"head_{number}" for number in range(1, 6))
GROUPS = {
    "heel": ("heel",),
    "midfoot": ("midfoot",),
    "metatarsal_heads": HEADS,
    "toes": ("hallux", "lesser_toes"),
    **{head: (head,) for head in HEADS},
}
"""Names of what is reported, and the regions of the sole in each."""
WEIGHT_KG = Range(5, 250, "kg")
MOST_SHOWN = 100.0
"""Per cent; a map shows no greater changes."""
_MODEL_SHARE, _MODEL_POINTS = 0.2, 2.0
"""Standard deviation of the model itself: a share of each change, and points of per cent. By it,
published series lie within the limits; see the page on pressure changes."""
_NORMAL_95 = 1.96
_WIDEST_POINTS = 45.0
"""Half the width of limits from which on nothing is told."""
_PUBLISHED = (-67.0, 110.0)
"""The greatest changes of published series, and 10 points; the model overrates what is beyond:
reliefs up to 57 % (Chen, Ju and Tang, Clin. Biomech. 18, 2003), and twice the pressure on a pad."""
_NONE, _NOT_LOADED = Message(""), Message("Nothing pressed there before.")
_MOVED = Message("The most pressed place is now one where nothing pressed before.")
_CARRIES_MORE = Message("The most pressed place is relieved, but the region carries more in all.")
_MOST_MORE_PERCENT = 25.0
"""Load that a region may gain while its peak falls: more is well beyond what the model may miss."""
_AS_GROUP = Message("Nothing can be told of the heads together, so of none of them alone.")
_BESIDE = Message(
    "The place lies beside the sole of the foot, or the sole is too steep or not measured there."
)
_TOO_UNSURE = Message("What is not known of the foot changes it too much.")
_NOT_MET = Message(
    "The model does not always meet published series here, measured in walking; of some pads and "
    "bars not even the direction is right."
)
_TOO_THIN = Message("The insole is too thin there: it is compressed by more than half.")
_APART = tuple(name for name in GROUPS if name != "metatarsal_heads")
"""Regions of which every place of a sole is in one at most."""
_AT_HEADS = frozenset({"metatarsal_heads", *HEADS})
_AT_PUSH_OFF = {
    "toes": Message("Toes bend at push-off, and the model does not bend them."),
    "heel": Message("At push-off the heel leaves the ground."),
}
_UNEVEN_MM = 2.0
"""Where the insole gets another form under the heads or comes up there and not at the heel, and
always at push-off, the model fails on published series of domes, bars and covers: see the page."""
_SAME = 1e-6
_VARIED = 8
"""Number of the assumptions that are varied."""
_DENSE = 0.5
"""Strain from which on foams are stiffer than they are taken to be."""


class Shown(IntEnum):
    """What the colour of a place says."""

    PERCENT = 0
    """How the pressure changes."""
    NEWLY = 1
    """Something presses now, and nothing did before."""
    IDLE = 2
    """Nothing presses, before or after."""
    UNTOLD = 3
    """Something presses, and nothing can be told of its region."""


@dataclass(frozen=True)
class Assumptions:
    """What is not known of a person, as far as it counts.

    Parameters
    ----------
    tissue
    softer
        How many times lower than by its hardness the modulus of the insole is.
    moved_mm
        Of the load's centre, from where it usually is: medially and ahead.
    heavier
        Load, in multiples of the usual share of the weight.
    """

    tissue: Tissue = field(default_factory=Tissue)
    softer: float = 1.0
    moved_mm: tuple[float, float] = (0.0, 0.0)
    heavier: float = 1.0

    def varied(self, *, material_is_known: bool) -> Iterator[Assumptions]:
        """Give the assumptions with one of them off by a standard deviation at a time."""
        tissue = self.tissue
        yield replace(self, tissue=tissue.scaled(heel=1.35))
        yield replace(self, tissue=tissue.scaled(forefoot=1.35))
        yield replace(self, tissue=tissue.scaled(arch=2.0))
        yield replace(self, tissue=tissue.scaled(thickness=1.2))
        yield replace(self, softer=self.softer * (1.3 if material_is_known else 2.0))
        medial, ahead = self.moved_mm
        yield replace(self, moved_mm=(medial, ahead + 8.0))
        yield replace(self, moved_mm=(medial + 4.0, ahead))
        yield replace(self, heavier=self.heavier * 1.1)


@dataclass(frozen=True)
class Loading:
    """A foot, its load and posture.

    Parameters
    ----------
    sole
    weight_kg
        Of the person.
    posture
    """

    sole: Sole
    weight_kg: float
    posture: Posture = Posture.STANDING

    @property
    def case(self) -> LoadCase:
        """Load and centre of the posture."""
        return LOAD_CASES[self.posture]

    @property
    def load_n(self) -> float:
        """On this foot."""
        return self.case.load_n(self.weight_kg)

    def pressed(
        self,
        ground: Ground,
        assumed: Assumptions,
        start: Pressed | None = None,
        *,
        follows: bool = False,
    ) -> Pressed:
        """Load the foot on a ground.

        Raises
        ------
        InputError
            When no pressure on the sole has the centre of the posture.
        """
        foot = self.sole.foot
        medial_mm, ahead_mm = assumed.moved_mm
        centre = (
            medial_mm * foot.side.medial_sign,
            self.case.centre_share * foot.length_mm + ahead_mm,
        )
        load_n = self.load_n * assumed.heavier
        under = ground.softer(assumed.softer)
        return stand(self.sole, under, load_n, centre, assumed.tissue, start=start, follows=follows)


@dataclass(frozen=True)
class RegionChange:
    """Change of the peak pressure and of the load in a region, per cent.

    Parameters
    ----------
    peak_percent, load_percent
        None where nothing pressed before.
    """

    peak_percent: float | None
    load_percent: float | None


@dataclass(frozen=True, eq=False)
class Change:
    """The pressures on two grounds.

    Parameters
    ----------
    loading
    grounds
        The old and the new one.
    assumed
    old, new
    """

    loading: Loading
    grounds: tuple[Ground, Ground]
    assumed: Assumptions
    old: Pressed
    new: Pressed

    @property
    def sole(self) -> Sole:
        """Of the foot."""
        return self.loading.sole

    def begins_as(self, loading: Loading, old: Ground, assumed: Assumptions) -> bool:
        """Return whether the old pressures are those of a foot that stands on a ground."""
        is_same = self.loading == loading and self.assumed == assumed
        return is_same and self.grounds[0].is_like(old)

    @property
    def old_kpa(self) -> FloatArray:
        """(ny, nx) as sensors show it."""
        return self.old.sensed_kpa

    @property
    def new_kpa(self) -> FloatArray:
        """(ny, nx) as sensors show it."""
        return self.new.sensed_kpa

    @cached_property
    def percent(self) -> FloatArray:
        """(ny, nx) change of the pressure; NaN where nothing pressed before or is sole."""
        told = self.sole.known & (self.old_kpa >= LOADED_KPA)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(told, 100 * (self.new_kpa / self.old_kpa - 1), np.nan)

    @cached_property
    def reasons(self) -> dict[str, Message]:
        """Why nothing can be told of some of `GROUPS`, as far as this change says it."""
        found = {name: self.reason(name) for name in GROUPS}
        return {name: reason for name, reason in found.items() if reason}

    @property
    def untold(self) -> tuple[str, ...]:
        """Names of the regions of which nothing can be told, as far as this change says it."""
        return tuple(self.reasons)

    def shown(self, untold: Collection[str]) -> IntArray:
        """(ny, nx) what is to be painted, as numbers of `Shown`.

        Parameters
        ----------
        untold
            Names of regions of which nothing is told.
        """
        apart = frozenset(untold).intersection(_APART)
        if apart not in self._shown:
            self._shown[apart] = self._shown_without(apart)
        return self._shown[apart]

    @cached_property
    def _shown(self) -> dict[frozenset[str], IntArray]:
        """What is to be painted, by what is untold: each view paints the same."""
        return {}

    def _shown_without(self, untold: frozenset[str]) -> IntArray:
        presses = self.sole.known & (self.new_kpa >= LOADED_KPA)
        shown = np.where(presses, Shown.NEWLY, Shown.IDLE)
        shown[np.isfinite(self.percent)] = Shown.PERCENT
        for name in untold:
            here = inside(self.sole, name) & (shown != Shown.IDLE)
            if self.reasons.get(name) in (_NOT_LOADED, _MOVED):
                here &= shown != Shown.NEWLY  # which is just what the reason says
            shown[here] = Shown.UNTOLD
        return shown

    @property
    def areas_mm2(self) -> tuple[float, float]:
        """Area of contact before and after."""
        cell = self.sole.field.step_mm**2
        return float((self.old.mpa > 0).sum() * cell), float((self.new.mpa > 0).sum() * cell)

    def of(self, name: str) -> RegionChange:
        """Return the change of one of `GROUPS`."""
        here = _places(self.sole, name)
        old, new = self.peaks_kpa(name)
        if old < LOADED_KPA:
            return RegionChange(None, None)
        before, after = (pressed.mpa.take(here).sum() for pressed in (self.old, self.new))
        load = float(100 * (after / before - 1)) if before > 0 else None
        return RegionChange(100 * (new / old - 1), load)

    def peaks_kpa(self, name: str) -> tuple[float, float]:
        """Return the peak pressures of one of `GROUPS` before and after, as sensors show them."""
        here = _places(self.sole, name)
        old, new = (kpa.take(here).max(initial=0.0) for kpa in (self.old_kpa, self.new_kpa))
        return float(old), float(new)

    def at(self, xy: Place) -> float | None:
        """Return the change at a place, mm, insole frame; None where nothing pressed there."""
        percent = float(replace(self.sole.field, heights_mm=self.percent).height_at(np.array(xy)))
        return percent if np.isfinite(percent) else None

    def reason(self, name: str) -> Message:
        """Return why nothing can be told of one of `GROUPS`, or an empty text."""
        if name == "toes" and not self.sole.has_toes:
            return Message("The scan does not show the toes.")
        own = self._not_modelled(name) or self._not_compared(name)
        return _AS_GROUP if not own and name in HEADS and self._heads_are_untold else own

    @cached_property
    def _heads_are_untold(self) -> bool:
        return bool(self.reason("metatarsal_heads"))

    def _not_modelled(self, name: str) -> Message:
        """Return what the model leaves out that counts in a region, or an empty text."""
        pushes = self.loading.posture is Posture.PUSH_OFF
        if pushes and name in _AT_PUSH_OFF:
            return _AT_PUSH_OFF[name]
        if name in _AT_HEADS and (
            pushes or self._heads_are_raised or self._unevenly_raised_mm(name) > _UNEVEN_MM
        ):
            return _NOT_MET
        return _NONE

    @cached_property
    def _heads_are_raised(self) -> bool:
        """Whether the ground comes up under the heads and not under the heel, as by a cover."""
        heads_mm, heel_mm = (
            float(np.median(self._raised_mm.take(_places(self.sole, name))))
            for name in ("metatarsal_heads", "heel")
        )
        return heads_mm - heel_mm > _UNEVEN_MM

    @cached_property
    def _raised_mm(self) -> FloatArray:
        """(ny, nx) how much higher the new ground is."""
        old, new = self.grounds
        return new.top_mm - old.top_mm

    def _unevenly_raised_mm(self, name: str) -> float:
        """Return how much another form a region has on the new ground, whatever level and tilt."""
        raised = self._raised_mm.take(_places(self.sole, name))
        motions = _level_and_tilts(self.sole, name)
        off = raised - motions @ (motions.T @ raised)
        return float(np.ptp(off)) if len(off) else 0.0

    def _not_compared(self, name: str) -> Message:
        """Return why pressures of a region say nothing beside each other, or an empty text."""
        if self._densified.take(_places(self.sole, name)).any():
            return _TOO_THIN
        old, new = self.peaks_kpa(name)
        if old < LOADED_KPA:
            return _NOT_LOADED
        if new < old and self._is_newly_pressed(name):
            return _MOVED
        if new < old and (self.of(name).load_percent or 0.0) > _MOST_MORE_PERCENT:
            return _CARRIES_MORE
        return _NONE

    def _is_newly_pressed(self, name: str) -> bool:
        """Return whether the greatest pressure of a region moves to where nothing pressed."""
        here = _places(self.sole, name)
        return bool(self.old_kpa.take(here[self.new_kpa.take(here).argmax()]) < LOADED_KPA)

    def region_at(self, xy: Place) -> str | None:
        """Return which of `GROUPS` holds a place, the heads each; None beside the sole."""
        field = self.sole.field
        column, row = (
            round((at - first) / field.step_mm)
            for at, first in zip(xy, (field.x0_mm, field.y0_mm), strict=True)
        )
        rows, columns = self.sole.known.shape
        if not (0 <= row < rows and 0 <= column < columns):
            return None
        return next((name for name in _APART if inside(self.sole, name)[row, column]), None)

    @cached_property
    def _densified(self) -> BoolArray:
        """(ny, nx) where one of the insoles is so compressed that its foam gets stiffer."""
        densified = np.zeros(self.sole.known.shape, dtype=np.bool_)
        for ground, pressed in zip(self.grounds, (self.old, self.new), strict=True):
            densified |= (ground.strain(pressed.sunk_mm) > _DENSE) & (pressed.mpa > 0)
        return densified


def inside(sole: Sole, name: str) -> BoolArray:
    """(ny, nx) which nodes of a sole belong to one of `GROUPS`; kept with the sole."""

    def find() -> BoolArray:
        return np.asarray(np.any([sole.masks[number] for number in _numbers(name)], axis=0))

    return sole.derived.get("inside", name, find)


def _places(sole: Sole, name: str) -> IntArray:
    """(n,) which nodes, one row after the other, belong to one of `GROUPS`; kept with the sole."""
    return sole.derived.get("places", name, lambda: np.flatnonzero(inside(sole, name)))


def _level_and_tilts(sole: Sole, name: str) -> FloatArray:
    """(n, k) directions, orthonormal, in which the heights of a group's nodes may change as one.

    Its form stays under all of them: it only rises or tilts.
    """

    def find() -> FloatArray:
        rows, columns = np.nonzero(inside(sole, name))
        motions = np.column_stack([np.ones(len(rows)), columns, rows]).astype(np.float64)
        return np.asarray(scipy.linalg.orth(motions))

    return sole.derived.get("level and tilts", name, find)


def _numbers(name: str) -> list[int]:
    """Return the numbers of the regions in one of `GROUPS`."""
    return [REGIONS.index(region) for region in GROUPS[name]]


@dataclass(frozen=True)
class Told:
    """The change of a region or at a point, with the limits it has at 95 %.

    Parameters
    ----------
    percent, limits
        Of the peak pressure; None where there is none.
    load_percent
        Of the whole load in a region; it has no limits.
    reason
        Why it cannot be told, whatever was computed; empty where it can.
    """

    percent: float | None
    limits: tuple[float, float] | None
    load_percent: float | None = None
    reason: Message = _NONE


@dataclass(frozen=True, eq=False)
class PressureChange:
    """How load moves from one ground to another.

    Parameters
    ----------
    loading
    change
        With the usual assumptions.
    regions
        By the names in `GROUPS`.
    points
        In the order of those asked for.
    assumed
        The usual assumptions.
    """

    loading: Loading
    change: Change
    regions: dict[str, Told]
    points: tuple[Told, ...]
    assumed: Assumptions

    @property
    def load_n(self) -> float:
        """That was put on the foot."""
        return self.loading.load_n * self.assumed.heavier

    @property
    def cannot_tell(self) -> tuple[str, ...]:
        """Names of the regions of which nothing can be told."""
        return tuple(name for name, told in self.regions.items() if told.reason)


def changed(
    loading: Loading,
    old: Ground,
    new: Ground,
    assumed: Assumptions,
    before: Change | None = None,
    *,
    follows: bool = False,
) -> Change:
    """Compute the pressures on two grounds, without their uncertainty.

    Parameters
    ----------
    before
        Of much the same grounds, to start from; its old pressures are taken if nothing of them
        has changed.
    follows
        Only follow from what was before, while the new ground is being drawn: fast enough for each
        picture of a drag.
    """
    if before is not None and before.begins_as(loading, old, assumed):
        pressed = before.old
    else:
        pressed = loading.pressed(old, assumed, None if before is None else before.old)
    start = None if before is None else before.new
    after = loading.pressed(new, assumed, start, follows=follows)
    return Change(loading, (old, new), assumed, pressed, after)


def pressure_change(
    loading: Loading,
    old: Ground,
    new: Ground,
    *,
    material_is_known: bool = True,
    points: Sequence[Place] = (),
    assumed: Assumptions | None = None,
    known: Change | None = None,
    progress: Progress = SILENT,
) -> PressureChange:
    """Compute how load moves, and how sure that is.

    The assumptions are varied one at a time, and the model's own deviation from published series
    is added.

    Parameters
    ----------
    old, new
        What the foot stood on, and what it will stand on.
    material_is_known
        Whether the hardness of the insole is, or a usual one is taken.
    points
        Places (x, y), mm, insole frame.
    assumed
        By default those for anybody.
    known
        The change with these assumptions, where it is computed already.

    Raises
    ------
    InputError
        When no pressure on the sole has the centre of the posture.
    Cancelled
    """
    assumed = assumed or Assumptions()
    usual = known or changed(loading, old, new, assumed)
    varied: list[Change | None] = []
    for other in assumed.varied(material_is_known=material_is_known):
        progress.step(len(varied) / _VARIED, "Loading the foot")
        varied.append(_varied(usual, other))
    regions = {}
    for name in GROUPS:
        here = usual.of(name)
        others = [None if one is None else one.of(name).peak_percent for one in varied]
        regions[name] = _told(here.peak_percent, others, usual.reason(name), here.load_percent)
    if regions["metatarsal_heads"].reason:
        for head in HEADS:
            regions[head] = replace(regions[head], reason=regions[head].reason or _AS_GROUP)
    at = []
    for xy in points:
        values = [None if one is None else one.at(xy) for one in varied]
        region = usual.region_at(xy)
        reason = _BESIDE if region is None else regions[region].reason
        at.append(_told(usual.at(xy), values, reason))
    return PressureChange(loading, usual, regions, tuple(at), assumed)


def _varied(usual: Change, assumed: Assumptions) -> Change | None:
    """Return the change with other assumptions; None where no pressure has that centre."""
    try:
        return changed(usual.loading, *usual.grounds, assumed, usual)
    except InputError:
        return None


def _told(
    percent: float | None,
    others: Sequence[float | None],
    reason: Message,
    load_percent: float | None = None,
) -> Told:
    if percent is None:
        return Told(None, None, None, reason or _NOT_LOADED)
    off = np.array([other for other in others if other is not None]) - percent
    if max(abs(percent), np.abs(off).max(initial=0.0)) < _SAME:
        return Told(0.0, (0.0, 0.0), load_percent, reason)
    if len(off) < len(others):
        return Told(percent, None, load_percent, reason or _TOO_UNSURE)
    model = _MODEL_POINTS + _MODEL_SHARE * abs(percent)
    half = _NORMAL_95 * float(np.sqrt(model**2 + (off * off).sum()))
    if not reason and half > max(_WIDEST_POINTS, abs(percent)):
        reason = _TOO_UNSURE
    if not reason and not _PUBLISHED[0] <= percent <= _PUBLISHED[1]:
        reason = Message("No published series has measured so much; the model overrates it.")
    return Told(percent, (max(percent - half, -100.0), percent + half), load_percent, reason)
