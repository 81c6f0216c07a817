"""Translated names of corrections."""

from __future__ import annotations

from collections.abc import Callable

from insole_core.geometry.side import Side
from insole_core.insole.elements import (
    ArchRaise,
    BrushStroke,
    Correction,
    ForefootTwist,
    HeelCup,
    HeelLift,
    HeelSkive,
    Pelott,
    Posting,
    Rocker,
)
from insole_core.insole.pads.pad_places import SIZED_BY_FOOT
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.workflows.pad_library import LibraryPad
from insole_studio.texts import localised, tr, translate_core_message

PAD_NAMES: dict[str, Callable[[], str]] = {
    "egg": lambda: tr("Pelott"),
    "outline": lambda: tr("Free-hand pad"),
    "drop": lambda: tr("Drop"),
    "bar": lambda: tr("Metatarsal bar"),
    "arch_support": lambda: tr("Arch support"),
    "horseshoe": lambda: tr("Horseshoe"),
    "cut_out": lambda: tr("Cut-out"),
    "mortons_extension": lambda: tr("Morton's extension"),
    "oval": lambda: tr("Oval pad"),
    "flat_outline": lambda: tr("Flat pad"),
}
_NAMES: dict[type[Correction], Callable[[], str]] = {
    Posting: lambda: tr("Posting"),
    ForefootTwist: lambda: tr("Forefoot twist"),
    HeelSkive: lambda: tr("Heel skive"),
    HeelLift: lambda: tr("Heel lift"),
    ArchRaise: lambda: tr("Arch raise"),
    HeelCup: lambda: tr("Heel cup"),
    Rocker: lambda: tr("Rocker"),
    BrushStroke: lambda: tr("Brush stroke"),
}
WORDS: dict[str, Callable[[], str]] = {
    "medial": lambda: tr("Medial"),
    "lateral": lambda: tr("Lateral"),
    "extrinsic": lambda: tr("Extrinsic"),
    "intrinsic": lambda: tr("Intrinsic"),
    "push": lambda: tr("Raise"),
    "pull": lambda: tr("Lower"),
    "smooth": lambda: tr("Smooth"),
    "flat": lambda: tr("Flat"),
    "following": lambda: tr("Cupped"),
    "foot": lambda: tr("From the foot"),
    "shoe_size": lambda: tr("Shoe size"),
    "drawn": lambda: tr("Drawn"),
    "full": lambda: tr("Full length"),
    "three_quarter": lambda: tr("Three-quarter"),
}
"""Translated names of the values of choices in a prescription."""
_OWN_WORDS: dict[tuple[str, str], Callable[[], str]] = {
    ("over", "heel"): lambda: tr("Heel"),
    ("over", "toes"): lambda: tr("Toe zone"),
    ("over", "foot"): lambda: tr("The foot itself"),
    ("toe_zone", "sulcus"): lambda: tr("Sulcus"),
    ("toe_zone", "crest"): lambda: tr("Toe crest"),
    ("toe_zone", "as_scanned"): lambda: tr("As scanned"),
}
"""Those of values that mean something else, or nothing, for another choice, by its name."""

KIND_NAMES: dict[str, Callable[[], str]] = {
    "reverse_mortons_extension": lambda: tr("Reverse Morton's extension"),
    "dancers_pad": lambda: tr("Dancer's pad"),
    "first_ray_cut_out": lambda: tr("1st-ray cut-out"),
    "fifth_ray_cut_out": lambda: tr("5th-ray cut-out"),
    "relief_head_1": lambda: tr("Relief, 1st head"),
    "relief_head_2": lambda: tr("Relief, 2nd head"),
    "relief_head_3": lambda: tr("Relief, 3rd head"),
    "relief_head_4": lambda: tr("Relief, 4th head"),
    "relief_head_5": lambda: tr("Relief, 5th head"),
    "relief_base_5": lambda: tr("Relief, base of the 5th"),
    "cuboid_raise": lambda: tr("Cuboid raise"),
    "heel_spur_recess": lambda: tr("Heel-spur recess"),
    "relief_toe_1": lambda: tr("Relief, 1st toe"),
    "relief_toe_2": lambda: tr("Relief, 2nd toe"),
    "relief_toe_3": lambda: tr("Relief, 3rd toe"),
    "relief_toe_4": lambda: tr("Relief, 4th toe"),
    "relief_toe_5": lambda: tr("Relief, 5th toe"),
    "toe_filler_1": lambda: tr("Filler, 1st toe"),
    "toe_filler_2": lambda: tr("Filler, 2nd toe"),
    "toe_filler_3": lambda: tr("Filler, 3rd toe"),
    "toe_filler_4": lambda: tr("Filler, 4th toe"),
    "toe_filler_5": lambda: tr("Filler, 5th toe"),
    "forefoot_filler": lambda: tr("Forefoot filler"),
}
"""Translated names of the kinds of pads that their shape does not name."""


def from_axis() -> str:
    """Return the name of a distance from the foot axis, which is above 0 medially."""
    return tr("From axis")


def from_heel() -> str:
    """Return the name of a distance from the back of the heel."""
    return tr("From heel")


def place_text(side: Side, x_mm: float, y_mm: float) -> str:
    """Say a place of the insole frame as the fields of a pad do."""
    medial = localised(side.medial_sign * x_mm)
    return f"{from_axis()} {medial}   {from_heel()} {localised(y_mm)}"


def device_name(design: InsoleDesign) -> str:
    """Return the name of the device that a design started from."""
    if design.finish is None:
        return tr("As scanned")
    return translate_core_message(design.device) or tr("of this foot")


def word_of(choice: str, word: str) -> str:
    """Return the name of a value of a choice."""
    return _OWN_WORDS.get((choice, word), WORDS.get(word, lambda: word))()


def pad_text(pad: LibraryPad) -> str:
    """Return the name of a library pad with its size; of one sized by the foot only its height."""
    of_foot = pad.place in SIZED_BY_FOOT
    size = _height(pad.template) if of_foot else _size(pad.template)
    name = " ".join(word for word in (name_of(pad.template), pad.size) if word)
    return f"{name}   {size}"


def name_of(correction: Correction) -> str:
    """Return the name of a correction's kind."""
    if isinstance(correction, Pelott):
        return _pad_name(correction)
    return _NAMES[type(correction)]()


def _pad_name(pad: Pelott) -> str:
    """Return the name of a pad; a kind of the clinic's own is named as it is written."""
    if pad.kind is None:
        return PAD_NAMES[pad.shape]()
    return KIND_NAMES[pad.kind]() if pad.kind in KIND_NAMES else pad.kind.replace("_", " ")


def describe(correction: Correction) -> str:
    """Return the name of a correction with its main values."""
    return f"{name_of(correction)} {_numbers(correction)}"


def _numbers(correction: Correction) -> str:
    if isinstance(correction, Pelott):
        size = f" ({_plain(correction.length_mm)} × {_plain(correction.width_mm)})"
        return _height(correction) + (size if correction.outline_mm is None else "")
    if isinstance(correction, Posting):
        return f"{_edge(correction.rearfoot_deg)} / {_edge(correction.forefoot_deg)}"
    if isinstance(correction, ForefootTwist):
        return _edge(correction.angle_deg)
    if isinstance(correction, BrushStroke):
        return WORDS[correction.mode]().lower()
    if isinstance(correction, HeelSkive):
        return f"{WORDS[correction.border]().lower()} {_plain(correction.depth_mm)} mm"
    return _rise(correction)


def _rise(correction: ArchRaise | HeelCup | HeelLift | Rocker) -> str:
    """Write what a correction adds; of an arch with a target, the height that it reaches."""
    if isinstance(correction, Rocker):
        return f"{_plain(correction.slope_deg)}°"
    if isinstance(correction, ArchRaise) and correction.target_mm is not None:
        return tr("to {height} mm").format(height=_plain(correction.target_mm))
    height = correction.depth_mm if isinstance(correction, HeelCup) else correction.height_mm
    return f"{_plain(height)} mm"


def _plain(value: float) -> str:
    """Write a number with the precision of the fields, and no needless zero."""
    return localised(round(value, 1) + 0.0, "g")


def _edge(angle_deg: float) -> str:
    """Say which edge an angle of a posting raises."""
    if round(angle_deg, 1) == 0:
        return "0°"
    edge = tr("medial") if angle_deg > 0 else tr("lateral")
    return f"{_plain(abs(angle_deg))}° {edge}"


def _size(pad: Pelott) -> str:
    size = f"{_plain(pad.length_mm)} × {_plain(pad.width_mm)}"
    return f"{size} × {_height(pad)}" if pad.height_mm >= 0 else f"{size} mm, {_height(pad)}"


def _height(pad: Pelott) -> str:
    """Write the height of a pad, or the depth of a recess."""
    if pad.height_mm >= 0:
        return f"{_plain(pad.height_mm)} mm"
    return tr("{depth} mm deep").format(depth=_plain(-pad.height_mm))
