"""What every value of a prescription is called and how it is written, declared once.

Papers walk this table by general code (`prescription_lines`); the names are those of the window's
fields. A new field is declared here; a test names those that say nothing to anybody.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final

from insole_core.insole.elements import (
    ArchRaise,
    BrushStroke,
    ForefootTwist,
    HeelCup,
    HeelLift,
    HeelSkive,
    Pelott,
    Posting,
    Rocker,
)
from insole_core.insole.pads.pad_shapes import DOMED
from insole_core.insole.prescription.base_form import BaseForm, Form
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Post, Shell
from insole_core.insole.prescription.shoe import Shoe

RAISING: Final = "{value}° medial"
"""The template of angles that raise the medial edge above 0, the lateral one below."""
WORDS: Final[Mapping[str, str]] = {
    "flat": "flat",
    "following": "cupped",
    "full": "full length",
    "three_quarter": "three-quarter",
    "sulcus": "sulcus",
    "crest": "crest",
    "as_scanned": "as scanned",
    "foot": "from the foot",
    "shoe_size": "from the shoe size",
    "drawn": "drawn",
    "medial": "medial",
    "lateral": "lateral",
    "extrinsic": "extrinsic",
    "intrinsic": "intrinsic",
    "push": "raise",
    "pull": "lower",
    "smooth": "smooth",
}
"""How the words of a design are said, where a field has none of its own."""


@dataclass(frozen=True)
class Spoken:
    """How a field is said.

    Parameters
    ----------
    name
        As in the window.
    template
        Of a number or of two, with its unit.
    scale
        By which a number is multiplied.
    decimals
        As in the field of the window.
    words
        Of a choice, before `WORDS`.
    """

    name: str
    template: str = "{value} mm"
    scale: float = 1.0
    decimals: int = 1
    words: Mapping[Any, str] = field(default_factory=dict)


def _degrees(name: str) -> Spoken:
    return Spoken(name, "{value}°")


def _raising(name: str) -> Spoken:
    return Spoken(name, RAISING)


def _share(name: str) -> Spoken:
    return Spoken(name, "{value} %", 100)


def _of_length(name: str) -> Spoken:
    return Spoken(name, "{value} % of the length", 100)


def _plain(name: str) -> Spoken:
    return Spoken(name, "{value}")


SPOKEN: Final[Mapping[type[Any], Mapping[str, Spoken]]] = {
    Pelott: {
        "shape": Spoken("Shape"),
        "height_mm": Spoken("Height"),
        "turn_deg": _degrees("Turn"),
        "length_mm": Spoken("Length"),
        "width_mm": Spoken("Width"),
        "centre_mm": Spoken("Place"),
        "egg_ratio": _share("Taper"),
        "sigma_mm": Spoken("Fullness across and along"),
        "blend_mm": Spoken("Edge"),
        "outline_mm": Spoken("Outline"),
    },
    Posting: {
        "rearfoot_deg": _raising("Rearfoot"),
        "forefoot_deg": _raising("Forefoot"),
        "method": Spoken("Kind"),
        "blend_start": _of_length("Rearfoot up to"),
        "blend_end": _of_length("Forefoot from"),
    },
    ForefootTwist: {
        "angle_deg": _raising("Angle"),
        "blend_start": _of_length("Begins at"),
        "blend_end": _of_length("Full from"),
    },
    HeelSkive: {
        "depth_mm": Spoken("Depth"),
        "slope_deg": _degrees("Slope"),
        "border": Spoken("Edge"),
    },
    HeelLift: {
        "height_mm": Spoken("Height"),
        "fade_start": _of_length("Full up to"),
        "fade_end": _of_length("Ends at"),
    },
    ArchRaise: {
        "height_mm": Spoken("Height"),
        "target_mm": Spoken("Finished height"),
        "length_mm": Spoken("Length"),
        "width_mm": Spoken("Width"),
        "apex_mm": Spoken("Place"),
    },
    HeelCup: {
        "depth_mm": Spoken("Depth"),
        "fade_start": _of_length("Full up to"),
        "fade_end": _of_length("Ends at"),
    },
    Rocker: {
        "behind_heads_mm": Spoken("Behind the heads"),
        "slope_deg": _degrees("Slope"),
    },
    BrushStroke: {
        "mode": Spoken("Brush"),
        "strength": Spoken("Strength", decimals=2),
        "radius_mm": Spoken("Radius"),
        "points_mm": Spoken("Path"),
    },
    InsoleDesign: {
        "thickness_mm": Spoken("Thickness"),
        "bottom": Spoken("Underside"),
        "max_height_mm": Spoken("Side height"),
        "margin_mm": Spoken("Margin"),
        "grid_mm": Spoken("Computed every", decimals=2),
    },
    Outline: {
        "source": Spoken("Outline"),
        "extent": Spoken("Extent"),
        "toe_allowance_mm": Spoken("Toes"),
        "ball_allowance_mm": Spoken("Ball"),
        "heel_allowance_mm": Spoken("Heel"),
        "shoe_size_eu": _plain("EU size"),
        "width_mm": Spoken("Width", "{value} mm from the bisection of the 1st metatarsal"),
        "points_mm": Spoken("Line"),
    },
    Shoe: {
        "name": Spoken("Shoe"),
        "trim": Spoken("Trimmed to it"),
        "clearance_mm": Spoken("Room"),
        "inside_mm": Spoken("Inside"),
    },
    Layers: {
        "cover_mm": Spoken("Cover"),
        "shell_mm": Spoken("Middle layer"),
        "base_mm": Spoken("Base"),
        "cover_is_taken_off": Spoken(
            "Cover is", words={False: "made with it", True: "glued on later"}
        ),
    },
    BaseForm: {"contact_share": _share("Share of the foot")},
    Form: {
        "name": Spoken("Form"),
        "length_mm": Spoken("Foot length"),
        "ball_width_mm": Spoken("Ball width"),
    },
    Finish: {
        "toe_zone": Spoken("Toe zone"),
        "toe_line_mm": Spoken("Toe line"),
        "arch_fill_mm": Spoken("Arch fill"),
        "heel_blend_mm": Spoken("Heel transition"),
        "arch_blend_mm": Spoken("Arch transition"),
        "forefoot_blend_mm": Spoken("Forefoot transition"),
        "expansion_mm": Spoken("Soft tissue"),
        "skin_smoothing_mm": Spoken("Skin smoothing"),
    },
    RimStation: {
        "along": _share("Place"),
        "height_mm": Spoken("Height"),
        "over": Spoken(
            "Over", words={"heel": "heel", "toes": "toe zone", "foot": "the foot itself"}
        ),
    },
    Shell: {
        "material": Spoken("Material"),
        "body_weight_kg": Spoken("Body weight", "{value} kg"),
        "least_mm": Spoken("Least thickness"),
        "least_edge_mm": Spoken("Least thickness at the front edge"),
        "heel_pitch_mm": Spoken("Heel pitch"),
        "taper_mm": Spoken("Front edge"),
        "taper_length_mm": Spoken("Taper length"),
        "edge_radius_mm": Spoken("Edge radius"),
        "draft_medial_deg": _degrees("Medial draft"),
        "draft_lateral_deg": _degrees("Lateral draft"),
        "chamfer_mm": Spoken("Chamfer"),
        "trim_mm": Spoken("Trim line"),
    },
    Post: {
        "angle_deg": _raising("Angle"),
        "length_mm": Spoken("Length"),
        "edge_radius_mm": Spoken("Edge radius"),
    },
}
"""The fields of each part of a prescription, in the order in which they are said."""
NAMES: Final[Mapping[type[Any], str]] = {
    Posting: "Posting",
    ForefootTwist: "Forefoot twist",
    HeelSkive: "Heel skive",
    HeelLift: "Heel lift",
    ArchRaise: "Arch raise",
    HeelCup: "Heel cup",
    Rocker: "Rocker",
    BrushStroke: "Brush stroke",
}
"""What corrections are called; pads have names of their own (`pad_kinds`)."""
_SIZES: Final = ("length_mm", "width_mm")


def acts(part: Any, name: str) -> bool:
    """Return whether a field of a part does something beside the part's other values."""
    if isinstance(part, Outline):
        return _acts_on_outline(part, name)
    if isinstance(part, Pelott):
        return _acts_on_pad(part, name)
    return not (isinstance(part, ArchRaise) and name == "height_mm" and part.target_mm is not None)


def spoken(part: Any, name: str) -> Spoken:
    """Return how a field of a part is said."""
    if isinstance(part, BrushStroke) and name == "strength" and part.mode == "smooth":
        return _share("Strength")
    return SPOKEN[type(part)][name]


def _acts_on_outline(outline: Outline, name: str) -> bool:
    if outline.source == "drawn":
        return name in ("source", "points_mm")
    if name == "toe_allowance_mm":
        return outline.source == "foot" and outline.extent == "full"
    if name == "shoe_size_eu":
        return outline.source == "shoe_size"
    return name != "points_mm"


def _acts_on_pad(pad: Pelott, name: str) -> bool:
    if name == "shape":
        return pad.kind is not None  # else it is the name
    if name == "egg_ratio":
        return pad.shape == "egg"
    if name == "sigma_mm":
        return pad.shape in DOMED
    return name not in _SIZES or pad.outline_mm is None
