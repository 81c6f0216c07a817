"""What a pad is by itself: its kind, its values, and what it is called."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Final

import numpy as np

from insole_core.errors import DesignError
from insole_core.insole.fields import (
    Angle,
    Choice,
    Declared,
    Depth,
    Line,
    Number,
    Pair,
    Part,
    Place,
    Share,
    Spot,
    Text,
)
from insole_core.insole.primitives.outline_curve import closed_curve, crosses_itself, inside_curve

PAD_NAMES = {
    "egg": "pelott",
    "bar": "metatarsal bar",
    "outline": "free-hand pad",
    "flat_outline": "flat pad",
    "oval": "oval pad",
    "arch_support": "arch support",
    "cut_out": "cut-out",
    "mortons_extension": "Morton's extension",
    "reverse_mortons_extension": "reverse Morton's extension",
    "dancers_pad": "dancer's pad",
    "first_ray_cut_out": "1st-ray cut-out",
    "fifth_ray_cut_out": "5th-ray cut-out",
    "relief_base_5": "relief at the base of the 5th metatarsal",
    "cuboid_raise": "cuboid raise",
    "heel_spur_recess": "heel-spur recess",
    "forefoot_filler": "forefoot filler",
    "relief_head_1": "relief under the 1st head",
    "relief_head_2": "relief under the 2nd head",
    "relief_head_3": "relief under the 3rd head",
    "relief_head_4": "relief under the 4th head",
    "relief_head_5": "relief under the 5th head",
    "relief_toe_1": "relief under the 1st toe",
    "relief_toe_2": "relief under the 2nd toe",
    "relief_toe_3": "relief under the 3rd toe",
    "relief_toe_4": "relief under the 4th toe",
    "relief_toe_5": "relief under the 5th toe",
    "toe_filler_1": "filler for the 1st toe",
    "toe_filler_2": "filler for the 2nd toe",
    "toe_filler_3": "filler for the 3rd toe",
    "toe_filler_4": "filler for the 4th toe",
    "toe_filler_5": "filler for the 5th toe",
}
"""Names of kinds and of shapes whose identifier says too little."""
PAD_SHAPES: Final = (
    "egg", "outline", "drop", "bar", "arch_support", "horseshoe", "cut_out", "mortons_extension",
    "oval", "flat_outline",
)  # fmt: skip
DOMED: Final = ("egg", "drop", "arch_support", "outline", "oval")
"""Shapes with a single peak; the others have a flat top."""
FREE: Final = ("outline", "flat_outline")
"""Shapes that are drawn or made by landmarks, and hold the corners of their outline."""
SIZES: Final = ("length_mm", "width_mm")
LONGEST_KIND: Final = 60
"""Most letters in the kind of a pad."""
_SHAPE_WORDS = {shape: PAD_NAMES.get(shape, shape) for shape in PAD_SHAPES}
_BEHIND_HEADS = ("egg", "drop", "bar")
_FIRST_HEAD_FREE = ("reverse_mortons_extension", "dancers_pad")
_RECESSES = (
    "cut_out",
    "first_ray_cut_out",
    "fifth_ray_cut_out",
    "heel_spur_recess",
    "relief_base_5",
    *(f"relief_head_{n}" for n in range(1, 6)),
    *(f"relief_toe_{n}" for n in range(1, 6)),
)
"""Kinds, and the shape, that are laid to take pressure off what lies over them."""
_DEPTH = Depth(
    "Depth",
    "Depth at the deepest place; below 0 it stands out of the insole",
    -20,
    20,
    main="{value} deep",
    main_below="{value} high",
)
_FILLERS = ("forefoot_filler", *(f"toe_filler_{n}" for n in range(1, 6)))


@dataclass(frozen=True, kw_only=True)
class PadForm(Part):
    """The values of a pad, thesis 6.3.2; a recess if its height is negative.

    Parameters
    ----------
    shape
        "egg" (26), "drop", "bar", "arch_support", "horseshoe", "cut_out", "mortons_extension",
        "oval", or a free shape, domed ("outline") or with a flat top ("flat_outline").
    kind
        What the pad is prescribed as, a kind of the pad library ("relief_head_3"); None if its
        shape says it.
    height_mm
        Added at the apex: the peak of the Gaussian neighbourhood (25), or the flat top.
    turn_deg
        Counter-clockwise seen from above (from the foot's side). At 0 the blunt end of an egg and
        the opening of a horseshoe point to the toes, the flat side of an arch support to +x.
    length_mm, width_mm
        Size of the outline along and across the pad; ignored for a free-hand outline.
    centre_mm
        Position of the apex, where the added height is `height_mm`; of a horseshoe the centre of
        its arc, whose height is reached along the middle of the legs.
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

    shape: Annotated[
        str, Choice("Shape", words=_SHAPE_WORDS, effect="What the pad looks like from above")
    ] = "egg"
    kind: Annotated[
        str | None,
        Text(
            "Kind",
            effect="What it is prescribed as, a kind of the pad library; its shape if left out",
        ),
    ] = None
    height_mm: Annotated[
        float,
        Number("Height", "Height at the highest place; below 0 it is a recess", -20, 20, main=""),
    ] = 6.0
    turn_deg: Annotated[
        float, Angle("Turn", "Turn seen from above; > 0 is counter-clockwise", -360, 360)
    ] = 0.0
    length_mm: Annotated[
        float, Number("Length", "Length of the pad", 5, 200, main="{value} long")
    ] = 60.0
    width_mm: Annotated[float, Number("Width", "Width of the pad", 5, 150)] = 40.0
    centre_mm: Annotated[Place, Spot("Place")]
    egg_ratio: Annotated[
        float,
        Share(
            "Taper",
            "How much narrower the rear end is than the front; 0 % is an ellipse",
            expert=True,
        ),
    ] = 0.5
    sigma_mm: Annotated[
        Place | None,
        Pair(
            "Fullness across and along",
            least=1,
            greatest=400,
            expert=True,
            each=(
                (
                    "Fullness across",
                    "How far the height spreads across the pad; more makes it fuller",
                ),
                (
                    "Fullness along",
                    "How far the height spreads along the pad; more makes it fuller",
                ),
            ),
        ),
    ] = None
    blend_mm: Annotated[
        float | None,
        Number(
            "Edge",
            least=0.5,
            greatest=100,
            effect="Breadth over which the pad runs out; a share of its size if left out",
        ),
    ] = None
    outline_mm: Annotated[
        tuple[Place, ...] | None,
        Line(
            "Outline",
            "",
            3,
            400,
            reach_mm=200,
            is_on_foot=False,
            effect="Corners of a free-hand pad, from its highest place",
        ),
    ] = None

    @property
    def noun(self) -> str:
        """What it is called within a sentence: as its kind, or else as its shape."""
        name = self.kind or self.shape
        return PAD_NAMES.get(name, name.replace("_", " "))

    @property
    def title(self) -> str:
        """The same as a heading."""
        return self.noun[0].upper() + self.noun[1:]

    @property
    def ends_behind_heads(self) -> bool:
        """Whether it is laid by the distance of its front edge from the heads."""
        return self.kind is None and self.shape in _BEHIND_HEADS

    @property
    def leaves_first_head_free(self) -> bool:
        """Whether it raises the lesser heads against the 1st."""
        return self.kind in _FIRST_HEAD_FREE

    @property
    def is_recess(self) -> bool:
        """Whether it is to lie below the surface, and so is told by its depth."""
        return (self.kind if self.kind in PAD_NAMES else self.shape) in _RECESSES

    def declared(self, name: str) -> Declared:
        """Return what a field is: the height of a recess is shown as its depth."""
        if name == "height_mm" and self.is_recess:
            return _DEPTH
        return super().declared(name)

    @property
    def is_filler(self) -> bool:
        """Whether it fills the room of a missing part of the foot, and so lies beside it."""
        return self.kind in _FILLERS

    def acts(self, name: str) -> bool:
        """Return whether a field does something, or says what the name does not."""
        if name == "kind":
            return False  # it is the name
        if name == "shape":
            return self.kind is not None
        if name == "egg_ratio":
            return self.shape == "egg"
        if name == "sigma_mm":
            return self.shape in DOMED
        return name not in SIZES or self.outline_mm is None

    def check(self, where: str) -> None:
        """Check its kind, and the outline of a free shape."""
        if self.kind is not None and not 0 < len(self.kind) <= LONGEST_KIND:
            raise DesignError(
                "kind{where} has {count} letters, and must have 1 to {most}; shorten it, or leave "
                "it out.",
                where=where,
                count=len(self.kind),
                most=LONGEST_KIND,
            )
        if (self.shape in FREE) != (self.outline_mm is not None):
            raise DesignError(
                'outline_mm{where} belongs to the shapes "outline" and "flat_outline" and to no '
                "other; draw an outline, or choose another shape and leave it out.",
                where=where,
            )
        if self.outline_mm is None:
            return
        if crosses_itself(self.outline_mm):
            raise DesignError(
                "outline_mm{where} crosses itself; draw the outline again in one round.",
                where=where,
            )
        if not inside_curve(closed_curve(self.outline_mm), np.zeros(2)):
            raise DesignError(
                "outline_mm{where} does not go round the pad's centre; put the apex into the "
                "outline.",
                where=where,
            )
