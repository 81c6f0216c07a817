"""What a print weighs where: walls and solid layers take most of what is thin, whatever was asked.

The piece is cut into layers on a raster, as a slicer does: walls along every contour, solid above
and below what lies within some layers of the surface, and infill in what is left.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import cv2
import manifold3d
import numpy as np
import numpy.typing as npt
import scipy

from insole_core.formats.slicer_3mf import Modifier, Pattern, PrintedPart
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.messages import Message, joined
from insole_core.solids.simplification import to_manifold
from insole_core.solids.zone_bodies import LINE_MM

_PIXEL_MM = 0.5
_SUBPIXEL_BITS = 6
_OVERLAP = 0.25
"""Share of a line by which infill reaches into the walls."""
_MARGIN_MM = 3.0
"""How far solid layers on open surfaces reach under what lies beside them."""
_BRIDGE_MM = 0.4 * np.pi / 4
"""Thickness of lines that a usual nozzle draws over nothing, side by side."""
_SOLID_BELOW_MM2 = 70.0
"""Smaller islands of infill are solid."""


_BEYOND = 0.3
"""By how many lines more than one a layer has to hold the infill of the next."""
_DENSER_PERCENT = 10.0
"""By how much more than was asked is told."""
_LEAST_SHARE = 0.005
"""Smaller zones are seams between others."""
_GROWN_MM = 0.7
"""How much wider solid infill beside a slope is than the layers above and below tell."""


@dataclass(frozen=True)
class _Pattern:
    """What a pattern lays down, measured on a box.

    Parameters
    ----------
    share, more
        Of the nominal density: `share`, and so much more at 0 %, down to none at 100 %.
    border_mm
        Width of the lines along the border that join those of the pattern.
    """

    share: float = 1.0
    more: float = 0.0
    border_mm: float = 0.17

    def laid(self, density: float) -> float:
        """Return the share of an area that is filled, but for its border."""
        return density * (self.share + self.more * (1 - density))


_PATTERNS: dict[Pattern, _Pattern] = {
    "gyroid": _Pattern(share=0.925, border_mm=0.19),
    "grid": _Pattern(border_mm=0.05),
    "honeycomb": _Pattern(more=0.32, border_mm=0.1),
    "cubic": _Pattern(border_mm=0.1),
    "rectilinear": _Pattern(),
    "concentric": _Pattern(),
}


@dataclass(frozen=True)
class ZoneDensity:
    """What is printed of a zone.

    Parameters
    ----------
    name
        As its modifier has it; of what lies in none, "rest" and its density.
    asked_percent, percent
        Density of its infill, and of all that is printed in it.
    volume_mm3
        Of the zone within the part.
    mass_g
        Of what is printed.
    is_strip
        Whether it is only a step between two zones.
    """

    name: str
    asked_percent: float
    percent: float
    volume_mm3: float
    mass_g: float
    is_strip: bool = False


@dataclass(frozen=True)
class PrintedDensities:
    """The zones of a part as they are printed with layers of a height.

    Parameters
    ----------
    zones
        What lies in no zone first, unless that is nothing; then the zones, without those that are
        covered by later ones.
    """

    layer_mm: float
    zones: tuple[ZoneDensity, ...]

    @property
    def facts(self) -> dict[str, str]:
        """Density and mass of all that is printed, and by zone; to be translated."""
        said = "{percent:.0f} %, {mass:.1f} g"
        volume_mm3 = sum(zone.volume_mm3 for zone in self.zones)
        percent = sum(zone.percent * zone.volume_mm3 for zone in self.zones) / max(volume_mm3, 1e-9)
        mass = sum(zone.mass_g for zone in self.zones)
        return {
            Message("with walls and solid layers of {layer:g} mm", layer=self.layer_mm): Message(
                said, percent=min(percent, 100.0), mass=mass
            ),
            **{
                zone.name: Message(said, percent=min(zone.percent, 100.0), mass=zone.mass_g)
                for zone in self.zones
                if not zone.is_strip
            },
        }

    @property
    def notes(self) -> tuple[str, ...]:
        """Which zones cannot have the density that is asked for; none or one sentence."""
        denser = [
            Message("{zone}: {percent:.0f} %", zone=zone.name, percent=min(zone.percent, 100.0))
            for zone in self.zones
            if min(zone.percent, 100.0) > zone.asked_percent + _DENSER_PERCENT and not zone.is_strip
        ]
        if not denser:
            return ()
        return (
            Message(
                "Walls and solid layers make the print denser than its infill ({zones}); where it "
                "has to be softer, take a preset with fewer of them, or make the insole thicker.",
                zones=joined(denser),
            ),
        )


def printed_densities(printed: PrintedPart, layer_mm: float, g_per_cm3: float) -> PrintedDensities:
    """Compute the density of every zone of a part, walls and solid layers included.

    Parameters
    ----------
    printed
        As it lies on the bed.
    layer_mm
        Height of the layers.
    g_per_cm3
        Of the material.
    """
    low, high = printed.mesh.bounds_mm
    levels = np.arange(low[2] + layer_mm / 2, high[2], layer_mm)
    raster, body = _Raster(low[:2], high[:2]), to_manifold(printed.mesh)
    cuts = [body.slice(float(level)) for level in levels]
    line_mm = _spacing_mm(layer_mm)
    walls_mm = printed.walls * line_mm + (LINE_MM - line_mm) / 2
    whole = raster.layers(cuts)
    inner = raster.layers(cuts, walls_mm)
    filled = raster.layers(cuts, walls_mm - _OVERLAP * line_mm)
    held = raster.layers(cuts, min(LINE_MM / 2 + (1 + _BEYOND) * line_mm, walls_mm))
    cut = _Cut(whole, inner, held, line_mm)
    sparse = _sparse(cut, printed.bottom_layers, printed.top_layers)
    bridged = _opened(inner, _under(whole)) & ~_bottom(whole)
    zone: npt.NDArray[np.int16] = np.full(whole.shape, -1, np.int16)
    for number, modifier in enumerate(printed.modifiers):
        shape = to_manifold(modifier.mesh)
        zone[raster.layers([shape.slice(float(level)) for level in levels], -_PIXEL_MM)] = number
    walls_share = printed.walls * line_mm / walls_mm
    laid = _Laid(whole, inner, filled, sparse, bridged, walls_share, _BRIDGE_MM / layer_mm)
    zones = _densities(printed, laid, zone, layer_mm, g_per_cm3)
    return PrintedDensities(layer_mm, tuple(zones))


def _spacing_mm(layer_mm: float) -> float:
    """Return the distance of two lines that touch, with round sides."""
    return LINE_MM - layer_mm * (1 - np.pi / 4)


@dataclass(frozen=True, eq=False)
class _Laid:
    """What a slicer lays down, as masks (layers, ny, nx).

    Parameters
    ----------
    whole, inner
        The part, and what lies inside its walls.
    filled
        Where infill is laid: over the inner half of a line of the walls, too.
    sparse
        Where it is not solid.
    bridged
        Where it is laid over nothing.
    wall_share, bridge_share
        Of walls and bridges that is plastic: lines of walls have round sides, those of bridges are
        as thick as the nozzle is wide.
    """

    whole: BoolArray
    inner: BoolArray
    filled: BoolArray
    sparse: BoolArray
    bridged: BoolArray
    wall_share: float
    bridge_share: float


@dataclass(frozen=True, eq=False)
class _Cut:
    """A part in layers, as masks (layers, ny, nx): the whole, what lies inside the walls, and what
    lies so far inside that the layer above or below holds it."""

    whole: BoolArray
    inner: BoolArray
    held: BoolArray
    line_mm: float


def _sparse(cut: _Cut, below: int, above: int) -> BoolArray:
    """Return where infill is not solid: not near the surface, and not in small islands."""
    whole, inner = cut.whole, cut.inner
    over, under = np.concatenate([whole[1:], np.zeros_like(whole[:1])]), _under(whole)
    tops, bottoms = (_bared(whole, inner, beside, cut.line_mm) for beside in (over, under))
    solid = _reached(tops, above, 0) | _reached(bottoms, 0, below)
    solid |= _reached(~cut.held, above, below)
    if max(below, above) > 1:
        solid = np.array([_grown(mask, _GROWN_MM) for mask in solid & inner])
    sparse = inner & ~solid
    for layer, mask in enumerate(inner & over & under):
        count, islands, facts, _ = cv2.connectedComponentsWithStats(mask.astype(np.uint8))
        small = facts[:, cv2.CC_STAT_AREA] * _PIXEL_MM**2 < _SOLID_BELOW_MM2
        if count > 1 and small[1:].any():
            sparse[layer] &= ~small[islands]
    return np.asarray(sparse)


def _under(whole: BoolArray) -> BoolArray:
    return np.concatenate([np.zeros_like(whole[:1]), whole[:-1]])


def _bottom(whole: BoolArray) -> BoolArray:
    """Return the layer that lies on the bed."""
    bottom = np.zeros_like(whole)
    bottom[:1] = True
    return bottom


def _bared(whole: BoolArray, inner: BoolArray, beside: BoolArray, line_mm: float) -> BoolArray:
    """Return what is made solid in every layer because the layer beside it does not cover it."""
    opened = (whole & ~beside) | _opened(inner, beside)
    return np.array([_grown(mask, line_mm) for mask in opened])


def _opened(inner: BoolArray, beside: BoolArray) -> BoolArray:
    """Return what is laid as an open surface where the layer beside it does not cover a layer."""
    return np.array([_grown(mask, _MARGIN_MM) for mask in inner & ~beside]) & inner


def _reached(masks: BoolArray, above: int, below: int) -> BoolArray:
    """Return where a mask is true in a layer or in the next so many but one above or below it."""
    up, down = max(above - 1, 0), max(below - 1, 0)
    if above == below == 0:
        return np.zeros_like(masks)
    padded = np.pad(masks.astype(np.uint8), ((down, up), (0, 0), (0, 0)))
    most = scipy.ndimage.maximum_filter1d(padded, up + down + 1, axis=0)
    return np.asarray(most[(up + down + 1) // 2 :][: len(masks)] > 0)


def _grown(mask: BoolArray, by_mm: float) -> BoolArray:
    """Return a mask that reaches farther; the border of a pixel lies half of one from it."""
    if not mask.any():
        return mask
    away = cv2.distanceTransform((~mask).astype(np.uint8), cv2.DIST_L2, 5)
    return np.asarray(away * _PIXEL_MM <= by_mm + _PIXEL_MM / 2)


def _border_mm(masks: BoolArray) -> float:
    """Return the length of the borders of masks (layers, ny, nx), at any angle on the average."""
    sides = sum(int((np.diff(masks, axis=axis)).sum()) for axis in (1, 2))
    return sides * _PIXEL_MM * np.pi / 4


def _densities(
    printed: PrintedPart,
    laid: _Laid,
    zone: npt.NDArray[np.int16],
    layer_mm: float,
    g_per_cm3: float,
) -> Iterator[ZoneDensity]:
    rest = Message("{zone} {density:g} %", zone="rest", density=printed.infill.density_percent)
    areas = (Modifier(printed.mesh, rest, printed.infill), *printed.modifiers)
    least = _LEAST_SHARE * laid.whole.sum()
    for number, area in enumerate(areas, start=-1):
        infill = area.infill
        here = zone == number
        whole, inner, filled, sparse, bridged = (
            int((mask & here).sum())
            for mask in (laid.whole, laid.inner, laid.filled, laid.sparse, laid.bridged)
        )
        if whole <= least:
            continue
        pattern = _PATTERNS[infill.used_pattern]
        share = pattern.laid(infill.density_percent / 100)
        border = _border_mm(laid.sparse & here) * pattern.border_mm / _PIXEL_MM**2
        infilled = (inner - sparse + share * sparse) * filled / max(inner, 1)
        infilled += bridged * (laid.bridge_share - 1)
        infilled += min(border, (1 - share) * sparse)
        percent = 100 * ((whole - inner) * laid.wall_share + infilled) / whole
        volume_mm3 = whole * _PIXEL_MM**2 * layer_mm
        mass_g = volume_mm3 / 1000 * percent / 100 * g_per_cm3
        yield ZoneDensity(
            area.name, infill.density_percent, percent, volume_mm3, mass_g, area.is_strip
        )


class _Raster:
    """Pixels over a part, seen from above."""

    def __init__(self, low_mm: FloatArray, high_mm: FloatArray) -> None:
        self._low = low_mm - _PIXEL_MM
        columns, rows = np.ceil((high_mm - low_mm) / _PIXEL_MM).astype(int) + 3
        self._shape = int(rows), int(columns)

    def layers(self, plans: Sequence[manifold3d.CrossSection], within_mm: float = 0.0) -> BoolArray:
        """Return which pixels (layers, ny, nx) lie so far within plans."""
        masks = np.zeros((len(plans), *self._shape), np.uint8)
        for mask, plan in zip(masks, plans, strict=True):
            # Pixels on the outline count as inside, which makes it half of one too wide.
            inside = plan.offset(-within_mm - _PIXEL_MM / 2, manifold3d.JoinType.Miter)
            rings = [
                np.rint((np.asarray(ring) - self._low) / _PIXEL_MM * 2**_SUBPIXEL_BITS)
                for ring in inside.to_polygons()
            ]
            if rings:
                cv2.fillPoly(mask, [r.astype(np.int32) for r in rings], 1, shift=_SUBPIXEL_BITS)
        return masks > 0
