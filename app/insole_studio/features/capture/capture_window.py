"""The capture stage in a window of its own, and the action that opens it."""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal

from insole_core.errors import UsageError
from insole_core.records.visit import VisitSummary
from insole_studio.acquisition.capture_plan import parse_assignment
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.services.action_record import ActionRecord
from insole_studio.services.app_services import AppServices
from insole_studio.services.person_list import name_and_birth, visit_time_text
from insole_studio.services.stage_window import StageWindow
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_studio.features.capture.stage import CaptureStage

log = logging.getLogger(__name__)
CAPTURE_ACTIONS: tuple[ActionRecord[CaptureWindow], ...] = (
    ActionRecord(
        "capture",
        lambda: tr("Capture…"),
        lambda: tr("Capture a foot with the sensors"),
        lambda window, _on: window.open(),
        icon="capture",
        shortcut="Ctrl+Shift+C",
    ),
)


class CaptureWindow(StageWindow["CaptureStage"]):
    """Opens the capture stage; the sensors are switched off when it closes.

    A capture interrupted by closing keeps its finished views. Captured sessions are passed on after
    the window has closed: those of both feet of a visit, one after the other.
    """

    captured = Signal(object)
    """The path of a captured session."""
    captured_for = Signal(str, object)
    """The visit of the work list that a session was captured for, and the session's path."""

    def __init__(self, services: AppServices, source: SensorSource) -> None:
        super().__init__(services.window)
        self._services = services
        self._source = source
        self._waiting: list[Path] = []
        self._names: dict[str, str] = {}
        """Of the visits that were listed since the stage was opened."""
        services.keeper.moved.connect(self._move)

    def make_stage(self) -> CaptureStage:
        """Create the stage with the last assignment of views, and start the sensors."""
        from insole_studio.features.capture.stage import CaptureStage

        # Emulated sensors take the views of their recording.
        emulated = self._source.emulate is not None
        questions = self._services.messages.questions
        return CaptureStage(
            source=self._source,
            assignment=() if emulated else self._remembered_views(),
            folder=self._services.paths.data_folder,
            remember=(lambda _assignment: None) if emulated else self._remember_views,
            ask=lambda stage, sentence: questions.on(stage).use_unfinished(sentence),
        )

    def connect_stage(self, stage: CaptureStage) -> None:
        """Collect the captured sessions until the stage is closed."""
        stage.kept.connect(self._keep)
        stage.closed.connect(self.hand_on)
        self._names.clear()
        self._services.clinic.changed.connect(self._list_work)
        self._list_work()

    def _keep(self, path: Path) -> None:
        """Keep a session to be opened; one of another visit is only stored with it."""
        visit_id = "" if self.stage is None else self.stage.view.visit_id
        if visit_id and visit_id != self._services.keeper.visit_id:
            self.captured_for.emit(visit_id, path)
        else:
            self._waiting.append(path)

    def _move(self, before: str, visit_id: str) -> None:
        """Capture for the visit that has taken the place of a lost one, if that was chosen."""
        if self.stage is not None and before in self._names:
            self._names[visit_id] = self._names.pop(before)
            self.stage.view.move_visit(before, visit_id)

    def _list_work(self) -> None:
        """Show whose feet wait to be captured, if the clinic's record can be asked."""
        clinic = self._services.clinic
        if self.stage is not None and clinic.is_open:
            clinic.ask(
                "capture-work-list",
                lambda records: records.visits.work_list(),
                self._show_work,
                self._services.messages.show_error,
            )

    def _show_work(self, waiting: Sequence[VisitSummary]) -> None:
        if self.stage is None:
            return
        kept = self._services.case.kept
        open_here = self._services.keeper.visit_id
        visits = [("", tr("Nobody of the work list"))]
        if kept is not None:
            self._names[kept.visit.id] = kept.person.name
            visits.append((kept.visit.id, tr("{name} (open here)").format(name=kept.person.name)))
        others = [visit for visit in waiting if visit.id != open_here]
        times = Counter(visit.person_id for visit in others)
        for visit in others:
            name = name_and_birth(visit.person_name, visit.birth_date)
            if times[visit.person_id] > 1:
                name = tr("{name}, visit of {time}").format(name=name, time=visit_time_text(visit))
            self._names[visit.id] = name
            visits.append((visit.id, name))
        chosen = self.stage.view.visit_id
        if chosen not in dict(visits):  # captured once: the other foot is of the same patient
            visits.append((chosen, self._names[chosen]))
        only = others[0].id if len(others) == 1 else ""
        self.stage.view.show_visits(visits, open_here or only)

    def hand_on(self) -> None:
        """Pass on the next waiting session, if any."""
        if self._waiting:
            self.captured.emit(self._waiting.pop(0))

    def end_merging(self) -> None:
        """Begin a new step of undo with the next gesture."""
        if self.stage is not None:
            self.stage.presenter.end_merging()

    def forget_waiting(self) -> None:
        """Pass on nothing that waits: it belongs to a case that is left."""
        self._waiting.clear()

    def close(self) -> None:
        """Close the stage at the end of the program; nothing is passed on."""
        self.forget_waiting()
        super().close()

    def _remember_views(self, assignment: Sequence[tuple[str, str]]) -> None:
        views = [f"{view}={serial}" for view, serial in assignment]
        self._services.settings.capture_views = views

    def _remembered_views(self) -> tuple[tuple[str, str], ...]:
        try:
            return parse_assignment(self._services.settings.capture_views)
        except UsageError as error:
            log.warning("the views of the sensors are forgotten: %s", error)
            return ()
