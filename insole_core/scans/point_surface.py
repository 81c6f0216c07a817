"""A surface through a cloud of points: signed distances on a grid, and its zero level.

The distance to the tangent planes of the nearest points, weighted by nearness (Kolluri 2008,
"Provably good moving least squares"). Points without normals get those of the planes through their
neighbours, turned alike along the spanning tree of least bend (Hoppe and others 1992).
"""

from __future__ import annotations

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, ByteArray, FloatArray, IndexArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.surface_nets import surface_nets
from insole_core.messages import Message
from insole_core.scans.cleaning import first_of_each_place

_PLANE_NEIGHBOURS, _LINKED_NEIGHBOURS, _BLENDED_NEIGHBOURS = 16, 8, 8
_LEAST_CELL_MM, _MOST_POINTS = 1.0, 100_000
_MOST_NODES = 12_000_000
_SPACING_NEIGHBOUR = 6  # 1.4 times the distance of neighbours on a grid, as in a random sample
_CELL_SHARE, _REACH_SHARE = 0.72, 1.6
"""Edge of the grid's cells, and how far from a point the surface goes on, in these spacings."""
_BAND_CELLS = 3
_BOX = np.ones((3, 3, 3), dtype=bool)
_CROSS = np.abs(np.indices(_BOX.shape) - 1).sum(axis=0) <= 1  # without loading SciPy
_MOST_ONE_SIDED = 0.7
"""Of the mean distance to the nearest points, that their middle lies off within the surface."""
_OUTLIER_NEIGHBOURS, _OUTLIER_FACTOR = 6, 4.0
_FAR_SHARE, _CUBES, _ROUNDS = 0.005, 600, 8
"""Share of the points at either end beyond which some may lie far away; cubes along the rest."""


def even_points(points: FloatArray) -> IntArray:
    """Return which points (n,) are enough for a surface: one of each place, or of each cube.

    Parameters
    ----------
    points : (n, 3) float64
        In any unit.
    """
    if len(points) <= _MOST_POINTS:
        return first_of_each_place(points)
    sample = points[:: len(points) // 20_000]
    low, high = np.quantile(sample, (_FAR_SHARE, 1 - _FAR_SHARE), axis=0)
    size = float((high - low).max())
    inside = np.clip(points, low - size, high + size) - (low - size)  # what is far does not count
    if size == 0:
        return first_of_each_place(points)
    pitch = size / _CUBES
    for _ in range(_ROUNDS):
        chosen = _one_of_each(np.floor(inside / pitch).astype(np.int64))
        if len(chosen) <= _MOST_POINTS:
            break
        pitch *= 1.05 * np.sqrt(len(chosen) / _MOST_POINTS)  # as of a surface
    return chosen


def _one_of_each(cubes: IntArray) -> IntArray:
    """Return the first point of each cube (n, 3), in their order."""
    reach = cubes.max(axis=0) + 1
    keys = (cubes[:, 0] * reach[1] + cubes[:, 1]) * reach[2] + cubes[:, 2]
    return np.sort(np.unique(keys, return_index=True)[1])


def without_outliers(points: FloatArray) -> BoolArray:
    """Return which points (n,) lie among others: not much farther from them than most are.

    Parameters
    ----------
    points : (n, 3) float64
        In places of their own, in any unit.
    """
    tree = scipy.spatial.cKDTree(points)
    sample = points[:: max(1, len(points) // 20_000)]
    reach = min(_OUTLIER_NEIGHBOURS + 1, len(points))
    usual = float(np.median(_nearest(tree, sample, reach)[0][:, -1]))
    distance = _nearest(tree, points, reach, _OUTLIER_FACTOR * usual)[0][:, -1]
    return np.isfinite(distance)


def surface_through(
    points: FloatArray, normals: FloatArray | None, colors: ByteArray | None
) -> TriangleMesh:
    """Make a surface of points.

    Parameters
    ----------
    points : (n, 3) float64, mm
    normals : (n, 3) float64, optional
        Outwards, of any length; None to compute them.
    colors : (n, 3) uint8, optional

    Returns
    -------
    TriangleMesh
        Open where there are no points within a few times their distance.

    Raises
    ------
    ValueError
        When the points are too few for a surface.
    """
    if len(points) < 4 * _PLANE_NEIGHBOURS:
        raise ValueError(Message("they are too few for a surface"))
    tree = scipy.spatial.cKDTree(points)
    spacing = float(np.median(_nearest(tree, points, _SPACING_NEIGHBOUR + 1)[0][:, -1]))
    cell = max(_LEAST_CELL_MM, _CELL_SHARE * spacing)
    cell = max(cell, float(np.prod(np.ptp(points, axis=0) + 8 * cell) / _MOST_NODES) ** (1 / 3))
    given = None if normals is None else _unit_vectors(normals)
    directions = _normals(points, tree) if given is None else given
    mesh = _zero_level(points, directions, tree, cell)
    if colors is not None and len(mesh.vertices):
        mesh = mesh.with_attributes(colors=colors[_nearest(tree, mesh.vertices, 1)[1][:, 0]])
    return mesh


def _unit_vectors(vectors: FloatArray) -> FloatArray | None:
    """Return the vectors (n, 3) with length 1; None if some have none."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    if not np.isfinite(length).all() or (length == 0).any():
        return None
    return np.asarray(vectors / length)


def _normals(points: FloatArray, tree: scipy.spatial.cKDTree) -> FloatArray:
    """Return normals (n, 3) of the planes through each point's neighbours, turned outwards."""
    near = _nearest(tree, points, _PLANE_NEIGHBOURS)[1]
    offsets = points[near] - points[near].mean(axis=1, keepdims=True)
    covariance = np.einsum("nki,nkj->nij", offsets, offsets)
    normals = np.linalg.eigh(covariance)[1][:, :, 0]
    return np.asarray(
        normals * _turns(points, normals, near[:, 1 : _LINKED_NEIGHBOURS + 1])[:, None]
    )


def _turns(points: FloatArray, normals: FloatArray, near: IntArray) -> FloatArray:
    """Return +1 or -1 for each normal (n,), so that neighbours agree and pieces face outwards."""
    count, width = near.shape
    starts, ends = np.repeat(np.arange(count), width), near.ravel()
    cosines = np.einsum("ij,ij->i", normals[starts], normals[ends])
    weights = 1.001 - np.abs(cosines)
    graph = scipy.sparse.csr_array((weights, (starts, ends)), shape=(count, count))
    tree = scipy.sparse.csgraph.minimum_spanning_tree(graph.maximum(graph.T))
    _, piece = scipy.sparse.csgraph.connected_components(tree, directed=False)
    turn = _along_tree(tree, piece, normals)
    sizes = np.bincount(piece)
    middle = np.stack([np.bincount(piece, column) for column in points.T], axis=1) / sizes[:, None]
    outwards = np.einsum("ij,ij->i", points - middle[piece], normals) * turn
    return np.where(np.bincount(piece, outwards)[piece] < 0, -turn, turn)


def _along_tree(tree: scipy.sparse.csr_array, piece: IndexArray, normals: FloatArray) -> FloatArray:
    """Return +1 or -1 for each normal (n,), so that all agree with the first of their piece.

    Each knows how it compares with the one before it, and takes over what that one knows: in every
    round the way that is known of doubles.
    """
    count = len(normals)
    firsts = np.unique(piece, return_index=True)[1]
    root = scipy.sparse.csr_array(
        (np.ones(len(firsts)), (np.full(len(firsts), count), firsts)), shape=(count + 1, count + 1)
    )
    rooted = scipy.sparse.block_diag((tree, [[0.0]]), format="csr") + root
    _, before = scipy.sparse.csgraph.breadth_first_order(rooted, count, directed=False)
    before[count] = count
    before[firsts] = count
    with_root = np.vstack([normals, np.zeros(3)])
    agree = np.einsum("ij,ij->i", with_root, with_root[before]) >= 0  # with the root, all do
    turn = np.where(agree, 1.0, -1.0)
    while (before != count).any():
        turn *= turn[before]
        before = before[before]
    return turn[:count]


def _zero_level(
    points: FloatArray, normals: FloatArray, tree: scipy.spatial.cKDTree, cell: float
) -> TriangleMesh:
    margin = _BAND_CELLS + 2
    origin = points.min(axis=0) - margin * cell
    shape = np.ceil(np.ptp(points, axis=0) / cell).astype(int) + 2 * margin + 1
    near = np.zeros(shape, dtype=bool)
    near[tuple(np.rint((points - origin) / cell).astype(int).T)] = True
    for step in (_BOX, _CROSS, _BOX):  # nearly a ball of `_BAND_CELLS`
        near = scipy.ndimage.binary_dilation(near, step)
    nodes = np.argwhere(near)
    places = origin + cell * nodes
    distance, index = _nearest(tree, places, _BLENDED_NEIGHBOURS)
    heights = np.einsum("nki,nki->nk", places[:, None] - points[index], normals[index])
    width = np.maximum(distance[:, [_BLENDED_NEIGHBOURS // 2]], cell)
    weights = np.exp(-((distance / width) ** 2))
    values = np.full(shape, np.inf)
    values[near] = (weights * heights).sum(axis=1) / weights.sum(axis=1)
    known = np.zeros(shape, dtype=bool)
    known[near] = distance[:, 0] <= _BAND_CELLS * cell
    mesh = surface_nets(np.where(known, values, 1.0), known, origin, cell)
    if not len(mesh.triangles):
        raise ValueError(Message("they lie on no surface"))
    return mesh.part(_within_surface(mesh.vertices, points, tree, cell))


def _within_surface(
    vertices: FloatArray, points: FloatArray, tree: scipy.spatial.cKDTree, cell: float
) -> BoolArray:
    """Return which vertices (n,) lie near points, and not beyond the border of a surface."""
    distance, index = _nearest(tree, vertices, _BLENDED_NEIGHBOURS)
    aside = np.linalg.norm(points[index].mean(axis=1) - vertices, axis=1)
    beyond = (distance[:, 0] > cell) & (aside > _MOST_ONE_SIDED * distance.mean(axis=1))
    return np.asarray((distance[:, 0] <= _REACH_SHARE / _CELL_SHARE * cell) & ~beyond)


def _nearest(
    tree: scipy.spatial.cKDTree, places: FloatArray, count: int, within: float = np.inf
) -> tuple[FloatArray, IntArray]:
    """Return distances and indices (n, count) of the nearest points, inf where there is none."""
    wanted = np.arange(1, count + 1)
    distance, index = tree.query(places, wanted, distance_upper_bound=within, workers=-1)
    return np.asarray(distance), np.asarray(index)
