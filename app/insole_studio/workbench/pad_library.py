"""The sizes of pads that a clinic keeps: data, not code."""

from __future__ import annotations

from dataclasses import dataclass, replace

from insole_core.insole.design import Pelott
from insole_core.insole.limits import CORRECTION_RANGES
from insole_core.json_object import JsonObject
from insole_core.resources import resource_path

SIZES = ("length_mm", "width_mm", "height_mm")


@dataclass(frozen=True)
class PadSize:
    """A named size."""

    name: str
    length_mm: float
    width_mm: float
    height_mm: float

    def of(self, pad: Pelott) -> Pelott:
        """Give a pad this size."""
        return replace(
            pad, length_mm=self.length_mm, width_mm=self.width_mm, height_mm=self.height_mm
        )


def load_pelott_sizes() -> tuple[PadSize, ...]:
    """Read the library.

    Raises
    ------
    InputError
        When the file breaks its format.
    """
    path = resource_path("pads/library.json")
    library = JsonObject.parse(path.name, path.read_bytes())
    library.choice("format", ["insole-pad-library"])
    library.integer("version", 1, 1)
    return tuple(_size(pad) for pad in library.objects("pelotts"))


def _size(pad: JsonObject) -> PadSize:
    allowed = CORRECTION_RANGES[Pelott]
    numbers = {
        name: pad.number(name, allowed[name].least, allowed[name].greatest) for name in SIZES
    }
    return PadSize(pad.text("name"), **numbers)
