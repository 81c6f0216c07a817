"""How load moves under the active foot: computed in the background while the insole is drawn."""

from __future__ import annotations

from dataclasses import dataclass, replace

from PySide6.QtCore import QObject, Signal

from insole_core.contact.change import (
    Assumptions,
    Change,
    Loading,
    PressureChange,
    changed,
    pressure_change,
)
from insole_core.contact.designs import Shoe
from insole_core.contact.dose import DoseCurve, dose_curve, dosed
from insole_core.contact.load_case import Posture
from insole_core.contact.stance import Ground, Sole
from insole_core.errors import InsoleError
from insole_core.foot.foot import Foot
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.primitives.height_field import HeightField
from insole_core.insole.surface.pads_on_surface import apply_pads
from insole_core.progress import Progress
from insole_core.workflows.insole_builder import InsoleBuilder
from insole_studio.document.case import Case
from insole_studio.document.insole_preview import InsolePreview
from insole_studio.document.material_model import MaterialModel
from insole_studio.jobs import Jobs

CHANNEL = "load"


@dataclass(frozen=True)
class LoadQuestion:
    """What is asked.

    Parameters
    ----------
    weight_kg
        Of the person.
    posture
    variant
        Whose insole the foot stood on before; empty for a flat shoe.
    """

    weight_kg: float
    posture: Posture = Posture.STANDING
    variant: str = ""


@dataclass(frozen=True)
class Target:
    """A change that is asked for, of a region, by the height of a pad.

    Parameters
    ----------
    pad_id
    region
        One of `GROUPS`.
    percent
    """

    pad_id: str
    region: str
    percent: float


@dataclass(frozen=True, eq=False)
class _Task:
    """Everything that a computation reads, as it was when it began."""

    question: LoadQuestion
    foot: Foot
    design: InsoleDesign
    contact: HeightField
    old_design: InsoleDesign | None
    shoe: Shoe
    is_at_rest: bool

    def loading(self) -> Loading:
        return Loading(Sole.of(self.foot), self.question.weight_kg, self.question.posture)

    def grounds(self, builder: InsoleBuilder) -> tuple[Ground, Ground]:
        sole, old = Sole.of(self.foot), self.old_design
        after = self.shoe.insole(sole, self.design, self.contact)
        if old is None:
            return self.shoe.floor(sole, self.design), after
        return self.shoe.insole(sole, old, builder.insole(self.foot, old).contact), after


class LoadView(QObject):
    """The change of the pressure that is shown, and how sure it is.

    While something is dragged, the newest insole is computed next, without limits; these follow
    once the hand rests.
    """

    changed = Signal()
    told = Signal()
    """What is told of regions, or why nothing is, has changed."""

    def __init__(
        self, case: Case, surface: InsolePreview, jobs: Jobs, materials: MaterialModel
    ) -> None:
        super().__init__()
        self._case, self._surface = case, surface
        self._jobs, self._materials = jobs, materials
        self._question: LoadQuestion | None = None
        self._is_computing, self._is_late = False, False
        """Whether a change is being computed, and whether the insole has changed meanwhile."""
        self.change: Change | None = None
        self.limits: PressureChange | None = None
        """None while they are computed."""
        self.curve: DoseCurve | None = None
        """By the target; None without one, and while it is computed."""
        self._target: Target | None = None
        self._limited: tuple[_Task, Change] | None = None
        """Of what the limits were computed."""
        self.problem = ""
        surface.changed.connect(self._refresh)
        case.changed.connect(self._refresh)
        materials.changed.connect(self._refresh)

    def ask(self, question: LoadQuestion | None) -> None:
        """Compute the answer to a question from now on; None stops."""
        if question == self._question:
            return
        self._question = question
        self._jobs.cancel(CHANNEL)
        self._is_computing = False
        self._show(None)
        self._refresh()

    def aim(self, target: Target | None) -> None:
        """Compute by which dose a target is reached; None for none."""
        if target == self._target:
            return
        self._target, self.curve = target, None
        self.told.emit()
        if self._limited is not None:
            self._find_dose(*self._limited)

    @property
    def names_material(self) -> bool:
        """Whether the design says what it is made of."""
        design = self._case.shown.design
        return design is not None and Shoe(self._materials.table).knows_material(design)

    def _refresh(self) -> None:
        task = self._task()
        if task is None:
            return
        if self._is_computing:
            self._is_late = True
        else:
            self._start(task)

    def _task(self) -> _Task | None:
        case, contact, question = self._case, self._surface.contact, self._question
        foot, design = case.foot, case.shown.design
        if question is None or foot is None or design is None or contact is None:
            return None
        record = case.record.current
        variants = () if record is None else record.variants
        old = next((one.design for one in variants if one.name == question.variant), None)
        still = replace(contact, heights_mm=contact.heights_mm.copy())
        is_at_rest = case.shown is case.record and self._surface.is_current
        shoe = Shoe(self._materials.table)
        return _Task(question, foot, design, still, old, shoe, is_at_rest)

    def _start(self, task: _Task) -> None:
        self._is_computing, self._is_late = True, False
        builder, before = self._surface.builder, self._of_same_sole(task)

        def compute(_progress: Progress) -> Change:
            old, new = task.grounds(builder)
            return changed(task.loading(), old, new, Assumptions(), before)

        def take(change: Change) -> None:
            self._is_computing = False
            self._show(change)
            self._go_on(task, change)

        self._jobs.start(CHANNEL, compute, take, self._refuse)

    def _go_on(self, task: _Task, change: Change) -> None:
        """Compute a newer insole, or the limits of this one."""
        if self._is_late:
            self._refresh()
        elif task.is_at_rest:
            self._find_limits(task, change)

    def _find_limits(self, task: _Task, change: Change) -> None:
        builder = self._surface.builder

        def compute(progress: Progress) -> PressureChange:
            old, new = task.grounds(builder)
            known = task.shoe.knows_material(task.design)
            return pressure_change(
                task.loading(), old, new, material_is_known=known, known=change, progress=progress
            )

        def take(told: PressureChange) -> None:
            self.limits, self._limited = told, (task, change)
            self.told.emit()
            self._find_dose(task, change)

        self._jobs.start(CHANNEL, compute, take, self._refuse)

    def _find_dose(self, task: _Task, change: Change) -> None:
        target, base = self._target, self._surface.base
        pad = None if target is None else task.design.found(target.pad_id, Pelott)
        if target is None or pad is None or base is None:
            return

        def compute(progress: Progress) -> DoseCurve | None:
            sole = Sole.of(task.foot)
            grounds = (
                (dose, task.shoe.insole(sole, design, apply_pads(base, design)))
                for dose, design in dosed(task.design, pad)
            )
            return dose_curve(task.loading(), change, grounds, target.region, progress)

        def take(curve: DoseCurve | None) -> None:
            self.curve = curve
            self.told.emit()

        self._jobs.start(CHANNEL, compute, take, self._refuse)

    def _of_same_sole(self, task: _Task) -> Change | None:
        change = self.change
        return change if change is not None and change.sole.foot is task.foot else None

    def _refuse(self, error: Exception) -> None:
        self._is_computing = False
        if not isinstance(error, InsoleError):
            raise error
        self._show(None, str(error))
        if self._is_late:
            self._refresh()

    def _show(self, change: Change | None, problem: str = "") -> None:
        self.change, self.limits, self.problem = change, None, problem
        self.curve, self._limited = None, None
        self.changed.emit()
        self.told.emit()
