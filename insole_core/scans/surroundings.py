"""Leave out what a scanner sees beside a foot: the floor, furniture, the inner side of a shell."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import pieces
from insole_core.messages import Message
from insole_core.scans.cleaning import faces_outwards
from insole_core.scans.sheets import without_sheet

_SHEET_TOLERANCE_MM = 1.5
_LEAST_PIECE = 0.02
"""Of all area; smaller pieces are counted where the foot is found."""
_FLAT_MM, _ROD_SHARE = 3.0, 0.16
_LEAST_HEIGHT_MM = 45.0
"""Of a foot over a floor; what is lower may be an imprint in foam, and the plane its rim."""
_INNER_MM, _INNER_SHARE = 12.0, 0.95
_FAR_MM, _SECOND_FOOT_SHARE = 30.0, 0.5
_SAMPLE = 2000


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
