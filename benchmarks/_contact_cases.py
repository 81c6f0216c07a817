"""Contacts with known pressures: closed forms, and a published series on the heel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from benchmarks._finite_elements import FINE, indent
from benchmarks._layer_theory import sphere_load_by_theory
from insole_core.contact.elastic_layers import Layer
from insole_core.contact.hardness import foam
from insole_core.contact.pressing import Bed, Support
from insole_core.contact.stance import Sole
from insole_core.contact.tissue import Tissue
from insole_core.foot.landmarks import HEADS, find_landmarks
from insole_core.geometry.arrays import FloatArray

_ROOM = 4.0
_LOAD_N = 10.0
HAYES = {
    0.30: {0.2: 1.207, 0.4: 1.472, 0.6: 1.784, 1.0: 2.480, 2.0: 4.336},
    0.45: {0.2: 1.252, 0.4: 1.599, 0.6: 2.031, 1.0: 3.085, 2.0: 6.380},
}
"""Stiffness of a flat round punch on a bonded layer against that on a half-space, by Poisson's
ratio and radius / thickness: Hayes, Keer, Herrmann and Mockros, J. Biomech. 5, 1972, 541-551."""


def _bedded(n: int, step_mm: float, layer: Layer) -> Support:
    return Support((n, n), step_mm, [Bed((layer,), np.ones((n, n)))], _ROOM)


def punch_stiffness(poisson: float, radius_by_thickness: float, nodes: int) -> float:
    """Return what `HAYES` holds, from a punch of so many nodes in its radius."""
    n = 2 * nodes + 3
    away = np.arange(n) - (n - 1) / 2
    inside = np.hypot(away[:, None], away) <= nodes
    radius = float(np.sqrt(inside.sum() / np.pi))  # of the area that is pressed
    layer = Layer(radius / radius_by_thickness, 0.5, poisson)
    centre = (n - 1) / 2
    gap = np.where(inside, 0.0, np.nan)
    pressed = _bedded(n, 1.0, layer).press(gap, _LOAD_N, (centre, centre))
    return _LOAD_N * (1 - poisson**2) / (2 * radius * layer.modulus_mpa * pressed.sinking_mm)


def sphere_load_ratio(radius_mm: float, layer: Layer, load_n: float, step_mm: float) -> float:
    """Return the load on a sphere against that by theory for the sinking that is found."""
    reach = 1.7 * (0.75 * load_n * radius_mm / layer.modulus_mpa) ** (1 / 3)
    n = 2 * int(reach / step_mm) + 1
    x = step_mm * (np.arange(n) - (n - 1) / 2)
    gap = (x[:, None] ** 2 + x**2) / (2 * radius_mm)
    centre = (n - 1) / 2 * step_mm
    sunk = _bedded(n, step_mm, layer).press(gap, load_n, (centre, centre)).sinking_mm
    hertz_n = 4 / 3 * layer.modulus_mpa / (1 - layer.poisson**2) * np.sqrt(radius_mm) * sunk**1.5
    h = layer.thickness_mm
    return float(load_n / hertz_n / sphere_load_by_theory(layer.poisson, radius_mm / h, sunk / h))


LAYERED_PADS = {
    "tissue": (Layer(16.0, 0.2, 0.3),),
    "tissue on foam": (Layer(16.0, 0.2, 0.3), Layer(6.0, 1.4, 0.2)),
    "foam on soft foam": (Layer(4.0, 1.4, 0.2), Layer(10.0, 0.3, 0.2)),
    "cover on foam": (Layer(3.0, 0.5, 0.3), Layer(12.0, 1.4, 0.2)),
}
_BALL_MM, _SUNK_MM = 38.0, 1.5


def finite_element_ratios(
    layers: Sequence[Layer], *, is_ball: bool, fine: int = FINE
) -> tuple[float, float]:
    """Return sinking and peak pressure of a ball or cylinder on a pad against finite elements."""
    expected = indent(layers, _BALL_MM, _SUNK_MM, is_ball=is_ball, fine=fine)
    reach, step = 2.2 * np.sqrt(2 * _BALL_MM * _SUNK_MM), 0.75 if is_ball else 0.5
    n = 2 * int(reach / step) + 1
    x = step * (np.arange(n) - (n - 1) / 2)
    y, shape = (x, (n, n)) if is_ball else (np.zeros(1), (1, n))
    gap = (x**2 + y[:, None] ** 2) / (2 * _BALL_MM)
    support = Support(shape, step, [Bed(tuple(layers), np.ones(shape))], _ROOM)
    centre = (n - 1) / 2 * step
    pressed = support.press(gap, expected.load_n, (centre, centre if is_ball else 0.0))
    return pressed.sinking_mm / _SUNK_MM, float(pressed.mpa.max()) / expected.peak_mpa


PUBLISHED_PADS = {
    "dome, front 10 mm behind the heads": "less, by less than 17 %",
    "dome, front 5 mm ahead of the heads": "-17 %",
    "bar behind the heads": "less, by less than 17 %",
    "plantar cover": "-19 %",
}
"""Peak pressure of the forefoot in walking against a shoe alone: Journal of Foot and Ankle Research
7:18, 2014."""


def forefoot_pads(sole: Sole) -> dict[str, FloatArray]:
    """Return the heights (ny, nx), mm, of pads as in `PUBLISHED_PADS`, 5 and 4 mm high."""
    marks = find_landmarks(sole.foot)
    heads = np.array([marks[name].point[:2] for name in HEADS])
    middle = heads[1:3].mean(axis=0)
    order = np.argsort(heads[:, 0])
    x, y = np.meshgrid(sole.field.x_mm, sole.field.y_mm)
    ahead = y - np.interp(x, heads[order, 0], heads[order, 1])

    def dome(front_mm: float) -> FloatArray:
        away = np.hypot((x - middle[0]) / 22.5, (y - middle[1] - front_mm + 27.5) / 27.5)
        return np.asarray(5.0 * np.cos(np.minimum(away, 1.0) * np.pi / 2))

    bar = 4.0 * np.clip(np.minimum(-ahead / 10, (40 + ahead) / 25), 0, 1)
    cover = 4.0 * np.clip((ahead + 60) / 25, 0, 1)
    return dict(zip(PUBLISHED_PADS, (dome(-10.0), dome(5.0), bar, cover), strict=True))


CONFORMITIES = {"flat": 0.0, "half": 5.0, "full": 12.0}
"""Height of a heel's cup, mm."""
THICKNESSES_MM = (6.3, 9.5, 12.7)
MATERIALS_MPA = {"Poron Cushioning": 0.3, "Microcel Puff Lite": 0.6, "Microcel Puff": 1.0}
"""Moduli are of open-celled polyurethane and of crosslinked foams of Shore A about 20 and 30."""
_HALF_MM, _HEEL_RADIUS_MM = 40, 38.0
_SECTION_LOAD = 8.0
"""N per mm of a section: early support."""


@dataclass(frozen=True)
class HeelInsole:
    """An insole under a section of a heel; a thickness of 0 is the bare floor."""

    conformity_mm: float = 0.0
    thickness_mm: float = 0.0
    modulus_mpa: float = 1.0


def heel_peak_kpa(insole: HeelInsole) -> float:
    """Return the peak pressure of a section of a heel in plane strain, as Goske's, on an insole."""
    x = np.arange(-_HALF_MM, _HALF_MM + 1.0)
    slope = np.clip(np.abs(x) / _HEEL_RADIUS_MM, 0, 0.99)
    sole = _HEEL_RADIUS_MM * (1 - np.sqrt(1 - slope**2))
    upright = np.sqrt(1 - slope**2)
    top = np.minimum(sole, insole.conformity_mm)
    gap = np.where(upright > 0.5, sole - top, np.nan)[None]
    tissue = Tissue().layers[0]
    beds = [Bed((tissue,), (1 / upright)[None], tissue.thickness_mm)]
    if insole.thickness_mm:
        beds += _insole_beds(insole, top[None])
    support = Support((1, len(x)), 1.0, beds)
    return float(support.press(gap, _SECTION_LOAD, (_HALF_MM, 0.0)).mpa.max() * 1000)


def _insole_beds(insole: HeelInsole, top: FloatArray) -> list[Bed]:
    thin = Layer(insole.thickness_mm, insole.modulus_mpa, foam(35).poisson)
    beds = [Bed((thin,), np.ones_like(top))]
    if insole.conformity_mm:
        thick = replace(thin, thickness_mm=insole.thickness_mm + insole.conformity_mm)
        beds.append(Bed((thick,), top / insole.conformity_mm, counted=(thin,)))
    return beds


def heel_reliefs() -> dict[tuple[str, float, str], float]:
    """Return the change of the peak, %, against the bare floor, of each of the 27 designs."""
    bare = heel_peak_kpa(HeelInsole())
    return {
        (form, mm, material): 100 * (heel_peak_kpa(HeelInsole(cup, mm, mpa)) / bare - 1)
        for form, cup in CONFORMITIES.items()
        for mm in THICKNESSES_MM
        for material, mpa in MATERIALS_MPA.items()
    }
