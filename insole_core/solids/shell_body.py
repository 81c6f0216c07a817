"""The body of an insole between its two faces: underside, posts, taper, thickness, front edge."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.build import Insole
from insole_core.insole.elements.rocker import LEAST_LEFT_MM
from insole_core.insole.outline.shoe_outline import last_heights_mm
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.materials import material_of
from insole_core.insole.prescription.shell import LONGEST_TAPER, Post, Shell
from insole_core.insole.primitives.blending import smooth_hinge, smooth_step
from insole_core.insole.primitives.height_field import HeightField, ahead_of_heads_mm
from insole_core.insole.primitives.outline_curve import evenly_spread
from insole_core.insole.surface.rocker import eased, rocker_heights_mm
from insole_core.solids.ball_offset import PITCH_MM, parallel_below
from insole_core.solids.prism import Walls
from insole_core.solids.rounded_edge import RoundedEdge, edge_contours_mm
from insole_core.solids.solid_outline import OutlineDistance, outline_of

_AHEAD = 0.6  # y of the outward normal: the front edge turns by at most 53 degrees
_STEEPEST = np.sqrt(1 - _AHEAD**2) / _AHEAD
_PITCH_MM, _SIGMA_MM = 0.5, 3.0
INSET_MM = 5.0
"""How far the foot of a post's wall lies inside the edge of the insole."""
POST_BAND_MM = 14.0
"""Beyond this distance from the edge of the insole the foot of every post's wall is reached."""
_WALL = np.radians(65.0)  # of the walls against the ground
_CORNER_MM = 8.0  # radius of the corners, seen from above
_AHEAD_OF_HEADS_MM = 8.0
_USUAL_LENGTH = {"rearfoot": 0.25, "forefoot": 0.12}  # shares of the foot's length
_LOSS = 0.1  # of a step of the grid, by which triangles between bent faces lie nearer
_FILLET_MM = (0.5, 8.0)
"""Difference of height within which the wall of a post is rounded into the shell above it, least
and greatest: as much as the shell is above the ground, so that the post's sole does not grow."""


def behind_front_mm(outline: FloatArray, field: HeightField) -> FloatArray:
    """Measure how far the nodes of a field lie behind the front edge of an outline.

    The distance is exact along a straight edge and to first order along a bent one. It has no
    creases, unlike the distance to the nearest point; beside the front edge it goes on straight.

    Parameters
    ----------
    outline : (n, 2) float64, mm, frame of `field`
        Counter-clockwise; the first point is not repeated.

    Returns
    -------
    (ny, nx) float64, mm
        Negative ahead of the edge.
    """
    x, y = _front(outline).T
    front = np.interp(field.x_mm, x, y)
    ends = (y[1] - y[0]) / (x[1] - x[0]), (y[-1] - y[-2]) / (x[-1] - x[-2])
    slopes = np.clip(ends, -_STEEPEST, _STEEPEST)
    front += slopes[0] * np.minimum(field.x_mm - x[0], 0)
    front += slopes[1] * np.maximum(field.x_mm - x[-1], 0)
    sigma = _SIGMA_MM / field.step_mm
    slope = scipy.ndimage.gaussian_filter1d(
        np.gradient(front, field.step_mm), sigma, mode="nearest"
    )
    return np.asarray((front - field.y_mm[:, None]) / np.hypot(1.0, slope))


def _front(outline: FloatArray) -> FloatArray:
    """Return the points (n, 2) about the foremost one whose normals point ahead, by x."""
    length_mm = np.hypot(*(np.roll(outline, -1, axis=0) - outline).T).sum()
    points = evenly_spread(outline, max(int(length_mm / _PITCH_MM), 16))
    points = np.roll(points, -int(points[:, 1].argmax()), axis=0)
    along = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    ahead = -along[:, 0] / np.hypot(*along.T) > _AHEAD
    onward, back = (_run(run) for run in (ahead, ahead[:0:-1]))
    edge = np.concatenate([points[len(points) - back :], points[:onward]])[::-1]
    edge = np.asarray(edge[np.concatenate([[True], np.diff(edge[:, 0]) > 0])])
    if len(edge) > 1:
        return edge
    return np.asarray(points[0] + [[-_PITCH_MM, 0.0], [_PITCH_MM, 0.0]])  # a sharp tip


def _run(holds: FloatArray) -> int:
    """Return for how many values from the first one on a condition holds."""
    return int(holds.argmin()) if not holds.all() else len(holds)


@dataclass(frozen=True, eq=False)
class _PostPlan:
    """Where posts may stand: distances at the nodes of a field, mm.

    Parameters
    ----------
    inside : (ny, nx) float64
        From the edge of the insole.
    before_heel : (ny, 1) float64
        From the rear end of the insole.
    behind_front : (ny, nx) float64
        From the front end of a forefoot post.
    """

    inside: FloatArray
    before_heel: FloatArray
    behind_front: FloatArray


def post_length_mm(post: Post, foot_length_mm: float) -> float:
    """Return the length of a post: its own, or the usual one of its region."""
    if post.length_mm is not None:
        return post.length_mm
    return _USUAL_LENGTH[post.region] * foot_length_mm


def _post_underside(post: Post, plan: _PostPlan, foot_length_mm: float) -> FloatArray:
    """Return the height of a post's underside and walls over the ground, (ny, nx), mm.

    Its walls go on rising beside it, so that the lower one of this and of a shell's underside is
    the underside of both.
    """
    length_mm = post_length_mm(post, foot_length_mm)
    sides = [plan.inside - INSET_MM]
    if post.region == "rearfoot":
        sides.append(length_mm - plan.before_heel)
    else:
        sides += [plan.behind_front, length_mm - plan.behind_front]
    return _wall_mm(_rounded_inside(sides), post.edge_radius_mm)


def behind_heads_mm(insole: Insole, field: HeightField) -> FloatArray:
    """Return how far nodes lie behind a line ahead of the heads 1 and 5, (ny, nx), mm."""
    return np.asarray(_AHEAD_OF_HEADS_MM - ahead_of_heads_mm(insole.foot, field))


def _rounded_inside(sides: list[FloatArray]) -> FloatArray:
    """Return the distance inside an area, from those inside its sides; its corners are round."""
    short = [np.maximum(_CORNER_MM - side, 0) for side in sides]
    return np.asarray(_CORNER_MM - np.sqrt(sum(s * s for s in short)))


def _wall_mm(inside_mm: FloatArray, radius_mm: float) -> FloatArray:
    """Return the height of ground and wall at distances inside the foot of the wall."""
    begin = radius_mm * np.tan(_WALL / 2)
    end = begin - radius_mm * np.sin(_WALL)
    on_arc = np.clip(begin - inside_mm, 0, begin - end)
    arc = radius_mm - np.sqrt(np.maximum(radius_mm**2 - on_arc**2, 0))
    return np.asarray(arc + np.tan(_WALL) * np.maximum(end - inside_mm, 0))


@dataclass(frozen=True, eq=False)
class Body:
    """Upper side and underside of an insole at the nodes of its grid, (ny, nx), mm."""

    top_mm: FloatArray
    bottom_mm: FloatArray


@dataclass(frozen=True, eq=False)
class BodyPlan:
    """All that the body of an insole depends on beside its contact surface, at the same nodes.

    Parameters
    ----------
    ground_mm : (ny, nx) float64
        The plane, or the last of a shoe with a heel.
    rise_mm : (ny, nx) float64, optional
        By how much rockers ask the underside to rise; None without one.
    taper : (ny, nx) float64
        From 0 at the front edge to 1 behind the taper; 1 everywhere without a shell.
    posts_mm : (ny, nx) float64 each
        Undersides of the posts over the ground.
    """

    design: InsoleDesign
    ground_mm: FloatArray
    rise_mm: FloatArray | None
    taper: FloatArray
    posts_mm: tuple[FloatArray, ...]

    @classmethod
    def of(cls, insole: Insole, outline: FloatArray, edge: OutlineDistance) -> BodyPlan:
        """Return the plan of an insole.

        Parameters
        ----------
        outline : (n, 2) float64, mm, insole frame
            Counter-clockwise.
        edge
            The distance to it.
        """
        field, design, length_mm = insole.contact, insole.design, insole.foot.length_mm
        ground = np.zeros_like(field.heights_mm)
        ground += last_heights_mm(design, field.y_mm, length_mm)[:, None]
        rise = rocker_heights_mm(design, insole.foot, field)
        shell = design.shell
        if shell is None:
            return cls(design, ground, rise, np.ones_like(ground), ())
        behind = behind_front_mm(outline, field)
        taper = smooth_step(behind, 0.0, taper_length_mm(shell, outline))
        front = behind
        if shell.posts and design.outline.extent != "three_quarter":
            front = behind_heads_mm(insole, field)
        heel = field.y_mm[:, None] - outline[:, 1].min()
        places = _PostPlan(edge.inside_mm, heel, front)
        posts = tuple(_post_underside(post, places, length_mm) for post in shell.posts)
        return cls(design, ground, rise, taper, posts)

    @property
    def is_plain(self) -> bool:
        """Whether the upper side is the contact surface and the underside does not follow it."""
        design = self.design
        follows = design.bottom != "flat" or self.rise_mm is not None
        return not follows and design.shell is None and design.taken_off_mm == 0

    @property
    def reach_mm(self) -> float:
        """How far beside a change of the contact surface the body may change."""
        return self.design.taken_off_mm + _thickness_mm(self.design)

    def within(self, rows: slice, columns: slice) -> BodyPlan:
        """Return the part of the plan for a window of the nodes."""
        at = rows, columns
        return replace(
            self,
            ground_mm=self.ground_mm[at],
            rise_mm=None if self.rise_mm is None else self.rise_mm[at],
            taper=self.taper[at],
            posts_mm=tuple(post[at] for post in self.posts_mm),
        )

    def body(
        self,
        contact: HeightField,
        pitch_mm: float = PITCH_MM,
        *,
        made_mm: FloatArray | None = None,
    ) -> Body:
        """Return the body below a contact surface: tapered, posted, and nowhere too thin.

        The taper thins a flat insole from above and one with a following underside from below.
        Where less than the least thickness of the material is left, the upper side is raised.

        Parameters
        ----------
        contact
            On the nodes of the plan. Within `reach_mm` of a window's border, the body of a window
            differs from that of the whole.
        pitch_mm
            As of `parallel_below`.
        made_mm : (ny, nx) float64, optional
            Heights of the `made_surface`, if they are known.
        """
        top = made_heights_mm(contact, self.design, pitch_mm) if made_mm is None else made_mm
        bottom = self._underside(contact, top, pitch_mm)
        shell = self.design.shell
        if shell is None:
            return Body(top, bottom)
        top, bottom = self._tapered(shell, top, bottom)
        for post in self.posts_mm:
            over_post = bottom - self.ground_mm - post
            fillet = np.clip(bottom - self.ground_mm, *_FILLET_MM)
            bottom = np.maximum(bottom - smooth_hinge(over_post, fillet), self.ground_mm)
        return Body(np.maximum(top, bottom + _least_mm(shell, self.taper)), bottom)

    def _underside(self, contact: HeightField, top_mm: FloatArray, pitch_mm: float) -> FloatArray:
        """Return the underside before taper and posts: flat, or parallel to the top, and rocked."""
        bottom, design = self.ground_mm, self.design
        if design.bottom != "flat":
            away_mm = design.taken_off_mm + _thickness_mm(design)
            bottom = np.maximum(parallel_below(contact, away_mm, pitch_mm), bottom)
        if self.rise_mm is None:
            return bottom
        shell = design.shell
        needed_mm = 0.0 if shell is None else max(material_of(shell).least_mm - LEAST_LEFT_MM, 0.0)
        return eased(bottom, top_mm - needed_mm, self.rise_mm)

    def _tapered(
        self, shell: Shell, top: FloatArray, bottom: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        share, front_mm = self.taper, max(shell.taper_mm, material_of(shell).least_edge_mm)
        if self.design.bottom == "flat":
            thinner = bottom + front_mm + (top - bottom - front_mm) * share
            return np.where(share < 1, thinner, top), bottom
        # Thickness counts along the normal, so that it is scaled: flanks stay as thick.
        scale = share + (1 - share) * front_mm / _thickness_mm(self.design)
        return top, np.maximum(top - (top - bottom) * scale, self.ground_mm)


def made_surface(insole: Insole) -> HeightField:
    """Return the upper side of what is made: below a cover that is glued on later.

    Returns
    -------
    HeightField, mm, insole frame
        The contact surface itself if no cover is taken off.
    """
    if insole.design.taken_off_mm == 0:
        return insole.contact
    return replace(insole.contact, heights_mm=made_heights_mm(insole.contact, insole.design))


def made_heights_mm(
    contact: HeightField, design: InsoleDesign, pitch_mm: float = PITCH_MM
) -> FloatArray:
    """Return the heights (ny, nx), mm, of the upper side of what is made."""
    if design.taken_off_mm == 0:
        return contact.heights_mm
    return parallel_below(contact, design.taken_off_mm, pitch_mm)


def _thickness_mm(design: InsoleDesign) -> float:
    """Return the thickness of what is made: at least that which the material needs."""
    if design.shell is None:
        return design.made_thickness_mm
    least_mm = material_of(design.shell).least_mm + _LOSS * design.grid_mm
    return max(design.made_thickness_mm, least_mm)


def least_thickness(insole: Insole, shell: Shell) -> HeightField:
    """Return the least thickness that the shell's material allows at the nodes of the grid, mm.

    It is that of the thinnest place which a normal of this length can lead to.
    """
    field, outline = insole.contact, outline_of(insole)
    behind = behind_front_mm(outline, field) - material_of(shell).least_mm
    share = smooth_step(behind, 0.0, taper_length_mm(shell, outline))
    return replace(field, heights_mm=_least_mm(shell, share))


def shell_walls(
    shell: Shell, medial_sign: float, edge: OutlineDistance, outline: FloatArray
) -> Walls:
    """Return the walls of a shell: the draft of both borders blends round heel and toes."""
    medial = (1 + medial_sign * edge.outward[..., 0]) / 2
    draft = shell.draft_lateral_deg + (shell.draft_medial_deg - shell.draft_lateral_deg) * medial
    is_round = bool(edge_contours_mm(shell.edge_radius_mm))
    rounded = RoundedEdge.along(outline, shell.edge_radius_mm) if is_round else None
    return Walls(draft, shell.chamfer_mm, rounded)


def bends_mm(shell: Shell) -> tuple[float, ...]:
    """Return the distances from the outline at which the upper edge bends, in ascending order."""
    bevel = {shell.chamfer_mm} if shell.chamfer_mm > 0 else set()
    return tuple(sorted(bevel | set(edge_contours_mm(shell.edge_radius_mm))))


def taper_length_mm(shell: Shell, outline: FloatArray) -> float:
    """Return the length of the taper: at most half of the insole's."""
    return min(shell.taper_length_mm, LONGEST_TAPER * float(np.ptp(outline[:, 1])))


def _least_mm(shell: Shell, share: FloatArray) -> FloatArray:
    """Return the least thickness where a share of the taper from the front edge is reached."""
    material = material_of(shell)
    return material.least_edge_mm + (material.least_mm - material.least_edge_mm) * share
