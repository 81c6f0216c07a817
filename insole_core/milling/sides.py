"""The sides of a block that are milled: what a cutter may touch, and how deep it goes beside it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from insole_core.geometry.arrays import Float32Array, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.milling.contours import (
    EDGE_STEP_MM,
    Loop,
    contour,
    contour_loops,
    outermost,
    require_apart,
    ways_along_edge,
)
from insole_core.milling.machine import FlipAxis, Machine
from insole_core.milling.rasters import OVER_RIM, finishing
from insole_core.milling.roughing import roughing
from insole_core.milling.stock import Stock
from insole_core.milling.surface import Surface, sample_surface
from insole_core.milling.tabs import (
    OFF_EDGE_MM,
    Tabs,
    tabs_of_foot_side,
)
from insole_core.milling.tool_path import Operation, SideName
from insole_core.progress import Progress

_PITCH_MM = 0.25
_BESIDE_MM = 0.5
"""By which roughing goes farther from the solids than needed."""
_DEEPER_MM = 4.0
"""By which the ball may fall beside the edge of an underside, where the foot side was cut free."""


@dataclass(frozen=True, eq=False)
class BlockSide:
    """A side of the block as it lies up.

    Parameters
    ----------
    loops
        Of all solids, for the contour.
    rough_mm, floor_mm : (nx, ny) float32
        Heights beside the solids to which roughing goes, but for its allowance, and finishing and
        contour.
    along_edges : (n, 3) float64 each, mm
        Ways of the contour's cutter once the walls are cut.
    """

    name: SideName
    surface: Surface
    loops: tuple[Loop, ...]
    tabs: Tabs
    rough_mm: Float32Array
    floor_mm: Float32Array
    along_edges: tuple[FloatArray, ...] = ()


def one_side_of(
    solids: Sequence[TriangleMesh], block_mm: tuple[float, float, float], machine: Machine
) -> BlockSide:
    """Return the foot side of solids that stand on the bottom of the block.

    Raises
    ------
    DesignError
        When the cutter does not fit between two solids, or a solid and the side of the block.
    """
    surface = _sampled(solids, block_mm, machine)
    loops = [contour_loops(solid, machine, block_mm, 0.0) for solid in solids]
    return _foot_side(surface, loops, 0.0, np.zeros_like(surface.heights_mm), machine)


def both_sides_of(
    solids: Sequence[TriangleMesh], block_mm: tuple[float, float, float], machine: Machine
) -> list[BlockSide]:
    """Return the foot side and the underside, of solids that lie above a skin.

    The foot side is cut free down to the skin, but for tabs. They stand on the edge of the
    underside, wherever it is, so that they still hold the solids when the skin is gone.

    Raises
    ------
    DesignError
        When the cutter does not fit between two solids, or a solid and the side of the block.
    """
    flip, skin_mm = machine.both_sides.flip, machine.both_sides.skin_mm
    turned = [turned_over(solid, block_mm, flip) for solid in solids]
    surface, under = (_sampled(lying, block_mm, machine) for lying in (solids, turned))
    loops = [contour_loops(solid, machine, block_mm, skin_mm) for solid in solids]
    edge = (
        block_mm[2]
        - under.beyond_rim(under.heights_mm)[_nodes_below(surface, under, block_mm, flip)]
    )
    first = _foot_side(surface, loops, skin_mm, edge + np.float32(OFF_EDGE_MM), machine)
    places = turned_points(np.pad(first.tabs.places_mm, ((0, 0), (0, 1))), block_mm, flip)[:, :2]
    return [
        first,
        _underside(under, turned, replace(first.tabs, places_mm=places), block_mm, machine),
    ]


def mill_side(
    side: BlockSide, machine: Machine, block_height_mm: float, progress: Progress
) -> tuple[list[Operation], Stock]:
    """Return the operations of a side (roughing, finishing, contour), and what they leave.

    Raises
    ------
    Cancelled
    """
    stock = Stock(side.surface, block_height_mm, machine.roughing.step_over_mm)
    rough = roughing(
        side.surface.with_floor(np.minimum(side.rough_mm, np.float32(block_height_mm))),
        machine, block_height_mm, side.name,
        reach_mm=_reach_mm(machine), stock=stock, progress=progress.part(0.0, 0.5),
    )  # fmt: skip
    progress.step(0.5, "Finishing the surface")
    surface = side.surface.with_floor(side.floor_mm)
    finish = finishing(surface, machine, block_height_mm, side.name, stock)
    progress.step(0.8, "Cutting round the piece")
    walls = contour(
        side.loops, surface, machine, block_height_mm,
        side=side.name, tabs=side.tabs,
        stock=stock, along_edges=side.along_edges,
    )  # fmt: skip
    return [each for each in (rough, finish, walls) if each is not None], stock


def turned_over(
    solid: TriangleMesh, block_mm: tuple[float, float, float], flip: FlipAxis
) -> TriangleMesh:
    """Return a solid in the frame of the block after it was turned over."""
    return TriangleMesh(turned_points(solid.vertices, block_mm, flip), solid.triangles)


def turned_points(
    points_mm: FloatArray, block_mm: tuple[float, float, float], flip: FlipAxis
) -> FloatArray:
    """Return points (n, 3) of the block in its frame after it was turned over."""
    width, length, height = block_mm
    signs = np.array([-1.0, 1, -1] if flip == "length" else [1.0, -1, -1])
    offset = np.array([width if flip == "length" else 0, 0 if flip == "length" else length, height])
    return np.asarray(points_mm * signs + offset)


def _foot_side(
    surface: Surface,
    loops: Sequence[Sequence[Loop]],
    bottom_mm: float,
    tabs_begin_mm: Float32Array,
    machine: Machine,
) -> BlockSide:
    require_apart(loops, machine)
    outlines = [outermost(each) for each in loops]
    tabs = tabs_of_foot_side(surface, outlines, tabs_begin_mm, machine)
    floor = tabs.over(surface, bottom_mm)
    # What stays round the piece, which holds it till then, is cut in one step of the contour.
    web_mm = max(machine.contour.step_down_mm - machine.roughing.allowance_mm, 0.0)
    rough = np.maximum(floor, np.float32(bottom_mm + web_mm))
    every = tuple(loop for each in loops for loop in each)
    return BlockSide("foot side", surface, every, tabs, rough, floor)


def _underside(
    surface: Surface,
    solids: Sequence[TriangleMesh],
    tabs: Tabs,
    block_mm: tuple[float, float, float],
    machine: Machine,
) -> BlockSide:
    """Beside the edge the block was cut free from the foot side; only the tabs must stay."""
    edge = surface.beyond_rim(surface.heights_mm)
    tabs = tabs.begun_at(edge)
    lowest = float(tabs.heights_mm.min())
    loops = [loop for solid in solids for loop in contour_loops(solid, machine, block_mm, lowest)]
    fine = replace(machine, contour=replace(machine.contour, step_down_mm=EDGE_STEP_MM))
    along_edges = [
        way
        for solid in solids
        for way in ways_along_edge(
            contour_loops(solid, fine, block_mm, lowest), surface, edge, tabs
        )
    ]
    floor = tabs.over(surface, edge - np.float32(_DEEPER_MM))
    return BlockSide("underside", surface, tuple(loops), tabs, edge, floor, tuple(along_edges))


def _nodes_below(
    surface: Surface, under: Surface, block_mm: tuple[float, float, float], flip: FlipAxis
) -> tuple[FloatArray, ...]:
    """Return the nodes of the turned surface that lie below each node of another."""
    nodes = np.stack(np.meshgrid(surface.x_mm, surface.y_mm, indexing="ij"), axis=-1)
    points = np.pad(nodes.reshape(-1, 2), ((0, 0), (0, 1)))
    below = under.index_of(turned_points(points, block_mm, flip)[:, :2])
    return tuple(index.reshape(surface.inside.shape) for index in below)


def _reach_mm(machine: Machine) -> float:
    """Return how far from the solids the cutter's axis goes when it clears the block."""
    rough = machine.roughing
    beside = max(
        rough.cutter.radius_mm + rough.allowance_mm,
        machine.contour.cutter.diameter_mm - rough.cutter.radius_mm,
        machine.finishing.cutter.radius_mm * (1 + OVER_RIM) - rough.cutter.radius_mm,
    )
    return beside + rough.step_over_mm + _BESIDE_MM


def _sampled(
    solids: Sequence[TriangleMesh], block_mm: tuple[float, float, float], machine: Machine
) -> Surface:
    how = machine.finishing
    step = how.step_over_mm / np.ceil(how.step_over_mm / _PITCH_MM)
    return sample_surface(solids, block_mm, _reach_mm(machine) + 1, float(step))
