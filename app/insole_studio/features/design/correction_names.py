"""Translated names of corrections."""

from __future__ import annotations

from insole_core.geometry.side import Side
from insole_core.insole.elements import Correction
from insole_core.insole.elements.pad_places import SIZED_BY_FOOT
from insole_core.insole.fields import Part, Spot, declared
from insole_core.insole.pads.pad_form import PAD_NAMES
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.workflows.pad_library import LibraryPad
from insole_studio.texts import localised, tr, translate_core_message, with_capital


def capitalised(word: str) -> str:
    """Return a word of the core in the language of the window, as it stands alone."""
    return with_capital(translate_core_message(word))


def label_of(kind: type[Part], name: str) -> str:
    """Return what a value of a part of the prescription is called."""
    return translate_core_message(declared(kind)[name].label)


def place_text(side: Side, x_mm: float, y_mm: float) -> str:
    """Say a place of the insole frame as the fields of a pad do."""
    from_axis, from_heel = (translate_core_message(label) for label, _ in Spot.each)
    across, along = localised(side.medial_sign * x_mm), localised(y_mm)
    return f"{from_axis} {across} mm   {from_heel} {along} mm"


def device_name(design: InsoleDesign) -> str:
    """Return the name of the device that a design started from."""
    if design.finish is None:
        return tr("As scanned")
    return translate_core_message(design.device) or tr("of this foot")


def pad_text(pad: LibraryPad) -> str:
    """Return the name of a library pad with its size; of one sized by the foot only its height."""
    template = pad.template
    height = translate_core_message(template.height_text())
    if pad.place in SIZED_BY_FOOT:
        size = height
    else:
        size = f"{_plain(template.length_mm)} × {_plain(template.width_mm)}"
        size = f"{size} × {height}" if template.has_plain_height else f"{size} mm, {height}"
    name = " ".join(word for word in (name_of(template), pad.size) if word)
    return f"{name}   {size}"


def name_of(correction: Correction) -> str:
    """Return the name of a correction's kind; one of the clinic's own is named as it is written."""
    kind = getattr(correction, "kind", None)
    return correction.noun if kind and kind not in PAD_NAMES else capitalised(correction.noun)


def describe(correction: Correction) -> str:
    """Return the name of a correction with its main values."""
    return f"{name_of(correction)} {translate_core_message(correction.brief())}"


def _plain(value: float) -> str:
    """Write a number with the precision of the fields, and no needless zero."""
    return localised(round(value, 1) + 0.0, "g")
