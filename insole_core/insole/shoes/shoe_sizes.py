"""The inside of a shoe by its size and width, from a table of systems.

The table stands in resources/shoes/sizes.json. Lengths are those of the systems' definitions (ISO
9407, ISO/TS 19407); no standard says how wide a shoe is inside or how its edge runs, so those are a
clinic's own judgement, for it to change.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path

from insole_core.errors import InputError
from insole_core.insole.prescription.outline import Shoe
from insole_core.json_object import JsonObject
from insole_core.resources import resource_path

FORMAT, VERSION = "insole-shoe-sizes", 1
REGULAR = "regular"
LEAST_WIDTH_MM, MOST_WIDTH_MM = 40.0, 140.0
_LEAST_STATIONS = 8


@dataclass(frozen=True)
class SizeSystem:
    """A way of counting sizes: the inside's length is `at_zero_mm` + size · `step_mm`."""

    name: str
    step_mm: float
    at_zero_mm: float
    least: float
    greatest: float

    def length_mm(self, size: float) -> float:
        """Return the length of the inside."""
        return self.at_zero_mm + size * self.step_mm


@dataclass(frozen=True)
class ShoeTable:
    """Systems of sizes, widths, and the usual edge of the inside.

    Parameters
    ----------
    widths_mm
        By which the ball is wider than regular, by name.
    ball_at_zero_mm, ball_share
        Width of the ball: the first, and this share of the length.
    stations
        (share of the length, medial and lateral border as shares of the ball's width), from the
        heel to the toes.
    """

    systems: tuple[SizeSystem, ...]
    widths_mm: dict[str, float]
    ball_at_zero_mm: float
    ball_share: float
    stations: tuple[tuple[float, float, float], ...]

    def shoe(
        self, system: SizeSystem, size: float, width: str = REGULAR, width_mm: float | None = None
    ) -> Shoe:
        """Return a shoe of a size.

        Parameters
        ----------
        width
            One of the table's.
        width_mm
            Of the inside at the ball, where it is known; the width is not read then.

        Raises
        ------
        InputError
            When the size is not one of the system, or the width is none.
        """
        if not system.least <= size <= system.greatest:
            raise InputError(
                "There is no size {size:g} in {system}, which goes from {least:g} to "
                "{greatest:g}; check size and system.",
                size=size,
                system=system.name,
                least=system.least,
                greatest=system.greatest,
            )
        length_mm = system.length_mm(size)
        if width_mm is None:
            width_mm = self.ball_at_zero_mm + self.ball_share * length_mm + self._wider_mm(width)
            said = width
        else:
            said = f"{width_mm:g} mm"
        if not LEAST_WIDTH_MM <= width_mm <= MOST_WIDTH_MM:
            raise InputError(
                "A shoe is {least:g} to {most:g} mm wide inside at the ball, and not {width:g} mm; "
                "put in the width in millimetres.",
                least=LEAST_WIDTH_MM,
                most=MOST_WIDTH_MM,
                width=width_mm,
            )
        medial = [(x * width_mm, along * length_mm) for along, x, _ in self.stations]
        lateral = [(x * width_mm, along * length_mm) for along, _, x in self.stations]
        return Shoe(
            name=f"{system.name} {size:g}, {said}",
            inside_mm=(*medial, *lateral[-2:0:-1]),
        )

    def system(self, name: str) -> SizeSystem:
        """Return the system of a name, whatever its case.

        Raises
        ------
        InputError
        """
        for system in self.systems:
            if system.name.casefold() == name.strip().casefold():
                return system
        raise InputError(
            'There is no system of shoe sizes "{name}"; there are {known}.',
            name=name,
            known=", ".join(system.name for system in self.systems),
        )

    def _wider_mm(self, width: str) -> float:
        if width not in self.widths_mm:
            raise InputError(
                'There is no width "{width}" of a shoe; there are {known}.',
                width=width,
                known=", ".join(self.widths_mm),
            )
        return self.widths_mm[width]


def read_shoe_table(path: Path | None = None) -> ShoeTable:
    """Read a table of sizes, by default that shipped with the product.

    Raises
    ------
    InputError
        Naming the file and the key that is missing or wrong.
    """
    return _shipped() if path is None else _read(path)


@cache
def _shipped() -> ShoeTable:
    return _read(resource_path("shoes/sizes.json"))


def _read(path: Path) -> ShoeTable:
    root = JsonObject.read(path)
    root.check_format(FORMAT, VERSION)
    ball = root.object("ball")
    widths = {item.text("name"): item.number("ball_mm", -30, 30) for item in root.objects("widths")}
    if REGULAR not in widths:
        raise root.fail("widths", 'must hold one of the name "regular"')
    return ShoeTable(
        tuple(_system(item) for item in root.objects("systems")),
        widths,
        ball.number("at_zero_mm", -100, 100),
        ball.number("share_of_length", 0, 1),
        _stations(root),
    )


def _system(item: JsonObject) -> SizeSystem:
    system = SizeSystem(
        item.text("name"),
        item.number("step_mm", 0.1, 20),
        item.number("at_zero_mm", -100, 400),
        item.number("least", 0, 400),
        item.number("greatest", 0, 400),
    )
    for size in (system.least, system.greatest):
        if not 80 <= system.length_mm(size) <= 400:
            raise item.fail("step_mm", "gives a length that no shoe has; check step and least size")
    return system


def _stations(root: JsonObject) -> tuple[tuple[float, float, float], ...]:
    stations = tuple(
        (item.number("along", 0, 1), item.number("medial", -1, 1), item.number("lateral", -1, 1))
        for item in root.objects("shape")
    )
    along = [station[0] for station in stations]
    ordered = along == sorted(set(along)) and along[:1] == [0] and along[-1:] == [1]
    if len(stations) < _LEAST_STATIONS or not ordered:
        raise root.fail(
            "shape", "must hold at least 8 stations, from along 0 at the heel to 1 at the toes"
        )
    if any(medial < lateral for _, medial, lateral in stations):
        raise root.fail("shape", "has a lateral border on the medial side; change the two")
    return stations


def said_size(words: str, table: ShoeTable) -> tuple[SizeSystem, float]:
    """Return system and size of words such as "EU 42" or "mondopoint 265".

    Raises
    ------
    InputError
    """
    name, _, number = words.strip().rpartition(" ")
    try:
        size = float(number.replace(",", "."))
    except ValueError:
        name = ""
    if not name:
        raise InputError(
            '"{words}" is no shoe size; write system and size, such as "EU 42".', words=words
        )
    return table.system(name), size
