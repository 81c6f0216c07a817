"""An insole during editing: pads, strokes and the rim are moved and checked interactively."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import numpy as np

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.build import material_problem
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.surface.contact import ContactBase, with_rim
from insole_core.insole.surface.height_field import HeightField
from insole_core.insole.surface.pads_on_surface import Window, apply_pads, moved_pad
from insole_core.insole.surface.posting import posted_mesh, posting_angles
from insole_core.insole.surface.shoe_last import last_heights_mm
from insole_core.workflows.insole_builder import BareInsole, BareKey, bare_key


class EditedInsole:
    """The insole of a design, updated as the design is edited.

    A change of a pad updates only the part of surface and mesh that it covers; contact surface and
    findings are those of `build_insole`, bit for bit. A change of the rim's stations updates the
    whole top at once; until the insole is built anew, its walls keep the widths of `bare`, and so
    does a bottom that follows the surface: see `is_exact`.

    Parameters
    ----------
    bare
        Of the same foot and an equal `bare_key`.
    """

    def __init__(self, bare: BareInsole, design: InsoleDesign) -> None:
        self.bare = bare
        self.base: ContactBase = bare.base
        """The contact surface before pads: that of `bare`, or with another rim."""
        self.design = design
        self._rimless_key = _rimless_key(bare.foot, design)
        self.contact: HeightField = apply_pads(bare.base, design)
        self.mesh = replace(bare.solid, vertices=bare.solid.vertices.copy())
        """Its vertices are overwritten by the next change of a pad."""
        self.normals: FloatArray = bare.solid.vertex_normals.copy()
        self._move_vertices(_whole(self.contact))
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

    def can_follow_rim(self, foot: Foot, design: InsoleDesign) -> bool:
        """Return whether a design differs only in pads, strokes and the stations of the rim."""
        return self.base.finished is not None and self._rimless_key == _rimless_key(foot, design)

    def follow(self, design: InsoleDesign) -> None:
        """Update the insole to another design, for which one of the two above is true."""
        try:
            base = self._base_of(design)
        except DesignError as error:
            self.problem = str(error)
            return
        if base is self.base:
            change = moved_pad(base, self.contact, self.design, design)
            self.contact, window = change.surface, change.window
        else:
            self.contact = apply_pads(base, design)
            window = _whole(self.contact)
        self.base, self.design = base, design
        self.moved = self._move_vertices(window)
        self.problem = self._problem()

    def _base_of(self, design: InsoleDesign) -> ContactBase:
        if self.can_follow(self.bare.foot, design):
            return self.bare.base
        if design.finish == self.design.finish:
            return self.base
        return with_rim(self.bare.base, self.bare.foot, design)

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

    def _move_vertices(self, window: Window) -> IntArray:
        bare = self.bare
        moved = bare.vertices_in(window)
        xy = bare.solid.vertices[moved, :2]
        vertices = self.mesh.vertices
        vertices[moved, 2] = self.contact.height_at(xy) - bare.below_contact_mm[moved]
        self.normals[moved] = _normals_at(self.contact, window, xy)
        walls = 2 * bare.top_count + np.arange(len(bare.rim))
        vertices[walls, 2] = vertices[bare.rim, 2]
        self.mesh = TriangleMesh(vertices, self.mesh.triangles)
        return np.concatenate([moved, walls])


def _whole(field: HeightField) -> Window:
    rows, columns = field.heights_mm.shape
    return Window(0, rows, 0, columns)


def _rimless_key(foot: Foot, design: InsoleDesign) -> BareKey:
    """Return the `bare_key` of a design whose rim has no stations."""
    finish = None if design.finish is None else replace(design.finish, rim=())
    return bare_key(foot, replace(design, finish=finish))


def _normals_at(field: HeightField, window: Window, xy: FloatArray) -> FloatArray:
    """Return unit normals (n, 3) of a field at points in or near a window, by nearest node."""
    first_row, first_column = max(window.first_row - 2, 0), max(window.first_column - 2, 0)
    normals = field.normals_of(
        slice(first_row, window.end_row + 2), slice(first_column, window.end_column + 2)
    )
    row = np.rint((xy[:, 1] - field.y0_mm) / field.step_mm).astype(int) - first_row
    column = np.rint((xy[:, 0] - field.x0_mm) / field.step_mm).astype(int) - first_column
    rows, columns = normals.shape[:2]
    return np.asarray(normals[np.clip(row, 0, rows - 1), np.clip(column, 0, columns - 1)])
