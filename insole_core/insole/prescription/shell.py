"""How the body below the contact surface is made: edges, posts, pitch and trim line."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from insole_core.insole.fields import Angle, Choice, Line, Number, Part, Place, Text

LONGEST_TAPER = 0.5
"""Greatest share of an insole's length over which it tapers."""


@dataclass(frozen=True, kw_only=True)
class Post(Part):
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

    region: Annotated[
        str,
        Choice(
            "Region",
            words={"rearfoot": "rearfoot", "forefoot": "forefoot"},
            effect="Below which part of the shell the post stands",
        ),
    ] = "rearfoot"
    angle_deg: Annotated[
        float,
        Angle(
            "Angle",
            "> 0 raises the medial edge (varus), < 0 the lateral one (valgus)",
            -15,
            15,
            raises=True,
        ),
    ] = 0.0
    length_mm: Annotated[
        float | None,
        Number(
            "Length",
            least=15,
            greatest=120,
            effect="How far the post reaches; by its region if left out",
        ),
    ] = None
    edge_radius_mm: Annotated[
        float,
        Number("Edge radius", least=0, greatest=10, effect="Rounding of the post's lower edge"),
    ] = 4.0

    def acts(self, name: str) -> bool:
        """Return whether a field says what the name of the post does not."""
        return name != "region"


@dataclass(frozen=True, kw_only=True)
class Shell(Part):
    """The body of a device; its thickness and underside are `thickness_mm` and `bottom`.

    Parameters
    ----------
    material, body_weight_kg
        From which the thickness was proposed; the weight is None if unknown.
    least_mm, least_edge_mm
        What the material needs, at the front edge too, by the clinic's table; None is what the
        product's table says. A design keeps them, so that it is made alike where the table differs.
    heel_pitch_mm
        Height of the shoe's heel over its forefoot: the underside is shaped for its last, on which
        the insole rests with heel and ball.
    taper_mm, taper_length_mm
        Thickness at the front edge, and the length over which it is reached.
    edge_radius_mm
        Rounding of the upper edge; the wall keeps at least half of its height.
    draft_medial_deg, draft_lateral_deg
        Inclination of the walls from the vertical; > 0: wider at the bottom.
    chamfer_mm
        Width of the bevel along the upper edge.
    trim_mm
        Points (x, y), insole frame, of the front edge of a short shell, from the medial to the
        lateral border; by default 11 mm behind the 1st head, 10 mm behind the 5th, and 4 mm
        farther ahead in the middle. Not read for a full or a drawn outline.
    posts
        At most one for each region.
    """

    material: Annotated[
        str, Text("Material", effect="What the shell is made of; a material of the clinic's table")
    ] = "polypropylene"
    body_weight_kg: Annotated[
        float | None,
        Number(
            "Body weight",
            least=5,
            greatest=250,
            unit="kg",
            effect="From which, with the material, a thickness is proposed",
        ),
    ] = None
    least_mm: Annotated[
        float | None,
        Number(
            "Least thickness",
            least=0.5,
            greatest=40,
            within="Shell",
            effect="Thickness below which it is warned of; the material's if left out",
        ),
    ] = None
    least_edge_mm: Annotated[
        float | None,
        Number(
            "Least thickness at the front edge",
            least=0.5,
            greatest=40,
            within="Shell",
            effect="The same at the front edge",
        ),
    ] = None
    heel_pitch_mm: Annotated[
        float, Number("Heel pitch", "Height of the shoe's heel over its forefoot", 0, 30)
    ] = 0.0
    taper_mm: Annotated[
        float,
        Number(
            "Front edge",
            "Thickness of the shell at its front edge",
            0.5,
            10,
            expert=True,
            within="Shell",
        ),
    ] = 1.0
    taper_length_mm: Annotated[
        float,
        Number(
            "Taper length",
            "Length over which the shell gets as thin as its front edge",
            5,
            60,
            expert=True,
            within="Shell",
        ),
    ] = 18.0
    edge_radius_mm: Annotated[
        float, Number("Edge radius", "Rounding of the upper edge", 0, 5, expert=True)
    ] = 1.0
    draft_medial_deg: Annotated[
        float,
        Angle(
            "Medial draft",
            "Inclination of the medial wall; > 0 is wider at the bottom",
            -15,
            30,
            expert=True,
        ),
    ] = 0.0
    draft_lateral_deg: Annotated[
        float,
        Angle(
            "Lateral draft",
            "Inclination of the lateral wall; > 0 is wider at the bottom",
            -15,
            30,
            expert=True,
        ),
    ] = 0.0
    chamfer_mm: Annotated[
        float, Number("Chamfer", "Width of the bevel along the upper edge", 0, 10, expert=True)
    ] = 0.0
    trim_mm: Annotated[
        tuple[Place, ...] | None,
        Line("Trim line", "", 2, 60, effect="Where the shell ends in front, from border to border"),
    ] = None
    posts: tuple[Post, ...] = ()
