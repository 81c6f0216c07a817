"""The fused surface refined by the infrared pictures of those views that have them."""

from __future__ import annotations

from dataclasses import dataclass, replace

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

LEAST_SHARE = 0.6
"""A picture that agrees with the pattern on less of the foot is of another pose or device."""
_MOST_DRIFT_RAW = 0.5
"""By the sensor's own depth a foot as a whole is off by 0.1, the tendon by up to 0.4."""


@dataclass(frozen=True)
class InfraredUse:
    """What became of the infrared picture of a view.

    Parameters
    ----------
    share
        Of the foot's pixels, on which it was like the pattern last.
    used
        Whether it has changed the surface.
    drift_raw
        By how much its pattern lies elsewhere on the first surface as a whole, raw units.
    bright, noisy
        Share of the foot's pixels on which it counts less for other light, or for noise.
    moved_raw
        As of `DotPictures`.
    """

    share: float
    used: bool
    drift_raw: float = 0.0
    bright: float = 0.0
    noisy: float = 0.0
    moved_raw: float | None = None

    @property
    def trusted(self) -> float:
        """Share of the foot's pixels on which nothing speaks against it."""
        return self.share - self.bright - self.noisy

    @property
    def has_drifted(self) -> bool:
        """Whether the pattern lies too far from where the sensor's own depth places it."""
        return abs(self.drift_raw) > _MOST_DRIFT_RAW


_UNKNOWN = InfraredUse(1.0, used=True)


def by_infrared(
    surface: RefinedSurface, views: list[PreparedView]
) -> tuple[RefinedSurface, dict[str, InfraredUse]]:
    """Refine a surface by the infrared pictures of its views.

    Parameters
    ----------
    surface
        As the sensors' own depth shows it: where no dot is trusted it stays, and changes smoothly.
    views

    Returns
    -------
    surface, uses
        By view. A picture that is trusted on less than `LEAST_SHARE` of the first surface is not
        used; what it says of later ones, which the others have changed, does not decide. A pattern
        that has drifted as a whole is put back to where the sensor's own depth places it.
    """
    seeing = [(view, view.infrared) for view in views if view.infrared is not None]
    uses: dict[str, InfraredUse] = {}

    def observed(mesh: TriangleMesh, normals: FloatArray, caster: RayCaster) -> list[Observations]:
        def compare(seen: tuple[PreparedView, InfraredView]) -> Evidence:
            view, infrared = seen
            return infrared_evidence(infrared, view.reading, mesh, normals, caster)

        asked = [seen for seen in seeing if uses.get(seen[0].reading.name, _UNKNOWN).used]
        observations = []
        for (view, infrared), evidence in zip(asked, for_views(compare, asked), strict=True):
            name, seen = view.reading.name, evidence.observations
            before = uses.get(name)
            first = _first_use(infrared, evidence) if before is None else before
            uses[name] = use = replace(
                first, share=evidence.share, bright=evidence.bright, noisy=evidence.noisy
            )
            if use.used:
                observations.append(seen.shifted(-use.drift_raw) if use.has_drifted else seen)
        return observations

    if not seeing:
        return surface, uses
    return refine_near(surface, observed), uses


def _first_use(infrared: InfraredView, evidence: Evidence) -> InfraredUse:
    seen = evidence.observations
    total = seen.information.sum()
    drift_raw = float(seen.information @ seen.residuals / total) if total else 0.0
    used = evidence.share >= LEAST_SHARE
    return InfraredUse(evidence.share, used, drift_raw, moved_raw=infrared.moved_raw)
