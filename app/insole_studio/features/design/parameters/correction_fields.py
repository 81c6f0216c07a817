"""The editable values of a prescription as a table: label, unit and step of each."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np

from insole_core.insole.pads.pad_shapes import local_outline
from insole_core.insole.prescription.design import (
    ArchRaise,
    BrushStroke,
    ForefootTwist,
    HeelCup,
    HeelLift,
    HeelSkive,
    InsoleDesign,
    Layers,
    Outline,
    Pelott,
    Posting,
)
from insole_core.insole.prescription.design_limits import (
    CHOICES,
    CORRECTION_RANGES,
    DESIGN_RANGES,
    LAYER_RANGES,
    OUTLINE_RANGES,
    Range,
    range_beside,
)
from insole_studio.features.design.correction_names import WORDS
from insole_studio.features.design.rows import ChoiceSpec, FieldSpec
from insole_studio.texts import tr

Part = TypeVar("Part")


@dataclass(frozen=True)
class Editable:
    """One editable value of a part of the prescription.

    Parameters
    ----------
    name
        Name of the attribute.
    label
        Function that returns the translated label.
    number
        Index into a position or pair; None for a single value.
    step
        Step of the field.
    expert
        Whether it is about the computation, not about the foot: shown apart, after all others.
    """

    name: str
    label: Callable[[], str]
    number: int | None = None
    step: float = 0.5
    expert: bool = False

    @property
    def key(self) -> str:
        """Key of the value, unique within its part."""
        return self.name if self.number is None else f"{self.name}.{self.number}"


def _height(name: str = "height_mm") -> Editable:
    return Editable(name, lambda: tr("Height"))


def _length() -> Editable:
    return Editable("length_mm", lambda: tr("Length"))


def _width() -> Editable:
    return Editable("width_mm", lambda: tr("Width"))


def _zone(start: str, end: str) -> tuple[Editable, Editable]:
    return (
        Editable(start, lambda: tr("Blend from"), step=0.01),
        Editable(end, lambda: tr("Blend to"), step=0.01),
    )


EDITABLE: dict[type[Any], tuple[Editable, ...]] = {
    Pelott: (
        _height(),
        Editable("turn_deg", lambda: tr("Turn")),
        _length(),
        _width(),
        Editable("centre_mm", lambda: tr("Place x"), 0),
        Editable("centre_mm", lambda: tr("Place y"), 1),
        Editable("egg_ratio", lambda: tr("Egg ratio"), step=0.05),
        Editable("sigma_mm", lambda: tr("Sigma across"), 0),
        Editable("sigma_mm", lambda: tr("Sigma along"), 1),
    ),
    Posting: (
        Editable("rearfoot_deg", lambda: tr("Rearfoot")),
        Editable("forefoot_deg", lambda: tr("Forefoot")),
        *_zone("blend_start", "blend_end"),
        Editable("method", lambda: tr("Posting")),
    ),
    ForefootTwist: (
        Editable("angle_deg", lambda: tr("Angle")),
        *_zone("blend_start", "blend_end"),
    ),
    HeelSkive: (
        Editable("depth_mm", lambda: tr("Depth")),
        Editable("slope_deg", lambda: tr("Slope")),
        Editable("border", lambda: tr("Edge")),
    ),
    HeelLift: (_height(), *_zone("fade_start", "fade_end")),
    ArchRaise: (
        _height(),
        _length(),
        _width(),
        Editable("apex_mm", lambda: tr("Apex x"), 0),
        Editable("apex_mm", lambda: tr("Apex y"), 1),
    ),
    HeelCup: (Editable("depth_mm", lambda: tr("Depth")), *_zone("fade_start", "fade_end")),
    BrushStroke: (
        Editable("strength", lambda: tr("Strength"), step=0.1),
        Editable("radius_mm", lambda: tr("Radius")),
        Editable("mode", lambda: tr("Brush")),
    ),
    InsoleDesign: (
        Editable("thickness_mm", lambda: tr("Thickness")),
        Editable("bottom", lambda: tr("Bottom")),
        Editable("max_height_mm", lambda: tr("Flank height")),
        Editable("grid_mm", lambda: tr("Grid"), step=0.25, expert=True),
    ),
    Layers: (
        Editable("cover_mm", lambda: tr("Cover")),
        Editable("shell_mm", lambda: tr("Shell")),
        Editable("base_mm", lambda: tr("Base")),
    ),
    Outline: (
        Editable("source", lambda: tr("Outline")),
        Editable("extent", lambda: tr("Extent")),
        Editable("toe_allowance_mm", lambda: tr("Toes")),
        Editable("ball_allowance_mm", lambda: tr("Ball")),
        Editable("heel_allowance_mm", lambda: tr("Heel")),
        Editable("shoe_size_eu", lambda: tr("EU size")),
    ),
}
_RANGES: dict[type[Any], dict[str, Range]] = {
    **CORRECTION_RANGES,
    InsoleDesign: DESIGN_RANGES,
    Layers: LAYER_RANGES,
    Outline: OUTLINE_RANGES,
}


def field_specs(
    part: Any, prefix: str, *, expert: bool = False
) -> tuple[FieldSpec | ChoiceSpec, ...]:
    """Return the fields of a correction, of the design, of its layers or outline, in tab order.

    Values that the part does not have (the egg ratio of a bar, an automatic position) are omitted.

    Parameters
    ----------
    part
        The part of the prescription.
    prefix
        Prefix of the fields' keys.
    expert
        Whether to return those for experts, or all others.
    """
    wanted = (editable for editable in EDITABLE[type(part)] if editable.expert is expert)
    specs = (_spec(part, editable, f"{prefix}.{editable.key}") for editable in wanted)
    return tuple(spec for spec in specs if spec is not None)


def with_value(part: Part, key: str, value: float | str) -> Part:
    """Return the part with one value replaced.

    Parameters
    ----------
    part
        The part of the prescription.
    key
        Key of the field, without the prefix.
    value
        The new number or choice.
    """
    name, _, number = key.partition(".")
    changes: dict[str, Any] = {name: value}
    if number:
        pair = list(_pair(part, name) or (0.0, 0.0))
        pair[int(number)] = float(value)
        changes = {name: tuple(pair)}
    changed = replace(part, **changes)  # type: ignore[type-var]
    return _within(changed) if isinstance(value, str) else changed


def _within(part: Part) -> Part:
    """Return the part with its numbers clipped to the ranges that its choices allow."""
    for name in (editable.name for editable in EDITABLE[type(part)]):
        number = getattr(part, name)
        if isinstance(number, int | float):
            allowed = _allowed(part, name)
            fitting: dict[str, Any] = {name: min(max(number, allowed.least), allowed.greatest)}
            part = replace(part, **fitting)  # type: ignore[type-var]
    return part


def _allowed(part: Any, name: str) -> Range:
    return range_beside(part, name, _RANGES[type(part)][name])


def _spec(part: Any, editable: Editable, key: str) -> FieldSpec | ChoiceSpec | None:
    if isinstance(part, Outline) and not _acts(part, editable.name):
        return None
    words = CHOICES.get(type(part), {}).get(editable.name)
    if words is not None:
        options = tuple((word, WORDS[word]()) for word in words)
        return ChoiceSpec(key, editable.label(), getattr(part, editable.name), options)
    value = _number(part, editable)
    if value is None:
        return None
    allowed = _allowed(part, editable.name)
    unit = {"degrees": "°", "": ""}.get(allowed.unit, allowed.unit)
    return FieldSpec(
        key,
        editable.label(),
        unit,
        value,
        allowed.least,
        allowed.greatest,
        editable.step,
        decimals=2 if editable.step < 0.5 else 1,
    )


def _number(part: Any, editable: Editable) -> float | None:
    if isinstance(part, Pelott) and not _has(part, editable.name):
        return None
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


def _acts(outline: Outline, name: str) -> bool:
    """Return whether a value applies to this kind of outline."""
    if outline.source == "drawn":
        return name == "source"
    if name == "toe_allowance_mm":
        return outline.source == "foot" and outline.extent == "full"
    return name != "shoe_size_eu" or outline.source == "shoe_size"


def _has(pad: Pelott, name: str) -> bool:
    """Return whether a pad of this shape has a value."""
    if name == "egg_ratio":
        return pad.shape == "egg"
    if name == "sigma_mm":
        return pad.shape in ("egg", "drop", "arch_support", "outline")
    return name not in ("length_mm", "width_mm") or pad.outline_mm is None
