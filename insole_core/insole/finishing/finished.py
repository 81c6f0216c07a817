"""The finishing stage: from the shaped contact surface to the surface that pads are put on.

The supporting zone keeps the contact surface; rim and toe zone are designed, and a thin plate joins
the three. Order and figures: docs/decisions/0036-rim-plate-and-shell.md.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
import scipy

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.insole.fields import Place
from insole_core.insole.finishing.contact_shaping import (
    Arch,
    Middle,
    arch_filled,
    expanded,
    without_folds,
)
from insole_core.insole.finishing.edge import flank_heights
from insole_core.insole.finishing.edge_distance import EdgeDistance, edge_distance
from insole_core.insole.finishing.rim_curve import RIM_SIGMA_MM, Rim, RimCurve
from insole_core.insole.finishing.thin_plate import SprungPlate
from insole_core.insole.finishing.toe_zone import ToeZone, toe_zone
from insole_core.insole.finishing.zones import BlendWidths, Zones, blend_widths, zones_of
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.primitives.height_field import HEEL_SHARE, HeightField

_HEEL_INSIDE_MM = 6.0  # the floor of the heel lies at least so far from the edge


@dataclass(frozen=True, eq=False)
class FinishedSurface:
    """A contact surface with designed rim and toe zone.

    Parameters
    ----------
    finish
        That was applied.
    surface
        Heights in the level of the contact surface that it was made from.
    heel_mm
        Level of the heel's floor, from which the rim is counted, in the level of `surface`.
    goal
        What the plate is held at: the shaped contact surface, and the floor of the toe zone.
    plate
        Returns the plate of these zones, which is large and is kept with the foot as long as it is
        one of the last.
    """

    finish: Finish
    surface: HeightField
    heel_mm: float
    rim: Rim
    curve: RimCurve
    widths: BlendWidths
    toes: ToeZone
    arch: Arch
    zones: Zones
    goal: HeightField
    place: EdgeDistance
    plate: Callable[[], SprungPlate]

    def with_rim(self, stations: tuple[RimStation, ...]) -> FinishedSurface:
        """Return the surface with other stations, in the time of a drag.

        The transitions keep their widths: a wall that gets too steep is widened only by
        `finished`.

        Raises
        ------
        DesignError
            As `Rim.curve`.
        """
        curve = self.rim.curve(stations)
        heights = _joined(self.place, self.plate(), self.goal, self.heel_mm + curve.height_mm)
        surface = replace(self.surface, heights_mm=heights)
        finish = replace(self.finish, rim=stations)
        return replace(self, finish=finish, surface=surface, curve=curve)


def finished(
    foot: Foot,
    design: InsoleDesign,
    finish: Finish,
    *,
    sole: HeightField,
    contact: HeightField,
    measured: BoolArray,
    arch_apex_mm: Place,
) -> FinishedSurface:
    """Finish a contact surface.

    Parameters
    ----------
    sole
        The level foot's.
    contact
        The same after posting, skive and lift.
    measured : (ny, nx) bool
        Nodes where the foot was measured.

    Raises
    ------
    DesignError
        If stations of the rim contradict each other.
    """
    place = edge_distance(foot, design.outline, contact)
    arch = Arch.of(foot, contact, arch_apex_mm)
    on_sole = measured & (place.inside_mm > 0)
    shaped = _shaped(foot, finish, place, contact, arch)
    even = without_folds(shaped, on_sole, finish.skin_smoothing_mm)
    shaped = replace(shaped, heights_mm=even)
    heel_mm = _heel_floor_mm(foot, place, even, measured)
    toes = toe_zone(foot, place, even, measured, finish)
    rim = Rim(
        place.edge,
        _along_edge(place, shaped) - heel_mm,
        flank_heights(foot, design.outline)
        + (_along_edge(place, shaped) - _along_edge(place, sole) - heel_mm),
        toes.level_mm - heel_mm,
    )
    curve = rim.curve(finish.rim)
    goal = replace(shaped, heights_mm=toes.joined(even))
    rim_mm = heel_mm + curve.height_mm
    widths = blend_widths(place, goal, rim_mm, finish)
    zones = zones_of(place, widths, toes, goal)
    plate = partial(_factorised, foot, design.outline, place, zones)
    surface = replace(contact, heights_mm=_joined(place, plate(), goal, rim_mm))
    return FinishedSurface(
        finish, surface, heel_mm, rim, curve, widths, toes, arch, zones, goal, place, plate
    )


def _shaped(
    foot: Foot, finish: Finish, place: EdgeDistance, contact: HeightField, arch: Arch
) -> HeightField:
    """Return the contact surface with expansion and fill; no fill is deeper than the arch."""
    medial = foot.side.medial_sign
    middle = Middle.of(place.edge, contact, medial)
    shaped = contact
    if finish.expansion_mm > 0:
        wider = expanded(shaped, middle, finish.expansion_mm, medial, foot.length_mm)
        shaped = replace(shaped, heights_mm=wider)
    fill_mm = min(finish.arch_fill_mm, arch.height_mm)
    if fill_mm > 0:
        shaped = replace(shaped, heights_mm=arch_filled(shaped, middle, arch, fill_mm, medial))
    return shaped


def _heel_floor_mm(
    foot: Foot, place: EdgeDistance, heights_mm: FloatArray, measured: BoolArray
) -> float:
    """Return the lowest height of the heel, away from the edge."""
    heel = place.y_mm <= HEEL_SHARE * foot.length_mm
    inside = heel & (place.inside_mm > _HEEL_INSIDE_MM)
    for nodes in (inside & measured, inside):
        if nodes.any():
            return float(heights_mm[nodes].min())
    return float(heights_mm.min())


def _along_edge(place: EdgeDistance, field: HeightField) -> FloatArray:
    """Return the smoothed heights (n,) of a field at the points of the edge."""
    edge = place.edge
    heights = field.height_at(edge.points_mm)
    return np.asarray(
        scipy.ndimage.gaussian_filter1d(heights, RIM_SIGMA_MM / edge.step_mm, mode="wrap")
    )


def _factorised(foot: Foot, outline: Outline, place: EdgeDistance, zones: Zones) -> SprungPlate:
    """Return the plate on the springs of its zones; cached with the foot."""
    stiffness = zones.stiffness()
    key = outline, place.grid, stiffness.tobytes()
    # Each step of a drag has a plate of its own, on a coarse grid: it evicts no finer one.
    kind = f"finishing plate, {place.plate.step_mm:g} mm"
    return foot.derived.get(kind, key, partial(place.plate.on_springs, stiffness))


def _joined(
    place: EdgeDistance, plate: SprungPlate, goal: HeightField, rim_mm: FloatArray
) -> FloatArray:
    """Return heights (ny, nx) of the plate, continued beyond it by those of its nearest nodes."""
    heights = np.zeros_like(goal.heights_mm)
    heights[place.plate.nodes] = plate.solve(goal.heights_mm, rim_mm)
    return np.asarray(heights[place.nearest_in_plate])
