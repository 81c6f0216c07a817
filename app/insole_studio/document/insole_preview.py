"""Keeps the insole of the open case up to date: pads at once, the rest in the background."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QObject, Signal

from insole_core.errors import InsoleError
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.build import Insole, check_design_for
from insole_core.insole.finishing.finished import FinishedSurface
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.primitives.height_field import HeightField
from insole_core.insole.surface.contact import ContactBase
from insole_core.progress import Progress
from insole_core.workflows.edited_insole import EditedInsole
from insole_core.workflows.insole_builder import BareInsole, InsoleBuilder
from insole_studio.document.case import Case
from insole_studio.jobs import Jobs

CHANNEL = "insole"


class InsolePreview(QObject):
    """The insole derived from the shown design, and the problem that prevents building it.

    A change of a pad is applied at once, and so is one of the finish while it is dragged; edges and
    walls follow exactly when the drag is over. The surface below is computed in the background;
    while that runs, newer requests wait, and only the newest is computed next.
    """

    changed = Signal()
    failed = Signal(object)
    """The problem has changed; empty if there is none any more."""

    def __init__(self, case: Case, jobs: Jobs, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._case = case
        self._jobs = jobs
        self._insole: EditedInsole | None = None
        self.builder = InsoleBuilder()
        """Shared by all that build insoles of the open case."""
        self.problem = ""
        case.closing.connect(self._let_go)
        case.opened.connect(self.builder.forget)
        case.foot_changed.connect(self._forget)
        case.changed.connect(self._refresh)
        case.preview_changed.connect(self._refresh)

    @property
    def is_current(self) -> bool:
        """Whether the shown insole matches the design completely."""
        design, foot = self._case.shown.design, self._case.foot
        if design is None or foot is None:
            return True
        insole = self._insole
        if insole is None or insole.bare.foot is not foot:
            return False
        return insole.design == design and insole.is_exact

    @property
    def base(self) -> ContactBase | None:
        """Return the contact surface before pads and strokes."""
        return None if self._insole is None else self._insole.base

    @property
    def finished(self) -> FinishedSurface | None:
        """Return how the contact surface was finished; None as scanned."""
        return None if self.base is None else self.base.finished

    @property
    def insole(self) -> Insole | None:
        """Return the finished insole; None while the shown one does not match its design."""
        design, foot, base = self._case.record.design, self._case.foot, self.base
        if design is None or foot is None or base is None or self._insole is None:
            return None
        if not self.is_current or self._case.shown.design is not design:
            return None
        return Insole(design, foot, self._insole.contact, base.measured, base.finished)

    @property
    def contact(self) -> HeightField | None:
        """Return the contact surface."""
        return None if self._insole is None else self._insole.contact

    @property
    def mesh(self) -> TriangleMesh | None:
        """Return the preview mesh; the next change of a pad modifies its vertices in place."""
        return None if self._insole is None else self._insole.mesh

    @property
    def closed_mesh(self) -> TriangleMesh | None:
        """Return the mesh as it is now, its walls joined to top and bottom."""
        return None if self._insole is None else self._insole.closed_mesh

    @property
    def normals(self) -> FloatArray | None:
        """Return the (n, 3) normals of the mesh's vertices."""
        return None if self._insole is None else self._insole.normals

    @property
    def moved(self) -> IntArray | None:
        """Return the vertices that the last change moved; None if the mesh was replaced."""
        return None if self._insole is None else self._insole.moved

    @property
    def bottom_heights_mm(self) -> FloatArray | None:
        """Return the (n,) heights of the bottom below the top's vertices."""
        return None if self._insole is None else self._insole.bottom_heights_mm

    @property
    def cover_mm(self) -> float:
        """Return the thickness of the cover, the uppermost layer; 0 without one."""
        return 0.0 if self._insole is None else self._insole.design.layers.cover_mm

    @property
    def skins(self) -> tuple[TriangleMesh, TriangleMesh] | None:
        """Return top (without pads) and bottom of the trimmed insole."""
        return None if self._insole is None else self._insole.skins

    @property
    def standing_foot(self) -> TriangleMesh | None:
        """Return the foot standing on the insole: turned by the posting, at the least thickness."""
        return None if self._insole is None else self._insole.standing_foot

    def values_everywhere(self, top: FloatArray, bottom: FloatArray) -> FloatArray:
        """Extend values at the top's and the bottom's vertices to all vertices of the mesh.

        Parameters
        ----------
        top, bottom : (n,)
            One value for each vertex.
        """
        assert self._insole is not None
        return self._insole.values_everywhere(top, bottom)

    def height_mm(self, x_mm: float, y_mm: float) -> float:
        """Return the height of the contact surface near a place; 0 before one exists.

        Parameters
        ----------
        x_mm, y_mm
            Place in the insole's plane.
        """
        return float(self.heights_mm(np.array([x_mm, y_mm])))

    def heights_mm(self, xy: FloatArray) -> FloatArray:
        """Return the heights of the contact surface near places (..., 2); 0 before one exists."""
        return np.zeros(xy.shape[:-1]) if self._insole is None else self._insole.heights_mm(xy)

    def covers(self, x_mm: float, y_mm: float) -> bool:
        """Return whether the insole covers a place.

        Parameters
        ----------
        x_mm, y_mm
            Place in the insole's plane.
        """
        return self._insole is not None and self._insole.covers(x_mm, y_mm)

    def _let_go(self) -> None:
        self._jobs.cancel(CHANNEL)
        self._insole = None
        self._set_problem("")
        self.changed.emit()

    def _forget(self) -> None:
        self._let_go()
        self._refresh()

    def _refresh(self) -> None:
        design, foot = self._case.shown.design, self._case.foot
        if design is None or foot is None:
            return
        try:
            check_design_for(foot, design)
        except InsoleError as error:
            self._set_problem(str(error))
            return
        insole = self._insole
        if insole is not None and insole.can_follow(foot, design):
            self._follow(insole, design)
            return
        if (bare := self.builder.known_bare(foot, design)) is not None:
            self._jobs.cancel(CHANNEL)
            self._show(bare, design)
            return
        if insole is not None and insole.can_follow_finish(foot, design):
            self._follow(insole, design)
            if self._case.shown is not self._case.record:
                return  # exactly only once the drag is over: meanwhile its hand has all the time
        if not self._jobs.is_running(CHANNEL):
            self._build(foot, design)

    def _follow(self, insole: EditedInsole, design: InsoleDesign) -> None:
        is_other = design != insole.design
        if is_other:
            insole.follow(design)
        is_settled = self._settle(insole)
        self._set_problem(insole.problem)
        if is_other or is_settled:
            self.changed.emit()

    def _show(self, bare: BareInsole, design: InsoleDesign) -> None:
        self._insole = EditedInsole(bare, design)
        self._settle(self._insole)
        self._set_problem(self._insole.problem)
        self.changed.emit()

    def _settle(self, insole: EditedInsole) -> bool:
        return self._case.shown is self._case.record and insole.settle()

    def _build(self, foot: Foot, design: InsoleDesign) -> None:
        def build(progress: Progress) -> BareInsole:
            return self.builder.bare(foot, design, progress)

        def take(bare: BareInsole) -> None:
            self._show(bare, design)  # on the way, if need be: the picture follows the pointer
            self._refresh()

        def fail(error: Exception) -> None:
            if not isinstance(error, InsoleError):
                raise error
            self._set_problem(str(error))
            if self._case.shown.design != design:
                self._refresh()  # a newer request has waited

        self._jobs.start(CHANNEL, build, take, fail)

    def _set_problem(self, problem: str) -> None:
        if problem != self.problem:
            self.problem = problem
            self.failed.emit(problem)
