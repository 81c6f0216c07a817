"""How the body below the contact surface is made: edges, posts, pitch and trim line."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.insole.prescription.corrections import Place


@dataclass(frozen=True, kw_only=True)
class Post:
    """A body below the shell that tilts it.

    Parameters
    ----------
    region
        "rearfoot" or "forefoot".
    angle_deg
        > 0 raises the medial edge.
    length_mm
        Along the foot axis; by default the usual one of the region.
    edge_radius_mm
        Rounding of its lower edge.
    """

    region: str = "rearfoot"
    angle_deg: float = 0.0
    length_mm: float | None = None
    edge_radius_mm: float = 4.0


@dataclass(frozen=True, kw_only=True)
class Shell:
    """The body of a device; its thickness and underside are `thickness_mm` and `bottom`.

    Parameters
    ----------
    material, body_weight_kg
        From which the thickness was proposed; the weight is None if unknown.
    taper_mm, taper_length_mm
        Thickness at the front edge, and the length over which it is reached.
    edge_radius_mm
        Rounding of the upper edge.
    draft_medial_deg, draft_lateral_deg
        Inclination of the walls from the vertical; > 0: wider at the bottom.
    chamfer_mm
        Width of the bevel along the upper edge.
    heel_pitch_mm
        Height of the shoe's heel over its forefoot, for which the underside is made.
    trim_mm
        Points (x, y), insole frame, of the front edge of a short shell, from the medial to the
        lateral border; by default behind the heads.
    posts
        At most one for each region.
    """

    material: str = "polypropylene"
    body_weight_kg: float | None = None
    taper_mm: float = 1.0
    taper_length_mm: float = 18.0
    edge_radius_mm: float = 1.0
    draft_medial_deg: float = 0.0
    draft_lateral_deg: float = 0.0
    chamfer_mm: float = 0.0
    heel_pitch_mm: float = 0.0
    trim_mm: tuple[Place, ...] | None = None
    posts: tuple[Post, ...] = ()
