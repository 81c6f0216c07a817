"""An insole during editing: pads, strokes and finish are changed and checked interactively."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import numpy as np

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.build import material_problem
from insole_core.insole.outline.shoe_outline import last_heights_mm
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_totals import posting_angles
from insole_core.insole.prescription.finish import Finish
from insole_core.insole.primitives.height_field import HeightField
from insole_core.insole.surface.contact import ContactBase, with_rim
from insole_core.insole.surface.followed_base import followed_base
from insole_core.insole.surface.pads_on_surface import Window, apply_pads, moved_pad
from insole_core.insole.surface.posting import posted_mesh
from insole_core.solids.ball_offset import PITCH_MM
from insole_core.solids.prism import Faces
from insole_core.solids.shell_body import Body
from insole_core.solids.solid import with_walls_for
from insole_core.workflows.insole_builder import BareInsole, BareKey, bare_key

_QUICK_PITCH_MM = 2.0
"""Of the points that the ball of an underside touches, while the surface is not exact either."""
_SAME_MM = 1e-9


class EditedInsole:
    """The insole of a design, updated as the design is edited.

    A change of a pad updates only the part of surface and mesh that it covers; contact surface and
    findings are those of `build_insole`, bit for bit, and the body is that of `insole_solid`. Its
    edges and walls only rise and sink with the body, until they are made anew: see `settle`. A
    change of the finish or of the share of the foot updates the whole at once; until the insole is
    built anew, it is close to that: see `is_exact`.

    Parameters
    ----------
    bare
        Of the same foot and an equal `bare_key`.
    """

    def __init__(self, bare: BareInsole, design: InsoleDesign) -> None:
        self.bare = bare
        self.base: ContactBase = bare.base
        """The contact surface before pads: that of `bare`, or with another finish."""
        self.design = design
        self._rimless_key = _rimless_key(bare.foot, design)
        self._lasting_key = _lasting_key(bare.foot, design)
        self.contact: HeightField = apply_pads(bare.base, design)
        self.mesh = replace(bare.solid, vertices=bare.solid.vertices.copy())
        """Its vertices are overwritten by the next change."""
        self.normals: FloatArray = bare.solid.vertex_normals.copy()
        self._is_settled = False
        self._move_all()
        self.moved: IntArray | None = None
        """Indices of the vertices that the last change moved; None before the first."""
        self.problem = self._problem()
        """Why the insole cannot be made, a sentence; empty when it can."""

    @property
    def is_exact(self) -> bool:
        """Whether the surface is that of `build_insole`, and not only close to it."""
        return self.base is self.bare.base

    def can_follow(self, foot: Foot, design: InsoleDesign) -> bool:
        """Return whether a design is for the same foot and differs only in pads and strokes."""
        return self.bare.key == bare_key(foot, design)

    def can_follow_finish(self, foot: Foot, design: InsoleDesign) -> bool:
        """Return whether a design differs only in pads, strokes, finish and share of the foot."""
        return self.bare.coarse is not None and self._lasting_key == _lasting_key(foot, design)

    def follow(self, design: InsoleDesign) -> None:
        """Update the insole to another design, for which one of the two above is true."""
        try:
            base = self._base_of(design)
        except DesignError as error:
            self.problem = str(error)
            return
        before, self.design = self.design, design
        self._is_settled = False
        if base is self.base:
            change = moved_pad(base, self.contact, before, design)
            self.contact = change.surface
            self.moved = self._move_vertices(change.window)
        else:
            self.base, self.contact = base, apply_pads(base, design)
            self.moved = self._move_all()
        self.problem = self._problem()

    def settle(self) -> bool:
        """Make edges and walls as `insole_solid` does; return whether any vertex moved by that.

        Does nothing while the insole is not exact or cannot be made.
        """
        if self._is_settled or not self.is_exact or self.problem:
            return False
        self._is_settled = True
        bare, vertices = self.bare, self.mesh.vertices
        prism = with_walls_for(bare.prism, self.design, bare.outline, self.contact)
        made = prism.vertices(Faces(self._body.top_mm, self._body.bottom_mm))
        made = np.concatenate([made, made[bare.rim], made[bare.rim + bare.top_count]])
        off = np.abs(made - vertices).max(axis=1) > _SAME_MM
        if not off.any():
            return False
        vertices[off] = made[off]
        self.mesh = bare.solid.moved(vertices)
        corners = bare.solid.triangles
        moved = np.unique(corners[off[corners].any(axis=1)])
        self.normals[moved] = self.mesh.normals_at(moved)
        if self.moved is not None:
            self.moved = np.union1d(self.moved, moved)
        return True

    def _base_of(self, design: InsoleDesign) -> ContactBase:
        bare = self.bare
        if self.can_follow(bare.foot, design):
            return bare.base
        if (design.finish, design.base) == (self.design.finish, self.design.base):
            return self.base
        if _rimless_key(bare.foot, design) == self._rimless_key:
            return with_rim(bare.base, bare.foot, design)
        assert bare.coarse is not None, "asked for by can_follow_finish"
        return followed_base(bare.base, bare.coarse, bare.foot, design)

    @property
    def skins(self) -> tuple[TriangleMesh, TriangleMesh]:
        """Top (without pads) and bottom as meshes of all vertices, without the walls.

        The vertices of a bottom that follows the surface are those of `mesh`, and move with them.
        """
        return self._skins

    @cached_property
    def _skins(self) -> tuple[TriangleMesh, TriangleMesh]:
        top, bottom = self.bare.skins
        return top, replace(bottom, vertices=self.mesh.vertices)

    @property
    def closed_mesh(self) -> TriangleMesh:
        """The mesh without the second copy of the walls' vertices: closed, and of its own."""
        count, rim = 2 * self.bare.top_count, self.bare.rim
        number = np.concatenate([np.arange(count), rim, rim + self.bare.top_count])
        corners = number[self.mesh.triangles].astype(np.int32)
        return TriangleMesh(self.mesh.vertices[:count].copy(), corners)

    @property
    def bottom_heights_mm(self) -> FloatArray:
        """(n,) heights of the bottom below the top's vertices."""
        count = self.bare.top_count
        return self.mesh.vertices[count : 2 * count, 2]

    def values_everywhere(self, top: FloatArray, bottom: FloatArray) -> FloatArray:
        """Distribute values of the top and the bottom to all vertices of the mesh.

        Parameters
        ----------
        top, bottom : (n,) float64
            For the vertices of the top and those below them.

        Returns
        -------
        (2 n + k,) float64
            The walls' second copy of the rim included.
        """
        rim = self.bare.rim
        return np.concatenate([top, bottom, top[rim], bottom[rim]])

    def heights_mm(self, xy: FloatArray) -> FloatArray:
        """Interpolate the contact surface.

        Parameters
        ----------
        xy : (..., 2) float64, mm, insole frame
            Points beyond the grid take the height at its edge.

        Returns
        -------
        (...) float64, mm
        """
        field = self.contact
        inset = 1e-6 * field.step_mm
        low = np.array([field.x_mm[0], field.y_mm[0]]) + inset
        high = np.array([field.x_mm[-1], field.y_mm[-1]]) - inset
        return field.height_at(np.clip(xy, low, high))

    def covers(self, x_mm: float, y_mm: float) -> bool:
        """Return whether a point, mm, insole frame, is on the grid of the contact surface."""
        field = self.contact
        inside_x = field.x_mm[0] <= x_mm <= field.x_mm[-1]
        return bool(inside_x and field.y_mm[0] <= y_mm <= field.y_mm[-1])

    @cached_property
    def standing_foot(self) -> TriangleMesh:
        """The foot standing on the insole and its cover, rotated by postings and posts.

        Independent of pads and strokes; mm, insole frame.
        """
        turned = posted_mesh(self.bare.foot, *posting_angles(self.design))
        foot, z = self.bare.foot, turned.vertices[:, 2]
        over = z - last_heights_mm(self.design, turned.vertices[:, 1], foot.length_mm)
        lift = self.design.least_thickness_mm - over.min()
        return replace(turned, vertices=turned.vertices + np.array([0, 0, lift]))

    def _problem(self) -> str:
        problem = material_problem(self.contact, self.design, self.bare.foot.length_mm)
        return "" if problem is None else str(problem)

    def _window_of_pads(self) -> Window:
        """Return the smallest window outside which the surface is that of the bare insole."""
        differs = self.contact.heights_mm != self.bare.base.surface.heights_mm
        rows, columns = (np.flatnonzero(differs.any(axis=axis)) for axis in (1, 0))
        if len(rows) == 0:
            return Window(0, 0, 0, 0)
        window = Window(int(rows[0]), int(rows[-1]) + 1, int(columns[0]), int(columns[-1]) + 1)
        return window.widened(differs.shape)

    def _move_all(self) -> IntArray:
        """Move all vertices, and only where pads make the body another one if it is exact."""
        self._body = _copy_of(self.bare.body)
        if not self.is_exact:
            return self._move_vertices(_whole(self.contact))
        self.mesh.vertices[:] = self.bare.solid.vertices
        self.normals[:] = self.bare.solid.vertex_normals
        window = self._window_of_pads()
        self._is_settled = window.is_empty  # then it is the bare insole
        self._move_vertices(window)
        return np.arange(len(self.mesh.vertices))

    def _move_vertices(self, window: Window) -> IntArray:
        """Move the vertices that depend on a window of the nodes; return their indices."""
        bare, vertices = self.bare, self.mesh.vertices
        moved = self._move_body(window)
        below = bare.rim + bare.top_count
        walls = 2 * bare.top_count + np.arange(2 * len(bare.rim))
        vertices[walls, 2] = vertices[np.concatenate([bare.rim, below]), 2]
        self.mesh = bare.solid.moved(vertices)
        moved = np.concatenate([moved, walls])
        self.normals[moved] = self.mesh.normals_at(moved)
        return moved

    def _move_body(self, window: Window) -> IntArray:
        """Move top and bottom by what the body differs from that of the bare insole."""
        if window.is_empty:
            return np.zeros(0, dtype=np.int64)
        bare, shape = self.bare, self.contact.heights_mm.shape
        reach = 0
        if not bare.plan.is_plain:
            reach = int(np.ceil(bare.plan.reach_mm / self.contact.step_mm)) + 1
        window = window.widened(shape, reach)
        around = window.widened(shape)  # between its nodes lie vertices that move
        read = around.widened(shape, reach)
        pitch_mm = PITCH_MM if self.is_exact else _QUICK_PITCH_MM
        contact = _part(self.contact, self.contact.heights_mm, read)
        body = bare.plan.within(read.rows, read.columns).body(contact, pitch_mm)
        inner = around.relative_to(read)
        at = around.rows, around.columns
        self._body.top_mm[at], self._body.bottom_mm[at] = body.top_mm[inner], body.bottom_mm[inner]
        moved = bare.vertices_in(window)
        top, bottom = moved[moved < bare.top_count], moved[moved >= bare.top_count]
        self._move_face(top, around, body.top_mm[inner] - bare.body.top_mm[at])
        if bare.plan.is_plain:
            return top
        self._move_face(bottom, around, body.bottom_mm[inner] - bare.body.bottom_mm[at])
        return moved

    def _move_face(self, moved: IntArray, window: Window, rise_mm: FloatArray) -> None:
        """Move vertices of a face by what its heights differ from those of the bare insole.

        Parameters
        ----------
        window
            Of the nodes around all vertices that move, where the differences are.
        """
        solid, rise = self.bare.solid, _part(self.contact, rise_mm, window)
        risen = rise.height_at(solid.vertices[moved, :2])
        self.mesh.vertices[moved, 2] = solid.vertices[moved, 2] + risen


def _copy_of(body: Body) -> Body:
    return Body(body.top_mm.copy(), body.bottom_mm.copy())


def _part(field: HeightField, heights_mm: FloatArray, window: Window) -> HeightField:
    """Return a field on a window of the nodes of another one.

    Parameters
    ----------
    heights_mm
        At the nodes of the window, or at all of them.
    """
    if heights_mm.shape == field.heights_mm.shape:
        heights_mm = heights_mm[window.rows, window.columns]
    x0_mm = field.x0_mm + window.first_column * field.step_mm
    y0_mm = field.y0_mm + window.first_row * field.step_mm
    return HeightField(x0_mm, y0_mm, field.step_mm, heights_mm)


def _whole(field: HeightField) -> Window:
    rows, columns = field.heights_mm.shape
    return Window(0, rows, 0, columns)


def _rimless_key(foot: Foot, design: InsoleDesign) -> BareKey:
    """Return the `bare_key` of a design whose rim has no stations."""
    finish = None if design.finish is None else replace(design.finish, rim=())
    return bare_key(foot, replace(design, finish=finish))


def _lasting_key(foot: Foot, design: InsoleDesign) -> BareKey:
    """Return the `bare_key` of a design whose finish and share of the foot are the usual ones."""
    finish = None if design.finish is None else Finish()
    base = None if design.base is None else replace(design.base, contact_share=0.0)
    return bare_key(foot, replace(design, finish=finish, base=base))
