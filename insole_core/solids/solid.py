"""The three products of a workshop: the insole, its block for milling, the mould of the foot."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import numpy as np

from insole_core.errors import DesignError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.build import Insole
from insole_core.insole.surface.block import apexes, block_solid
from insole_core.progress import SILENT, Progress
from insole_core.solids.ball_offset import parallel_below
from insole_core.solids.prism import Faces, band_mm, prism
from insole_core.solids.solid_outline import (
    OutlineDistance,
    checked_outline,
    outline_distance,
    outline_of,
)
from insole_core.solids.trimmed_grid import Plan, trim

Kind: TypeAlias = Literal["insole", "block", "positive"]
KINDS: tuple[Kind, ...] = ("insole", "block", "positive")

LEAST_WALL_MM = 0.3
"""Least height of a wall, so that top and bottom never meet."""


@dataclass(frozen=True)
class SolidOptions:
    """Shape of the sides and the back of a solid.

    Parameters
    ----------
    draft_deg
        Inclination of the walls from the vertical; positive: wider at the bottom, so that a cutter
        reaches everything from above; negative: narrower, to fit a shoe.
    chamfer_mm
        Width of the 45 degree bevel along the upper rim; 0 for a sharp rim.
    mould_base_mm
        Least height of a mould.
    """

    draft_deg: float = 3.0
    chamfer_mm: float = 0.0
    mould_base_mm: float = 15.0

    def __post_init__(self) -> None:
        limits = {
            "draft_deg": (-15, 30, "degrees"),
            "chamfer_mm": (0, 10, "mm"),
            "mould_base_mm": (1, 100, "mm"),
        }
        for key, (least, greatest, unit) in limits.items():
            value = getattr(self, key)
            if not least <= value <= greatest:
                raise DesignError(
                    "{what} is {value:g}, and must be {least} to {most} {unit}; put in a value of "
                    "that range.",
                    what=key,
                    value=value,
                    least=least,
                    most=greatest,
                    unit=unit,
                )


DEFAULT_OPTIONS = SolidOptions()


def make_solid(
    insole: Insole,
    kind: Kind = "insole",
    options: SolidOptions = DEFAULT_OPTIONS,
    progress: Progress = SILENT,
) -> TriangleMesh:
    """Make one of the three solids of an insole.

    Parameters
    ----------
    options
        Not used for a block.

    Returns
    -------
    TriangleMesh, mm
        Closed; for its frame see `insole_solid`, `block_solid` or `positive_solid`.

    Raises
    ------
    DesignError
        If the outline leaves no solid.
    """
    progress.step(0.0, "Closing the {kind}", kind=kind)
    if kind == "block":
        return block_solid(insole)
    return (insole_solid if kind == "insole" else positive_solid)(insole, options)


def insole_solid(
    insole: Insole,
    options: SolidOptions = DEFAULT_OPTIONS,
    outline: FloatArray | None = None,
) -> TriangleMesh:
    """Trim the contact surface by its outline and close it with walls and a bottom.

    Parameters
    ----------
    outline : (n, 2) float64, mm, insole frame, optional
        The upper rim; by default the outline of the design.

    Returns
    -------
    TriangleMesh, mm, insole frame
        Closed, facing outwards; foot side towards +z, z = 0 the bottom plane.

    Raises
    ------
    DesignError
        If the outline leaves no insole.
    """
    field = insole.contact
    distance = _distance(insole, outline, options, float(field.heights_mm.max()))
    bottom = _bottom(insole)
    top = field.heights_mm - np.clip(options.chamfer_mm - distance.inside_mm, 0, None)
    top = np.maximum(top, bottom + LEAST_WALL_MM)
    plan, tips = _plan(insole, distance, options.chamfer_mm)
    tip_bottom = replace(field, heights_mm=bottom).height_at(tips[:, :2])
    faces = Faces(top, bottom, np.column_stack([tips, tip_bottom]))
    return prism(plan, field, faces, distance, options.draft_deg)


def positive_solid(
    insole: Insole,
    options: SolidOptions = DEFAULT_OPTIONS,
    outline: FloatArray | None = None,
) -> TriangleMesh:
    """Make the mould of the corrected foot: it fills the insole up to a level plane.

    Parameters
    ----------
    outline : (n, 2) float64, mm, insole frame, optional
        Edge of the sole; by default the outline of the design.

    Returns
    -------
    TriangleMesh, mm
        Closed, facing outwards; turned by 180 degrees about y, so that the sole faces +z and the
        base lies at z = 0.

    Raises
    ------
    DesignError
        If the outline leaves no mould.
    """
    field = insole.contact
    level = float(field.heights_mm.max()) + options.mould_base_mm
    distance = _distance(insole, outline, options, level)
    plan, tips = _plan(insole, distance, 0.0)
    faces = Faces(
        level - field.heights_mm,
        np.zeros_like(field.heights_mm),
        np.column_stack([tips[:, :2], level - tips[:, 2], np.zeros(len(tips))]),
    )
    upright = prism(plan, field, faces, distance, options.draft_deg)
    # Heights were measured down from the level, a mirror in z; with one in x it is a rotation.
    return replace(upright, vertices=upright.vertices * [-1, 1, 1]).flipped()


def _distance(
    insole: Insole, outline: FloatArray | None, options: SolidOptions, wall_mm: float
) -> OutlineDistance:
    polygon = outline_of(insole) if outline is None else checked_outline(outline)
    reach = max(band_mm(wall_mm, options.draft_deg), options.chamfer_mm)
    reach += 2 * insole.contact.step_mm
    distance = outline_distance(polygon, insole.contact, reach)
    if not ((distance.inside_mm > 0) & insole.measured)[1:-1, 1:-1].any():
        raise DesignError(
            "The outline lies beside the foot, which leaves no insole; draw it round the foot."
        )
    return distance


def _plan(insole: Insole, distance: OutlineDistance, clear_mm: float) -> tuple[Plan, FloatArray]:
    """Trim the lattice; the apexes (k, 3) that are clear of the rim become vertices."""
    tips = apexes(insole)
    clear = {cell: tip for cell, tip in tips.items() if distance.inside_mm[cell] > clear_mm + 2}
    plan = trim(distance.inside_mm, tuple(clear))
    return plan, np.array([clear[cell] for cell in plan.fans]).reshape(-1, 3)


def _bottom(insole: Insole) -> FloatArray:
    field = insole.contact
    if insole.design.bottom == "flat":
        return np.zeros_like(field.heights_mm)
    return parallel_below(field, insole.design.least_thickness_mm)
