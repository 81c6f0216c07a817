"""The body of an insole between its two faces: underside, posts, taper, least thickness, edge."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.build import Insole
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.materials import material_of
from insole_core.insole.prescription.shell import LONGEST_TAPER, Shell
from insole_core.insole.surface.blending import smooth_hinge, smooth_step
from insole_core.insole.surface.height_field import HeightField
from insole_core.insole.surface.rocker import LEAST_LEFT_MM, eased, rocker_heights_mm, rockers
from insole_core.insole.surface.shoe_last import last_heights_mm
from insole_core.solids.ball_offset import parallel_below
from insole_core.solids.front_edge import behind_front_mm
from insole_core.solids.posts import PostPlan, behind_heads_mm, post_underside
from insole_core.solids.prism import Walls
from insole_core.solids.solid_outline import OutlineDistance, outline_of

_LOSS = 0.1  # of a step of the grid, by which triangles between bent faces lie nearer
_FLATTENED_MM = 0.04
"""By how much the facets of a rounded edge may lie inside of it."""
_FILLET_MM = (0.5, 8.0)
"""Difference of height within which the wall of a post is rounded into the shell above it, least
and greatest: as much as the shell is above the ground, so that the post's sole does not grow."""


@dataclass(frozen=True, eq=False)
class Body:
    """Upper side and underside of an insole at the nodes of its grid, (ny, nx), mm."""

    top_mm: FloatArray
    bottom_mm: FloatArray


def made_surface(insole: Insole) -> HeightField:
    """Return the upper side of what is made: below a cover that is glued on later.

    Returns
    -------
    HeightField, mm, insole frame
        The contact surface itself if no cover is taken off.
    """
    taken_off_mm = insole.design.taken_off_mm
    if taken_off_mm == 0:
        return insole.contact
    lowered = parallel_below(insole.contact, taken_off_mm)
    return replace(insole.contact, heights_mm=lowered)


def plain_underside(insole: Insole, made: HeightField) -> FloatArray:
    """Return the underside before taper and posts, (ny, nx), mm: flat, or parallel to the top.

    For a shoe with a heel a flat one has the shape of its last. A rocker eases it at the forefoot.

    Parameters
    ----------
    made
        The `made_surface` of the insole.
    """
    whole, design = _unrocked_underside(insole), insole.design
    if not rockers(design):
        return whole
    rise = rocker_heights_mm(design, insole.foot, insole.contact)
    shell = design.shell
    needed_mm = 0.0 if shell is None else max(material_of(shell).least_mm - LEAST_LEFT_MM, 0.0)
    return eased(whole, made.heights_mm - needed_mm, rise)


def _unrocked_underside(insole: Insole) -> FloatArray:
    field, design = insole.contact, insole.design
    ground = np.zeros_like(field.heights_mm)
    ground += last_heights_mm(design, field.y_mm, insole.foot.length_mm)[:, None]
    if design.bottom == "flat":
        return ground
    return np.maximum(parallel_below(field, design.taken_off_mm + _thickness_mm(design)), ground)


def _thickness_mm(design: InsoleDesign) -> float:
    """Return the thickness of what is made: at least that which the material needs."""
    if design.shell is None:
        return design.made_thickness_mm
    least_mm = material_of(design.shell).least_mm + _LOSS * design.grid_mm
    return max(design.made_thickness_mm, least_mm)


def shell_body(
    insole: Insole,
    shell: Shell,
    made: HeightField,
    outline: FloatArray,
    edge: OutlineDistance,
) -> Body:
    """Return the body of an insole with a shell: tapered, posted, and nowhere too thin.

    The taper thins a flat insole from above and one with a following underside from below. Where
    less than the least thickness of the material is left, the upper side is raised.

    Parameters
    ----------
    made
        The `made_surface` of the insole.
    outline : (n, 2) float64, mm, insole frame
        Counter-clockwise.
    edge
        The distance to it.
    """
    field, design, length_mm = insole.contact, insole.design, insole.foot.length_mm
    top, bottom = made.heights_mm, plain_underside(insole, made)
    behind = behind_front_mm(outline, field)
    share = smooth_step(behind, 0.0, taper_length_mm(shell, outline))
    front_mm = max(shell.taper_mm, material_of(shell).least_edge_mm)
    ground = last_heights_mm(design, field.y_mm, length_mm)[:, None]
    if design.bottom == "flat":
        top = np.where(share < 1, bottom + front_mm + (top - bottom - front_mm) * share, top)
    else:
        # Thickness counts along the normal, so that it is scaled: flanks stay as thick.
        thinner = share + (1 - share) * front_mm / _thickness_mm(design)
        bottom = np.maximum(top - (top - bottom) * thinner, ground)
    for post in shell.posts:
        short = design.outline.extent == "three_quarter"
        front = behind if short else behind_heads_mm(insole, field)
        heel = field.y_mm[:, None] - outline[:, 1].min()
        plan = PostPlan(edge.inside_mm, heel, front)
        over_post = bottom - ground - post_underside(post, plan, length_mm)
        fillet = np.clip(bottom - ground, *_FILLET_MM)
        bottom = np.maximum(bottom - smooth_hinge(over_post, fillet), ground)
    return Body(np.maximum(top, bottom + _least_mm(shell, share)), bottom)


def least_thickness(insole: Insole, shell: Shell) -> HeightField:
    """Return the least thickness that the shell's material allows at the nodes of the grid, mm.

    It is that of the thinnest place which a normal of this length can lead to.
    """
    field, outline = insole.contact, outline_of(insole)
    behind = behind_front_mm(outline, field) - material_of(shell).least_mm
    share = smooth_step(behind, 0.0, taper_length_mm(shell, outline))
    return replace(field, heights_mm=_least_mm(shell, share))


def shell_walls(shell: Shell, medial_sign: float, edge: OutlineDistance) -> Walls:
    """Return the walls of a shell: the draft of both borders blends round heel and toes."""
    medial = (1 + medial_sign * edge.outward[..., 0]) / 2
    draft = shell.draft_lateral_deg + (shell.draft_medial_deg - shell.draft_lateral_deg) * medial
    return Walls(draft, partial(_cut_mm, shell.edge_radius_mm, shell.chamfer_mm))


def edge_contours_mm(shell: Shell) -> tuple[float, ...]:
    """Return the distances from the outline at which the upper edge bends, in ascending order."""
    radius_mm = shell.edge_radius_mm
    bends = {shell.chamfer_mm} if shell.chamfer_mm > 0 else set()
    if radius_mm > _FLATTENED_MM:
        half_angle = np.arccos(1 - _FLATTENED_MM / radius_mm)
        count = int(np.ceil(np.pi / 4 / half_angle))
        bends |= {radius_mm * (1 - np.cos(np.pi / 2 * k / count)) for k in range(1, count + 1)}
    return tuple(sorted(float(bend) for bend in bends))


def taper_length_mm(shell: Shell, outline: FloatArray) -> float:
    """Return the length of the taper: at most half of the insole's."""
    return min(shell.taper_length_mm, LONGEST_TAPER * float(np.ptp(outline[:, 1])))


def _least_mm(shell: Shell, share: FloatArray) -> FloatArray:
    """Return the least thickness where a share of the taper from the front edge is reached."""
    material = material_of(shell)
    return material.least_edge_mm + (material.least_mm - material.least_edge_mm) * share


def _cut_mm(radius_mm: float, chamfer_mm: float, inside_mm: FloatArray) -> FloatArray:
    """Return by how much rounding and bevel lower the upper edge at a distance from it."""
    short = np.clip(radius_mm - inside_mm, 0, radius_mm)
    rounded = radius_mm - np.sqrt(radius_mm**2 - short**2)
    return np.maximum(rounded, np.maximum(chamfer_mm - np.maximum(inside_mm, 0), 0))
