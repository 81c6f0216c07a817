"""Keeps the insole of the open case built: pads at once, everything heavier beside the window."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from PySide6.QtCore import QObject, Signal

from insole_core.errors import InsoleError
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.build import Insole
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_limits import check_design
from insole_core.insole.surface.contact import ContactBase, base_key, contact_base
from insole_core.insole.surface.height_field import HeightField
from insole_core.insole.surface.pads_on_surface import (
    Window,
    added_corrections,
    apply_pads,
    moved_pad,
)
from insole_core.insole.surface.posting import posted_mesh, posting_angles
from insole_core.progress import Progress
from insole_core.solids.solid import insole_solid
from insole_studio.document.case import Case
from insole_studio.jobs import Jobs

CHANNEL = "insole"
KEPT_GROUNDS = 4


@dataclass(frozen=True, eq=False)
class BaseSolid:
    """What a design stands on while pads come, go and move: the insole without them.

    Parameters
    ----------
    key
        Equal keys, equal ground.
    base
    solid
        Its vertices are the top, the bottom below it, and those of the walls once more, so that
        light falls on them as on walls.
    top_count
        Number of vertices that follow the contact surface; as many are below them.
    rim
        Which of them the walls begin at.
    """

    key: tuple[Any, ...]
    base: ContactBase
    solid: TriangleMesh
    top_count: int
    rim: IntArray

    @classmethod
    def of(cls, key: tuple[Any, ...], base: ContactBase, solid: TriangleMesh) -> BaseSolid:
        """Take a closed solid whose first half of vertices is the top."""
        count = len(solid.vertices) // 2
        on_top = solid.triangles < count
        is_wall = on_top.any(axis=1) & ~on_top.all(axis=1)
        used = np.unique(solid.triangles[is_wall])
        again = np.zeros(len(solid.vertices), dtype=np.int32)
        again[used] = len(solid.vertices) + np.arange(len(used), dtype=np.int32)
        triangles = solid.triangles.copy()
        triangles[is_wall] = again[triangles[is_wall]]
        vertices = np.concatenate([solid.vertices, solid.vertices[used]])
        mesh = TriangleMesh(vertices, triangles)
        _ = mesh.vertex_normals  # kept by the mesh: computed here, not in the window
        return cls(key, base, mesh, count, used[used < count].astype(np.int64))

    @cached_property
    def skins(self) -> tuple[TriangleMesh, TriangleMesh]:
        """Top and bottom, without the walls."""
        corners, count = self.solid.triangles, self.top_count
        top = (corners < count).all(axis=1)
        bottom = ((corners >= count) & (corners < 2 * count)).all(axis=1)
        return replace(self.solid, triangles=corners[top]), replace(
            self.solid, triangles=corners[bottom]
        )

    def vertices_in(self, window: Window) -> IntArray:
        """Indices of the top's vertices that the nodes of a window decide."""
        field = self.base.surface
        low = field.y0_mm + (window.first_row - 1) * field.step_mm
        high = field.y0_mm + window.end_row * field.step_mm
        order, y = self._by_y
        found = order[slice(*np.searchsorted(y, [low, high]))]
        x = self.solid.vertices[found, 0]
        left = field.x0_mm + (window.first_column - 1) * field.step_mm
        right = field.x0_mm + window.end_column * field.step_mm
        return found[(x > left) & (x < right)]

    @cached_property
    def _by_y(self) -> tuple[IntArray, FloatArray]:
        y = self.solid.vertices[: self.top_count, 1]
        order = np.argsort(y, kind="stable")
        return order, y[order]


class InsolePreview(QObject):
    """The surface derived from the shown design.

    Dragging a pad changes only the part of a surface that it covers. What lies below is computed
    in the background; while that runs, newer wishes wait, and only the newest is computed next.
    """

    changed = Signal()
    failed = Signal(object)

    def __init__(self, case: Case, jobs: Jobs, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._case = case
        self._jobs = jobs
        self._ground: BaseSolid | None = None
        self._kept: list[BaseSolid] = []
        self._shown_design: InsoleDesign | None = None
        self._standing: tuple[tuple[object, ...], TriangleMesh] | None = None
        self.contact: HeightField | None = None
        self.mesh: TriangleMesh | None = None
        """What the preview shows; its vertices are written to by the next change of a pad."""
        self.normals: FloatArray | None = None
        self.moved: IntArray | None = None
        """The vertices that the last change moved; None when the mesh is another one."""
        self.problem = ""
        case.opened.connect(self._kept.clear)
        case.foot_changed.connect(self._forget)
        case.changed.connect(self._refresh)
        case.preview_changed.connect(self._refresh)

    @property
    def is_current(self) -> bool:
        """Whether what is shown is all that the design asks for."""
        design, foot = self._case.shown.design, self._case.foot
        if design is None or foot is None:
            return True
        return self._has_ground(foot, design) and not self.problem

    @property
    def base(self) -> ContactBase | None:
        """The contact surface before pads and strokes."""
        return None if self._ground is None else self._ground.base

    @property
    def bottom_heights_mm(self) -> FloatArray | None:
        """(n,) heights of the bottom below the top's vertices."""
        if self._ground is None or self.mesh is None:
            return None
        count = self._ground.top_count
        return self.mesh.vertices[count : 2 * count, 2]

    def values_everywhere(self, top: FloatArray, bottom: FloatArray) -> FloatArray:
        """Give numbers of the top's and the bottom's vertices to all vertices of the mesh."""
        assert self._ground is not None
        rim = self._ground.rim
        return np.concatenate([top, bottom, top[rim], bottom[rim]])

    @property
    def skins(self) -> tuple[TriangleMesh, TriangleMesh] | None:
        """Top (without pads) and bottom of the trimmed insole."""
        return None if self._ground is None else self._ground.skins

    @property
    def standing_foot(self) -> TriangleMesh | None:
        """The foot as the insole holds it: turned by the posting, on the least thickness."""
        design, foot = self._shown_design, self._case.foot
        if design is None or foot is None:
            return None
        key = (foot, posting_angles(design), design.least_thickness_mm)
        if self._standing is None or self._standing[0] != key:
            turned = posted_mesh(foot, *posting_angles(design))
            lift = design.least_thickness_mm - turned.vertices[:, 2].min()
            raised = replace(turned, vertices=turned.vertices + np.array([0, 0, lift]))
            self._standing = (key, raised)
        return self._standing[1]

    def height_mm(self, x_mm: float, y_mm: float) -> float:
        """Height of the contact surface, as near as the grid has it; 0 before there is one."""
        return float(self.heights_mm(np.array([x_mm, y_mm])))

    def heights_mm(self, xy: FloatArray) -> FloatArray:
        """Heights at places (..., 2), as near as the grid has them."""
        if self.contact is None:
            return np.zeros(xy.shape[:-1])
        field = self.contact
        inset = 1e-6 * field.step_mm
        low = np.array([field.x_mm[0], field.y_mm[0]]) + inset
        high = np.array([field.x_mm[-1], field.y_mm[-1]]) - inset
        return field.height_at(np.clip(xy, low, high))

    def covers(self, x_mm: float, y_mm: float) -> bool:
        """Whether the insole lies under a place."""
        field = self.contact
        if field is None:
            return False
        inside_x = field.x_mm[0] <= x_mm <= field.x_mm[-1]
        return bool(inside_x and field.y_mm[0] <= y_mm <= field.y_mm[-1])

    def _forget(self) -> None:
        self._jobs.cancel(CHANNEL)
        self._ground = self._shown_design = self._standing = None
        self.contact = self.mesh = self.normals = self.moved = None
        self._set_problem("")
        self.changed.emit()
        self._refresh()

    def _refresh(self) -> None:
        design, foot = self._case.shown.design, self._case.foot
        if design is None or foot is None:
            return
        try:
            check_design(design)
        except InsoleError as error:
            self._set_problem(str(error))
            return
        self._set_problem("")
        if self._has_ground(foot, design):
            if design != self._shown_design:
                self._move_pads(design)
        elif (kept := self._kept_ground(foot, design)) is not None:
            self._jobs.cancel(CHANNEL)
            self._ground = kept
            self._show_all(design)
        elif not self._jobs.is_running(CHANNEL):
            self._build_ground(foot, design)

    def _has_ground(self, foot: Foot, design: InsoleDesign) -> bool:
        return self._ground is not None and self._ground.key == _ground_key(foot, design)

    def _kept_ground(self, foot: Foot, design: InsoleDesign) -> BaseSolid | None:
        """Find what was built lately: the other foot, another variant, a step of undo."""
        key = _ground_key(foot, design)
        return next((ground for ground in self._kept if ground.key == key), None)

    def _build_ground(self, foot: Foot, design: InsoleDesign) -> None:
        def build(progress: Progress) -> BaseSolid:
            base = contact_base(foot, design, progress.part(0.0, 0.7))
            progress.step(0.7, "Trimming the insole")
            bare = without_added(design)
            solid = insole_solid(Insole(bare, foot, base.surface, base.measured))
            return BaseSolid.of(_ground_key(foot, design), base, solid)

        def take(ground: BaseSolid) -> None:
            self._ground = ground
            self._kept.insert(0, ground)
            del self._kept[KEPT_GROUNDS:]
            self._show_all(design)  # on the way, if need be: the picture follows the hand
            self._refresh()

        def fail(error: Exception) -> None:
            if not isinstance(error, InsoleError):
                raise error
            self._set_problem(str(error))

        self._jobs.start(CHANNEL, build, take, fail)

    def _show_all(self, design: InsoleDesign) -> None:
        """Begin with a new solid, and put pads and strokes onto it."""
        ground = self._ground
        assert ground is not None
        self._shown_design = design
        self.contact = apply_pads(ground.base, design)
        self.mesh = replace(ground.solid, vertices=ground.solid.vertices.copy())
        self.normals = ground.solid.vertex_normals.copy()
        rows, columns = self.contact.heights_mm.shape
        self._move_vertices(ground, Window(0, rows, 0, columns))
        self.moved = None
        self.changed.emit()

    def _move_pads(self, design: InsoleDesign) -> None:
        """Follow pads and strokes where they have changed."""
        ground = self._ground
        assert ground is not None
        assert self.contact is not None
        assert self._shown_design is not None
        change = moved_pad(ground.base, self.contact, self._shown_design, design)
        self._shown_design = design
        self.contact = change.surface
        self.moved = self._move_vertices(ground, change.window)
        self.changed.emit()

    def _move_vertices(self, ground: BaseSolid, window: Window) -> IntArray:
        assert self.contact is not None
        assert self.mesh is not None
        assert self.normals is not None
        moved = ground.vertices_in(window)
        xy = ground.solid.vertices[moved, :2]
        self.mesh.vertices[moved, 2] = self.contact.height_at(xy)
        self.normals[moved] = _normals_at(self.contact, window, xy)
        walls = 2 * ground.top_count + np.arange(len(ground.rim))
        self.mesh.vertices[walls, 2] = self.mesh.vertices[ground.rim, 2]
        self.mesh = TriangleMesh(self.mesh.vertices, self.mesh.triangles)
        return np.concatenate([moved, walls])

    def _set_problem(self, problem: str) -> None:
        if problem != self.problem:
            self.problem = problem
            self.failed.emit(problem)


def without_added(design: InsoleDesign) -> InsoleDesign:
    """Leave out the pads and strokes."""
    added = {correction.id for correction in added_corrections(design)}
    return replace(design, corrections=tuple(c for c in design.corrections if c.id not in added))


def _ground_key(foot: Foot, design: InsoleDesign) -> tuple[Any, ...]:
    return foot, base_key(design), design.outline, design.bottom


def _normals_at(field: HeightField, window: Window, xy: FloatArray) -> FloatArray:
    """Unit normals (n, 3) of a field at places near or in a window, from the nearest nodes."""
    rows, columns = field.heights_mm.shape
    if len(xy) == 0:
        return np.zeros((0, 3))
    first_row, first_column = max(window.first_row - 2, 0), max(window.first_column - 2, 0)
    end_row, end_column = min(window.end_row + 2, rows), min(window.end_column + 2, columns)
    part = field.heights_mm[first_row:end_row, first_column:end_column]
    along_y: FloatArray = np.gradient(part, field.step_mm, axis=0)
    along_x: FloatArray = np.gradient(part, field.step_mm, axis=1)
    column = np.rint((xy[:, 0] - field.x0_mm) / field.step_mm).astype(int) - first_column
    row = np.rint((xy[:, 1] - field.y0_mm) / field.step_mm).astype(int) - first_row
    i = np.clip(row, 0, part.shape[0] - 1), np.clip(column, 0, part.shape[1] - 1)
    normals = np.stack([-along_x[i], -along_y[i], np.ones(len(xy))], axis=1)
    return np.asarray(normals / np.sqrt(np.einsum("nc,nc->n", normals, normals))[:, None])
