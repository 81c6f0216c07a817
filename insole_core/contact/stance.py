"""Lay a foot on the floor of its shoe, or on an insole, and load it."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import pairwise

import numpy as np

from insole_core.contact.elastic_layers import Layer, uniform_compliance
from insole_core.contact.pressing import Bed, Pressed, Support
from insole_core.contact.tissue import Tissue, tissue_shares
from insole_core.errors import InputError
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import HEADS, Landmarks, find_landmarks
from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.insole.outline.insole_outline import insole_outline
from insole_core.insole.outline.shoe_outline import last_heights_mm
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.primitives.height_field import HeightField
from insole_core.insole.surface.contact import sole_surface
from insole_core.memo import Memo
from insole_core.messages import Message
from insole_core.pressure.alignment import CELL_MM, SolePrint
from insole_core.pressure.regions import REGIONS, regions_of

STEP_MM = 2.0
SOFT_SHOE = (Layer(10.0, 2.0, 0.2),)
"""A midsole of foam."""
_STEEPEST_DEG = 60.0
_LEVELS = 3
"""Thicknesses of an insole between which it is interpolated."""
_STIFF = 0.02
"""What sinks less than this, mm/MPa, does not give way."""
_FLAT_MM, _FLAT_SHARE, _ROUNDS = 0.4, 0.3, 8
_NEEDED = ((0.06, 0.24, "heel", 0.06), (0.58, 0.76, "ball", 0.1))
"""Shares of the length between which the scan must show the foot, and how wide on either side."""
_ROWS = 0.8
_TOES = (0.86, 0.95)
_KEPT = 16
_BEHIND_HEADS = 0.04
"""Share of the length: pads press behind the heads, and relieve the heads themselves."""
_WITH_WEIGHT = Message(
    "The foot was recorded with a part of the weight on it: the sole is flatter than without it, "
    "and reliefs are understated."
)
_NOT_SAID = Message(
    "Nobody has said whether weight was on the foot as it was scanned: with it the sole is flatter "
    "than without it, and reliefs are understated."
)
_FLATTER = Message(
    "The imprint or cast was taken under a part of the weight: the sole is flatter than without "
    "it, and reliefs are understated."
)


def notes_of_weight(weight_bearing: str | None) -> tuple[Message, ...]:
    """Return what has to be told of the weight with which a foot was recorded.

    Parameters
    ----------
    weight_bearing
        One of `WEIGHT_BEARING`; None where nobody has said it.
    """
    if weight_bearing is None:
        return (_NOT_SAID,)
    return (_WITH_WEIGHT,) if weight_bearing == "semi" else ()


def check_weight(weight_bearing: str) -> None:
    """Refuse a foot that was recorded with the whole weight on it.

    Raises
    ------
    InputError
    """
    if weight_bearing == "full":
        raise InputError(
            "The foot was recorded with the weight on it, and its sole is flat then; how load "
            "moves can only be told from a foot without weight on it."
        )


def _cache() -> Memo:
    return Memo(_KEPT)


@dataclass(frozen=True, eq=False)
class Sole:
    """The unloaded sole on the nodes of a grid.

    Parameters
    ----------
    field
        Its height, mm, insole frame of the level foot; without meaning where it is not `known`.
    known : (ny, nx) bool
        Nodes that can touch.
    landmarks
        Of the foot; by them heel, heads and toes are told apart.
    derived
        Cache of what follows of it.
    """

    foot: Foot
    field: HeightField
    known: BoolArray
    landmarks: Landmarks
    derived: Memo = dataclasses.field(default_factory=_cache, init=False, repr=False)

    @classmethod
    def of(
        cls, foot: Foot, step_mm: float = STEP_MM, *, landmarks: Landmarks | None = None
    ) -> Sole:
        """Return the sole of a foot; cached with the foot.

        Parameters
        ----------
        landmarks
            With those that were corrected by hand; None: as they are found.

        Raises
        ------
        InputError
            When heel or ball are missing in the scan, or when weight has made the sole flat.
        """
        places = None if landmarks is None else tuple(
            (name, *map(float, mark.point)) for name, mark in landmarks.items()
        )  # fmt: skip
        find = partial(_checked_sole, foot, step_mm, landmarks)
        return foot.derived.get("pressed sole", (step_mm, places), find)

    @property
    def notes(self) -> tuple[Message, ...]:
        """What has to be told of how the foot was scanned."""
        return (_FLATTER,) if self.foot.form.is_spread else ()

    @cached_property
    def regions(self) -> IntArray:
        """(ny, nx) numbers of the regions, in `REGIONS`; -1 beside the foot."""
        numbers = regions_of(self.field.nodes[:, :2], self.landmarks, _BEHIND_HEADS)
        return numbers.reshape(self.known.shape)

    @cached_property
    def masks(self) -> tuple[BoolArray, ...]:
        """(ny, nx) which nodes that can touch are in each of `REGIONS`."""
        return tuple((self.regions == number) & self.known for number in range(len(REGIONS)))

    @cached_property
    def share(self) -> FloatArray:
        """(ny, 1) place of the rows along the foot, as a share of its length."""
        return np.asarray(self.field.y_mm[:, None] / self.foot.length_mm)

    @cached_property
    def tissue(self) -> FloatArray:
        """(3, ny, nx) how much tissue of each zone gives way upwards; more where the sole slopes.

        On a slope a pressure compresses tissue along the normal, and the bone comes down by more.
        """
        slope = np.minimum(self.field.slope_deg(), _STEEPEST_DEG)
        shares = tissue_shares(self.share, self._from_heads, self.field.heights_mm)
        return shares / np.cos(np.radians(slope))

    @cached_property
    def _from_heads(self) -> FloatArray:
        marks = self.landmarks
        x, y = np.array(sorted(tuple(marks[head].point[:2]) for head in HEADS)).T
        behind = self.field.y_mm[:, None] - np.interp(self.field.x_mm, x, y)
        return np.asarray(behind / self.foot.length_mm)

    @cached_property
    def has_toes(self) -> bool:
        """Whether the scan shows the toes."""
        return _shows(self.foot, *_TOES)


def _shows(foot: Foot, first: float, last: float, beside: float = 0.0) -> bool:
    """Return whether a scan shows the sole between shares of the length, in nearly every row.

    Parameters
    ----------
    beside
        Share of the length by which a row has to reach to either side of the foot's axis.
    """
    seen = ~SolePrint.of(foot).is_beside
    x_mm, y_mm = (
        start + CELL_MM * np.arange(count)
        for start, count in zip(SolePrint.of(foot).first_mm, seen.shape[::-1], strict=True)
    )
    rows = (y_mm >= first * foot.length_mm) & (y_mm <= last * foot.length_mm)
    reach_mm = beside * foot.length_mm
    right, left = seen[:, x_mm >= reach_mm], seen[:, x_mm <= -reach_mm]
    shown = right.any(axis=1) & left.any(axis=1) if beside else seen.any(axis=1)
    return bool(np.mean(np.asarray(shown)[rows]) >= _ROWS)


def _checked_sole(foot: Foot, step_mm: float, landmarks: Landmarks | None) -> Sole:
    for first, last, name, beside in _NEEDED:
        if not _shows(foot, first, last, beside):
            raise InputError(
                "The scan does not show the whole {part} of the foot, so it cannot be said how it "
                "is loaded; scan the whole sole.",
                part=name,
            )
    found = sole_surface(foot, InsoleDesign(foot.side, grid_mm=step_mm))
    known = found.measured & (found.surface.slope_deg() < _STEEPEST_DEG)
    rows, columns = (np.flatnonzero(known.any(axis=axis)) for axis in (1, 0))
    box = slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
    field = found.surface
    x0_mm, y0_mm = float(field.x_mm[columns[0]]), float(field.y_mm[rows[0]])
    heights = HeightField(x0_mm, y0_mm, step_mm, field.heights_mm[box])
    sole = Sole(foot, heights, known[box], landmarks or find_landmarks(foot))
    if _flat_share(sole) > _FLAT_SHARE:
        raise InputError(
            "The sole of this scan is flat, as weight makes it; how load moves can only be told "
            "from a foot that was scanned without weight on it."
        )
    return sole


def _flat_share(sole: Sole) -> float:
    """Return the share of a sole that lies in one plane."""
    nodes = sole.field.nodes[sole.known.ravel()]
    rows, z = np.column_stack([np.ones(len(nodes)), nodes[:, :2]]), nodes[:, 2]
    near = z <= np.median(z)
    for _ in range(_ROUNDS):
        plane = np.linalg.lstsq(rows[near], z[near], rcond=None)[0]
        off = np.abs(z - rows @ plane)
        near = off <= max(_FLAT_MM, float(np.median(off[near])))
    return float((off <= _FLAT_MM).mean())


@dataclass(frozen=True, eq=False)
class Ground:
    """What is below a sole, at its nodes: an insole, or the floor of a shoe.

    Parameters
    ----------
    top_mm, thickness_mm : (ny, nx) float64
        Of the insole, insole frame; its thickness is 0 beside it, where the floor is its top.
    body
        A millimetre of its material; None without an insole.
    shoe
        Layers of the shoe below; none of a rigid one.
    upper
        Separate layers of the insole, from the foot down; its body is what they leave.
    """

    top_mm: FloatArray
    thickness_mm: FloatArray
    body: Layer | None = None
    shoe: tuple[Layer, ...] = ()
    upper: tuple[Layer, ...] = ()

    def is_like(self, other: Ground) -> bool:
        """Return whether a foot stands on another ground just as on this one."""
        return (
            (self.body, self.shoe, self.upper) == (other.body, other.shoe, other.upper)
            and np.array_equal(self.top_mm, other.top_mm)
            and np.array_equal(self.thickness_mm, other.thickness_mm)
        )

    def softer(self, times: float) -> Ground:
        """Return the same with materials of moduli that are so many times lower."""
        if self.body is None:
            return self
        body, *upper = (
            replace(layer, modulus_mpa=layer.modulus_mpa / times)
            for layer in (self.body, *self.upper)
        )
        return replace(self, body=body, upper=tuple(upper))

    def strain(self, sunk_mm: FloatArray) -> FloatArray:
        """(ny, nx) how far the softest layer is compressed, as a share of it; 0 beside the insole.

        Parameters
        ----------
        sunk_mm : (ny, nx) float64
            How far insole and shoe have sunk together.
        """
        if self.body is None:
            return np.zeros_like(sunk_mm)
        whole = np.full_like(sunk_mm, uniform_compliance(self.shoe))
        softest = np.zeros_like(sunk_mm)
        left = self.thickness_mm
        most_mm = (*(layer.thickness_mm for layer in self.upper), np.inf)
        for layer, most in zip((*self.upper, self.body), most_mm, strict=True):
            whole += np.minimum(left, most) / layer.confined_mpa
            softest = np.where(left > 0, np.maximum(softest, 1 / layer.confined_mpa), softest)
            left = np.maximum(left - most, 0.0)
        mpa = np.divide(sunk_mm, whole, out=np.zeros_like(sunk_mm), where=self.thickness_mm > 0)
        return np.asarray(mpa * softest)

    def beds(self, known: BoolArray) -> list[Bed]:
        """Return what gives way: the thinnest stack, and for each thicker one what it adds."""
        counted: tuple[Layer, ...] = ()
        beds = []
        for thickness, share in self._steps(known):
            layers = (*self._insole(thickness), *self.shoe)
            if uniform_compliance(layers) - uniform_compliance(counted) > _STIFF:
                beds.append(Bed(layers, share, counted=counted))
                counted = layers
        return beds

    def _insole(self, thickness_mm: float) -> Iterator[Layer]:
        """Yield the layers of the insole where it has a thickness."""
        if self.body is None:
            return
        for layer in self.upper:
            taken_mm = min(layer.thickness_mm, thickness_mm)
            yield replace(layer, thickness_mm=taken_mm)
            thickness_mm -= taken_mm
        yield replace(self.body, thickness_mm=thickness_mm)

    def _steps(self, known: BoolArray) -> list[tuple[float, FloatArray]]:
        """Return thicknesses, and how far each node is thicker than the one before, up to 1."""
        among = np.linspace(0, 1, _LEVELS)
        levels = np.unique(np.quantile(self.thickness_mm[known], among).round(1))
        steps = [(float(levels[0]), np.ones_like(self.thickness_mm))]
        for thin, thick in pairwise(levels):
            reached = np.clip((self.thickness_mm - thin) / (thick - thin), 0.0, 1.0)
            steps.append((float(thick), reached))
        return steps


def shoe_floor(
    sole: Sole, design: InsoleDesign | None = None, shoe: Sequence[Layer] = ()
) -> Ground:
    """Return the floor of a shoe without an insole: flat, or as the last of a design's shoe."""
    floor = np.zeros(sole.known.shape)
    if design is not None:
        floor += last_heights_mm(design, sole.field.y_mm, sole.foot.length_mm)[:, None]
    return Ground(floor, np.zeros_like(floor), shoe=tuple(shoe))


def insole_on_floor(
    sole: Sole,
    design: InsoleDesign,
    contact: HeightField,
    layers: Sequence[Layer],
    shoe: Sequence[Layer] = (),
) -> Ground:
    """Return an insole in its shoe; beside it, the foot stands on the shoe's floor.

    Parameters
    ----------
    contact
        Upper side of the insole, with its pads, mm, insole frame.
    layers
        Of its materials, from the foot down; the last takes what the others leave.
    """
    floor = shoe_floor(sole, design).top_mm
    curve = insole_outline(sole.foot, design, find_landmarks(sole.foot))
    on_insole = sole.field.nodes_about(curve, 0)
    heights = _at_nodes(sole, contact).reshape(floor.shape)
    top = np.where(on_insole & np.isfinite(heights), heights, floor)
    *upper, body = layers
    return Ground(top, np.maximum(top - floor, 0.0), body, tuple(shoe), tuple(upper))


def _at_nodes(sole: Sole, contact: HeightField) -> FloatArray:
    """(n,) heights of a contact surface at the nodes of a sole; where they lie on it is kept."""
    nodes = sole.field.nodes[:, :2]
    shares = sole.derived.get("on contact", contact.grid, lambda: contact.weights_at(nodes))
    return np.asarray(shares @ contact.heights_mm.ravel())


def stand(
    sole: Sole,
    ground: Ground,
    load_n: float,
    centre_mm: tuple[float, float],
    tissue: Tissue,
    *,
    start: Pressed | None = None,
    follows: bool = False,
) -> Pressed:
    """Load a foot on its ground.

    Parameters
    ----------
    centre_mm
        Of the load, insole frame.
    start
        What was found on much the same ground, to start from.
    follows
        As in `Support.press`.

    Raises
    ------
    InputError
        When no pressure on the sole has this centre.
    """
    zones = zip(tissue.layers, sole.tissue, strict=True)
    beds = [Bed((layer,), share, layer.thickness_mm) for layer, share in zones]
    support = Support(sole.known.shape, sole.field.step_mm, [*beds, *ground.beds(sole.known)])
    gap = np.where(sole.known, sole.field.heights_mm - ground.top_mm, np.nan)
    x_mm, y_mm = centre_mm[0] - sole.field.x0_mm, centre_mm[1] - sole.field.y0_mm
    return support.press(gap, load_n, (x_mm, y_mm), start, follows=follows)
