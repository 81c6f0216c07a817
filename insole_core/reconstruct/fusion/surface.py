"""The fused surface: mesh all views, refine it against their readings, colour it finely."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.spatial import cKDTree

from insole_core.geometry.arrays import BoolArray
from insole_core.geometry.border_growth import grown
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import in_large_pieces, relaxed
from insole_core.geometry.subdivision import subdivided
from insole_core.progress import SILENT, Progress
from insole_core.reconstruct.fusion.distance_field import FieldLimits, mesh_views
from insole_core.reconstruct.fusion.reading import Reading
from insole_core.reconstruct.fusion.refinement import RefinementLimits, refine
from insole_core.reconstruct.fusion.silhouette import within_outline
from insole_core.reconstruct.fusion.smoothing import smooth_depth
from insole_core.reconstruct.fusion.texture import color_vertices
from insole_core.reconstruct.result import Surface

_RELAXING_ROUNDS = 10
_EVENING_ROUNDS = 3
_LEAST_PIECE = 0.05
"""Share of the surface that a piece must have: a tendon that no view joins to the sole has it."""


@dataclass(frozen=True)
class FusionLimits:
    """How views become a surface.

    Parameters
    ----------
    lattice, refinement
    reach_mm
        The mesh that is refined ends so far from the nearest reading.
    border_mm
        By so much it is first grown: the lattice ends a cell before the readings do.
    support_mm
        The refined surface ends so far from the nearest reading.
    """

    lattice: FieldLimits = field(default_factory=FieldLimits)
    refinement: RefinementLimits = field(default_factory=RefinementLimits)
    reach_mm: float = 3.5
    border_mm: float = 1.2
    support_mm: float = 1.5


def fuse(
    readings: list[Reading],
    progress: Progress = SILENT,
    limits: FusionLimits = FusionLimits(),
    on_preview: Callable[[TriangleMesh], None] | None = None,
) -> Surface:
    """Make one smooth surface of the placed readings of all views.

    Parameters
    ----------
    readings
        At least one.
    progress
    limits
    on_preview
        Is given the coloured mesh before refinement, as soon as there is one.
    """
    progress.step(0.0, "Joining the views")
    readings = [within_outline(reading) for reading in readings]
    coarse = _mesh(readings, limits)
    if on_preview is not None:
        on_preview(replace(coarse, colors=color_vertices(coarse, readings)))
    progress.step(0.4, "Refining the surface")
    refined = refine(coarse, readings, [reading.pixels for reading in readings], limits.refinement)
    kept = _near_readings(refined.mesh, readings, limits.support_mm)
    kept[kept] = in_large_pieces(refined.mesh.part(kept), _LEAST_PIECE)
    progress.step(0.8, "Colouring the surface")
    fine, ends = subdivided(refined.mesh.part(kept))
    colors = color_vertices(fine, readings)
    return Surface(replace(fine, colors=colors), refined.deviation_mm[kept][ends].mean(1))


def _mesh(readings: list[Reading], limits: FusionLimits) -> TriangleMesh:
    mesh = mesh_views(readings, [smooth_depth(reading) for reading in readings], limits.lattice)
    mesh = mesh.part(_near_readings(mesh, readings, limits.reach_mm))
    mesh = mesh.part(in_large_pieces(mesh, _LEAST_PIECE))
    mesh = TriangleMesh(relaxed(mesh, _RELAXING_ROUNDS), mesh.triangles)
    mesh = grown(mesh, limits.border_mm)
    return TriangleMesh(relaxed(mesh, _EVENING_ROUNDS), mesh.triangles)


def _near_readings(mesh: TriangleMesh, readings: list[Reading], reach_mm: float) -> BoolArray:
    """Tell which vertices (n,) have a reading near them."""
    points = np.concatenate(
        [reading.points(reading.raw)[np.isfinite(reading.raw)] for reading in readings]
    )
    distance, _ = cKDTree(points).query(mesh.vertices, distance_upper_bound=reach_mm)
    return np.isfinite(distance)
