"""The pad library of the clinic, which is data, not code."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from insole_core.insole.elements import Pelott
from insole_core.insole.elements.pad_places import PLACES
from insole_core.insole.fields import ranges_of
from insole_core.insole.pads.pad_form import LONGEST_KIND, PAD_SHAPES
from insole_core.json_object import JsonObject
from insole_core.resources import resource_path

GROUPS = ("forefoot", "midfoot", "heel", "toes")
"""Parts of the foot by which the library is listed."""
_SIZES = ("length_mm", "width_mm", "height_mm", "blend_mm")
_BY_SHAPE = {"egg": "pelott"}
"""Kinds that a pad of a shape has without saying so, where they are not named like the shape."""


@dataclass(frozen=True)
class LibraryPad:
    """A pad of the library.

    Parameters
    ----------
    group
        Part of the foot: one of `GROUPS`, or empty.
    kind
        What it is prescribed as: "pelott", "bar", "relief_head_3", …
    size
        Its size within the kind: "S", "M", "L"; empty for the only one.
    template
        The pad, without id and position; a "flat_outline" gets its outline when it is placed.
    place
        Where it is usually placed: one of `pad_places.PLACES`.
    """

    group: str
    kind: str
    size: str
    template: Pelott
    place: str


def load_pads(path: Path | None = None) -> tuple[LibraryPad, ...]:
    """Read the library, by default that shipped with the product.

    Raises
    ------
    InputError
        When the file violates its format.
    """
    library = JsonObject.read(path or resource_path("pads/library.json"))
    library.check_format("insole-pad-library")
    return tuple(_pad(pad) for pad in library.objects("pads"))


def default_pelott(pads: Sequence[LibraryPad]) -> Pelott:
    """Return the pelott that is placed when nothing else was chosen, without id and position."""
    fallback = Pelott(id="", centre_mm=(0.0, 0.0))
    return next((pad.template for pad in pads if pad.kind == "pelott"), fallback)


def _kind(pad: JsonObject) -> str:
    kind = pad.text("kind")
    if len(kind) > LONGEST_KIND:
        raise pad.fail(
            "kind", "has {count} letters, but may have {most}", count=len(kind), most=LONGEST_KIND
        )
    return kind


def _pad(pad: JsonObject) -> LibraryPad:
    allowed = ranges_of(Pelott)
    sizes: dict[str, Any] = {
        name: pad.number(name, allowed[name].least, allowed[name].greatest)
        for name in _SIZES
        if name == "height_mm" or pad.has(name)
    }
    kind, shape = _kind(pad), pad.choice("shape", PAD_SHAPES)
    is_shape = kind == _BY_SHAPE.get(shape, shape)
    template = Pelott(
        id="", centre_mm=(0.0, 0.0), shape=shape, kind=None if is_shape else kind, **sizes
    )
    group = pad.choice("group", GROUPS) if pad.has("group") else ""
    place = pad.choice("place", list(PLACES))
    size = pad.text("size") if pad.has("size") else ""
    return LibraryPad(group, kind, size, template, place)
