"""The tool paths of solids in a block: what is milled, how long it takes, and what stays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.errors import DesignError
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.messages import Message
from insole_core.milling.contours import dowel_holes
from insole_core.milling.drop_cutter import STEEPEST
from insole_core.milling.machine import Machine
from insole_core.milling.sides import both_sides_of, mill_side, one_side_of, turned_over
from insole_core.milling.stock import Stock
from insole_core.milling.surface import Surface
from insole_core.milling.tabs import Tabs
from insole_core.milling.tool_path import Motion, Operation, SideName
from insole_core.progress import SILENT, Progress

_MOST_LEFT_MM = 0.2
"""Material in a hollow of which nothing is said."""
HEIGHT_TOLERANCE_MM = 0.05
"""By which a piece may be higher than its block: the rounding of files."""
_TAB_SHARE = 0.9
"""Of the thickness asked for, from which nothing is said of a tab."""
_FAR_MM = 1e3
_LAND_MM = 2.0
"""Width along a wall of which the left-over material is not computed."""
_LEAST_UP = 0.15
"""Share of a normal along z from which a surface is milled from above, and is no wall."""
_HOLLOW = {
    "medial": 'The cutter "{cutter}" is too thick for a hollow of the {side}, {heel:.0f} mm from '
    "the heel on the medial side: {left:.1f} mm stay there; take a thinner one.",
    "middle": 'The cutter "{cutter}" is too thick for a hollow of the {side}, {heel:.0f} mm from '
    "the heel in the middle: {left:.1f} mm stay there; take a thinner one.",
    "lateral": 'The cutter "{cutter}" is too thick for a hollow of the {side}, {heel:.0f} mm from '
    "the heel on the lateral side: {left:.1f} mm stay there; take a thinner one.",
}


@dataclass(frozen=True, eq=False)
class LeftOver:
    """Material that the program leaves, on pixels of about 0.25 mm.

    Parameters
    ----------
    first_mm : (2,) float64
        x and y of the pixel [0, 0], in the block's frame as the side lies.
    pitch_mm
        From pixel to pixel.
    height_mm : (nx, ny) float64
        Of the material; NaN beside the solids.
    top_mm : (nx, ny) float64
        Of the surface, above the bottom of the block.
    """

    side: SideName
    first_mm: FloatArray
    pitch_mm: float
    height_mm: FloatArray
    top_mm: FloatArray

    def at(self, points_mm: FloatArray) -> FloatArray:
        """Return the height of the material (n,) at places (n, 2) in mm, as the side lies.

        A place on the land along a wall, which no pixel lies on, has that of the nearest pixel.
        """
        away, nearest = scipy.ndimage.distance_transform_edt(
            np.isnan(self.height_mm), return_indices=True
        )
        heights = np.where(away * self.pitch_mm <= _LAND_MM, self.height_mm[tuple(nearest)], np.nan)
        pixels = np.rint((points_mm - self.first_mm) / self.pitch_mm).astype(int)
        rows, columns = np.clip(pixels, 0, np.array(heights.shape) - 1).T
        return np.asarray(heights[rows, columns])


@dataclass(frozen=True)
class FootInBlock:
    """For which foot a solid is, and whether its toes point to the end of the block at y = 0.

    Parameters
    ----------
    order
        By which the shop knows it, where a block holds those of several; never the patient's name.
    """

    side: Side
    is_turned: bool = False
    order: str = ""


@dataclass(frozen=True, eq=False)
class MillingPlan:
    """Everything that is milled from one block.

    Parameters
    ----------
    block_mm
        Width (x), length (y), height.
    solids : mm
        Where they lie in the block, foot side up.
    left_over
        Of each side that is milled.
    notes
        What the shop should know, one sentence each.
    feet
        For which foot each solid is.
    """

    machine: Machine
    block_mm: tuple[float, float, float]
    solids: tuple[TriangleMesh, ...]
    operations: tuple[Operation, ...]
    left_over: tuple[LeftOver, ...]
    notes: tuple[Message, ...]
    feet: tuple[FootInBlock, ...] = ()

    def left_on(self, number: int) -> FloatArray:
        """Return the height of the material that stays at each vertex of a solid.

        Returns
        -------
        (n,) float64, mm
            NaN on walls, and on a side that is not milled.
        """
        solid = self.solids[number]
        values = np.full(len(solid.vertices), np.nan)
        for left in self.left_over:
            lying = solid
            if left.side == "underside":
                lying = turned_over(solid, self.block_mm, self.machine.both_sides.flip)
            faces_up = lying.vertex_normals[:, 2] > _LEAST_UP
            values[faces_up] = left.at(lying.vertices[faces_up, :2])
        return values

    @property
    def is_turned(self) -> bool:
        """Whether the block is turned onto dowels, so that its underside is milled too."""
        return any(operation.side == "underside" for operation in self.operations)

    @property
    def minutes(self) -> float:
        """Time of the path, without changes of cutters."""
        return sum(operation.minutes(self.machine) for operation in self.operations)

    @property
    def most_left_mm(self) -> float:
        """Greatest height of the material that stays in a hollow."""
        return max(float(np.nanmax(left.height_mm)) for left in self.left_over)

    @property
    def length_m(self) -> float:
        """Length of the path at feed, plunging included."""
        kinds = (Motion.FEED, Motion.PLUNGE)
        return sum(item.lengths_mm(kind) for item in self.operations for kind in kinds) / 1000


def plan_milling(
    solids: Sequence[TriangleMesh],
    block_mm: tuple[float, float, float],
    machine: Machine,
    *,
    both_sides: bool = False,
    feet: Sequence[FootInBlock] = (),
    progress: Progress = SILENT,
) -> MillingPlan:
    """Compute the tool paths of solids in a block.

    Parameters
    ----------
    solids : mm
        Standing on the bottom of the block: a corner at the origin, its width along x and its
        length along y.
    block_mm
        Width, length, height.
    both_sides
        Whether the block is turned, so that the underside is milled too. The solids then lie
        `skin_mm` above its bottom.
    feet
        For which foot each solid is; then places in notes are said by heel and side.

    Raises
    ------
    DesignError
        When block, machine or a cutter is too small.
    Cancelled
    """
    lift = machine.both_sides.skin_mm if both_sides else 0.0
    lying = [_moved(solid, np.array([0.0, 0.0, lift])) for solid in solids]
    _require_fit(lying, block_mm, machine)
    parts = progress.parts(3 if both_sides else 2)
    parts[0].step(0.0, "Sampling the surface")
    if both_sides:
        sides = both_sides_of(lying, block_mm, machine)
        operations = [dowel_holes(machine, sides[0].surface, block_mm)]
    else:
        sides = [one_side_of(lying, block_mm, machine)]
        operations = []
    left_over = []
    for side, part in zip(sides, parts[1:], strict=True):
        own, stock = mill_side(side, machine, block_mm[2], part.part(0.0, 0.9))
        operations += own
        part.step(0.9, "Looking for material that stays")
        left_over.append(_left_over(side.surface, stock, side.name))
    hollows = [_hollow(left, machine, block_mm, lying, feet) for left in left_over]
    notes = tuple(note for note in (*hollows, _thin_tabs(sides[0].tabs)) if note is not None)
    return MillingPlan(
        machine, block_mm, tuple(lying), tuple(operations), tuple(left_over), notes, tuple(feet)
    )


def _thin_tabs(tabs: Tabs) -> Message | None:
    """Say how many tabs stay thinner than asked for."""
    asked_mm = tabs.how.tab_height_mm
    thin = tabs.thickness_mm < _TAB_SHARE * asked_mm
    if not thin.any():
        return None
    return Message(
        "{thin} of {count} tabs stay thinner than the {asked:g} mm that were asked for, the "
        "thinnest {least:.1f} mm: the edge is thin or steep there, or no block stays beside "
        "it. Hold the piece down when it comes free, or leave more of the block beside it.",
        thin=int(thin.sum()),
        count=len(thin),
        asked=asked_mm,
        least=float(tabs.thickness_mm.min()),
    )


def _moved(solid: TriangleMesh, by_mm: FloatArray) -> TriangleMesh:
    return TriangleMesh(solid.vertices + by_mm, solid.triangles)


def _require_fit(
    solids: Sequence[TriangleMesh], block_mm: tuple[float, float, float], machine: Machine
) -> None:
    high = np.max([solid.bounds_mm[1] for solid in solids], axis=0)
    low = np.min([solid.bounds_mm[0] for solid in solids], axis=0)
    if high[2] > block_mm[2] + HEIGHT_TOLERANCE_MM:
        raise DesignError(
            "The block is {there:g} mm high, and the piece needs {need:.1f} mm in it; take a "
            "higher block.",
            there=block_mm[2],
            need=float(high[2]),
        )
    if min(low) < -1e-6 or (high[:2] - block_mm[:2] > 1e-6).any():
        raise DesignError("The piece does not lie within the block; take a larger block.")
    deepest = block_mm[2] - float(low[2])
    for cutter in (machine.roughing.cutter, machine.finishing.cutter, machine.contour.cutter):
        if cutter.reach_mm < deepest:
            raise DesignError(
                'The cutter "{cutter}" reaches {reach:g} mm, and must go {depth:.1f} mm deep; '
                "take a lower block or a longer cutter.",
                cutter=cutter.name,
                reach=cutter.reach_mm,
                depth=deepest,
            )
        if cutter.shank_mm > cutter.diameter_mm and cutter.flute_mm < deepest:
            raise DesignError(
                'The shank of the cutter "{cutter}" is thicker than its edges, which are {flute:g} '
                "mm long, and must go {depth:.1f} mm deep beside walls; take a lower block or "
                "another cutter.",
                cutter=cutter.name,
                flute=cutter.flute_mm,
                depth=deepest,
            )
    _require_travel(block_mm, machine)


def _require_travel(block_mm: tuple[float, float, float], machine: Machine) -> None:
    width, length, height = block_mm
    across = (length, width) if machine.length_along == "x" else (width, length)
    needed = (*across, height + machine.safe_height_mm)
    for axis, need, there in zip("xyz", needed, machine.travel_mm, strict=True):
        if need > there:
            raise DesignError(
                "{machine} travels {there:g} mm along {axis}, and the block needs {need:g} mm; "
                "take a smaller block.",
                machine=machine.name,
                there=there,
                axis=axis,
                need=need,
            )
    base = (0.0, 0.0) if machine.origin.at == "corner" else (across[0] / 2, across[1] / 2)
    for axis, start, offset, size in zip("xy", base, machine.origin.offset_mm, across, strict=True):
        if not 0 <= start + offset <= size:
            raise DesignError(
                "The origin of {machine} lies outside the block: {place:g} mm along {axis}, and "
                "the block has {size:g} mm; correct its offset in the machine file.",
                machine=machine.name,
                place=start + offset,
                axis=axis,
                size=size,
            )


def _left_over(surface: Surface, stock: Stock, side: SideName) -> LeftOver:
    """Compare what the cutters leave with the surface, on every few nodes of the grid."""
    every = stock.every
    heights, within = surface.heights_mm[::every, ::every], _off_the_walls(surface, every)
    left = np.where(within, np.minimum(stock.heights_mm, stock.last_swept()) - heights, np.nan)
    return LeftOver(
        side, surface.first_mm, every * surface.step_mm,
        np.maximum(left, 0), np.asarray(heights, float),
    )  # fmt: skip


def _off_the_walls(surface: Surface, every: int) -> BoolArray:
    """Find the nodes (every few of them) that are no part of a wall, and not beside one."""
    fall = np.zeros(surface.inside.shape, np.float32)
    heights = np.where(surface.inside, surface.heights_mm, np.float32(-_FAR_MM))
    for axis in (0, 1):
        for by in (1, -1):
            np.maximum(fall, np.abs(heights - np.roll(heights, by, axis)), out=fall)
    flat = surface.inside & (fall < STEEPEST * surface.step_mm)
    return np.asarray(scipy.ndimage.binary_erosion(flat, iterations=2)[::every, ::every])


def _hollow(
    left: LeftOver,
    machine: Machine,
    block_mm: tuple[float, float, float],
    solids: Sequence[TriangleMesh],
    feet: Sequence[FootInBlock],
) -> Message | None:
    """Say where the cutter is too thick for a hollow."""
    if not (left.height_mm > _MOST_LEFT_MM).any():
        return None
    place = np.unravel_index(np.nanargmax(left.height_mm), left.height_mm.shape)
    x, y = left.first_mm + np.array(place) * left.pitch_mm
    words: dict[str, str | float] = {
        "cutter": machine.finishing.cutter.name,
        "side": Message(left.side),
        "left": float(left.height_mm[place]),
    }
    if left.side == "underside":
        by_length = machine.both_sides.flip == "length"
        x, y = (block_mm[0] - x, y) if by_length else (x, block_mm[1] - y)
    for solid, foot in zip(solids, feet, strict=False):
        low, high = solid.bounds_mm[:, :2]
        if (low <= [x, y]).all() and ([x, y] <= high).all():
            from_heel = high[1] - y if foot.is_turned else y - low[1]
            told = Message(
                _HOLLOW[_region(float(x), low, high, foot)], **words, heel=float(from_heel)
            )
            if not foot.order:
                return told
            piece = Message("{order} {side}", order=foot.order, side=Message(str(foot.side)))
            return Message("{piece}: {told}", piece=piece, told=told)
    return Message(
        'The cutter "{cutter}" is too thick for a hollow of the {side} at x = {x:.0f} mm, '
        "y = {y:.0f} mm of the block: {left:.1f} mm stay there; take a thinner one.",
        **words,
        x=float(x),
        y=float(y),
    )


def _region(x_mm: float, low_mm: FloatArray, high_mm: FloatArray, foot: FootInBlock) -> str:
    """Return which third of a solid's width a place lies in."""
    share = (x_mm - low_mm[0]) / (high_mm[0] - low_mm[0]) - 0.5
    medial = share * foot.side.medial_sign * (-1 if foot.is_turned else 1)
    if abs(medial) < 1 / 6:
        return "middle"
    return "medial" if medial > 0 else "lateral"
