"""Colours of a part before it is exported: its zones, or the material that the cutter leaves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from insole_core.formats.slicer_3mf import PrintedPart
from insole_core.formats.solid_content import merged
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.milling.plan import MillingPlan
from insole_core.solids.order import Part
from insole_core.solids.zone_bodies import cut_by_zones
from insole_core.workflows.make_order import MadeFor
from insole_studio.scene.coloring import Coloring, Swatch, map_colors
from insole_studio.texts import fill, tr, translate_core_message

_LEAST_SCALE_MM = 0.5
"""End of the scale of what stays, where nothing to speak of stays."""


@dataclass(frozen=True, eq=False)
class PartColors:
    """A part in colours.

    Parameters
    ----------
    mesh : mm, insole frame
        Its surface.
    swatches
        Colours with their names; empty where the colours have a scale.
    """

    mesh: TriangleMesh
    coloring: Coloring
    swatches: tuple[Swatch, ...] = ()


def colors_of(parts: Sequence[Part], made: MadeFor) -> dict[Side, PartColors]:
    """Return the colours of each part for what is made of them; none for a file of any machine."""
    if made.printing is not None:
        printed = [made.printing.zoned[part.side].printed for part in parts]
        levels = np.unique([each for one in printed for each in _densities(one)])
        return {part.side: _of_zones(one, levels) for part, one in zip(parts, printed, strict=True)}
    if made.milling is None:
        return {}
    plan = made.milling
    return {part.side: _of_milling(part, plan, number) for number, part in enumerate(parts)}


def placed_together(
    colors: Mapping[Side, PartColors], insole2block: Mapping[Side, FloatArray]
) -> PartColors | None:
    """Return parts in their colours where they lie in a block; None if they have no colours."""
    if not colors:
        return None
    placed = [(colors[side], where) for side, where in insole2block.items()]
    first = placed[0][0]
    painted = [each.coloring.painted for each, _ in placed if each.coloring.painted is not None]
    coloring = replace(
        first.coloring,
        values=np.concatenate([each.coloring.values for each, _ in placed]),
        painted=np.concatenate(painted) if painted else None,
    )
    swatches = dict.fromkeys(swatch for each, _ in placed for swatch in each.swatches)
    mesh = merged([each.mesh.transformed(where) for each, where in placed])
    return PartColors(mesh, coloring, tuple(swatches))


def _densities(printed: PrintedPart) -> list[float]:
    return [
        printed.infill.density_percent,
        *(zone.infill.density_percent for zone in printed.modifiers),
    ]


def _of_zones(printed: PrintedPart, levels: FloatArray) -> PartColors:
    """Colour a part by density, and name the zones that show.

    Parameters
    ----------
    printed
    levels : (n,) float64, %
        All densities that are shown together, ascending. Their colours are evenly apart, so that
        near ones can be told from each other.
    """
    mesh, zones = cut_by_zones(printed)
    densities = np.array(_densities(printed))
    ranks = np.searchsorted(levels, densities).astype(float)
    colors = map_colors(ranks, (0.0, max(len(levels) - 1.0, 1.0))).astype(np.uint8)
    names = [tr("elsewhere {density:g} %"), *(zone.name for zone in printed.modifiers)]
    names[0] = fill(names[0], density=printed.infill.density_percent)
    shown = [number for number in range(len(names)) if (zones + 1 == number).any()]
    shown.sort(key=lambda number: number == 0)  # what lies in no zone comes last
    swatches = tuple(
        Swatch(translate_core_message(names[number]), _hex(colors[number])) for number in shown
    )
    limits = float(levels[0]), max(float(levels[-1]), levels[0] + 1.0)
    coloring = Coloring(densities[zones + 1], limits, "", painted=colors[zones + 1])
    return PartColors(mesh, coloring, swatches)


def _of_milling(part: Part, plan: MillingPlan, number: int) -> PartColors:
    top = max(_LEAST_SCALE_MM, plan.most_left_mm)
    coloring = Coloring(plan.left_on(number), (0.0, top), tr("Left over"), from_light=True)
    return PartColors(part.solid, coloring)


def _hex(color: FloatArray) -> str:
    return "#" + "".join(f"{int(share):02x}" for share in color)
