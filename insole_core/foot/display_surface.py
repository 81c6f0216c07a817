"""The surface of a foot as it is shown: with an even border and without small holes.

A depth sensor sees the flanks of a foot at a grazing angle, and there its surface ends in shreds.
They tell nothing, and disturb whoever looks at the foot. For display only, narrow gaps are closed
and shreds are taken off; measures, fits and files use the measured surface.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray, IndexArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_boundary import gap_triangles
from insole_core.geometry.mesh_graph import pieces
from insole_core.geometry.point_tree import point_tree
from insole_core.geometry.sampling import boundary_points
from insole_core.geometry.sections import level_cut

_LOW_MM = 15.0
"""Height of the sole and the toes, which are narrower than the flanks and seen better."""
_LOW_GAP_MM, _HIGH_GAP_MM = 4.0, 8.0
"""Width of the gaps that are closed; toes must not be joined."""
_LOW_DISC_MM, _HIGH_DISC_MM = 3.0, 7.0
"""Radius of a disc that fits into everything that is kept: smaller than a little toe."""
_SLACK_MM = 0.3  # by which an even border may miss the discs
_RIM_STEP_MM = 1.0
_BORDER_ROUNDS = 10
_LEAST_PIECE_MM2 = 300.0


@dataclass(frozen=True, eq=False)
class DisplaySurface:
    """A foot's surface for display, and what of it was measured.

    Parameters
    ----------
    mesh : mm, frame of the foot's mesh
    is_filled : (m,) bool
        Triangles that close gaps, and were not measured.
    ends : (n, 2) int64
        The two measured vertices between which each vertex lies; often the same one.
    share : (n,) float64
        Where between them, 0 to 1.
    """

    mesh: TriangleMesh
    is_filled: BoolArray
    ends: IntArray
    share: FloatArray

    def transformed(self, a2b: FloatArray) -> DisplaySurface:
        """Return the same surface in frame b, given a rigid transform (4, 4) from its frame a."""
        return replace(self, mesh=self.mesh.transformed(a2b))

    def with_values(self, measured: FloatArray) -> tuple[TriangleMesh, FloatArray]:
        """Carry values over from the measured surface.

        Parameters
        ----------
        measured : (k,) float64
            One for each vertex of the measured surface.

        Returns
        -------
        mesh : TriangleMesh
            This surface; filled parts have vertices of their own.
        values : (n,) float64
            One for each of its vertices; NaN in filled parts.
        """
        start, end = measured[self.ends].T
        values = start + self.share * (end - start)
        filled, number = np.unique(self.mesh.triangles[self.is_filled], return_inverse=True)
        triangles = self.mesh.triangles.copy()
        triangles[self.is_filled] = number.reshape(-1, 3) + len(values)
        source = np.concatenate([np.arange(len(values)), filled])
        mesh = _taken(self.mesh, source, triangles)
        return mesh, np.concatenate([values, np.full(len(filled), np.nan)])


def display_surface(mesh: TriangleMesh) -> DisplaySurface:
    """Even the border of a foot's surface for display.

    Gaps narrower than 8 mm are closed, and 4 mm up to 15 mm above the ground. What is too narrow
    for a disc of 14 mm is taken off, and of 6 mm below. A closed surface stays as it is.

    Parameters
    ----------
    mesh : mm, insole frame

    Returns
    -------
    DisplaySurface
        mm, insole frame.
    """
    count = len(mesh.vertices)
    if len(mesh.links.ends) == 0:
        own = np.repeat(np.arange(count)[:, None], 2, axis=1)
        return DisplaySurface(mesh, np.zeros(len(mesh.triangles), bool), own, np.zeros(count))
    closed, is_filled = _gaps_closed(mesh, np.zeros(len(mesh.triangles), dtype=bool))
    cut = level_cut(closed, _opened(closed))
    colors = None if mesh.colors is None else cut.extended(mesh.colors.astype(np.float64))
    trimmed = TriangleMesh(
        cut.extended(mesh.vertices),
        cut.triangles,
        None if colors is None else np.rint(colors).astype(np.uint8),
    )
    kept = _in_large_pieces(trimmed)
    of_kept = kept[trimmed.triangles[:, 0]]
    whole, is_filled = _gaps_closed(trimmed.part(kept), is_filled[cut.source][of_kept])
    own = np.repeat(np.arange(count)[:, None], 2, axis=1)
    return DisplaySurface(
        replace(whole, vertices=_border_smoothed(whole)),
        is_filled,
        np.concatenate([own, cut.ends])[kept],
        np.concatenate([np.zeros(count), cut.share])[kept],
    )


def _gaps_closed(mesh: TriangleMesh, is_filled: BoolArray) -> tuple[TriangleMesh, BoolArray]:
    """Close the narrow gaps; return also which triangles (m,) do so, or did before."""
    is_low = mesh.vertices[:, 2] < _LOW_MM
    added = gap_triangles(mesh, np.where(is_low, _LOW_GAP_MM, _HIGH_GAP_MM))
    closed = TriangleMesh(mesh.vertices, np.concatenate([mesh.triangles, added]), mesh.colors)
    return closed, np.concatenate([is_filled, np.ones(len(added), dtype=bool)])


def _opened(mesh: TriangleMesh) -> FloatArray:
    """Return a field (n,), mm, that is negative where no disc within the surface reaches.

    That is an opening, in terms of morphology, by discs of one size for the sole and the toes and
    of another above. It is positive everywhere where no disc fits at all.
    """
    furthest_mm = 2 * _HIGH_DISC_MM
    rim_mm, _ = point_tree(boundary_points(mesh, _RIM_STEP_MM)).query(
        mesh.vertices, distance_upper_bound=furthest_mm, workers=-1
    )
    rim_mm = np.minimum(rim_mm, furthest_mm)
    low, high = (_within_discs(mesh, rim_mm, disc_mm) for disc_mm in (_LOW_DISC_MM, _HIGH_DISC_MM))
    field = np.maximum(high, np.minimum(low, _LOW_MM - mesh.vertices[:, 2]))
    return field if (field >= 0).any() else np.ones(len(field))


def _within_discs(mesh: TriangleMesh, rim_mm: FloatArray, disc_mm: float) -> FloatArray:
    """Return how far (n,) inside the nearest disc each vertex lies, mm; negative outside."""
    inside_mm = rim_mm - disc_mm
    cut = level_cut(mesh, inside_mm)
    used = np.zeros(len(mesh.vertices) + len(cut.ends), dtype=bool)
    used[cut.triangles] = True
    centres = cut.extended(mesh.vertices)[used]
    if len(centres) == 0:
        return np.full(len(rim_mm), -disc_mm)
    outer = inside_mm < 0
    near, _ = point_tree(centres).query(
        mesh.vertices[outer], distance_upper_bound=2 * disc_mm, workers=-1
    )
    away_mm = np.zeros(len(rim_mm))
    away_mm[outer] = np.minimum(near, 2 * disc_mm)
    return disc_mm + _SLACK_MM - away_mm


def _in_large_pieces(mesh: TriangleMesh) -> BoolArray:
    """Return which vertices (n,) lie in large pieces; those without triangles do not."""
    count, piece = pieces(mesh)
    area_mm2 = np.bincount(piece, mesh.vertex_areas, minlength=count)
    is_large = area_mm2 >= min(_LEAST_PIECE_MM2, area_mm2.max())
    return np.asarray(is_large[piece])


def _border_smoothed(mesh: TriangleMesh) -> FloatArray:
    """Average every boundary vertex with its neighbours on the boundary; return all (n, 3), mm."""
    ends, count = mesh.links.ends, len(mesh.vertices)
    degree = np.bincount(ends.ravel(), minlength=count)
    is_simple = (degree == 2)[:, None]
    both = np.concatenate([ends, ends[:, ::-1]])
    shape = (count, count)
    sums = scipy.sparse.csr_array((np.ones(len(both)), (both[:, 0], both[:, 1])), shape)
    vertices = mesh.vertices
    for _ in range(_BORDER_ROUNDS):
        beside = np.asarray(sums @ vertices) / 2
        vertices = np.where(is_simple, (vertices + beside) / 2, vertices)
    return vertices


def _taken(mesh: TriangleMesh, source: IntArray, triangles: IndexArray) -> TriangleMesh:
    """Return the triangles (m, 3) between the vertices `source` (n,) of a mesh."""
    colors = None if mesh.colors is None else mesh.colors[source]
    return TriangleMesh(mesh.vertices[source], triangles, colors)
