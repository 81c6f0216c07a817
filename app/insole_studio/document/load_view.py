"""How load moves under the active foot: computed in the background while the insole is drawn."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

from PySide6.QtCore import QObject, Signal

from insole_core.cases.case_record import CaseRecord
from insole_core.contact.change import (
    Assumptions,
    Change,
    Loading,
    PressureChange,
    changed,
    pressure_change,
)
from insole_core.contact.change_report import change_lines
from insole_core.contact.designs import Shoe, left_out_of
from insole_core.contact.dose import Dose, DoseCurve, dose_curve, dosed, with_dose
from insole_core.contact.fit import Fitted, fit_tissue
from insole_core.contact.load_case import Posture
from insole_core.contact.stance import Ground, Sole, check_weight, notes_of_weight
from insole_core.errors import InsoleError
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.primitives.height_field import HeightField
from insole_core.insole.surface.pads_on_surface import apply_pads
from insole_core.messages import Message
from insole_core.pressure.laid_map import PressureMap
from insole_core.progress import Progress
from insole_core.recording.session import WEIGHT_BEARING
from insole_core.workflows.foot_landmarks import Marked, landmarks_of
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
    is_fitted
        Whether the tissue is fitted to the map that lies under the foot.
    is_both
        Whether the insole of the variant is told beside, each of both against a flat shoe.
    """

    weight_kg: float
    posture: Posture = Posture.STANDING
    variant: str = ""
    is_fitted: bool = False
    is_both: bool = False


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
    marked: Marked
    design: InsoleDesign
    contact: HeightField
    old_design: InsoleDesign | None
    shoe: Shoe
    weight_bearing: str
    laid: PressureMap | None
    is_at_rest: bool

    @cached_property
    def sole(self) -> Sole:
        return Sole.of(self.foot, landmarks=landmarks_of(self.marked))

    @cached_property
    def loading(self) -> Loading:
        return Loading(self.sole, self.question.weight_kg, self.question.posture)

    @property
    def knows_material(self) -> bool:
        return not self.shoe.assumed(self.design, self.old_design)

    def fitted(self, before: _Found | None, progress: Progress) -> Fitted | None:
        """Return what the map tells of the foot: as before, or fitted anew."""
        if self.laid is None:
            return None
        loading = self.loading
        if (
            before is not None
            and before.task.laid is self.laid
            and before.change.loading == loading
        ):
            return before.fitted
        return fit_tissue(loading, self.laid, progress)

    @property
    def beside(self) -> InsoleDesign | None:
        """What is told beside, against a flat shoe."""
        return self.old_design if self.question.is_both else None

    @property
    def base(self) -> InsoleDesign | None:
        """What the foot stood on before; None in a flat shoe."""
        return None if self.question.is_both else self.old_design

    def grounds(self, builder: InsoleBuilder) -> tuple[Ground, Ground]:
        if self.base is None:
            return self.shoe.floor(self.sole, self.design), self.new_ground
        return self._built(self.base, builder), self.new_ground

    def changed_beside(self, builder: InsoleBuilder, change: Change) -> Change | None:
        """Return the change from a flat shoe to the variant; None where it is not told beside."""
        design = self.beside
        if design is None:
            return None
        floor = self.shoe.floor(self.sole, design)
        return changed(change.loading, floor, self._built(design, builder), change.assumed, change)

    def _built(self, design: InsoleDesign, builder: InsoleBuilder) -> Ground:
        contact = builder.insole(self.foot, design).contact
        return self.shoe.insole(self.sole, design, contact)

    @property
    def new_ground(self) -> Ground:
        return self.shoe.insole(self.sole, self.design, self.contact)

    def is_drawn_after(self, other: _Task) -> bool:
        """Return whether a design is being drawn, and another task is of the step before.

        Also where the hand comes back to where it began: the design at rest is drawn there too.
        """
        is_drawn = not self.is_at_rest or (not other.is_at_rest and self.design != other.design)
        return is_drawn and self.asks_as(other)

    def asks_as(self, other: _Task) -> bool:
        """Return whether another task differs by no more than the design that is drawn."""
        return (
            self.loading == other.loading
            and self.question == other.question
            and self.old_design is other.old_design
            and self.shoe == other.shoe
            and self.laid is other.laid
        )


@dataclass(frozen=True, eq=False)
class _Found:
    """A change, what it was computed of, and the fit to a map that it was computed with."""

    change: Change
    task: _Task
    fitted: Fitted | None
    beside: Change | None

    def followed_to(self, task: _Task) -> _Found:
        """Return the change of a design that is being drawn, from that of the step before."""
        old = self.change.grounds[0]
        if task.base is None:
            old = task.shoe.floor(task.sole, task.design)
        change = changed(
            task.loading, old, task.new_ground, self.assumed, self.change, follows=True
        )
        return replace(self, change=change, task=task)

    @property
    def assumed(self) -> Assumptions:
        return Assumptions() if self.fitted is None else self.fitted.assumed


class LoadView(QObject):
    """The change of the pressure that is shown, and how sure it is.

    While something is dragged, each picture of it has its change, followed from that before; all
    else is computed in the background, and the limits once the hand rests.
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
        self._foot: Foot | None = None
        """Of which a change is shown or computed; None while nothing can be."""
        self._is_computing, self._is_late = False, False
        """Whether a change is being computed, and whether the insole has changed meanwhile."""
        self._found: _Found | None = None
        self.change: Change | None = None
        self.limits: PressureChange | None = None
        """None while they are computed."""
        self._untold: tuple[str, ...] = ()
        """Regions of which nothing could be told when the hand last rested."""
        self.limits_beside: PressureChange | None = None
        """Of the variant beside; None where there is none, and while they are computed."""
        self.curve: DoseCurve | None = None
        """By the target; None without one, and while it is computed."""
        self.dose: Dose | None = None
        """That reaches the target; None too where none on the curve does."""
        self.target: Target | None = None
        self._limited: _Found | None = None
        """Of what the limits were computed."""
        self._is_on_papers = False
        self._on_papers: tuple[_Task, PressureChange] | None = None
        """What was ticked, also once the window is closed."""
        self._problem = ""
        surface.changed.connect(self._refresh)
        surface.failed.connect(self.told)
        case.changed.connect(self._refresh)
        materials.changed.connect(self._refresh)

    def ask(self, question: LoadQuestion | None) -> None:
        """Compute the answer to a question from now on; None stops."""
        if question == self._question:
            return
        self._question = question
        self._drop()
        self._refresh()

    def aim(self, target: Target | None) -> None:
        """Compute by which dose a target is reached; None for none."""
        if target == self.target:
            return
        self.target, self.curve, self.dose = target, None, None
        self.told.emit()
        if self._limited is not None and not self._is_computing:
            self._find_dose(self._limited)

    @property
    def is_on_papers(self) -> bool:
        """Whether papers carry what is told."""
        return self._is_on_papers

    def put_on_papers(self, is_ticked: bool) -> None:
        """Let papers carry what is told of the change, or nothing."""
        self._is_on_papers, self._on_papers = is_ticked, None
        self._note_for_papers()

    def told_on_papers(self, record: CaseRecord) -> dict[Side, tuple[Message, ...]]:
        """Return what papers of a case carry; nothing of another foot or design than was ticked."""
        if self._on_papers is None:
            return {}
        task, told = self._on_papers
        feet = (foot for foot in record.feet if foot.foot is task.foot)
        return {foot.side: change_lines(told) for foot in feet if foot.design == task.design}

    def _note_for_papers(self) -> None:
        if self._is_on_papers and self._limited is not None and self.limits is not None:
            self._on_papers = self._limited.task, self.limits

    @property
    def problem(self) -> str:
        """Why nothing is told, or not all; empty if there is no reason."""
        return self._problem or ("" if self._question is None else self._surface.problem)

    @property
    def notes(self) -> tuple[Message, ...]:
        """What is assumed, and what has to be told of the scan."""
        record = self._case.record.current
        of_foot: tuple[Message, ...] = ()
        if self.change is not None and record is not None:
            of_sole = self.change.sole.notes
            of_weight = () if of_sole else notes_of_weight(record.source.said_weight)
            of_foot = *of_sole, *of_weight
        designs = self._case.shown.design, self._old_design()
        of_designs = *Shoe(self._materials.table).assumed(*designs), *left_out_of(*designs)
        return *of_foot, *of_designs

    @property
    def untold_target(self) -> Message:
        """Why nothing is told of the region that is aimed at, whatever the pad; else empty."""
        if self.target is None or self.limits is None:
            return Message("")
        return self.limits.regions[self.target.region].reason

    @property
    def fitted(self) -> Fitted | None:
        """What the map under the foot has told of it; None where it is not asked."""
        return None if self._found is None else self._found.fitted

    @property
    def is_both(self) -> bool:
        """Whether a variant is told beside, each of both against a flat shoe."""
        return self._question is not None and self._question.is_both

    def beside(self, design: InsoleDesign) -> Change | None:
        """Return the change of the variant beside; None for another design than is told."""
        found = self._found
        return None if found is None or found.task.beside != design else found.beside

    def untold_of(self, change: Change) -> tuple[str, ...]:
        """Return the regions that have no colour, as nothing can be told of them.

        Until limits are there, those stay without that had none: nobody shall aim by colours
        that go once the hand rests.
        """
        known = (self.limits, self.limits_beside)
        told = next((one for one in known if one is not None and one.change is change), None)
        return (*change.untold, *self._untold) if told is None else told.cannot_tell

    def _refresh(self) -> None:
        task = self._task()
        foot = None if task is None else task.foot
        if foot is not self._foot:
            self._drop()
            self._foot = foot
        found = self._found
        if task is None:
            return
        if found is not None and task.is_drawn_after(found.task):
            self._follow(found, task)
            if not task.is_at_rest:
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
        old = self._old_design()
        still = replace(contact, heights_mm=contact.heights_mm.copy())
        is_at_rest = case.shown is case.record and self._surface.is_current
        shoe = Shoe(self._materials.table)
        record = case.record.current
        weight = WEIGHT_BEARING[0] if record is None else record.source.weight_bearing
        is_fitted = record is not None and question.is_fitted
        laid = record.plantar.pressure if record is not None and is_fitted else None
        return _Task(
            question, foot, case.record, design, still, old, shoe, weight, laid, is_at_rest
        )

    def _old_design(self) -> InsoleDesign | None:
        """Return the design of the variant that is compared with; None for a flat shoe."""
        record, question = self._case.record.current, self._question
        if record is None or question is None:
            return None
        return next((one.design for one in record.variants if one.name == question.variant), None)

    def _follow(self, found: _Found, task: _Task) -> None:
        """Show the change of what is drawn at once: a job would wait for the pictures."""
        self._jobs.cancel(CHANNEL)
        self._is_computing = False
        try:
            followed, problem = found.followed_to(task), ""
        except InsoleError as error:
            followed, problem = None, str(error)
        if followed is not None and self.limits is None and not self._problem:
            self._take(followed)  # and nothing else is told than at the step before
        else:
            self._show(followed, problem)

    def _start(self, task: _Task) -> None:
        self._is_computing, self._is_late = True, False
        builder, before = self._surface.builder, self._found

        def compute(progress: Progress) -> _Found:
            check_weight(task.weight_bearing)
            old, new = task.grounds(builder)
            fitted = task.fitted(before, progress)
            assumed = Assumptions() if fitted is None else fitted.assumed
            start = None if before is None else before.change
            change = changed(task.loading, old, new, assumed, start)
            if before is not None and before.task.asks_as(task):
                beside = before.beside
            else:
                beside = task.changed_beside(builder, change)
            return _Found(change, task, fitted, beside)

        def take(found: _Found) -> None:
            self._is_computing = False
            self._show(found)
            self._go_on(found)

        def fail(error: Exception) -> None:
            self._is_computing = False
            problem = _sentence(error)
            self._show(None, problem)
            if self._is_late:
                self._refresh()

        self._jobs.start(CHANNEL, compute, take, fail)

    def _go_on(self, found: _Found) -> None:
        """Compute a newer insole, or the limits of this one."""
        if self._is_late:
            self._refresh()
        elif found.task.is_at_rest:
            self._find_limits(found)

    def _find_limits(self, found: _Found) -> None:
        task, beside = found.task, self.limits_beside

        def told_of(change: Change, progress: Progress) -> PressureChange:
            return pressure_change(
                change.loading,
                *change.grounds,
                material_is_known=task.knows_material,
                assumed=found.assumed,
                known=change,
                progress=progress,
            )

        def compute(progress: Progress) -> tuple[PressureChange, PressureChange | None]:
            if found.beside is None or beside is not None:
                return told_of(found.change, progress), beside
            own = told_of(found.change, progress.part(0.0, 0.5))
            return own, told_of(found.beside, progress.part(0.5, 1.0))

        def take(told: tuple[PressureChange, PressureChange | None]) -> None:
            self.limits, self.limits_beside = told
            self._untold = self.limits.cannot_tell
            self._limited = found
            self._note_for_papers()
            self.changed.emit()
            self.told.emit()
            self._find_dose(found)

        self._jobs.start(CHANNEL, compute, take, self._keep)

    def _find_dose(self, base_on: _Found) -> None:
        change, task = base_on.change, base_on.task
        target, base = self.target, self._surface.base
        pad = None if target is None else task.design.found(target.pad_id, Pelott)
        if target is None or pad is None or base is None or self.untold_target:
            return

        def ground(design: InsoleDesign) -> Ground:
            return task.shoe.insole(change.sole, design, apply_pads(base, design))

        def compute(progress: Progress) -> tuple[DoseCurve | None, Dose | None]:
            grounds = ((dose, ground(design)) for dose, design in dosed(task.design, pad))
            curve = dose_curve(
                change.loading,
                change,
                grounds,
                target.region,
                progress.part(0.0, 0.4),
                assumed=base_on.assumed,
            )
            height_mm = None if curve is None else curve.reaching(target.percent)
            if height_mm is None:
                return curve, None
            told = pressure_change(
                change.loading,
                change.grounds[0],
                ground(with_dose(task.design, pad, height_mm)),
                material_is_known=task.knows_material,
                assumed=base_on.assumed,
                progress=progress.part(0.4, 1.0),
            )
            return curve, Dose(height_mm, told.regions[target.region])

        def take(found: tuple[DoseCurve | None, Dose | None]) -> None:
            if target == self.target:
                self.curve, self.dose = found
                self.told.emit()

        self._jobs.start(CHANNEL, compute, take, self._keep)

    def _keep(self, error: Exception) -> None:
        """Say why there are no limits or no dose; what is known of the change stays."""
        self._problem = _sentence(error)
        self.told.emit()

    def _drop(self) -> None:
        """Show nothing, and let nothing that is computed arrive."""
        self._jobs.cancel(CHANNEL)
        self._is_computing, self._untold = False, ()
        self._show(None)

    def _show(self, found: _Found | None, problem: str = "") -> None:
        self.limits, self._problem = None, problem
        beside = None if found is None else found.beside
        if self.limits_beside is not None and self.limits_beside.change is not beside:
            self.limits_beside = None  # else they hold on: it is not what is being drawn
        self.curve, self.dose, self._limited = None, None, None
        self._take(found)
        self.told.emit()

    def _take(self, found: _Found | None) -> None:
        self._found, self.change = found, None if found is None else found.change
        self.changed.emit()


def _sentence(error: Exception) -> str:
    """Return what an error of the data says; a fault of the program is raised."""
    if not isinstance(error, InsoleError):
        raise error
    return str(error)
