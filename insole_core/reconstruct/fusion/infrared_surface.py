"""The fused surface refined by the infrared pictures of those views that have them."""

from __future__ import annotations

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster
from insole_core.reconstruct.fusion.infrared_evidence import (
    Evidence,
    InfraredView,
    infrared_evidence,
)
from insole_core.reconstruct.fusion.observation import Observations
from insole_core.reconstruct.fusion.prepared_view import PreparedView
from insole_core.reconstruct.fusion.refinement import RefinedSurface, refine_near
from insole_core.reconstruct.parallel import for_views

LEAST_SHARE = 0.5
"""A picture that agrees with the pattern on less of the foot is of another pose or device."""


def by_infrared(
    surface: RefinedSurface, views: list[PreparedView]
) -> tuple[RefinedSurface, dict[str, float]]:
    """Refine a surface by the infrared pictures of its views.

    Parameters
    ----------
    surface
        As the sensors' own depth shows it: where no dot is trusted it stays, and changes smoothly.
    views

    Returns
    -------
    surface, shares
        The share of the foot's pixels on which each picture was trusted, by view; a picture that is
        trusted on less than `LEAST_SHARE` was not used.
    """
    seeing = [(view, view.infrared) for view in views if view.infrared is not None]
    shares: dict[str, float] = {}

    def observed(mesh: TriangleMesh, normals: FloatArray, caster: RayCaster) -> list[Observations]:
        def compare(seen: tuple[PreparedView, InfraredView]) -> Evidence:
            view, infrared = seen
            return infrared_evidence(infrared, view.reading, mesh, normals, caster)

        used = [seen for seen in seeing if shares.get(seen[0].reading.name, 1.0) >= LEAST_SHARE]
        found = for_views(compare, used)
        for (view, _), evidence in zip(used, found, strict=True):
            shares[view.reading.name] = evidence.share
        return [evidence.observations for evidence in found if evidence.share >= LEAST_SHARE]

    if not seeing:
        return surface, shares
    return refine_near(surface, observed), shares
