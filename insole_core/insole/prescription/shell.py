"""How the body below the contact surface is made: edges, posts, pitch and trim line."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.insole.fields import Place

LONGEST_TAPER = 0.5
"""Greatest share of an insole's length over which it tapers."""


@dataclass(frozen=True, kw_only=True)
class Post:
    """A body below the shell that tilts it, as an extrinsic posting does, and is level below.

    Parameters
    ----------
    region
        "rearfoot" or "forefoot".
    angle_deg
        > 0 raises the medial edge.
    length_mm
        Along the foot axis; by default 0.25 of the foot's length at the rearfoot, from the heel's
        rear end, and 0.12 at the forefoot, up to the trim line or just ahead of the heads.
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
    least_mm, least_edge_mm
        What the material needs, at the front edge too, by the clinic's table; None is what the
        product's table says. A design keeps them, so that it is made alike where the table differs.
    taper_mm, taper_length_mm
        Thickness at the front edge, and the length over which it is reached.
    edge_radius_mm
        Rounding of the upper edge; the wall keeps at least half of its height.
    draft_medial_deg, draft_lateral_deg
        Inclination of the walls from the vertical; > 0: wider at the bottom.
    chamfer_mm
        Width of the bevel along the upper edge.
    heel_pitch_mm
        Height of the shoe's heel over its forefoot: the underside is shaped for its last, on which
        the insole rests with heel and ball.
    trim_mm
        Points (x, y), insole frame, of the front edge of a short shell, from the medial to the
        lateral border; by default 11 mm behind the 1st head, 10 mm behind the 5th, and 4 mm
        farther ahead in the middle. Not read for a full or a drawn outline.
    posts
        At most one for each region.
    """

    material: str = "polypropylene"
    body_weight_kg: float | None = None
    least_mm: float | None = None
    least_edge_mm: float | None = None
    taper_mm: float = 1.0
    taper_length_mm: float = 18.0
    edge_radius_mm: float = 1.0
    draft_medial_deg: float = 0.0
    draft_lateral_deg: float = 0.0
    chamfer_mm: float = 0.0
    heel_pitch_mm: float = 0.0
    trim_mm: tuple[Place, ...] | None = None
    posts: tuple[Post, ...] = ()
