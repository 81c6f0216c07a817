"""What can be prescribed, one value each; `InsoleDesign` holds them in order.

All places are in the insole frame: mm, x = 0 on the foot axis, y = 0 at the rearmost heel point.
Shares are shares of the foot's length, counted from the heel. Angles > 0 raise the medial edge.
"""

from __future__ import annotations

import uuid
from dataclasses import dataclass, field
from typing import ClassVar, TypeAlias

Place: TypeAlias = tuple[float, float]
"""(x, y) in mm."""


def _new_id() -> str:
    return uuid.uuid4().hex[:12]


@dataclass(frozen=True, kw_only=True)
class CorrectionBase:
    """What every correction has.

    Parameters
    ----------
    id
        Stays the same while the correction is edited.
    enabled
        A correction that is switched off stays in the prescription and changes nothing.
    author, created_at
        Who prescribed it and when (ISO 8601, UTC); empty where unknown.
    """

    id: str = field(default_factory=_new_id)
    enabled: bool = True
    author: str = ""
    created_at: str = ""


@dataclass(frozen=True, kw_only=True)
class Pelott(CorrectionBase):
    """A pad on the contact surface, thesis 6.3.2; a recess where its height is negative.

    Parameters
    ----------
    shape
        One of `pad_shapes.PAD_SHAPES`: "egg" (26), "drop", "bar", "arch_support", "horseshoe",
        "cut_out", "mortons_extension", or "outline", a free one.
    centre_mm
        Place of the apex, where the added height is `height_mm`; of a horseshoe the centre of its
        bow, about which the height is held at half the leg's breadth.
    length_mm, width_mm
        Size of the outline along and across the pad; of a free outline its points decide.
    height_mm
        Added at the apex: the peak of the Gaussian neighbourhood (25), or the flat top.
    turn_deg
        Counter-clockwise seen from above (from the foot's side). At 0 the blunt end of an egg and
        the opening of a horseshoe point to the toes, the flat side of an arch support to +x.
    egg_ratio
        r of (26): 0 gives an ellipse, 1 the most pointed egg. Only eggs have it.
    sigma_mm
        Standard deviations (along width, along length) of (25); by default the outline decides.
        Flat-topped shapes have none.
    blend_mm
        Breadth of the edge over which the pad falls to zero with continuous slope; by default half
        of the way from apex to outline for domed shapes, a quarter of the width for flat ones.
    outline_mm
        Of the shape "outline": its corners about the centre, not turned, joined by a closed curve.
    """

    type: ClassVar[str] = "pelott"
    shape: str = "egg"
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
    """Pronation/supination: rotation of the foot against the insole's bottom, thesis 6.3.1.

    Parameters
    ----------
    rearfoot_deg, forefoot_deg
        Angles > 0 raise the medial edge (varus) of either foot.
    blend_start, blend_end
        Shares of the length between which the rearfoot's angle goes over to the forefoot's.
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
    """The forefoot turned against the rearfoot, which stays as it is.

    Parameters
    ----------
    angle_deg
        Greater than 0 raises the medial edge.
    blend_start, blend_end
        Shares of the length between which the angle grows from 0 to all of it.
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
        What the plane adds at most to the contact surface.
    slope_deg
        Of the plane against the bottom.
    """

    type: ClassVar[str] = "heel_skive"
    border: str = "medial"
    depth_mm: float = 3.0
    slope_deg: float = 15.0


@dataclass(frozen=True, kw_only=True)
class HeelLift(CorrectionBase):
    """The heel raised: all of it up to `fade_start`, nothing from `fade_end` on (shares)."""

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
        Added at the apex.
    apex_mm
        By default the apex of the foot's own arch.
    length_mm, width_mm
    """

    type: ClassVar[str] = "arch_raise"
    height_mm: float = 3.0
    apex_mm: Place | None = None
    length_mm: float = 100.0
    width_mm: float = 50.0


@dataclass(frozen=True, kw_only=True)
class HeelCup(CorrectionBase):
    """How high the rim of the heel cup stands over the heel's lowest point.

    A rim that the foot gives higher is taken down to it; a lower one is raised beside the foot.

    Parameters
    ----------
    depth_mm
    fade_start, fade_end
        Shares of the length between which the limit of the rim ends.
    """

    type: ClassVar[str] = "heel_cup"
    depth_mm: float = 12.0
    fade_start: float = 0.3
    fade_end: float = 0.45


@dataclass(frozen=True, kw_only=True)
class BrushStroke(CorrectionBase):
    """One stroke of the hand over the surface; the Gaussian neighbourhood (25) follows it.

    Parameters
    ----------
    mode
        "push" adds, "pull" takes away, "smooth" evens out.
    points_mm
        The way of the pointer, at least one place.
    radius_mm
        From here on nothing changes.
    strength
        "push", "pull": mm on the stroke itself; "smooth": share from 0 to 1 of the way to even.
    """

    type: ClassVar[str] = "brush"
    mode: str = "push"
    points_mm: tuple[Place, ...]
    radius_mm: float = 15.0
    strength: float = 1.0


Correction: TypeAlias = (
    Pelott | Posting | ForefootTwist | HeelSkive | HeelLift | ArchRaise | HeelCup | BrushStroke
)
CORRECTION_TYPES: dict[str, type[Correction]] = {
    kind.type: kind
    for kind in (
        Pelott, Posting, ForefootTwist, HeelSkive, HeelLift, ArchRaise, HeelCup, BrushStroke,
    )
}  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Outline:
    """The edge of the insole, seen from above.

    Parameters
    ----------
    source
        "foot": the foot's outline and the allowances; "shoe_size": its length from the shoe's size,
        the widths from the foot; "drawn": the closed curve through `points_mm`.
    extent
        "full", or "three_quarter": ends behind the metatarsal heads.
    toe_allowance_mm, ball_allowance_mm, heel_allowance_mm
        Added to the foot before the toes, at both sides of the ball, and about the heel.
    shoe_size_eu
        Paris points, 6.67 mm each; needed where the shoe's size is the source.
    points_mm
        At least four where the outline is drawn.
    """

    source: str = "foot"
    extent: str = "full"
    toe_allowance_mm: float = 5.0
    ball_allowance_mm: float = 2.0
    heel_allowance_mm: float = 2.0
    shoe_size_eu: float | None = None
    points_mm: tuple[Place, ...] | None = None


@dataclass(frozen=True, kw_only=True)
class Layers:
    """Thickness of the layers from the foot down, mm; 0 where a layer is not made on its own."""

    cover_mm: float = 0.0
    shell_mm: float = 0.0
    base_mm: float = 0.0

    @property
    def total_mm(self) -> float:
        """All layers together."""
        return self.cover_mm + self.shell_mm + self.base_mm
