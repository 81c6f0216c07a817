"""The contact surface: the foot's plantar side on a rectangular grid, thesis 3.3 and 6.3.4."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.sampling import sample_triangles
from insole_core.insole.design import InsoleDesign
from insole_core.insole.filling import fill
from insole_core.insole.height_field import HeightField
from insole_core.insole.posting import posted_mesh, posting_angles
from insole_core.progress import SILENT, Progress

_FACING = -0.34  # z of a normal that still counts as plantar: walls up to 70 degrees
_SAMPLES_PER_STEP = 1.5  # from sqrt 2 on, every node of a large triangle gets one
_LAYER_MM = 3.0  # what lies higher over the lowest layer of a node belongs to another layer
_COVERED = 0.3  # share of a node's cell that the foot must cover
_OUTLINE_HEIGHT_MM = 45.0  # the leg above does not widen the block


@dataclass(frozen=True, eq=False)
class ContactBase:
    """The contact surface before pads.

    Parameters
    ----------
    surface
        Insole frame, z = 0 the bottom plane; its lowest height is the design's thickness.
    measured : (ny, nx) bool
        Nodes where the foot was measured; the others continue it smoothly.
    """

    surface: HeightField
    measured: BoolArray


@dataclass(frozen=True)
class _Grid:
    """Absolute indices of the first node (row, column), and the number of nodes."""

    step_mm: float
    first: tuple[int, int]
    shape: tuple[int, int]

    def node(self, xy: FloatArray) -> tuple[IntArray, BoolArray]:
        """Nearest node of each place as a flat index, and whether it belongs to the grid."""
        index = np.rint(xy / self.step_mm).astype(np.int64)
        row, column = index[:, 1] - self.first[0], index[:, 0] - self.first[1]
        inside = (row >= 0) & (row < self.shape[0]) & (column >= 0) & (column < self.shape[1])
        return row * self.shape[1] + column, inside


def base_key(design: InsoleDesign) -> tuple[float, ...]:
    """Everything of a design that its contact base depends on; equal keys, equal base."""
    return (
        *posting_angles(design),
        design.thickness_mm,
        design.grid_mm,
        design.max_height_mm,
        design.margin_mm,
    )


def contact_base(foot: Foot, design: InsoleDesign, progress: Progress = SILENT) -> ContactBase:
    """Give the plantar surface on the design's grid, posted, filled, and lifted to its thickness.

    Parameters
    ----------
    foot
    design
        Of it only what `base_key` names.

    Raises
    ------
    DesignError
        When nothing of the foot faces the ground.
    """
    progress.step(0.0, "Turning the foot")
    mesh = posted_mesh(foot, *posting_angles(design))
    grid = _grid_around(foot, design)
    progress.step(0.2, "Laying the grid over the sole")
    heights, known = _snap(mesh, grid, design.max_height_mm)
    progress.step(0.7, "Continuing the surface to the edges")
    heights = fill(heights, known, grid.first)
    heights = heights + (design.thickness_mm - heights.min())
    row, column = grid.first
    field = HeightField(column * grid.step_mm, row * grid.step_mm, grid.step_mm, heights)
    return ContactBase(field, known)


def _grid_around(foot: Foot, design: InsoleDesign) -> _Grid:
    """Grid over the foot's outline and margin; the same for every posting of one foot."""
    low = foot.mesh.vertices[foot.mesh.vertices[:, 2] < _OUTLINE_HEIGHT_MM, :2]
    start = np.floor((low.min(axis=0) - design.margin_mm) / design.grid_mm).astype(int)
    end = np.ceil((low.max(axis=0) + design.margin_mm) / design.grid_mm).astype(int)
    columns, rows = (int(n) for n in end - start + 1)
    return _Grid(design.grid_mm, (int(start[1]), int(start[0])), (rows, columns))


def _snap(mesh: TriangleMesh, grid: _Grid, max_height_mm: float) -> tuple[FloatArray, BoolArray]:
    """Mean height of the sole at every node (thesis 3.3), and where there is one.

    The points are samples of the triangles, dense against the grid. Each is carried to its node
    along its triangle's plane, so that the mean of a sloped surface has no bias.
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


def _snapped_samples(
    mesh: TriangleMesh, grid: _Grid, max_height_mm: float
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Node (n,), height there (n,), and area in the (x, y)-plane (n,) of points on the sole."""
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
    """Triangles that face the ground and lie low: neither dorsum nor leg nor ankle."""
    low = mesh.vertices[:, 2] < mesh.vertices[:, 2].min() + max_height_mm
    part = mesh.part(low)
    return replace(part, triangles=part.triangles[part.triangle_normals[:, 2] < _FACING])
