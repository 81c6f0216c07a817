"""A surface through a cloud of points: signed distances on a grid, and its zero level.

The distance to the tangent planes of the nearest points, weighted by nearness (Kolluri 2008,
"Provably good moving least squares"). Points without normals get those of the planes through their
neighbours, turned alike along the spanning tree of least bend (Hoppe and others 1992).
"""

from __future__ import annotations

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, ByteArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.surface_nets import surface_nets
from insole_core.messages import Message

_PLANE_NEIGHBOURS, _LINKED_NEIGHBOURS, _BLENDED_NEIGHBOURS = 16, 8, 8
_LEAST_CELL_MM, _MOST_POINTS = 1.0, 150_000
_MOST_NODES = 12_000_000
_SPACING_NEIGHBOUR = 6  # 1.4 times the distance of neighbours on a grid, as in a random sample
_CELL_SHARE, _REACH_SHARE = 0.72, 1.6
"""Edge of the grid's cells, and how far from a point the surface goes on, in these spacings."""
_BAND_CELLS = 3
_MOST_ONE_SIDED = 0.7
"""Of the mean distance to the nearest points, that their middle lies off within the surface."""
_OUTLIER_NEIGHBOURS, _OUTLIER_FACTOR = 6, 4.0


def without_outliers(points: FloatArray) -> BoolArray:
    """Return which points (n,) lie among others: not much farther from them than most are."""
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
    points, normals, colors = _thinned(points, normals, colors)
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


def _thinned(
    points: FloatArray, normals: FloatArray | None, colors: ByteArray | None
) -> tuple[FloatArray, FloatArray | None, ByteArray | None]:
    """Keep one point in each cube, so that not many more than are needed are left."""
    if len(points) <= _MOST_POINTS:
        return points, normals, colors
    pitch = _LEAST_CELL_MM / 2
    while True:
        cube = np.floor((points - points.min(axis=0)) / pitch).astype(np.int64)
        reach = cube.max(axis=0) + 1
        keys = (cube[:, 0] * reach[1] + cube[:, 1]) * reach[2] + cube[:, 2]
        chosen = np.unique(keys, return_index=True)[1]
        if len(chosen) <= _MOST_POINTS:
            break
        pitch *= 1.3
    return (
        points[chosen],
        None if normals is None else normals[chosen],
        None if colors is None else colors[chosen],
    )


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
    pieces, piece = scipy.sparse.csgraph.connected_components(tree, directed=False)
    turn = np.ones(count)
    for number in range(pieces):
        members = np.flatnonzero(piece == number)
        order, before = scipy.sparse.csgraph.breadth_first_order(tree, members[0], directed=False)
        agree = np.einsum("ij,ij->i", normals[order[1:]], normals[before[order[1:]]]) >= 0
        signs = turn.tolist()
        for vertex, parent, same in zip(
            order[1:].tolist(), before[order[1:]].tolist(), agree.tolist(), strict=True
        ):
            signs[vertex] = signs[parent] if same else -signs[parent]
        turn = np.array(signs)
        offsets = points[members] - points[members].mean(axis=0)
        if np.einsum("ij,ij,i->", offsets, normals[members], turn[members]) < 0:
            turn[members] *= -1
    return turn


def _zero_level(
    points: FloatArray, normals: FloatArray, tree: scipy.spatial.cKDTree, cell: float
) -> TriangleMesh:
    margin = _BAND_CELLS + 2
    origin = points.min(axis=0) - margin * cell
    shape = np.ceil(np.ptp(points, axis=0) / cell).astype(int) + 2 * margin + 1
    near = np.zeros(shape, dtype=bool)
    near[tuple(np.rint((points - origin) / cell).astype(int).T)] = True
    near = scipy.ndimage.binary_dilation(
        near, np.ones((3, 3, 3), dtype=bool), iterations=_BAND_CELLS
    )
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
    distance, index = tree.query(places, wanted, distance_upper_bound=within)
    return np.asarray(distance), np.asarray(index)
