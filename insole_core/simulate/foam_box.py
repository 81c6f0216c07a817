"""A simulated foam box: feet pressed into foam, and its surface as a scanner from above sees it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray, IndexArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster
from insole_core.geometry.transforms import rigid, rotation_about

SINGLE_MM, DOUBLE_MM = (160.0, 320.0), (330.0, 300.0)
"""Width and length of a box for one foot, and for both."""
_BELOW_MM = 200.0
_STEEP = 3.0  # slope of a wall of which a scanner from above sees only parts
_PATCH_CELLS = 6.0


@dataclass(frozen=True)
class FoamBox:
    """A block of foam and the scanner above it.

    Parameters
    ----------
    size_mm
        Width and length.
    height_mm
        Of the block.
    curl_mm
        How far the edge of an imprint is dragged down; over about as much beside it.
    lip_mm
        How far the walls of the carton stand over the foam.
    cell_mm
        Distance of the measured points.
    noise_mm
        Standard deviation of their heights.
    unseen
        Share of the steep walls that the scanner does not see.
    is_closed
        Whether walls and bottom of the block are part of the surface.
    table_mm
        Width of the table around the block that was scanned as well; 0 for none.
    """

    size_mm: tuple[float, float] = SINGLE_MM
    height_mm: float = 70.0
    curl_mm: float = 4.0
    lip_mm: float = 0.0
    cell_mm: float = 1.0
    noise_mm: float = 0.2
    unseen: float = 0.3
    is_closed: bool = False
    table_mm: float = 0.0


def pressing(depth_mm: float, place_mm: tuple[float, float], yaw_deg: float = 0.0) -> FloatArray:
    """Return the transform (4, 4) of a foot, standing at z = 0, into the foam of a box.

    The frame of the box: x to the right, y ahead, z up; the origin in the middle of the rim.

    Parameters
    ----------
    depth_mm
        Of the lowest point of the sole below the rim.
    place_mm
        x and y to which the foot's origin comes.
    yaw_deg
        Rotation of the foot about z.
    """
    return rigid(
        rotation_about(np.array([0.0, 0.0, 1.0]), yaw_deg), np.array([*place_mm, -depth_mm])
    )


def press_feet(
    feet: Sequence[TriangleMesh], box: FoamBox, rng: np.random.Generator
) -> TriangleMesh:
    """Press feet straight down into foam, and scan it.

    The foam keeps the lowest height at which each of its columns was touched: it is the sole
    wherever the foot is not overhanging, and a vertical wall below the widest outline.

    Parameters
    ----------
    feet : mm, frame of the box
        Where they are at their deepest; see `pressing`.
    box
    rng
        For noise and for what is not seen.

    Returns
    -------
    TriangleMesh : mm, frame of the box
        Triangles face up, out of the foam.
    """
    x, y = (np.arange(-size / 2, size / 2 + box.cell_mm / 2, box.cell_mm) for size in box.size_mm)
    lowest = np.minimum.reduce([_lower_envelope(foot, x, y) for foot in feet])
    touched = lowest < 0
    heights = np.where(touched, lowest, _curled(lowest, touched, box))
    heights = heights + box.noise_mm * rng.standard_normal(heights.shape)
    if box.lip_mm > 0:
        heights[[0, 1, -2, -1]] = heights[:, [0, 1, -2, -1]] = box.lip_mm
    mesh = _grid_mesh(x, y, heights, _seen(heights, box, rng))
    parts = [mesh]
    if box.is_closed:
        parts.append(_walls_and_bottom(x, y, heights, -box.height_mm))
    if box.table_mm > 0:
        parts.append(_table(box))
    return _joined(parts)


def _lower_envelope(foot: TriangleMesh, x: FloatArray, y: FloatArray) -> FloatArray:
    """Return the lowest height of a foot over every node (ny, nx); infinite where there is none."""
    across, along = np.meshgrid(x, y)
    starts = np.stack([across.ravel(), along.ravel(), np.full(across.size, -_BELOW_MM)], axis=1)
    hits = RayCaster(foot).cast(starts, np.broadcast_to([0.0, 0.0, 1.0], starts.shape))
    lowest = np.full(len(starts), np.inf)
    corners = foot.vertices[foot.triangles[hits.triangle], 2]
    lowest[hits.ray] = (hits.weights * corners).sum(axis=1)
    return lowest.reshape(across.shape)


def _curled(lowest: FloatArray, touched: BoolArray, box: FoamBox) -> FloatArray:
    """Return the heights of the foam that was not touched: dragged down beside the imprint."""
    away, nearest = scipy.ndimage.distance_transform_edt(~touched, box.cell_mm, return_indices=True)
    depth = np.minimum(box.curl_mm, -lowest[tuple(nearest)])
    dragged = -depth * np.exp(-away / max(box.curl_mm, 1e-6))
    return np.asarray(np.minimum(dragged, 0.0))


def _seen(heights: FloatArray, box: FoamBox, rng: np.random.Generator) -> BoolArray:
    """Return which cells of the grid (ny - 1, nx - 1) the scanner sees."""
    corners = np.stack([heights[:-1, :-1], heights[1:, :-1], heights[:-1, 1:], heights[1:, 1:]])
    steep = np.ptp(corners, axis=0) > _STEEP * box.cell_mm
    patches = scipy.ndimage.gaussian_filter(rng.standard_normal(steep.shape), _PATCH_CELLS)
    hidden = patches < np.quantile(patches, box.unseen) if box.unseen > 0 else False
    return np.asarray(~(steep & hidden))


def _grid_mesh(x: FloatArray, y: FloatArray, heights: FloatArray, seen: BoolArray) -> TriangleMesh:
    across, along = np.meshgrid(x, y)
    vertices = np.stack([across.ravel(), along.ravel(), heights.ravel()], axis=1)
    index = np.arange(heights.size, dtype=np.int32).reshape(heights.shape)
    a, b = index[:-1, :-1][seen], index[:-1, 1:][seen]
    c, d = index[1:, 1:][seen], index[1:, :-1][seen]
    triangles = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    return TriangleMesh(vertices, triangles)


def _walls_and_bottom(
    x: FloatArray, y: FloatArray, heights: FloatArray, bottom_mm: float
) -> TriangleMesh:
    """Close a block below its upper side; the seam has the same points, so that files join it."""
    across, along = np.meshgrid(x, y)
    upper = np.stack([across, along, heights], axis=-1)
    ring = np.concatenate([upper[0], upper[1:, -1], upper[-1, -2::-1], upper[-2:0:-1, 0]])
    low = ring * [1, 1, 0] + [0, 0, bottom_mm]
    count = len(ring)
    here, after = np.arange(count), (np.arange(count) + 1) % count
    walls = np.concatenate(
        [
            np.stack([here, here + count, after], axis=1),
            np.stack([after, here + count, after + count], axis=1),
            np.stack([np.full(count, 2 * count), after + count, here + count], axis=1),
        ]
    )
    middle = [[0.0, 0.0, bottom_mm]]
    return TriangleMesh(np.concatenate([ring, low, middle]), walls.astype(np.int32))


def _table(box: FoamBox) -> TriangleMesh:
    """Return the table beside the block, facing up."""
    step = 4 * box.cell_mm
    x, y = (np.arange(-s / 2 - box.table_mm, s / 2 + box.table_mm, step) for s in box.size_mm)
    across, along = np.meshgrid(x[:-1] + step / 2, y[:-1] + step / 2)
    beside = (abs(across) > box.size_mm[0] / 2 + step) | (abs(along) > box.size_mm[1] / 2 + step)
    return _grid_mesh(x, y, np.full((len(y), len(x)), -box.height_mm), beside)


def _joined(parts: Sequence[TriangleMesh]) -> TriangleMesh:
    """Concatenate surfaces, merge equal points and leave out those without a triangle."""
    starts = np.cumsum([0, *(len(part.vertices) for part in parts)])
    triangles: list[IndexArray] = [
        (part.triangles + start).astype(np.int32)
        for part, start in zip(parts, starts[:-1], strict=True)
    ]
    points = np.concatenate([part.vertices for part in parts])
    vertices, kind = np.unique(points, axis=0, return_inverse=True)
    mesh = TriangleMesh(vertices, kind.ravel()[np.concatenate(triangles)].astype(np.int32))
    used = np.zeros(len(vertices), dtype=bool)
    used[mesh.triangles] = True
    return mesh.part(used)
