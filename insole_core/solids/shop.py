"""Stock and methods of a workshop: resources/rules/shop.json, which a clinic can change."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias, get_args

from insole_core.json_object import JsonObject
from insole_core.messages import Message
from insole_core.resources import resource_path

FORMAT, VERSION = "insole-shop", 1
LayerName: TypeAlias = Literal["cover", "shell", "base"]
LAYER_NAMES: tuple[LayerName, ...] = get_args(LayerName)


@dataclass(frozen=True)
class Block:
    """A block in stock: its name; length, width, height."""

    name: str
    size_mm: tuple[float, float, float]

    @property
    def sides_mm(self) -> tuple[float, float, float]:
        """Length, width and height, the longer side first however they were given."""
        length, width = sorted(self.size_mm[:2], reverse=True)
        return length, width, self.size_mm[2]

    @property
    def words(self) -> Message:
        """Name and sides, as every paper has them."""
        length, width, height = self.sides_mm
        return Message(
            "{block}, {length:g} × {width:g} × {height:g} mm",
            block=self.name,
            length=length,
            width=width,
            height=height,
        )


@dataclass(frozen=True)
class LayerMake:
    """Colour of a layer in the file, and the density at which it is printed."""

    color: tuple[int, int, int]
    density_percent: float


@dataclass(frozen=True)
class Shop:
    """Blocks and materials in stock, the required tolerance, and the make of each layer."""

    blocks: tuple[Block, ...]
    materials: tuple[str, ...]
    tolerance_mm: float
    layers: Mapping[LayerName, LayerMake]


def read_shop(path: Path | None = None) -> Shop:
    """Read a workshop's stock, by default that shipped with the product.

    Raises
    ------
    InputError
        Naming the file and the key that is missing or wrong.
    """
    root = JsonObject.read(path or resource_path("rules/shop.json"))
    root.check_format(FORMAT, VERSION)
    layers = root.object("layers")
    return Shop(
        tuple(read_block(item) for item in root.objects("blocks")),
        tuple(root.texts("materials")),
        root.number("tolerance_mm"),
        {name: _layer(layers.object(name)) for name in LAYER_NAMES},
    )


def read_block(item: JsonObject) -> Block:
    """Read a block from its JSON form.

    Raises
    ------
    InputError
        Naming the key that is missing or wrong.
    """
    size_mm = item.triple("size_mm")
    if min(size_mm) <= 0:
        raise item.fail("size_mm", "must be three lengths above 0")
    return Block(item.text("name"), size_mm)


def _layer(item: JsonObject) -> LayerMake:
    red, green, blue = (int(channel) for channel in item.numbers("color", 3))
    density = item.number("density_percent")
    if not (min(red, green, blue) >= 0 and max(red, green, blue) <= 255):
        raise item.fail("color", "must be three numbers of 0 to 255")
    if not 0 < density <= 100:
        raise item.fail("density_percent", "must be above 0 and at most 100")
    return LayerMake((red, green, blue), density)
