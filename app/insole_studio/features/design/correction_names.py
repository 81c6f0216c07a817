"""Translated names of corrections."""

from __future__ import annotations

from collections.abc import Callable

from insole_core.insole.prescription.design import (
    ArchRaise,
    BrushStroke,
    Correction,
    ForefootTwist,
    HeelCup,
    HeelLift,
    HeelSkive,
    Pelott,
    Posting,
)
from insole_core.workflows.pad_library import LibraryPad
from insole_studio.texts import localised, tr

PAD_NAMES: dict[str, Callable[[], str]] = {
    "egg": lambda: tr("Pelott"),
    "outline": lambda: tr("Free-hand pad"),
    "drop": lambda: tr("Drop"),
    "bar": lambda: tr("Metatarsal bar"),
    "arch_support": lambda: tr("Arch support"),
    "horseshoe": lambda: tr("Horseshoe"),
    "cut_out": lambda: tr("Cut-out"),
    "mortons_extension": lambda: tr("Morton's extension"),
}
_NAMES: dict[type[Correction], Callable[[], str]] = {
    Posting: lambda: tr("Posting"),
    ForefootTwist: lambda: tr("Forefoot twist"),
    HeelSkive: lambda: tr("Heel skive"),
    HeelLift: lambda: tr("Heel lift"),
    ArchRaise: lambda: tr("Arch raise"),
    HeelCup: lambda: tr("Heel cup"),
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
    "following": lambda: tr("Following"),
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
    "pelott": PAD_NAMES["egg"],
    "first_ray_cut_out": lambda: tr("1st-ray cut-out"),
    **PAD_NAMES,
}


def word_of(choice: str, word: str) -> str:
    """Return the name of a value of a choice."""
    return _OWN_WORDS.get((choice, word), WORDS.get(word, lambda: word))()


def pad_text(pad: LibraryPad) -> str:
    """Return the name of a library pad with its size."""
    name = KIND_NAMES[pad.kind]() if pad.kind in KIND_NAMES else pad.kind
    return f"{name} {pad.size}   {_size(pad.template)}"


def name_of(correction: Correction) -> str:
    """Return the name of a correction's kind."""
    if isinstance(correction, Pelott):
        return PAD_NAMES[correction.shape]()
    return _NAMES[type(correction)]()


def describe(correction: Correction) -> str:
    """Return the name of a correction with its main values."""
    return f"{name_of(correction)} {_numbers(correction)}"


def _numbers(correction: Correction) -> str:
    if isinstance(correction, Pelott):
        size = f" ({_plain(correction.length_mm)} × {_plain(correction.width_mm)})"
        return f"{_plain(correction.height_mm)} mm" + (
            size if correction.outline_mm is None else ""
        )
    if isinstance(correction, Posting):
        return f"{_edge(correction.rearfoot_deg)} / {_edge(correction.forefoot_deg)}"
    if isinstance(correction, ForefootTwist):
        return _edge(correction.angle_deg)
    if isinstance(correction, BrushStroke):
        return WORDS[correction.mode]().lower()
    if isinstance(correction, HeelSkive):
        return f"{WORDS[correction.border]().lower()} {_plain(correction.depth_mm)} mm"
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
    sizes = (pad.length_mm, pad.width_mm) if pad.outline_mm is None else ()
    return " × ".join(_plain(length) for length in (*sizes, pad.height_mm)) + " mm"
