"""The editable values of a prescription as a table: label, unit and step of each."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np

from insole_core.geometry.side import Side
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
from insole_core.insole.pads.pad_shapes import local_outline, pad_size, resized
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_limits import (
    CHOICES,
    CORRECTION_RANGES,
    DESIGN_RANGES,
    FINISH_RANGES,
    LAYER_RANGES,
    OUTLINE_RANGES,
    POST_RANGES,
    RIM_RANGES,
    SHELL_RANGES,
    Range,
    range_beside,
)
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Post, Shell
from insole_core.insole.prescription.vocabulary import acts
from insole_studio.features.design.correction_names import from_axis, from_heel, word_of
from insole_studio.features.design.rows import ChoiceSpec, FieldSpec
from insole_studio.texts import tr

NARROW_MM, WIDE_MM = -3.2, 3.2
"""Medial border of a narrow and a wide insole, from the bisection of the 1st metatarsal."""

Part = TypeVar("Part")
_SIZES = ("length_mm", "width_mm")


@dataclass(frozen=True)
class Editable:
    """One editable value of a part of the prescription.

    Parameters
    ----------
    name
        Name of the attribute.
    label, tip
        Functions that return the translated label, and what the value does, in one sentence.
    number
        Index into a position or pair; None for a single value.
    step
        Step of the field.
    is_share
        Whether it is a share, which is shown in per cent.
    is_medial
        Whether it is the x of a place, which is shown as > 0 on the medial side of either foot.
    choices
        The values that it can have, with their names, where these are no words of the file.
    expert
        Whether it is about the computation, or rarely changed: shown apart, after all others.
    """

    name: str
    label: Callable[[], str]
    tip: Callable[[], str]
    number: int | None = None
    step: float = 0.5
    is_share: bool = False
    is_medial: bool = False
    choices: tuple[tuple[Any, Callable[[], str]], ...] = ()
    expert: bool = False

    @property
    def key(self) -> str:
        """Key of the value, unique within its part."""
        return self.name if self.number is None else f"{self.name}.{self.number}"

    def factor(self, side: Side) -> float:
        """Return the number that a stored value is multiplied by to be shown."""
        return (100 if self.is_share else 1) * (side.medial_sign if self.is_medial else 1)


def _height(tip: Callable[[], str]) -> Editable:
    return Editable("height_mm", lambda: tr("Height"), tip)


def _length(tip: Callable[[], str]) -> Editable:
    return Editable("length_mm", lambda: tr("Length"), tip)


def _width(tip: Callable[[], str]) -> Editable:
    return Editable("width_mm", lambda: tr("Width"), tip)


def _place(name: str) -> tuple[Editable, Editable]:
    return (
        Editable(
            name,
            from_axis,
            lambda: tr("Distance of the highest place from the foot axis; > 0 is medial"),
            0,
            is_medial=True,
        ),
        Editable(
            name,
            from_heel,
            lambda: tr("Distance of the highest place from the back of the heel"),
            1,
        ),
    )


def _share(name: str, label: Callable[[], str], tip: Callable[[], str]) -> Editable:
    return Editable(name, label, tip, step=1, is_share=True, expert=True)


def _blend(name: str, label: Callable[[], str], where: Callable[[], str]) -> Editable:
    def tip() -> str:
        text = tr("Width of the transition from support to rim {where}")
        return text.format(where=where())

    return Editable(name, label, tip, expert=True)


EDITABLE: dict[type[Any], tuple[Editable, ...]] = {
    Pelott: (
        _height(lambda: tr("Height at the highest place; below 0 it is a recess")),
        Editable(
            "turn_deg",
            lambda: tr("Turn"),
            lambda: tr("Turn seen from above; > 0 is counter-clockwise"),
        ),
        _length(lambda: tr("Length of the pad")),
        _width(lambda: tr("Width of the pad")),
        *_place("centre_mm"),
        _share(
            "egg_ratio",
            lambda: tr("Taper"),
            lambda: tr("How much narrower the rear end is than the front; 0 % is an ellipse"),
        ),
        Editable(
            "sigma_mm",
            lambda: tr("Fullness across"),
            lambda: tr("How far the height spreads across the pad; more makes it fuller"),
            0,
            expert=True,
        ),
        Editable(
            "sigma_mm",
            lambda: tr("Fullness along"),
            lambda: tr("How far the height spreads along the pad; more makes it fuller"),
            1,
            expert=True,
        ),
    ),
    Posting: (
        Editable(
            "rearfoot_deg",
            lambda: tr("Rearfoot"),
            lambda: tr("> 0 raises the medial edge of the rearfoot (varus), < 0 the lateral one"),
        ),
        Editable(
            "forefoot_deg",
            lambda: tr("Forefoot"),
            lambda: tr("> 0 raises the medial edge of the forefoot (varus), < 0 the lateral one"),
        ),
        Editable(
            "method",
            lambda: tr("Kind"),
            lambda: tr("Extrinsic turns the whole insole, intrinsic leaves its rim as it is"),
        ),
        _share(
            "blend_start",
            lambda: tr("Rearfoot up to"),
            lambda: tr("Share of the foot's length up to which the rearfoot angle holds"),
        ),
        _share(
            "blend_end",
            lambda: tr("Forefoot from"),
            lambda: tr("Share of the foot's length from which the forefoot angle holds"),
        ),
    ),
    ForefootTwist: (
        Editable(
            "angle_deg",
            lambda: tr("Angle"),
            lambda: tr("> 0 raises the medial edge of the forefoot (varus), < 0 the lateral one"),
        ),
        _share(
            "blend_start",
            lambda: tr("Begins at"),
            lambda: tr("Share of the foot's length at which the twist begins"),
        ),
        _share(
            "blend_end",
            lambda: tr("Full from"),
            lambda: tr("Share of the foot's length from which the whole angle holds"),
        ),
    ),
    HeelSkive: (
        Editable(
            "depth_mm",
            lambda: tr("Depth"),
            lambda: tr("Greatest height of the wedge in the heel cup"),
        ),
        Editable(
            "slope_deg", lambda: tr("Slope"), lambda: tr("Slope of the wedge against the ground")
        ),
        Editable("border", lambda: tr("Edge"), lambda: tr("Edge of the heel that is raised")),
    ),
    HeelLift: (
        _height(lambda: tr("How much the heel is raised")),
        _share(
            "fade_start",
            lambda: tr("Full up to"),
            lambda: tr("Share of the foot's length up to which the heel is raised in full"),
        ),
        _share(
            "fade_end",
            lambda: tr("Ends at"),
            lambda: tr("Share of the foot's length at which the lift ends"),
        ),
    ),
    ArchRaise: (
        _height(lambda: tr("How much the arch is raised at its highest place")),
        Editable(
            "target_mm",
            lambda: tr("Finished height"),
            lambda: tr("Height of the finished arch over the underside of the insole"),
        ),
        _length(lambda: tr("Length of the zone that is raised")),
        _width(lambda: tr("Width of the zone that is raised")),
        *_place("apex_mm"),
    ),
    HeelCup: (
        Editable(
            "depth_mm",
            lambda: tr("Depth"),
            lambda: tr("Height of the rim over the lowest place of the heel"),
        ),
        _share(
            "fade_start",
            lambda: tr("Full up to"),
            lambda: tr("Share of the foot's length up to which the cup has its full depth"),
        ),
        _share(
            "fade_end",
            lambda: tr("Ends at"),
            lambda: tr("Share of the foot's length at which the cup ends"),
        ),
    ),
    Rocker: (
        Editable(
            "behind_heads_mm",
            lambda: tr("Behind the heads"),
            lambda: tr("Distance of the line behind heads 1 and 5; < 0 is ahead of them"),
        ),
        Editable(
            "slope_deg",
            lambda: tr("Slope"),
            lambda: tr("Slope of the underside ahead of the line"),
        ),
    ),
    BrushStroke: (
        Editable(
            "strength",
            lambda: tr("Strength"),
            lambda: tr("How much a stroke changes the height; 1 smooths out all it can"),
            step=0.1,
        ),
        Editable(
            "radius_mm",
            lambda: tr("Radius"),
            lambda: tr("Distance from the stroke beyond which nothing changes"),
        ),
        Editable("mode", lambda: tr("Brush"), lambda: tr("What the stroke does to the surface")),
    ),
    InsoleDesign: (
        Editable(
            "thickness_mm",
            lambda: tr("Thickness"),
            lambda: tr("Least thickness under the foot, before pads and recesses"),
        ),
        Editable(
            "bottom",
            lambda: tr("Underside"),
            lambda: tr("Flat on the ground, or cupped: everywhere as thick below the foot"),
        ),
        Editable(
            "max_height_mm",
            lambda: tr("Side height"),
            lambda: tr("Height over the ground up to which the insole follows the foot"),
        ),
        Editable(
            "grid_mm",
            lambda: tr("Computed every"),
            lambda: tr("Distance of the points that the surface is computed at"),
            step=0.25,
            expert=True,
        ),
    ),
    Layers: (
        Editable(
            "cover_mm",
            lambda: tr("Cover"),
            lambda: tr("Thickness of the layer next to the foot; 0 for none"),
        ),
        Editable(
            "shell_mm",
            lambda: tr("Middle layer"),
            lambda: tr("Thickness of the layer between cover and base; 0 for none"),
        ),
        Editable(
            "base_mm",
            lambda: tr("Base"),
            lambda: tr("Thickness of the layer next to the shoe; 0 for none"),
        ),
        Editable(
            "cover_is_taken_off",
            lambda: tr("Cover is"),
            lambda: tr("A cover that is glued on later is taken off what is made"),
            choices=((False, lambda: tr("made with it")), (True, lambda: tr("glued on later"))),
            expert=True,
        ),
    ),
    Outline: (
        Editable(
            "source", lambda: tr("Outline"), lambda: tr("What the edge of the insole follows")
        ),
        Editable(
            "extent",
            lambda: tr("Extent"),
            lambda: tr("To the toes, or to behind the metatarsal heads"),
        ),
        Editable(
            "toe_allowance_mm",
            lambda: tr("Toes"),
            lambda: tr("Allowance in front of the longest toe"),
        ),
        Editable(
            "ball_allowance_mm",
            lambda: tr("Ball"),
            lambda: tr("Allowance on both sides of the ball"),
        ),
        Editable("heel_allowance_mm", lambda: tr("Heel"), lambda: tr("Allowance around the heel")),
        Editable(
            "shoe_size_eu",
            lambda: tr("EU size"),
            lambda: tr("Size of the shoe, which decides the length"),
        ),
        Editable(
            "width_mm",
            lambda: tr("Width"),
            lambda: tr("Medial border against the bisection of the 1st metatarsal"),
            choices=(
                (None, lambda: tr("From the foot")),
                (NARROW_MM, lambda: tr("Narrow")),
                (0.0, lambda: tr("Regular")),
                (WIDE_MM, lambda: tr("Wide")),
            ),
        ),
    ),
    Finish: (
        Editable(
            "toe_zone",
            lambda: tr("Toe zone"),
            lambda: tr("What lies ahead of the metatarsal heads, in place of the scanned toes"),
        ),
        Editable(
            "toe_line_mm",
            lambda: tr("Toe line"),
            lambda: tr("How far ahead of the metatarsal heads the toe zone begins"),
            expert=True,
        ),
        _blend("heel_blend_mm", lambda: tr("Heel transition"), lambda: tr("at the heel")),
        _blend("arch_blend_mm", lambda: tr("Arch transition"), lambda: tr("in the arch")),
        _blend(
            "forefoot_blend_mm", lambda: tr("Forefoot transition"), lambda: tr("at the forefoot")
        ),
        Editable(
            "expansion_mm",
            lambda: tr("Soft tissue"),
            lambda: tr("Widening of heel and lateral border: soft tissue spreads in stance"),
            expert=True,
        ),
        Editable(
            "skin_smoothing_mm",
            lambda: tr("Skin smoothing"),
            lambda: tr("Width over which folds of the skin are evened out; 0 for none"),
            expert=True,
        ),
    ),
    RimStation: (
        Editable(
            "height_mm",
            lambda: tr("Height"),
            lambda: tr("Height of the rim at this station over its level"),
        ),
        Editable(
            "over", lambda: tr("Over"), lambda: tr("The level from which the height is counted")
        ),
        Editable(
            "along",
            lambda: tr("Place"),
            lambda: tr("0 % behind the heel, 70 % beside the metatarsal head, 100 % at the toes"),
            step=1,
            is_share=True,
        ),
    ),
    Shell: (
        Editable(
            "heel_pitch_mm",
            lambda: tr("Heel pitch"),
            lambda: tr("Height of the shoe's heel over its forefoot"),
        ),
        Editable(
            "taper_mm",
            lambda: tr("Front edge"),
            lambda: tr("Thickness of the shell at its front edge"),
            expert=True,
        ),
        Editable(
            "taper_length_mm",
            lambda: tr("Taper length"),
            lambda: tr("Length over which the shell gets as thin as its front edge"),
            expert=True,
        ),
        Editable(
            "edge_radius_mm",
            lambda: tr("Edge radius"),
            lambda: tr("Rounding of the upper edge"),
            expert=True,
        ),
        Editable(
            "draft_medial_deg",
            lambda: tr("Medial draft"),
            lambda: tr("Inclination of the medial wall; > 0 is wider at the bottom"),
            expert=True,
        ),
        Editable(
            "draft_lateral_deg",
            lambda: tr("Lateral draft"),
            lambda: tr("Inclination of the lateral wall; > 0 is wider at the bottom"),
            expert=True,
        ),
        Editable(
            "chamfer_mm",
            lambda: tr("Chamfer"),
            lambda: tr("Width of the bevel along the upper edge"),
            expert=True,
        ),
    ),
    Post: (
        Editable(
            "angle_deg",
            lambda: tr("Angle"),
            lambda: tr("> 0 raises the medial edge (varus), < 0 the lateral one (valgus)"),
        ),
    ),
}
_RANGES: dict[type[Any], dict[str, Range]] = {
    **CORRECTION_RANGES,
    InsoleDesign: DESIGN_RANGES,
    Layers: LAYER_RANGES,
    Outline: OUTLINE_RANGES,
    Finish: FINISH_RANGES,
    RimStation: RIM_RANGES,
    Shell: SHELL_RANGES,
    Post: POST_RANGES,
}


def field_specs(
    part: Any, prefix: str, side: Side, *, expert: bool = False
) -> tuple[FieldSpec | ChoiceSpec, ...]:
    """Return the fields of a correction, of the design, of its layers or outline, in tab order.

    Values that the part does not have (the taper of a bar, an automatic position) are omitted.

    Parameters
    ----------
    part
        The part of the prescription.
    prefix
        Prefix of the fields' keys.
    side
        The foot that it is for.
    expert
        Whether to return those for experts, or all others.
    """
    wanted = (editable for editable in EDITABLE[type(part)] if editable.expert is expert)
    specs = (_spec(part, editable, f"{prefix}.{editable.key}", side) for editable in wanted)
    return tuple(spec for spec in specs if spec is not None)


def with_value(part: Part, key: str, value: float | str, side: Side) -> Part:
    """Return the part with one value replaced.

    Parameters
    ----------
    part
        The part of the prescription.
    key
        Key of the field, without the prefix.
    value
        The new number, as the field shows it, or choice.
    side
        The foot that it is for.
    """
    (editable,) = (editable for editable in EDITABLE[type(part)] if editable.key == key)
    if editable.choices:
        chosen, _ = editable.choices[int(value)]
        return replace(part, **{key: chosen})  # type: ignore[type-var]
    if isinstance(value, str):
        return _within(replace(part, **{key: value}))  # type: ignore[type-var]
    stored = value / editable.factor(side)
    if isinstance(part, Pelott) and editable.name in _SIZES:
        sizes = dict(zip(_SIZES, pad_size(part), strict=True)) | {editable.name: stored}
        return resized(part, **sizes)  # type: ignore[return-value]
    if editable.number is None:
        return replace(part, **{editable.name: stored})  # type: ignore[type-var]
    pair = list(_pair(part, editable.name) or (0.0, 0.0))
    pair[editable.number] = stored
    return replace(part, **{editable.name: tuple(pair)})  # type: ignore[type-var]


def _within(part: Part) -> Part:
    """Return the part with its numbers clipped to the ranges that its choices allow."""
    for name in (editable.name for editable in EDITABLE[type(part)] if not editable.choices):
        number = getattr(part, name)
        if isinstance(number, int | float):
            allowed = _allowed(part, name)
            fitting: dict[str, Any] = {name: min(max(number, allowed.least), allowed.greatest)}
            part = replace(part, **fitting)  # type: ignore[type-var]
    return part


def _allowed(part: Any, name: str) -> Range:
    return range_beside(part, name, _RANGES[type(part)][name])


def _spec(part: Any, editable: Editable, key: str, side: Side) -> FieldSpec | ChoiceSpec | None:
    if editable.name not in _SIZES and not acts(part, editable.name):
        return None
    label, tip = editable.label(), editable.tip()
    words = CHOICES.get(type(part), {}).get(editable.name)
    if words is not None:
        options = tuple((word, word_of(editable.name, word)) for word in words)
        return ChoiceSpec(key, label, getattr(part, editable.name), options, tip)
    if editable.choices:
        return _choice(part, editable, key)
    value = _number(part, editable)
    if value is None:
        return None
    factor, allowed = editable.factor(side), _allowed(part, editable.name)
    least, greatest = sorted((factor * allowed.least, factor * allowed.greatest))
    return FieldSpec(
        key,
        label,
        _unit(part, editable, allowed),
        factor * value + 0.0,  # never "-0"
        least,
        greatest,
        editable.step,
        decimals=_decimals(editable),
        tip=tip,
    )


def _choice(part: Any, editable: Editable, key: str) -> ChoiceSpec:
    """Return the choice among values that are no words; one of another value shows nothing."""
    values = [value for value, _ in editable.choices]
    current = getattr(part, editable.name)
    shown = str(values.index(current)) if current in values else ""
    options = tuple((str(number), name()) for number, (_, name) in enumerate(editable.choices))
    return ChoiceSpec(key, editable.label(), shown, options, editable.tip())


def _unit(part: Any, editable: Editable, allowed: Range) -> str:
    if editable.is_share:
        return "%"
    if isinstance(part, BrushStroke) and editable.name == "strength":
        return "" if part.mode == "smooth" else "mm"
    return "°" if allowed.unit == "degrees" else allowed.unit


def _decimals(editable: Editable) -> int:
    if editable.is_share:
        return 0
    return 2 if editable.step < 0.5 else 1


def _number(part: Any, editable: Editable) -> float | None:
    if isinstance(part, Pelott) and editable.name in _SIZES:
        return pad_size(part)[_SIZES.index(editable.name)]
    if editable.number is not None:
        pair = _pair(part, editable.name)
        return None if pair is None else float(pair[editable.number])
    value = getattr(part, editable.name)
    return None if value is None else float(value)


def _pair(part: Any, name: str) -> tuple[float, float] | None:
    pair: tuple[float, float] | None = getattr(part, name)
    if pair is None and isinstance(part, Pelott) and name == "sigma_mm":
        half = np.ptp(local_outline(part), axis=0) / 2
        return round(float(half[0]), 1), round(float(half[1]), 1)
    return pair
