"""Close a foot that was scanned standing, and whose sole nobody saw.

A scanner that looks at a standing foot from above sees no sole: where the floor was left out, the
surface ends in a plane, in the outline of the foot. That plane is where the sole stood, whatever
the leg does above it, and closes the surface. Floor that was left at the outline would make the
foot longer and wider; it lies low, and nothing of the foot is over it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import cv2
import numpy as np
import scipy

from insole_core.foot.foot_proportions import is_within
from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import pieces

_OUTLINE_MM, _OUTLINE_ASPECT = (90.0, 350.0), (0.25, 0.6)
_LEAST_RIM = 30
"""Vertices."""
_FLAT_MM, _LEAST_FLAT, _FITS = 4.0, 0.6, 4
"""The rest runs over the arch, which is seen from the side."""
_BELOW_MM, _BELOW_PERCENT = 4.0, 2
_LEAST_HEIGHT = 0.28
"""Of the surface over the outline, in shares of its length: the outline of a foot that was cut
above its seen sole lies lower."""
_FLOOR_MM, _SHADOW_MM, _MARGIN_MM = 9.0, 60.0, 2.0
_GROUND_PERCENT = 10
_ABOVE, _ROUNDS = 0.05, 12
"""Weight of what lies over the ground."""
_CELL_MM, _PIXEL_MM = 3.0, 0.5


@dataclass(frozen=True, eq=False)
class ClosedSole:
    """A surface whose missing sole was closed by a plane.

    Parameters
    ----------
    mesh : mm, source frame
    dorsal : (3,) float64
        Unit normal of the plane, towards the foot.
    """

    mesh: TriangleMesh
    dorsal: FloatArray


def closed_sole(mesh: TriangleMesh) -> ClosedSole | None:
    """Close the sole of a foot that ends in a plane, as where it stood.

    Parameters
    ----------
    mesh : mm, source frame
        In one piece.

    Returns
    -------
    ClosedSole or None
        None for a surface with a sole, or that ends otherwise.
    """
    for rim in _rims(mesh):
        dorsal = _standing(mesh, rim)
        if dorsal is not None:
            foot = _without_floor(mesh, rim, dorsal)
            ground = _ground_rim(foot, dorsal)
            if ground is not None:
                dorsal = _ground_normal(foot.vertices[ground], dorsal)
                return ClosedSole(_closed(foot, ground, dorsal), dorsal)
    return None


def _rims(mesh: TriangleMesh) -> Iterator[IntArray]:
    """Return the vertices of each connected boundary, the longest first."""
    ends = mesh.links.ends
    if len(ends) == 0:
        return
    count = len(mesh.vertices)
    links = scipy.sparse.coo_array((np.ones(len(ends)), tuple(ends.T)), shape=(count, count))
    part = scipy.sparse.csgraph.connected_components(links, directed=False)[1]
    vertices = np.unique(ends)
    names, sizes = np.unique(part[vertices], return_counts=True)
    for name in names[np.argsort(-sizes)][sizes[np.argsort(-sizes)] >= _LEAST_RIM]:
        yield vertices[part[vertices] == name]


def _standing(mesh: TriangleMesh, rim: IntArray) -> FloatArray | None:
    """Return the way up (3,) from a rim that is flat and as large as the outline of a foot."""
    points = mesh.vertices[rim]
    flat = np.ones(len(points), dtype=bool)
    for _ in range(_FITS):
        centre = points[flat].mean(axis=0)
        along, across, normal = np.linalg.svd(points[flat] - centre, full_matrices=False)[2]
        off = np.abs((points - centre) @ normal)
        flat = off <= max(_FLAT_MM, float(np.quantile(off, _LEAST_FLAT)))
    length, width = np.ptp((points - centre) @ along), np.ptp((points - centre) @ across)
    is_outline = is_within(length, _OUTLINE_MM) and is_within(width / length, _OUTLINE_ASPECT)
    if not is_outline or np.quantile(off, _LEAST_FLAT) > _FLAT_MM:
        return None
    height = (mesh.vertices - centre) @ normal
    dorsal = normal if height.mean() > 0 else -normal
    height = (mesh.vertices - centre) @ dorsal
    is_below = np.percentile(height, _BELOW_PERCENT) < -_BELOW_MM
    if is_below or height.max() < _LEAST_HEIGHT * length:
        return None
    return np.asarray(dorsal)


def _without_floor(mesh: TriangleMesh, rim: IntArray, dorsal: FloatArray) -> TriangleMesh:
    """Leave out the floor at the rim: what lies low, and beside what is over it."""
    height = mesh.vertices @ dorsal
    height -= np.percentile(height[rim], _GROUND_PERCENT)
    flat = mesh.vertices @ _across(dorsal).T
    corners = height[mesh.triangles]
    is_over = (corners.min(axis=1) > _FLOOR_MM) & (corners.max(axis=1) < _SHADOW_MM)
    shadow = _Area.under(flat[mesh.triangles[is_over]], flat)
    is_floor = (height < _FLOOR_MM) & ~shadow.holds(flat)
    kept = mesh.part(~is_floor)
    count, piece = pieces(kept)
    return kept.part(piece == np.bincount(piece, minlength=count).argmax())


def _ground_rim(mesh: TriangleMesh, dorsal: FloatArray) -> IntArray | None:
    """Return the lowest rim that is as long as a foot: holes between toes may lie lower."""
    height, flat = mesh.vertices @ dorsal, mesh.vertices @ _across(dorsal).T
    long = [
        rim for rim in _rims(mesh) if np.linalg.norm(np.ptp(flat[rim], axis=0)) > _OUTLINE_MM[0]
    ]
    return min(long, key=lambda rim: float(np.median(height[rim])), default=None)


def _ground_normal(rim: FloatArray, dorsal: FloatArray) -> FloatArray:
    """Return the normal (3,) of the ground below a rim (n, 3).

    Asymmetric least squares (Newey & Powell 1987): heel and ball stand on the ground, and the rim
    between them runs over the arch.
    """
    across = _across(dorsal)
    design = np.column_stack([rim @ across.T, np.ones(len(rim))])
    height = rim @ dorsal
    weights = np.ones(len(rim))
    for _ in range(_ROUNDS):
        plane = np.linalg.lstsq(design * weights[:, None], height * weights, rcond=None)[0]
        weights = np.sqrt(np.where(height > design @ plane, _ABOVE, 1 - _ABOVE))
    normal = dorsal - plane[:2] @ across
    return np.asarray(normal / np.linalg.norm(normal))


def _closed(mesh: TriangleMesh, rim: IntArray, dorsal: FloatArray) -> TriangleMesh:
    """Close the rim on the ground by a plane through what is lowest of it."""
    height = mesh.vertices @ dorsal
    across = _across(dorsal)
    flat = mesh.vertices @ across.T
    ends = mesh.links.ends
    ends = ends[np.isin(ends[:, 0], rim)]
    inside = _Area.enclosed(flat[ends])
    inner = inside.lattice()
    places = np.vstack([flat[rim], inner])
    corners = scipy.spatial.Delaunay(places).simplices
    corners = corners[inside.holds(places[corners].mean(axis=1))]
    # It runs along the rim against the triangles there.
    runs_back = _signed_areas(places[corners]) * _enclosed(flat[ends]) < 0
    corners = np.where(runs_back[:, None], corners, corners[:, ::-1])
    ground = float(np.percentile(height[rim], _GROUND_PERCENT))
    vertices = np.vstack([mesh.vertices, inner @ across + ground * dorsal])
    index = np.concatenate([rim, len(mesh.vertices) + np.arange(len(inner))])
    colors = mesh.colors
    if colors is not None:
        usual = np.median(colors[rim], axis=0).astype(np.uint8)
        colors = np.vstack([colors, np.tile(usual, (len(inner), 1))])
    sole = index[corners].astype(mesh.triangles.dtype)
    return TriangleMesh(vertices, np.vstack([mesh.triangles, sole]), colors)


def _across(dorsal: FloatArray) -> FloatArray:
    """Return the axes (2, 3) of the ground."""
    return np.asarray(np.linalg.svd(dorsal[None])[2][1:])


@dataclass(frozen=True, eq=False)
class _Area:
    """An area of the ground, as pixels.

    Parameters
    ----------
    mask : (h, w) bool
    least : (2,) float64, mm
        Of the first pixel.
    """

    mask: BoolArray
    least: FloatArray

    @staticmethod
    def under(triangles: FloatArray, places: FloatArray) -> _Area:
        """Return what triangles (m, 3, 2) cover, and a margin; `places` (n, 2) are within reach."""
        least = places.min(axis=0) - 2 * _PIXEL_MM
        size = np.ceil((places.max(axis=0) - least) / _PIXEL_MM).astype(int) + 3
        drawn = np.zeros(size[::-1], dtype=np.uint8)
        for pixels in np.round((triangles - least) / _PIXEL_MM).astype(np.int32):
            cv2.fillConvexPoly(drawn, pixels, 1)
        margin = 2 * round(_MARGIN_MM / _PIXEL_MM) + 1
        shape = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (margin, margin))
        return _Area(cv2.dilate(drawn, shape) > 0, least)

    @staticmethod
    def enclosed(edges: FloatArray) -> _Area:
        """Draw the edges (n, 2, 2), mm, of a line, and fill it."""
        least = edges.min(axis=(0, 1)) - 2 * _PIXEL_MM
        pixels = np.round((edges - least) / _PIXEL_MM).astype(np.int32)
        drawn = np.zeros(pixels.max(axis=(0, 1))[::-1] + 3, dtype=np.uint8)
        cv2.polylines(drawn, list(pixels), isClosed=False, color=1)
        return _Area(scipy.ndimage.binary_fill_holes(drawn), least)

    def holds(self, places: FloatArray) -> BoolArray:
        """Return which of some places (n, 2), mm, lie inside."""
        x, y = np.round((places - self.least) / _PIXEL_MM).astype(np.int64).T
        return np.asarray(self.mask[y, x])

    def lattice(self) -> FloatArray:
        """Return evenly spread places (n, 2), mm, inside, none at the line."""
        depth = cv2.distanceTransform(self.mask.astype(np.uint8), cv2.DIST_L2, 3)
        step = round(_CELL_MM / _PIXEL_MM)
        y, x = np.nonzero(depth[::step, ::step] > step / 2)
        return np.asarray(np.column_stack([x, y]) * _CELL_MM + self.least)


def _signed_areas(triangles: FloatArray) -> FloatArray:
    """Return the areas (n,) of triangles (n, 3, 2), negative for those that run clockwise."""
    (x, y), (u, v) = (np.moveaxis(triangles[:, k] - triangles[:, 0], -1, 0) for k in (1, 2))
    return np.asarray((x * v - y * u) / 2)


def _enclosed(edges: FloatArray) -> float:
    """Return the signed area that the edges (n, 2, 2) of a closed line enclose."""
    (x, y), (u, v) = (np.moveaxis(edges[:, k], -1, 0) for k in (0, 1))
    return float((x * v - y * u).sum() / 2)
