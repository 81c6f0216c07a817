"""Cutting of the walls from above to the bottom, with tabs, dowel holes and edges of undersides."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import cv2
import manifold3d
import numpy as np
import scipy
from numpy.lib.stride_tricks import sliding_window_view

from insole_core.errors import DesignError
from insole_core.geometry.arrays import BoolArray, Float32Array, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.polygon import signed_area_mm2
from insole_core.milling.machine import Cutter, Machine
from insole_core.milling.stock import MOST_BEYOND, Stock, runs_of_closed
from insole_core.milling.surface import Surface
from insole_core.milling.tabs import Tabs
from insole_core.milling.tool_path import (
    RAMP,
    Operation,
    PathWriter,
    SideName,
    densified,
)

_ARC_PIECES = 64
"""Of a circle; its chords leave an arc of 3 mm by less than twice `_CHORD_MM`."""
_CHORD_MM = 0.002
_DIGITS = 3
_DIGIT_MM = 10.0**-_DIGITS
"""Of a program."""
_SLACK_MM = 0.01
"""By which the cutter may be thicker than the gap between two solids; more is a gouge."""
_ABOVE_MM = 1e-4
_SECTION_MM = 0.25
"""Between the sections whose union a wall must stay outside of."""
_AT_WALL_MM = 0.5
"""Beside a wall; nodes so near to it are not told from those of the wall."""
_SEARCH_MM = 1.0
"""Pitch of the map that tells where there is still a wall."""
_STRAIGHT_MM = 0.2
"""Radius of a helix below which it would have too many turns."""
EDGE_STEP_MM = 0.125
_EDGE_HEIGHT_MM = 1.5
"""Between the ways along an edge, and how high above it they begin."""
_LINK_MM = 0.5
"""A way goes on to a point that is nearer: a straight line of this length cuts no corner."""
_ALONG_MM = 0.1
_EVEN_MM = 2.0
"""Between points of the edge, and how far to either side its height is evened."""


@dataclass(frozen=True, eq=False)
class Loop:
    """A closed way (n, 2) of the cutter's axis round a solid, mm, at a height in the block."""

    level_mm: float
    line_mm: FloatArray


def contour(
    loops: Sequence[Loop],
    surface: Surface,
    machine: Machine,
    block_height_mm: float,
    *,
    side: SideName,
    tabs: Tabs,
    stock: Stock,
    along_edges: Sequence[FloatArray] = (),
) -> Operation | None:
    """Cut round the solids, from the top of their walls down.

    Parameters
    ----------
    surface
        With the heights beside the solids to which the walls are cut.
    stock
        From which the cutter takes away.
    along_edges : (n, 3) float64 each, mm
        Further ways of the axis, once the walls are cut.

    Returns
    -------
    Operation or None
        None when there is nothing to cut.
    """
    how = machine.contour
    writer = PathWriter(block_height_mm + machine.safe_height_mm)
    walls = _wall_tops(surface, how.cutter.radius_mm)
    stock.go_along_walls(_beyond(surface, tabs, how.cutter, side))
    for loop in loops:
        path = tabs.over_way(densified(loop.line_mm), loop.level_mm, surface)
        needed = _needed(path, loop.level_mm, surface, walls, machine)
        for run in runs_of_closed(path[:-1], needed[:-1]):
            stock.write(run, writer, how.cutter, how.step_down_mm)
    for way in along_edges:
        stock.write(way, writer, how.cutter, how.step_down_mm)
    return None if writer.is_empty else writer.operation("contour", side, how.cutter)


def contour_loops(
    solid: TriangleMesh,
    machine: Machine,
    block_mm: tuple[float, float, float],
    bottom_mm: float,
) -> list[Loop]:
    """Compute the ways round a solid, from above.

    At every level the cutter stays off all that is above it, and goes round each part of it.

    Parameters
    ----------
    solid : mm, block's frame
    bottom_mm
        Of the last level.

    Raises
    ------
    DesignError
        When the cutter does not fit between a solid and the side of the block.
    """
    how = machine.contour
    body = manifold3d.Manifold(
        manifold3d.Mesh64(np.ascontiguousarray(solid.vertices), solid.triangles.astype(np.uint64))
    )
    top = float(solid.bounds_mm[1, 2])
    count = max(int(np.ceil((top - bottom_mm) / how.step_down_mm)), 1)
    seen, reached = manifold3d.CrossSection(), manifold3d.CrossSection()
    loops: list[Loop] = []
    sections = max(int(np.ceil(how.step_down_mm / _SECTION_MM)), 1)
    heights = bottom_mm + (top - bottom_mm) * np.arange(count * sections - 1, -1, -1) / (
        count * sections
    )
    for level in heights.reshape(count, sections):
        # At the bottom itself the section may be empty or ambiguous; just above, it is the wall.
        cuts = [body.slice(float(height) + _ABOVE_MM).simplify(_CHORD_MM) for height in level]
        seen = manifold3d.CrossSection.batch_boolean([seen, *cuts], manifold3d.OpType.Add)
        seen = seen.simplify(_CHORD_MM)
        grown = seen.offset(how.cutter.radius_mm + 2 * _CHORD_MM, circular_segments=_ARC_PIECES)
        reached = _outwards(reached + manifold3d.CrossSection(_filled(grown.simplify(_CHORD_MM))))
        lines = [np.concatenate([one, one[:1]]) for one in _filled(reached)]
        loops.extend(Loop(float(level[-1]), line) for line in lines)
    _require_room(np.concatenate([loop.line_mm for loop in loops]), block_mm, machine)
    return loops


def require_apart(loops: Sequence[Sequence[Loop]], machine: Machine) -> None:
    """Check that no way round one solid leads through another.

    Parameters
    ----------
    loops
        Of each solid; the last ones lie farthest out.

    Raises
    ------
    DesignError
        When the cutter does not fit between two solids.
    """
    cutter = machine.contour.cutter
    for one, other in combinations([_enclosed(each) for each in loops], 2):
        if not (one ^ other).is_empty():
            raise DesignError(
                'The cutter "{cutter}" of the contour needs {need:g} mm between two pieces, and '
                "some lie nearer to each other; lay them farther apart, or take a thinner cutter.",
                cutter=cutter.name,
                need=cutter.diameter_mm,
            )


def _enclosed(loops: Sequence[Loop]) -> manifold3d.CrossSection:
    """Return what the lowest ways round a solid enclose: the solid, wider by the radius."""
    lines = [loop.line_mm[:-1] for loop in loops if loop.level_mm == loops[-1].level_mm]
    return manifold3d.CrossSection(lines).offset(-_SLACK_MM / 2 - 2 * _CHORD_MM)


def outermost(loops: Sequence[Loop]) -> FloatArray:
    """Return the longest way (n, 2) round a solid, mm."""
    return max((loop.line_mm for loop in loops), key=signed_area_mm2)


def _filled(section: manifold3d.CrossSection) -> list[FloatArray]:
    """Return the outlines (n, 2) of all parts of a section, without holes."""
    polygons = [np.asarray(polygon) for polygon in section.to_polygons()]
    return [polygon for polygon in polygons if signed_area_mm2(polygon) > 0]


def _outwards(section: manifold3d.CrossSection) -> manifold3d.CrossSection:
    """Return a section with its corners moved outwards to the digits of a program.

    Corners that have them already stay. So a way that leads farther round than the one above it
    does so in the program too, and meets no skin of a thousandth that it left.
    """
    moved = []
    for polygon in section.to_polygons():
        corners = np.asarray(polygon)
        along = np.roll(corners, -1, axis=0) - np.roll(corners, 1, axis=0)
        normal = np.column_stack([along[:, 1], -along[:, 0]])
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), _DIGIT_MM)
        rounded = np.round(corners, _DIGITS)
        is_new = np.abs(rounded - corners).max(axis=1) > _DIGIT_MM / 100
        rounded[is_new] = np.round(corners + normal * _DIGIT_MM, _DIGITS)[is_new]
        moved.append(rounded)
    return manifold3d.CrossSection(moved)


def _require_room(way: FloatArray, block_mm: tuple[float, float, float], machine: Machine) -> None:
    low, high = way.min(axis=0), way.max(axis=0)
    over = max(*-low, *(high - block_mm[:2]))
    if over > 0:
        raise DesignError(
            "Round the piece there is {over:.1f} mm too little of the block for the cutter "
            '"{cutter}"; take a larger block, or a thinner cutter for the contour.',
            over=float(over),
            cutter=machine.contour.cutter.name,
        )


def _wall_tops(surface: Surface, radius_mm: float) -> Float32Array:
    """Return the greatest height (nx, ny) near each pixel of 1 mm of the surface."""
    pixels = max(round(_SEARCH_MM / surface.step_mm), 1)
    nx, ny = (-(-size // pixels) for size in surface.inside.shape)
    padding = [
        (0, n * pixels - size) for n, size in zip((nx, ny), surface.inside.shape, strict=True)
    ]
    padded = np.pad(np.where(surface.inside, surface.heights_mm, -1), padding, constant_values=-1)
    coarse = padded.reshape(nx, pixels, ny, pixels).max(axis=(1, 3)).astype(np.float32)
    reach = 2 * int(np.ceil(radius_mm / _SEARCH_MM) + 2) + 1
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (reach, reach))
    return np.asarray(cv2.dilate(coarse, kernel), np.float32)


def _beyond(surface: Surface, tabs: Tabs, cutter: Cutter, side: SideName) -> Float32Array:
    """Return by how many steps of a grid (nx, ny) the cutter is taken to reach farther.

    Never to what a piece keeps; a little to the side that is turned away from it, where each level
    leads farther out. Off the tabs of an underside the way round the foot side has been there.
    """
    outer = surface.beside_mm > cutter.radius_mm
    if side == "underside":
        near = surface.beside_mm < cutter.diameter_mm - _AT_WALL_MM
        outer &= near | np.isfinite(tabs.axis_heights(surface))
    return np.select(
        [surface.inside, outer], [np.float32(-np.inf), np.float32(MOST_BEYOND)], np.float32(0)
    )


def _needed(
    path: FloatArray, level_mm: float, surface: Surface, walls: Float32Array, machine: Machine
) -> BoolArray:
    """Find the points of a path (n, 3) beside a wall that reaches up to its level, and down."""
    i, j = surface.index_of(path[:, :2])
    pixels = max(round(_SEARCH_MM / surface.step_mm), 1)
    reaches_up = walls[i // pixels, j // pixels] >= level_mm
    reaches_down = surface.heights_mm[i, j] < path[:, 2] + machine.contour.step_down_mm
    return np.asarray(reaches_up & reaches_down & (surface.beside_mm[i, j] > 0))


def dowel_places(
    machine: Machine, block_mm: tuple[float, float, float]
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return x and y of both dowels, on the line about which the block is turned."""
    width, length, _ = block_mm
    inset = machine.both_sides.dowel_inset_mm
    if machine.both_sides.flip == "length":
        return (width / 2, inset), (width / 2, length - inset)
    return (inset, length / 2), (width - inset, length / 2)


def dowel_holes(
    machine: Machine, surface: Surface, block_mm: tuple[float, float, float]
) -> Operation:
    """Bore the holes for the dowels through the block.

    Raises
    ------
    DesignError
        When a hole is narrower than the cutter or deeper than it reaches, meets the side of the
        block, or is too near a piece.
    """
    for place in dowel_places(machine, block_mm):
        _require_free(place, machine, surface, block_mm)
    return bored_at_dowels(machine, block_mm)


def bored_at_dowels(
    machine: Machine, block_mm: tuple[float, float, float], side: SideName = "foot side"
) -> Operation:
    """Bore through a block, or through the upper layer of a spoil board, where the dowels sit.

    Raises
    ------
    DesignError
        When a hole is narrower than the cutter, or deeper than it reaches.
    """
    how, cutter = machine.both_sides, machine.contour.cutter
    radius = how.dowel_diameter_mm / 2 - cutter.radius_mm
    if radius < 0:
        raise DesignError(
            'A dowel hole of {hole:g} mm cannot be bored with the cutter "{cutter}"; choose a '
            "thicker dowel.",
            hole=how.dowel_diameter_mm,
            cutter=cutter.name,
        )
    _require_depth(cutter, block_mm[2])
    writer = PathWriter(block_mm[2] + machine.safe_height_mm)
    for place in dowel_places(machine, block_mm):
        writer.start(_bore(place, radius, block_mm[2], machine.roughing.step_down_mm))
    return writer.operation("dowels", side, cutter)


def _require_depth(cutter: Cutter, depth_mm: float) -> None:
    """Check that neither the collet nor a shank thicker than its edges meets the holes' rim."""
    free_mm = cutter.flute_mm if cutter.shank_mm > cutter.diameter_mm else cutter.reach_mm
    if free_mm < depth_mm:
        raise DesignError(
            'The cutter "{cutter}" goes {free:g} mm deep into a hole, and the holes for the dowels '
            "are {depth:g} mm deep; take a longer cutter for the contour.",
            cutter=cutter.name,
            free=free_mm,
            depth=depth_mm,
        )


def _require_free(
    place: tuple[float, float],
    machine: Machine,
    surface: Surface,
    block_mm: tuple[float, float, float],
) -> None:
    hole = machine.both_sides.dowel_diameter_mm / 2
    node = (np.array(place) - surface.first_mm) / surface.step_mm
    on_grid = bool(((node >= 0) & (node <= np.array(surface.inside.shape) - 1)).all())
    needed = hole + machine.contour.cutter.diameter_mm + machine.roughing.allowance_mm
    i, j = surface.index_of(np.array([place]))
    room = min(*place, block_mm[0] - place[0], block_mm[1] - place[1])
    if room < hole or (on_grid and surface.beside_mm[i[0], j[0]] < needed):
        raise DesignError(
            "The dowel at x = {x:.0f} mm, y = {y:.0f} mm of the block has no room beside the "
            "piece; take a longer block, or set it nearer to the end.",
            x=place[0],
            y=place[1],
        )


def _bore(
    place: tuple[float, float], radius_mm: float, height_mm: float, step_down_mm: float
) -> FloatArray:
    """Return a path (n, 3) that bores a hole in a helix, and a circle at its bottom.

    A hole hardly wider than the cutter is bored straight down.
    """
    round_mm = 2 * np.pi * radius_mm
    fall_mm = height_mm if radius_mm < _STRAIGHT_MM else min(step_down_mm, RAMP * round_mm)
    turns = int(np.ceil(height_mm / fall_mm))
    angle = np.linspace(0, 2 * np.pi * (turns + 1), 32 * (turns + 1) + 1)
    circle = np.array(place) + radius_mm * np.column_stack([np.cos(angle), np.sin(angle)])
    sunk_mm = np.minimum(angle / (2 * np.pi * turns), 1) * height_mm
    return np.column_stack([circle, height_mm - sunk_mm])


def ways_along_edge(
    loops: Sequence[Loop], surface: Surface, edge_mm: Float32Array, tabs: Tabs
) -> list[FloatArray]:
    """Put the points of loops together to ways that keep their heights above an edge.

    Where a surface falls steeply to an edge that rises and sinks, lines of the ball across it and
    levels of the contour leave steps; a level follows it only for a short way.

    Parameters
    ----------
    loops
        Round one solid, `EDGE_STEP_MM` apart.
    surface
    edge_mm : (nx, ny) float32
        Heights of the edge, beside the solids as at the nearest point.
    tabs
        Which the ways leave out.

    Returns
    -------
    (n, 3) float64 each, mm
        Of the cutter's axis, from above.
    """
    around = densified(outermost(loops), _ALONG_MM)[:-1]
    height = _evened(edge_mm[surface.index_of(around)])
    points = np.concatenate([_points(loop) for loop in loops])
    node = surface.index_of(points[:, :2])
    place = np.asarray(scipy.spatial.cKDTree(around).query(points[:, :2])[1])
    step = np.rint((points[:, 2] - height[place]) / EDGE_STEP_MM).astype(int)
    kept = (step >= 0) & (step <= _EDGE_HEIGHT_MM / EDGE_STEP_MM)
    kept &= (points[:, 2] >= tabs.axis_heights(surface)[node]) & (surface.beside_mm[node] > 0)
    points, step, place = points[kept], step[kept], place[kept]
    order = np.lexsort((place, -step))
    points, step = points[order], step[order]
    apart = np.linalg.norm(np.diff(points[:, :2], axis=0), axis=1) > _LINK_MM
    ends = np.flatnonzero(apart | (np.diff(step) != 0)) + 1
    return [_in_steps(way) for way in np.split(points, ends) if len(way) > 1]


def _points(loop: Loop) -> FloatArray:
    line = densified(loop.line_mm, _LINK_MM / 2)
    return np.column_stack([line, np.full(len(line), loop.level_mm)])


def _in_steps(way: FloatArray) -> FloatArray:
    """Let a way (n, 3) change its height only where the lower one of two points is free."""
    at = np.flatnonzero(np.diff(way[:, 2])) + 1
    before, after = way[at - 1], way[at]
    corners = np.where(before[:, 2:] < after[:, 2:], before, after)
    corners[:, 2] = np.maximum(before[:, 2], after[:, 2])
    return np.insert(way, at, corners, axis=0)


def _evened(heights_mm: FloatArray) -> FloatArray:
    """Even the heights (n,) along a closed edge, of nodes that lie more or less inside of it."""
    reach = round(_EVEN_MM / _ALONG_MM)
    for even in (np.min, np.mean):
        windows = sliding_window_view(np.pad(heights_mm, reach, mode="wrap"), 2 * reach + 1)
        heights_mm = even(windows, axis=1)
    return heights_mm
