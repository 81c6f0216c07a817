"""The pad library of the clinic, which is data, not code."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.insole.pads.pad_places import PLACES
from insole_core.insole.prescription.design import Pelott
from insole_core.insole.prescription.design_limits import CORRECTION_RANGES, PELOTT_SHAPES
from insole_core.json_object import JsonObject
from insole_core.resources import resource_path

SIZES = ("length_mm", "width_mm", "height_mm")


@dataclass(frozen=True)
class LibraryPad:
    """A pad of the library.

    Parameters
    ----------
    kind
        Its group: "pelott", "bar", …
    size
        Its size within the group: "S", "M", "L".
    template
        The pad, without a position.
    place
        Where it is usually placed: one of `pad_places.PLACES`.
    """

    kind: str
    size: str
    template: Pelott
    place: str


def load_pads() -> tuple[LibraryPad, ...]:
    """Read the library.

    Raises
    ------
    InputError
        When the file violates its format.
    """
    library = JsonObject.read(resource_path("pads/library.json"))
    library.check_format("insole-pad-library")
    return tuple(_pad(pad) for pad in library.objects("pads"))


def _pad(pad: JsonObject) -> LibraryPad:
    allowed = CORRECTION_RANGES[Pelott]
    length, width, height = (
        pad.number(name, allowed[name].least, allowed[name].greatest) for name in SIZES
    )
    template = Pelott(
        centre_mm=(0.0, 0.0),
        shape=pad.choice("shape", PELOTT_SHAPES),
        length_mm=length,
        width_mm=width,
        height_mm=height,
    )
    place = pad.choice("place", list(PLACES))
    return LibraryPad(pad.text("kind"), pad.text("size"), template, place)
