"""Keeps the insole of the open case built: pads at once, everything heavier beside the window."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from PySide6.QtCore import QObject, Signal

from insole_core.errors import InsoleError
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.block import block_solid
from insole_core.insole.build import Insole, apply_pads
from insole_core.insole.contact import ContactBase, base_key, contact_base
from insole_core.insole.design import InsoleDesign
from insole_core.insole.height_field import HeightField
from insole_core.insole.limits import check_design
from insole_core.insole.posting import posted_mesh, posting_angles
from insole_core.progress import Progress
from insole_studio.jobs import Jobs
from insole_studio.workbench.case import Case

CHANNEL = "insole"


class InsoleSurface(QObject):
    """The surface derived from the shown design.

    Dragging a pad only adds pads to a base that is kept. A change of the base is computed in the
    background; while it runs, newer wishes wait, and only the newest is computed next.
    """

    changed = Signal()
    failed = Signal(str)

    def __init__(self, case: Case, jobs: Jobs, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._case = case
        self._jobs = jobs
        self._base: ContactBase | None = None
        self._base_of: tuple[Foot, tuple[float, ...]] | None = None
        self._block: TriangleMesh | None = None
        self._standing: tuple[tuple[object, ...], TriangleMesh] | None = None
        self._shown_design: InsoleDesign | None = None
        self.contact: HeightField | None = None
        self.mesh: TriangleMesh | None = None
        self.normals: FloatArray | None = None
        self.problem = ""
        case.opened.connect(self._forget)
        case.changed.connect(self._refresh)
        case.preview_changed.connect(self._refresh)

    @property
    def is_current(self) -> bool:
        """Whether what is shown is all that the design asks for."""
        design, foot = self._case.shown.design, self._case.foot
        if design is None or foot is None:
            return True
        return self._has_base(foot, design) and not self.problem

    @property
    def standing_foot(self) -> TriangleMesh | None:
        """The foot as the insole holds it: turned by the posting, on the least thickness."""
        design, foot = self._shown_design, self._case.foot
        if design is None or foot is None:
            return None
        key = (foot, posting_angles(design), design.thickness_mm)
        if self._standing is None or self._standing[0] != key:
            turned = posted_mesh(foot, *posting_angles(design))
            lift = design.thickness_mm - turned.vertices[:, 2].min()
            raised = replace(turned, vertices=turned.vertices + np.array([0, 0, lift]))
            self._standing = (key, raised)
        return self._standing[1]

    def _forget(self) -> None:
        self._jobs.cancel(CHANNEL)
        self._base = self._base_of = self._block = self._shown_design = None
        self.contact = self.mesh = self.normals = None
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
        if self._has_base(foot, design):
            if design != self._shown_design:
                self._add_pads(design)
        elif not self._jobs.is_running(CHANNEL):
            self._build_base(foot, design)

    def _has_base(self, foot: Foot, design: InsoleDesign) -> bool:
        return (
            self._base_of is not None
            and self._base_of[0] is foot
            and self._base_of[1] == base_key(design)
        )

    def _build_base(self, foot: Foot, design: InsoleDesign) -> None:
        def build(progress: Progress) -> tuple[ContactBase, TriangleMesh]:
            base = contact_base(foot, design, progress)
            bare = replace(design, corrections=())
            block = block_solid(Insole(bare, foot, base.surface, base.measured))
            _ = block.vertex_normals  # kept by the mesh: computed here, not in the window
            return base, block

        def take(built: tuple[ContactBase, TriangleMesh]) -> None:
            self._base, self._block = built
            self._base_of = (foot, base_key(design))
            wanted = self._case.shown.design
            if wanted is None or not self._has_base(foot, wanted):
                self._add_pads(design)  # on the way: the picture follows the hand
            self._refresh()

        def fail(error: Exception) -> None:
            if not isinstance(error, InsoleError):
                raise error
            self._set_problem(str(error))

        self._jobs.start(CHANNEL, build, take, fail)

    def _add_pads(self, design: InsoleDesign) -> None:
        assert self._base is not None
        assert self._block is not None
        self._shown_design = design
        self.contact = apply_pads(self._base, design)
        heights = self.contact.heights_mm.ravel()
        vertices = self._block.vertices.copy()
        vertices[: len(heights), 2] = heights
        self.mesh = TriangleMesh(vertices, self._block.triangles)
        self.normals = self._block.vertex_normals.copy()
        self.normals[: len(heights)] = self.contact.normals
        self.changed.emit()

    def _set_problem(self, problem: str) -> None:
        if problem != self.problem:
            self.problem = problem
            self.failed.emit(problem)

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
