"""The three products of a workshop: the insole, its block for milling, the mould of the foot."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final, Literal, TypeAlias

import numpy as np

from insole_core.errors import DesignError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.block import apexes, block_solid
from insole_core.insole.build import Insole
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.shell import Shell
from insole_core.insole.primitives.height_field import HeightField
from insole_core.messages import Message
from insole_core.progress import SILENT, Progress
from insole_core.solids.prism import Faces, Prism, band_mm
from insole_core.solids.shell_body import (
    POST_BAND_MM,
    Body,
    BodyPlan,
    bends_mm,
    made_surface,
    shell_walls,
)
from insole_core.solids.solid_outline import (
    OutlineDistance,
    checked_outline,
    outline_distance,
    outline_of,
)
from insole_core.solids.trimmed_grid import Plan, trim

Kind: TypeAlias = Literal["insole", "block", "positive"]
KINDS: tuple[Kind, ...] = ("insole", "block", "positive")
LIMITS: Final[dict[str, tuple[int, int, str]]] = {
    "draft_deg": (-15, 30, "degrees"),
    "chamfer_mm": (0, 10, "mm"),
    "mould_base_mm": (1, 100, "mm"),
}
"""Least and greatest value of each of the `SolidOptions`, and its unit."""


@dataclass(frozen=True)
class SolidOptions:
    """Shape of the sides and the back of a solid without a shell of its own.

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
        for key, (least, greatest, unit) in LIMITS.items():
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


@dataclass(frozen=True, eq=False)
class ClosedInsole:
    """The solid of an insole, and the body between whose faces it was closed.

    Parameters
    ----------
    solid : mm, insole frame
        As `insole_solid` returns it.
    plan, body
        At the nodes of the contact surface, before walls and edges.
    prism
        Its walls and edges.
    outline : (n, 2) float64, mm, insole frame
        The upper rim, counter-clockwise.
    """

    solid: TriangleMesh
    plan: BodyPlan
    body: Body
    prism: Prism
    outline: FloatArray


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
        return block_solid(_made(insole))
    return (insole_solid if kind == "insole" else positive_solid)(insole, options)


def insole_solid(
    insole: Insole,
    options: SolidOptions = DEFAULT_OPTIONS,
    outline: FloatArray | None = None,
) -> TriangleMesh:
    """Trim the contact surface by its outline and close it with walls and a bottom.

    Parameters
    ----------
    options
        Draft and chamfer are those of the design's shell, if it has one.
    outline : (n, 2) float64, mm, insole frame, optional
        The upper rim; by default the outline of the design.

    Returns
    -------
    TriangleMesh, mm, insole frame
        Closed, facing outwards; foot side towards +z, z = 0 the bottom plane. The first half of
        its vertices is the top, the second half the bottom in the same order.

    Raises
    ------
    DesignError
        If the outline leaves no insole.
    """
    return closed_insole(insole, options, outline).solid


def closed_insole(
    insole: Insole,
    options: SolidOptions = DEFAULT_OPTIONS,
    outline: FloatArray | None = None,
) -> ClosedInsole:
    """Make the solid as `insole_solid` does, and keep the body that it was made of.

    Raises
    ------
    DesignError
        If the outline leaves no insole.
    """
    polygon = outline_of(insole) if outline is None else checked_outline(outline)
    shell = insole.design.shell
    if shell is not None:
        return _closed_shell(insole, shell, polygon)
    made = _made(insole)
    field = made.contact
    distance = _distance(made, polygon, options, float(field.heights_mm.max()))
    body_plan = BodyPlan.of(insole, polygon, distance)
    body = body_plan.body(insole.contact, made_mm=field.heights_mm)
    top = body.top_mm
    if options.chamfer_mm > 0:
        top = top - np.clip(options.chamfer_mm - distance.inside_mm, 0, None)
    plan, tips = _plan(made, distance, options.chamfer_mm)
    tip_bottom = replace(field, heights_mm=body.bottom_mm).height_at(tips[:, :2])
    faces = Faces(top, body.bottom_mm, np.column_stack([tips, tip_bottom]))
    walled = Prism(plan, field, distance, options.draft_deg)
    return ClosedInsole(walled.between(faces), body_plan, body, walled, polygon)


def edge_notes(insole: Insole) -> tuple[Message, ...]:
    """Say where the edge of an insole is rounded otherwise than asked for; a sentence each.

    Raises
    ------
    DesignError
        If the outline leaves no insole.
    """
    if insole.design.shell is None or insole.design.shell.edge_radius_mm == 0:
        return ()
    closed = closed_insole(insole)
    return closed.prism.edge_notes(Faces(closed.body.top_mm, closed.body.bottom_mm))


def with_walls_for(
    prism: Prism, design: InsoleDesign, outline: FloatArray, contact: HeightField
) -> Prism:
    """Return the prism of an insole with its walls for another contact surface on the same nodes.

    The band in which the underside makes way for inward walls is as wide as the insole is high.
    """
    shell, before = design.shell, prism.outline
    if shell is None:
        return prism
    reach_mm = _reach_mm(shell, contact) + 2 * contact.step_mm
    if reach_mm == before.reach_mm:
        return prism
    distance = outline_distance(outline, contact, reach_mm)
    walls = shell_walls(shell, design.side.medial_sign, distance, outline)
    return replace(prism, outline=distance, walls=walls)


def _reach_mm(shell: Shell, contact: HeightField) -> float:
    """Return how far inside its outline the walls and edges of a shell change its body."""
    inward_deg = min(shell.draft_medial_deg, shell.draft_lateral_deg)
    return max(
        band_mm(float(contact.heights_mm.max()), inward_deg),
        max(bends_mm(shell), default=0.0),
        POST_BAND_MM if shell.posts else 0.0,
    )


def _closed_shell(insole: Insole, shell: Shell, polygon: FloatArray) -> ClosedInsole:
    made = _made(insole)
    field = made.contact
    distance = _distance_within(made, polygon, _reach_mm(shell, insole.contact))
    body_plan = BodyPlan.of(insole, polygon, distance)
    body = body_plan.body(insole.contact, made_mm=field.heights_mm)
    contours_mm = bends_mm(shell)
    plan, tips = _plan(made, distance, max(contours_mm, default=0.0), contours_mm)
    at = tips[:, :2]
    top, bottom = (
        replace(field, heights_mm=side).height_at(at) for side in (body.top_mm, body.bottom_mm)
    )
    top += tips[:, 2] - field.height_at(at)
    faces = Faces(body.top_mm, body.bottom_mm, np.column_stack([at, top, bottom]))
    walls = shell_walls(shell, insole.design.side.medial_sign, distance, polygon)
    walled = Prism(plan, field, distance, walls)
    return ClosedInsole(walled.between(faces), body_plan, body, walled, polygon)


def positive_solid(
    insole: Insole,
    options: SolidOptions = DEFAULT_OPTIONS,
    outline: FloatArray | None = None,
) -> TriangleMesh:
    """Make the mould of the corrected foot: it fills the insole up to a level plane.

    Over it the shell is formed, so that it takes neither underside, posts, taper nor edges from the
    design's shell, and its draft is that of the options. Where a cover is taken off, the foot is as
    much larger.

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
    made = _made(insole)
    field = made.contact
    level = float(field.heights_mm.max()) + options.mould_base_mm
    polygon = outline_of(insole) if outline is None else checked_outline(outline)
    distance = _distance(made, polygon, options, level)
    plan, tips = _plan(made, distance, 0.0)
    faces = Faces(
        level - field.heights_mm,
        np.zeros_like(field.heights_mm),
        np.column_stack([tips[:, :2], level - tips[:, 2], np.zeros(len(tips))]),
    )
    upright = Prism(plan, field, distance, options.draft_deg).between(faces)
    # Heights were measured down from the level, a mirror in z; with one in x it is a rotation.
    return upright.mirrored()


def _made(insole: Insole) -> Insole:
    """Return the insole with the upper side of what is made in place of the contact surface."""
    return replace(insole, contact=made_surface(insole))


def _distance(
    insole: Insole, polygon: FloatArray, options: SolidOptions, wall_mm: float
) -> OutlineDistance:
    reach = max(band_mm(wall_mm, options.draft_deg), options.chamfer_mm)
    return _distance_within(insole, polygon, reach)


def _distance_within(insole: Insole, polygon: FloatArray, reach_mm: float) -> OutlineDistance:
    """Return the distance to an outline, exact within a reach; check that there is a foot in it."""
    distance = outline_distance(polygon, insole.contact, reach_mm + 2 * insole.contact.step_mm)
    if not ((distance.inside_mm > 0) & insole.measured)[1:-1, 1:-1].any():
        raise DesignError(
            "The outline lies beside the foot, which leaves no insole; draw it round the foot."
        )
    return distance


def _plan(
    insole: Insole,
    distance: OutlineDistance,
    clear_mm: float,
    contours_mm: tuple[float, ...] = (),
) -> tuple[Plan, FloatArray]:
    """Trim the lattice; the apexes (k, 3) that are clear of the rim become vertices."""
    tips, beside_mm = apexes(insole), clear_mm + max(2.0, 1.5 * insole.contact.step_mm)
    clear = {cell: tip for cell, tip in tips.items() if distance.inside_mm[cell] > beside_mm}
    plan = trim(distance.inside_mm, tuple(clear), contours_mm)
    return plan, np.array([clear[cell] for cell in plan.fans]).reshape(-1, 3)
