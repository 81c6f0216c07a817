"""The corrections that can be prescribed, one value each; `InsoleDesign` holds them in order.

All positions are in the insole frame: mm, x = 0 on the foot axis, y = 0 at the rearmost heel point.
Shares are shares of the foot's length, counted from the heel. Angles > 0 raise the medial edge.
"""

from __future__ import annotations

import uuid
from dataclasses import dataclass, field
from typing import ClassVar, TypeAlias

from insole_core.insole.fields import Place


def _new_id() -> str:
    return uuid.uuid4().hex[:12]


@dataclass(frozen=True, kw_only=True)
class CorrectionBase:
    """Fields common to all corrections.

    Parameters
    ----------
    id
        Stays the same while the correction is edited.
    enabled
        A correction that is switched off stays in the prescription and changes nothing.
    author, created_at
        Who prescribed it and when (ISO 8601, UTC); empty if unknown.
    """

    id: str = field(default_factory=_new_id)
    enabled: bool = True
    author: str = ""
    created_at: str = ""


@dataclass(frozen=True, kw_only=True)
class Pelott(CorrectionBase):
    """A pad on the contact surface, thesis 6.3.2; a recess if its height is negative.

    Parameters
    ----------
    shape
        One of `pad_shapes.PAD_SHAPES`: "egg" (26), "drop", "bar", "arch_support", "horseshoe",
        "cut_out", "mortons_extension", "oval", or a free shape, domed ("outline") or with a flat
        top ("flat_outline").
    kind
        What the pad is prescribed as, a kind of the pad library ("relief_head_3"); None if its
        shape says it.
    centre_mm
        Position of the apex, where the added height is `height_mm`; of a horseshoe the centre of
        its arc, whose height is reached along the middle of the legs.
    length_mm, width_mm
        Size of the outline along and across the pad; ignored for a free-hand outline.
    height_mm
        Added at the apex: the peak of the Gaussian neighbourhood (25), or the flat top.
    turn_deg
        Counter-clockwise seen from above (from the foot's side). At 0 the blunt end of an egg and
        the opening of a horseshoe point to the toes, the flat side of an arch support to +x.
    egg_ratio
        r of (26): 0 gives an ellipse, 1 the most pointed egg. Only used by eggs.
    sigma_mm
        Standard deviations (along width, along length) of (25); by default half the outline's size.
        Not used by flat-topped shapes.
    blend_mm
        Breadth of the edge over which the pad falls to zero with continuous slope; by default half
        of the way from apex to outline for domed shapes, a quarter of the width for flat ones.
    outline_mm
        Of a free shape: its corners relative to the centre, not turned, joined by a closed curve.
    """

    type: ClassVar[str] = "pelott"
    shape: str = "egg"
    kind: str | None = None
    centre_mm: Place
    length_mm: float = 60.0
    width_mm: float = 40.0
    height_mm: float = 6.0
    turn_deg: float = 0.0
    egg_ratio: float = 0.5
    sigma_mm: Place | None = None
    blend_mm: float | None = None
    outline_mm: tuple[Place, ...] | None = None


@dataclass(frozen=True, kw_only=True)
class Posting(CorrectionBase):
    """Pronation/supination: rotation of the foot relative to the insole's bottom, thesis 6.3.1.

    Parameters
    ----------
    rearfoot_deg, forefoot_deg
        Angles > 0 raise the medial edge (varus) of either foot.
    blend_start, blend_end
        Shares of the length between which the rearfoot angle blends into the forefoot angle.
    method
        "extrinsic": the whole surface turns, as on a wedge below the device. "intrinsic": the
        sole's surface turns and the rim of the device stays.
    """

    type: ClassVar[str] = "posting"
    rearfoot_deg: float = 0.0
    forefoot_deg: float = 0.0
    blend_start: float = 0.25
    blend_end: float = 0.65
    method: str = "extrinsic"


@dataclass(frozen=True, kw_only=True)
class ForefootTwist(CorrectionBase):
    """Rotation of the forefoot relative to the rearfoot, which stays as it is.

    Parameters
    ----------
    angle_deg
        Angles > 0 raise the medial edge.
    blend_start, blend_end
        Shares of the length between which the angle grows from 0 to its full value.
    """

    type: ClassVar[str] = "forefoot_twist"
    angle_deg: float = 0.0
    blend_start: float = 0.45
    blend_end: float = 0.75


@dataclass(frozen=True, kw_only=True)
class HeelSkive(CorrectionBase):
    """A plane cut into one side of the heel of the positive (Kirby 1992): a wedge in the cup.

    Parameters
    ----------
    border
        "medial" or "lateral".
    depth_mm
        Greatest height that the plane adds to the contact surface.
    slope_deg
        Inclination of the plane to the bottom.
    """

    type: ClassVar[str] = "heel_skive"
    border: str = "medial"
    depth_mm: float = 3.0
    slope_deg: float = 15.0


@dataclass(frozen=True, kw_only=True)
class HeelLift(CorrectionBase):
    """A raised heel: full height up to `fade_start`, none from `fade_end` on (length shares)."""

    type: ClassVar[str] = "heel_lift"
    height_mm: float = 3.0
    fade_start: float = 0.25
    fade_end: float = 0.65


@dataclass(frozen=True, kw_only=True)
class ArchRaise(CorrectionBase):
    """The medial arch raised about its apex, an ellipse that falls to zero with continuous slope.

    Parameters
    ----------
    height_mm
        Added at the apex; ignored if there is a target.
    target_mm
        Height over the bottom plane that the arch reaches at the apex, before pads and strokes.
        A surface that is higher there is not lowered.
    apex_mm
        By default the apex of the foot's own arch.
    """

    type: ClassVar[str] = "arch_raise"
    height_mm: float = 3.0
    target_mm: float | None = None
    apex_mm: Place | None = None
    length_mm: float = 100.0
    width_mm: float = 50.0


@dataclass(frozen=True, kw_only=True)
class HeelCup(CorrectionBase):
    """Height of the heel cup's rim above the heel's lowest point.

    A rim that is higher on the foot is lowered to it; a lower one is raised beside the foot.

    Parameters
    ----------
    fade_start, fade_end
        Shares of the length between which the limit of the rim fades out.
    """

    type: ClassVar[str] = "heel_cup"
    depth_mm: float = 12.0
    fade_start: float = 0.3
    fade_end: float = 0.45


@dataclass(frozen=True, kw_only=True)
class Rocker(CorrectionBase):
    """An underside that rises ahead of a line along the heads, so that the foot rolls over it.

    The contact surface stays; what is eased comes off the thickness.

    Parameters
    ----------
    behind_heads_mm
        Distance of the line behind that through heads 1 and 5; < 0 ahead of it.
    slope_deg
        Slope of the underside ahead of the line.
    """

    type: ClassVar[str] = "rocker"
    behind_heads_mm: float = 5.0
    slope_deg: float = 10.0


@dataclass(frozen=True, kw_only=True)
class BrushStroke(CorrectionBase):
    """One free-hand stroke over the surface; the Gaussian neighbourhood (25) follows it.

    Parameters
    ----------
    mode
        "push" adds material, "pull" removes it, "smooth" evens out.
    points_mm
        Path of the pointer, at least one point.
    radius_mm
        Distance from the path beyond which nothing changes.
    strength
        "push", "pull": mm on the path itself; "smooth": share from 0 to 1 of full smoothing.
    """

    type: ClassVar[str] = "brush"
    mode: str = "push"
    points_mm: tuple[Place, ...]
    radius_mm: float = 15.0
    strength: float = 1.0


Correction: TypeAlias = (
    Pelott
    | Posting
    | ForefootTwist
    | HeelSkive
    | HeelLift
    | ArchRaise
    | HeelCup
    | Rocker
    | BrushStroke
)
CORRECTION_TYPES: dict[str, type[Correction]] = {
    kind.type: kind
    for kind in (
        Pelott, Posting, ForefootTwist, HeelSkive, HeelLift, ArchRaise, HeelCup, Rocker,
        BrushStroke,
    )
}  # fmt: skip
