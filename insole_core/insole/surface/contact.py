"""The contact surface: the foot's plantar side on a rectangular grid, thesis 3.3 and 6.3.4."""

from __future__ import annotations

from collections.abc import Set
from dataclasses import dataclass, field, fields, replace
from functools import partial
from typing import Any, TypeAlias

import numpy as np
import scipy

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.sampling import sample_triangles
from insole_core.insole.elements.correction import Sole
from insole_core.insole.fields import Place
from insole_core.insole.finishing.finished import FinishedSurface, finished
from insole_core.insole.forms.form_surface import base_surface, finish_on_base
from insole_core.insole.outline.insole_outline import insole_outline, outline_reach
from insole_core.insole.outline.shoe_outline import last_heights_mm
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish
from insole_core.insole.prescription.rim_sliders import finish_of
from insole_core.insole.primitives.height_field import HeightField
from insole_core.insole.surface.heel_rim import RimBand, rim_band
from insole_core.insole.surface.inpainting import fill
from insole_core.insole.surface.posting import posted
from insole_core.memo import Memo
from insole_core.progress import SILENT, Progress

_FACING = -0.42  # z of a normal that still counts as plantar: walls up to 65 degrees
_SAMPLES_PER_STEP = 1.5  # at sqrt 2 and above, every node of a large triangle gets one
_LAYER_MM = 3.0  # samples higher above the lowest one of a node belong to another layer
_COVERED = 0.3  # share of a node's cell that the foot must cover
_FRINGE_MM, _FIRM_NEIGHBOURS = 3.0, 4
"""Width of the fringe that is removed where nodes have fewer known neighbours, of eight; a straight
edge has five."""
_NEIGHBOURS = np.array([[1, 1, 1], [1, 0, 1], [1, 1, 1]], np.int8)
_RIM_MM, _RIM_SIGMA_MM = 4.0, 1.5
_WIDENING_MM = 10.0
_OUTLINE_HEIGHT_MM = 45.0  # the leg above this does not widen the block
_BESIDE_NODES = 2  # the cells that the edge crosses, and what their slopes depend on
_KEPT_SHAPES = 32  # twice the corrections of a rich prescription


@dataclass(frozen=True, eq=False)
class ContactBase:
    """The contact surface before pads.

    Parameters
    ----------
    surface
        Insole frame, z = 0 is the bottom plane; its lowest height is the design's thickness.
    measured : (ny, nx) bool
        Nodes where the foot was measured; the others continue it smoothly.
    arch_apex_mm
        Position (x, y) of the apex of the foot's own medial arch, insole frame.
    finished
        How the surface was finished; None of a design without a finish.
    shapes
        Cache of what corrections add on this grid, so that only the dragged one is recomputed.
    """

    surface: HeightField
    measured: BoolArray
    arch_apex_mm: Place
    finished: FinishedSurface | None = None
    shapes: Memo = field(default_factory=lambda: Memo(_KEPT_SHAPES), repr=False)


@dataclass(frozen=True)
class _Grid:
    """Absolute indices of the first node (row, column), and the number of nodes."""

    step_mm: float
    first: tuple[int, int]
    shape: tuple[int, int]

    def node(self, xy: FloatArray) -> tuple[IntArray, BoolArray]:
        """Return the nearest node of each point as a flat index, and whether it is in the grid."""
        index = np.rint(xy / self.step_mm).astype(np.int64)
        row, column = index[:, 1] - self.first[0], index[:, 0] - self.first[1]
        inside = (row >= 0) & (row < self.shape[0]) & (column >= 0) & (column < self.shape[1])
        return row * self.shape[1] + column, inside


BaseKey: TypeAlias = tuple[Any, ...]
_READ_IN_PART = frozenset({"corrections", "thickness_mm", "layers", "shell"})
_NOT_READ = frozenset({"bottom", "device"})


def base_key(design: InsoleDesign) -> BaseKey:
    """Return all values of a design on which its contact base depends: equal keys, equal base."""
    shell = design.shell
    return (
        *(replace(c, id="", author="", created_at="") for c in design.of_stage("turn", "sole")),
        None if shell is None else (shell.posts, shell.heel_pitch_mm, shell.trim_mm),
        design.least_thickness_mm,
        *values_but(design, _READ_IN_PART | _NOT_READ),
    )


def values_but(design: InsoleDesign, left_out: Set[str]) -> tuple[Any, ...]:
    """Return the values of a design for a key: all fields, a new one too, but those named."""
    return tuple(getattr(design, f.name) for f in fields(design) if f.name not in left_out)


def contact_base(foot: Foot, design: InsoleDesign, progress: Progress = SILENT) -> ContactBase:
    """Compute the plantar surface on the design's grid, corrected and raised to its thickness.

    The corrections that shape the whole surface are applied in a fixed order, whatever their order
    in the design: posting, then by `Correction.order`, and last the finish, which then makes the
    cup.

    Parameters
    ----------
    design
        Only the values in `base_key` are read.

    Returns
    -------
    ContactBase
        In the insole frame, mm.

    Raises
    ------
    DesignError
        If no part of the foot faces the ground.
    """
    sole = sole_surface(foot, design, progress.part(0.0, 0.8))
    progress.step(0.8, "Turning the foot and shaping the heel")
    surface, length = sole.surface, foot.length_mm
    if design.base is not None:
        surface = base_surface(foot, surface, design.base)
    level = surface
    surface = replace(surface, heights_mm=posted(surface, sole.measured, design, length))
    for correction in sorted(design.of_stage("sole"), key=lambda c: c.order):
        on = Sole(
            surface,
            sole.measured,
            foot.side,
            length,
            has_finish=design.finish is not None,
            beside_mm=partial(_beside_mm, foot, design, sole),
        )
        surface = replace(surface, heights_mm=correction.shaped(on))
    finish, asked = None, _finish_of(design)
    if asked is not None:
        progress.step(0.85, "Finishing rim and toe zone")
        finish = finished(
            foot,
            design,
            asked,
            sole=level,
            contact=surface,
            measured=sole.measured,
            arch_apex_mm=sole.arch_apex_mm,
        )
        surface = finish.surface
    return replace(sole, surface=_raised(surface, foot, design), finished=finish)


def with_rim(base: ContactBase, foot: Foot, design: InsoleDesign) -> ContactBase:
    """Return the base of a design that differs from that of `base` in its rim's stations only.

    It is much faster than `contact_base`, for a drag. The transitions to the rim keep their widths,
    so that a wall may get steeper than `contact_base` makes it.

    Raises
    ------
    DesignError
        If stations of the rim contradict each other.
    """
    finish = _finish_of(design)
    if base.finished is None or finish is None:
        return base
    moved = base.finished.with_rim(finish.rim)
    return replace(base, surface=_raised(moved.surface, foot, design), finished=moved)


def _finish_of(design: InsoleDesign) -> Finish | None:
    """Return a design's finish as its base and its heel cups change it."""
    finish = finish_of(design)
    return None if finish is None else finish_on_base(finish, design.base)


def _raised(surface: HeightField, foot: Foot, design: InsoleDesign) -> HeightField:
    """Raise a surface until its lowest place over the ground has the design's least thickness.

    What a short finished insole leaves off does not count: it is raised alone.
    """
    least_mm = design.least_thickness_mm
    ground = last_heights_mm(design, surface.y_mm, foot.length_mm)[:, None]
    over_ground = surface.heights_mm - ground
    if design.finish is None or design.outline.extent == "full":
        return replace(surface, heights_mm=surface.heights_mm + (least_mm - over_ground.min()))
    made = _made_nodes(surface, foot, design)
    up = least_mm - over_ground[made].min()
    raised = surface.heights_mm + up
    return replace(
        surface, heights_mm=np.where(made, raised, np.maximum(raised, ground + least_mm))
    )


def _made_nodes(surface: HeightField, foot: Foot, design: InsoleDesign) -> BoolArray:
    """Return the nodes (ny, nx) on a short insole and close beside it; cached with the foot."""

    def find() -> BoolArray:
        curve = insole_outline(foot, design, find_landmarks(foot))
        return surface.nodes_about(curve, _BESIDE_NODES)

    trim_mm = None if design.shell is None else design.shell.trim_mm
    return foot.derived.get("made nodes", (surface.grid, design.outline, trim_mm), find)


def sole_surface(foot: Foot, design: InsoleDesign, progress: Progress = SILENT) -> ContactBase:
    """Compute the plantar surface of the level foot on the design's grid; cached with the foot.

    Parameters
    ----------
    design
        Its grid, margin, greatest height and outline are read.

    Returns
    -------
    ContactBase
        Its heights are in mm above the foot's ground, z = 0 of the insole frame.

    Raises
    ------
    DesignError
        If no part of the foot faces the ground.
    """
    grid, highest_mm = _grid_around(foot, design), design.max_height_mm
    sample = partial(_sampled_sole, foot, grid, highest_mm, progress)
    return foot.derived.get("sole", (grid, highest_mm), sample)


def _beside_mm(
    foot: Foot, design: InsoleDesign, sole: ContactBase, rows: int
) -> tuple[FloatArray, FloatArray]:
    """Return where the rim of a cup can rise (see `RimBand`); cached with the foot."""
    field, outline = sole.surface, design.outline
    measure = partial(rim_band, foot, field, sole.measured, outline, rows)
    key = field.grid, design.max_height_mm, outline, rows
    band: RimBand = foot.derived.get("heel rim", key, measure)
    return band.beside_mm, band.room_mm


def _sampled_sole(foot: Foot, grid: _Grid, max_height_mm: float, progress: Progress) -> ContactBase:
    progress.step(0.2, "Laying the grid over the sole")
    heights, known = _snap(foot.mesh, grid, max_height_mm)
    known = _without_fringe(known, grid.step_mm)
    progress.step(0.7, "Continuing the surface to the edges")
    row, column = grid.first
    heights = _with_even_rim(fill(heights, known, grid.first), known, grid.step_mm)
    sole = HeightField(column * grid.step_mm, row * grid.step_mm, grid.step_mm, heights)
    apex = find_landmarks(foot)["arch_apex"].point
    return ContactBase(sole, known, (float(apex[0]), float(apex[1])))


def _grid_around(foot: Foot, design: InsoleDesign) -> _Grid:
    """Return a grid over foot and margin, and over the outline where that reaches farther.

    It is the same for every posting of one foot; dragging an outline widens it in large steps.
    """
    low = foot.mesh.vertices[foot.mesh.vertices[:, 2] < _OUTLINE_HEIGHT_MM, :2]
    outline = outline_reach(foot, design.outline) + design.grid_mm * np.array([[-2], [2]])
    first, last = low.min(axis=0) - design.margin_mm, low.max(axis=0) + design.margin_mm
    first = first - _WIDENING_MM * np.ceil(np.maximum(first - outline[0], 0) / _WIDENING_MM)
    last = last + _WIDENING_MM * np.ceil(np.maximum(outline[1] - last, 0) / _WIDENING_MM)
    start = np.floor(first / design.grid_mm).astype(int)
    end = np.ceil(last / design.grid_mm).astype(int)
    columns, rows = (int(n) for n in end - start + 1)
    return _Grid(design.grid_mm, (int(start[1]), int(start[0])), (rows, columns))


def _snap(mesh: TriangleMesh, grid: _Grid, max_height_mm: float) -> tuple[FloatArray, BoolArray]:
    """Return the mean height of the sole at every node (thesis 3.3), and where there is one.

    The points are samples of the triangles, dense relative to the grid. Each is moved to its node
    in the plane of its triangle, so that the mean of a sloped surface has no bias.
    """
    node, z, area = _snapped_samples(mesh, grid, max_height_mm)
    size = grid.shape[0] * grid.shape[1]
    lowest = np.full(size, np.inf)
    np.minimum.at(lowest, node, z)
    area = np.where(z < lowest[node] + _LAYER_MM, area, 0.0)
    covered = np.bincount(node, area, minlength=size)
    known = covered > _COVERED * grid.step_mm**2
    if not known.any():
        raise DesignError(
            "No part of this foot faces the ground, so no contact surface can be made;"
            " check the pose of the scan."
        )
    mean = np.bincount(node, area * z, minlength=size) / np.where(known, covered, 1.0)
    return mean.reshape(grid.shape), known.reshape(grid.shape)


def _without_fringe(known: BoolArray, step_mm: float) -> BoolArray:
    """Remove nodes with few neighbours at the rim.

    They are fragments of the flank, where a scan ends; filling between them would make pits.
    """
    for _ in range(max(round(_FRINGE_MM / step_mm), 1)):
        around = scipy.ndimage.convolve(known.astype(np.int8), _NEIGHBOURS, mode="constant")
        firm = known & (around >= _FIRM_NEIGHBOURS)
        if not firm.any():
            return known
        known = firm
    return known


def _with_even_rim(heights: FloatArray, known: BoolArray, step_mm: float) -> FloatArray:
    """Smooth the rim, more towards the edge: the flanks in a scan end in steps.

    Nodes farther inside keep their height to the bit.
    """
    inside_mm = scipy.ndimage.distance_transform_edt(known) * step_mm
    even = scipy.ndimage.gaussian_filter(heights, _RIM_SIGMA_MM / step_mm, mode="nearest")
    share = np.clip(inside_mm / _RIM_MM, 0, 1)
    return np.where(share < 1, even + share * (heights - even), heights)


def _snapped_samples(
    mesh: TriangleMesh, grid: _Grid, max_height_mm: float
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Sample the sole: node (n,), height there (n,), and area in the (x, y)-plane (n,)."""
    sole = _plantar_part(mesh, max_height_mm)
    samples = sample_triangles(sole, grid.step_mm / _SAMPLES_PER_STEP)
    xy = samples.points[:, :2]
    node, inside = grid.node(xy)
    to_node = np.rint(xy / grid.step_mm) * grid.step_mm - xy
    normal = sole.triangle_normals[samples.triangle]
    z = samples.points[:, 2] - (normal[:, :2] * to_node).sum(axis=1) / normal[:, 2]
    area = samples.area_mm2 * -normal[:, 2]
    return node[inside], z[inside], area[inside]


def _plantar_part(mesh: TriangleMesh, max_height_mm: float) -> TriangleMesh:
    """Return the low triangles that face the ground, without dorsum, leg and ankle."""
    low = mesh.vertices[:, 2] < mesh.vertices[:, 2].min() + max_height_mm
    part = mesh.part(low)
    return replace(part, triangles=part.triangles[part.triangle_normals[:, 2] < _FACING])
