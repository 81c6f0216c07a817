"""The fused surface: mesh all views, refine the mesh against their readings, colour it."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial

import numpy as np

from insole_core.geometry.arrays import BoolArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_boundary import extend_boundary
from insole_core.geometry.mesh_graph import in_large_pieces, relaxed
from insole_core.geometry.mesh_resolution import subdivided
from insole_core.progress import SILENT, Progress
from insole_core.reconstruct.fusion.contour_fit import bend_to, drawn_to, lies_before, touches_of
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.distance_field import FieldLimits, mesh_views
from insole_core.reconstruct.fusion.infrared_surface import by_infrared
from insole_core.reconstruct.fusion.occluding_contour import OccludingContour
from insole_core.reconstruct.fusion.prepared_view import PreparedView, corrections_mm
from insole_core.reconstruct.fusion.refinement import RefinementLimits, refine
from insole_core.reconstruct.fusion.silhouette import is_beside
from insole_core.reconstruct.fusion.texture import color_vertices
from insole_core.reconstruct.parallel import both, for_views
from insole_core.reconstruct.result import Surface

_RELAXING_ROUNDS = 10
_EVENING_ROUNDS = 3
_LEAST_PIECE = 0.05
"""Least share of the surface of a piece that is kept, such as a tendon not joined to the sole."""


@dataclass(frozen=True)
class FusionLimits:
    """Parameters of the fusion.

    Parameters
    ----------
    lattice, refinement
    reach_mm
        Largest distance of the initial mesh from the nearest reading.
    ring_mm, rings
        Width and number of the rings by which the initial mesh is extended: near its edge the foot
        is too steep for the sensor, whose window must be covered as a whole.
    more_rings
        Number of further rings where a contour shows that the foot continues.
    support_mm
        Largest distance of the refined surface from the nearest reading.
    proof_mm
        Or largest distance from a place where a contour is touched.
    own_mm
        Distance from the readings of a view within which its silhouette cuts the surface.
    """

    lattice: FieldLimits = field(default_factory=FieldLimits)
    refinement: RefinementLimits = field(default_factory=RefinementLimits)
    reach_mm: float = 3.5
    ring_mm: float = 1.5
    rings: int = 2
    more_rings: int = 4
    support_mm: float = 1.75
    proof_mm: float = 4.0
    own_mm: float = 6.0


def fuse(
    views: list[PreparedView],
    progress: Progress = SILENT,
    limits: FusionLimits = FusionLimits(),
) -> Surface:
    """Fuse the readings of all views to one smooth, coloured surface.

    Parameters
    ----------
    views
        At least one.
    progress
    limits

    Returns
    -------
    Surface
        mm, reference frame, with contour constraints, standard deviations and gaps between views.
    """
    progress.step(0.0, "Joining the views")
    readings = [view.reading for view in views]
    coarse = _mesh(views, limits)
    progress.step(0.4, "Refining the surface")
    refined, uses = by_infrared(refine(coarse, readings, limits.refinement), views)
    rims = _rims(views)
    mesh = drawn_to(refined.mesh, rims)
    kept = _is_supported(mesh, views, limits)
    kept[kept] = in_large_pieces(mesh.part(kept), _LEAST_PIECE)
    progress.step(0.8, "Colouring the surface")
    supported = mesh.part(kept)
    touches, (fine, ends) = both(
        lambda: touches_of(supported, rims), lambda: _colored(supported, readings)
    )
    fine = fine.with_attributes(touches=touches)
    moved_mm = corrections_mm(supported, views)
    return Surface(
        fine,
        deviation_mm=refined.deviation_mm[kept][ends].mean(1),
        correction_mm=None if moved_mm is None else moved_mm[ends].mean(1),
        view_gaps_mm=refined.view_gaps_mm,
        infrared=uses,
        infrared_share=float(refined.by_further[kept].mean()),
    )


def _colored(mesh: TriangleMesh, readings: list[DepthView]) -> tuple[TriangleMesh, IntArray]:
    fine, ends = subdivided(mesh)
    return fine.with_attributes(colors=color_vertices(fine, readings, mesh)), ends


def _rims(views: list[PreparedView]) -> list[OccludingContour]:
    return [view.rim for view in views if view.rim is not None]


def _mesh(views: list[PreparedView], limits: FusionLimits) -> TriangleMesh:
    mesh = mesh_views(views, limits.lattice)
    nearest = for_views(
        lambda view: view.reading.distance_mm(mesh.vertices, limits.reach_mm), views
    )
    mesh = mesh.part(np.any(np.isfinite(nearest), axis=0))
    mesh = mesh.part(in_large_pieces(mesh, _LEAST_PIECE))
    mesh = mesh.moved(relaxed(mesh, _RELAXING_ROUNDS))
    rims = _rims(views)
    for number in range(limits.rings + (limits.more_rings if rims else 0)):
        mesh = extend_boundary(mesh, limits.ring_mm, partial(bend_to, rims, number < limits.rings))
        mesh = mesh.moved(relaxed(mesh, _EVENING_ROUNDS))
    return mesh


def _is_supported(mesh: TriangleMesh, views: list[PreparedView], limits: FusionLimits) -> BoolArray:
    """Return which vertices (n,) have a reading near them and lie inside every silhouette."""
    before, found = both(
        lambda: lies_before(mesh, _rims(views), limits.proof_mm),
        lambda: for_views(lambda view: _near_and_beside(mesh, view, limits), views),
    )
    near, beside = np.any(found, axis=0)
    return np.asarray((near | before) & ~beside)


def _near_and_beside(
    mesh: TriangleMesh, view: PreparedView, limits: FusionLimits
) -> tuple[BoolArray, BoolArray]:
    distance_mm = view.reading.distance_mm(mesh.vertices, limits.own_mm)
    own = np.isfinite(distance_mm)
    beside = np.zeros(len(own), dtype=bool)
    if view.outline is not None:
        beside[own] = is_beside(mesh.vertices[own], view.reading, view.outline)
    return np.asarray(distance_mm < limits.support_mm), beside
