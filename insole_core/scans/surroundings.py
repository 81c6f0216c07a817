"""Leave out what a scanner sees beside a foot: the floor, a sheet of glass, furniture, a shell."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import pieces
from insole_core.messages import Message
from insole_core.scans.cleaning import faces_outwards

_TRIALS = 60
_ALIGNED = np.cos(np.radians(12.0))
_LEAST_SHARE = 0.12
"""Of all area, that a sheet outside of the foot has at least."""
_FOOT_SHARE = 0.4
"""Of the height over the plane, that counts for the outline of the foot: no leaning leg."""
_CELLS = 150
_MOST_BELOW = 0.05
_LEAST_SHEET = 0.03
_SHEET_TOLERANCE_MM = 1.5
_LEAST_PIECE = 0.02
"""Of all area; smaller pieces are counted where the foot is found."""
_FLAT_MM, _ROD_SHARE = 3.0, 0.16
_LEAST_HEIGHT_MM = 45.0
"""Of a foot over a floor; what is lower may be an imprint in foam, and the plane its rim."""
_INNER_MM, _INNER_SHARE = 12.0, 0.95
_FAR_MM, _SECOND_FOOT_SHARE = 30.0, 0.5
_SAMPLE = 2000


@dataclass(frozen=True)
class _Plane:
    normal: FloatArray
    offset: float

    def heights(self, points: FloatArray) -> FloatArray:
        return np.asarray(points @ self.normal - self.offset)


def without_sheet(mesh: TriangleMesh, tolerance: float, least_height: float = 0.0) -> TriangleMesh:
    """Cut off the largest plane, as far as it goes beyond the outline of what stands on it.

    Parameters
    ----------
    tolerance
        Greatest distance of the sheet's points from its plane, in the unit of the mesh.
    least_height
        Of what stands on the sheet.

    Returns
    -------
    TriangleMesh
        The same object if there is no sheet.
    """
    plane = _largest_plane(mesh, tolerance)
    heights = plane.heights(mesh.vertices)
    in_plane = np.abs(heights) <= tolerance
    flat = in_plane[mesh.triangles].all(axis=1)
    above = heights > tolerance
    below = heights < -tolerance
    if above.sum() < below.sum():
        heights, above, below = -heights, below, above
    if not above.any() or below.sum() > _MOST_BELOW * above.sum():
        return mesh  # it goes through the middle: no sheet on which something stands
    if np.quantile(heights[above], 0.98) < least_height:
        return mesh
    sheet = flat & ~_under_foot(mesh, plane, heights, above)
    areas = mesh.triangle_areas_mm2
    if areas[sheet].sum() < _LEAST_SHARE * areas.sum():
        return mesh
    kept = np.zeros(len(mesh.vertices), dtype=bool)
    kept[mesh.triangles[~sheet]] = True
    used = mesh.triangles[~sheet]
    part = TriangleMesh(mesh.vertices, used, mesh.colors, mesh.touches)
    return part.part(kept)


def _largest_plane(mesh: TriangleMesh, tolerance: float) -> _Plane:
    """Find the plane with the largest area of triangles in it, among trials (RANSAC)."""
    areas, normals = mesh.triangle_areas_mm2, mesh.triangle_normals
    centres = mesh.vertices[mesh.triangles].mean(axis=1)
    rng = np.random.default_rng(0)
    chosen = rng.choice(len(areas), min(20_000, len(areas)), p=areas / areas.sum())
    normals, centres = normals[chosen], centres[chosen]
    best, most = _Plane(normals[0], float(centres[0] @ normals[0])), 0
    for trial in rng.choice(len(chosen), _TRIALS):
        normal = normals[trial]
        if not normal.any():
            continue
        offset = float(centres[trial] @ normal)
        members = _members(normals, centres, _Plane(normal, offset), tolerance)
        if members.sum() > most:
            best, most = _refined(normals, centres, members, normal), int(members.sum())
    members = _members(normals, centres, best, tolerance)
    if members.sum() >= 3:
        best = _refined(normals, centres, members, best.normal)
    return best


def _members(
    normals: FloatArray, centres: FloatArray, plane: _Plane, tolerance: float
) -> BoolArray:
    aligned = np.abs(normals @ plane.normal) > _ALIGNED
    return np.asarray(aligned & (np.abs(plane.heights(centres)) <= tolerance))


def _refined(
    normals: FloatArray, centres: FloatArray, members: BoolArray, normal: FloatArray
) -> _Plane:
    """Fit a plane to the members."""
    points = centres[members]
    if len(points) < 3:
        return _Plane(normal, float(points.mean(axis=0) @ normal))
    middle = points.mean(axis=0)
    fitted = np.linalg.eigh((points - middle).T @ (points - middle))[1][:, 0]
    if fitted @ normal < 0:
        fitted = -fitted
    return _Plane(fitted, float(middle @ fitted))


def _under_foot(
    mesh: TriangleMesh, plane: _Plane, heights: FloatArray, above: BoolArray
) -> BoolArray:
    """Return which triangles (m,) lie within the outline of what stands on the plane."""
    top = np.quantile(heights[above], 0.99)
    across = np.linalg.svd(plane.normal[None])[2][1:]
    places = mesh.vertices @ across.T
    low = places.min(axis=0)
    cell = float(np.ptp(places[above], axis=0).max()) / _CELLS
    standing = above & (heights < max(_FOOT_SHARE * top, 0.0))
    shape = np.minimum(np.ceil(np.ptp(places, axis=0) / cell).astype(int) + 5, 40 * _CELLS)
    corners = mesh.triangles[standing[mesh.triangles].any(axis=1)]
    mask = np.zeros(shape, dtype=bool)
    middles = mesh.vertices[corners].mean(axis=1) @ across.T
    for points in (places[standing], middles):
        cells = np.minimum(((points - low) / cell).astype(int) + 2, shape - 1)
        mask[tuple(cells.T)] = True
    mask = scipy.ndimage.binary_closing(mask, np.ones((5, 5), dtype=bool))
    mask = scipy.ndimage.binary_fill_holes(mask)
    pieces, count = scipy.ndimage.label(mask)
    sizes = np.bincount(pieces.ravel(), minlength=count + 1)
    large = sizes >= _LEAST_SHEET * sizes[1:].max(initial=1)
    large[0] = False
    mask = large[pieces]
    centres = mesh.vertices[mesh.triangles].mean(axis=1) @ across.T
    cells = np.minimum(((centres - low) / cell).astype(int) + 2, shape - 1)
    return np.asarray(mask[tuple(cells.T)])


@dataclass(frozen=True, eq=False)
class FootScan:
    """What is left of a scan.

    Parameters
    ----------
    mesh : mm
    left_out
        What is not part of it, a sentence each.
    """

    mesh: TriangleMesh
    left_out: tuple[Message, ...]


def without_surroundings(mesh: TriangleMesh, *, is_foot: bool = False) -> FootScan:
    """Cut off a floor, and drop pieces that are no part of a foot.

    Parameters
    ----------
    mesh : mm
    is_foot
        Whether the user has said that it is a foot; else a floor with something low on it is left
        alone, since it may be an imprint in foam.
    """
    least_mm = 0.0 if is_foot else _LEAST_HEIGHT_MM
    cut = without_sheet(mesh, _SHEET_TOLERANCE_MM, least_height=least_mm)
    kept, dropped = _without_foreign_pieces(cut, least_mm)
    flat_mm2 = mesh.area_mm2 - cut.area_mm2
    if cut is not mesh:  # what was under the foot is left as a flat piece
        flat_mm2 += sum(area for kind, area in dropped if kind == "flat")
        dropped = [(kind, area) for kind, area in dropped if kind != "flat"]
    notes = [
        Message(
            "A piece of {area_cm2:.0f} cm² was left out: {kind}.",
            kind=_KINDS[kind],
            area_cm2=area / 100,
        )
        for kind, area in dropped
    ]
    if cut is not mesh:
        sheet = Message(
            "A flat sheet of {area_cm2:.0f} cm² (floor, table or glass) was cut off.",
            area_cm2=flat_mm2 / 100,
        )
        notes.insert(0, sheet)
    if notes and not faces_outwards(kept):  # a floor had hidden it
        kept = kept.flipped()
    return FootScan(kept, tuple(notes))


def _without_foreign_pieces(
    mesh: TriangleMesh, least_height_mm: float
) -> tuple[TriangleMesh, list[tuple[str, float]]]:
    """Return what is left, and the kind and area, mm², of each piece that is dropped."""
    count, piece = pieces(mesh)
    area = np.bincount(piece, mesh.vertex_areas, minlength=count)
    large = np.flatnonzero(area >= _LEAST_PIECE * area.sum())
    if len(large) < 2:
        return mesh, []
    extents = np.array([_extents(mesh.vertices[piece == number]) for number in large])
    is_flat = extents[:, 2] < _FLAT_MM
    is_rod = extents[:, 1] < _ROD_SHARE * extents[:, 0]
    candidates = large[~(is_flat | is_rod)]
    if len(candidates) == 0:
        return mesh, []
    main = candidates[np.argmax(area[candidates])]
    drop = {
        int(number): "flat"
        for number in large[is_flat]
        if _height_over(mesh.vertices[piece == number], mesh.vertices[piece == main])
        >= least_height_mm
    }
    drop |= {int(number): "rod" for number in large[is_rod & ~is_flat]}
    for number in candidates:
        if number != main:
            kind = _relation(mesh, piece, int(main), int(number), area[number] / area[main])
            if kind:
                drop[int(number)] = kind
    if not drop:
        return mesh, []
    kept = ~np.isin(piece, list(drop))
    return mesh.part(kept), [(kind, float(area[number])) for number, kind in drop.items()]


_KINDS = {
    "flat": Message("it is flat, as a sheet, a card or a wall"),
    "rod": Message("it is a rod, as a leg of a table"),
    "inner": Message("it lies within the surface, as the inner side of a shell"),
    "far": Message("it is far from the foot"),
}


def _relation(mesh: TriangleMesh, piece: IntArray, main: int, other: int, share: float) -> str:
    """Return why the other piece is no part of the main one; empty if it is, or a second foot."""
    of_main, of_other = np.flatnonzero(piece == main), np.flatnonzero(piece == other)
    sample = of_other[:: max(1, len(of_other) // _SAMPLE)]
    tree = scipy.spatial.cKDTree(mesh.vertices[of_main])
    distance, nearest = map(np.asarray, tree.query(mesh.vertices[sample]))
    offsets = mesh.vertices[sample] - mesh.vertices[of_main[nearest]]
    depth = np.einsum("ij,ij->i", offsets, mesh.vertex_normals[of_main[nearest]])
    if ((distance < _INNER_MM) & (depth <= 0)).mean() > _INNER_SHARE:
        return "inner"
    if distance.min() > _FAR_MM and share < _SECOND_FOOT_SHARE:
        return "far"
    return ""


def _height_over(flat: FloatArray, points: FloatArray) -> float:
    """Return how far points rise from the plane of a flat piece, mm."""
    middle = flat.mean(axis=0)
    normal = np.linalg.eigh((flat - middle).T @ (flat - middle))[1][:, 0]
    return float(np.quantile(np.abs((points - middle) @ normal), 0.98))


def _extents(points: FloatArray) -> FloatArray:
    """Return the extents (3,) along the principal axes, the longest first."""
    centred = points - points.mean(axis=0)
    axes = np.linalg.eigh(centred.T @ centred)[1]
    return np.sort(np.ptp(centred @ axes, axis=0))[::-1]


def second_foot(mesh: TriangleMesh) -> BoolArray | None:
    """Return which vertices (n,) belong to the second of two feet that do not touch; None if one.

    Two pieces are two feet if they are alike in their extents and lie beside each other.
    """
    count, piece = pieces(mesh)
    area = np.bincount(piece, mesh.vertex_areas, minlength=count)
    order = np.argsort(area)[::-1][:2]
    if count < 2 or area[order[1]] < _SECOND_FOOT_SHARE * area[order[0]]:
        return None
    first, second = (mesh.vertices[piece == number] for number in order)
    alike = _extents(second) / _extents(first)
    between = np.linalg.norm(first.mean(axis=0) - second.mean(axis=0))
    if (np.abs(np.log(alike)) > np.log(1.35)).any() or between < 0.5 * _extents(first)[1]:
        return None
    is_second = np.asarray(piece == order[1])
    crumbs = np.flatnonzero(~np.isin(piece, order))
    trees = (scipy.spatial.cKDTree(points) for points in (first, second))
    to_first, to_second = (tree.query(mesh.vertices[crumbs])[0] for tree in trees)
    is_second[crumbs] = to_second < to_first
    return is_second
