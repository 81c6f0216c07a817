"""The design stage: the four panels of thesis 6.3.3, their presenters, and the linked cameras."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from insole_core.insole.clinic_rules import ClinicRules
from insole_core.workflows.pad_library import LibraryPad
from insole_studio.document.case import Case
from insole_studio.document.foot_display import FootDisplay
from insole_studio.document.insole_preview import InsolePreview
from insole_studio.document.load_view import LoadView
from insole_studio.document.material_model import MaterialModel
from insole_studio.document.plantar_view import PlantarView
from insole_studio.document.rim_model import RimModel
from insole_studio.document.section_plane import SectionModel
from insole_studio.document.side_by_side import Beside, SideBySide
from insole_studio.features.design.correction_names import place_text
from insole_studio.features.design.models.model_presenter import (
    FootPresenter,
    InsolePresenter,
    ModelPresenter,
    ShownModels,
)
from insole_studio.features.design.models.rim_presenter import RimPresenter
from insole_studio.features.design.models.section_presenter import SectionFollower, SectionPresenter
from insole_studio.features.design.models.view_lines import rear_lines
from insole_studio.features.design.parameters.parameters_presenter import ParametersPresenter
from insole_studio.features.design.parameters.parameters_view import ParametersView
from insole_studio.features.design.parameters.warnings_presenter import WarningsPresenter
from insole_studio.features.design.patient.measure_texts import ANGLES, place_of
from insole_studio.features.design.patient.patient_presenter import PatientPresenter
from insole_studio.features.design.patient.patient_view import PatientView
from insole_studio.features.design.tools.tool_controller import ToolController
from insole_studio.jobs import Jobs
from insole_studio.scene.pointer import PointerEvent
from insole_studio.scene.scene_view import GRAB_PX, TOUCH_GRAB_PX
from insole_studio.scene.view_camera import Preset, Subject, ViewCamera
from insole_studio.texts import localised, tr
from insole_studio.widgets.model_view import ModelView
from insole_studio.widgets.notice_bar import NoticeBar
from insole_studio.widgets.rim_chart import RimChart
from insole_studio.widgets.section_chart import SectionChart
from insole_studio.widgets.step_strip import StepStrip
from insole_studio.widgets.text_fields import is_typing


class DesignStage(QObject):
    """The panels of the design stage; the window only arranges them."""

    action_requested = Signal(str)
    pointed = Signal(str)
    hint_changed = Signal(str)
    section_wanted = Signal(bool)
    """Whether to show the section panel: a section exists, or its tool is chosen."""
    section_chosen = Signal()
    """The section has just been asked for: it comes before what else is shown in its place."""
    rim_wanted = Signal(bool)
    """Whether to show the graph of the rim: its tool is chosen."""

    def __init__(
        self,
        *,
        case: Case,
        jobs: Jobs,
        surface: InsolePreview,
        foot_display: FootDisplay,
        section: SectionModel,
        rim: RimModel,
        plantar: PlantarView,
        counterpart: SideBySide,
        tool_controller: ToolController,
        pads: Sequence[LibraryPad],
        rules: ClinicRules,
        dark: bool,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self.materials = MaterialModel()
        self.load = LoadView(case, surface, jobs, self.materials)
        shown = ShownModels(
            case, surface, section, tool_controller, counterpart, plantar, self.load
        )
        self._case = case
        self.preview = surface
        self.tool_controller = self._tool_controller = tool_controller
        self.counterpart = self._counterpart = counterpart
        self.pads = pads
        self.rules = rules
        self.rim_model = rim
        self.plantar = plantar
        self.cut = section
        self._was_asked = False, False
        """Whether the section followed the pointer, and whether its tool was taken."""
        self._shown_beside = Beside.NOTHING
        self.linked = True
        self.ask_size: Callable[[], float | None] | None = None
        """Asks for the size of a shoe that nothing proposes; None until it is set."""
        self._before_posting: dict[Subject, ViewCamera] = {}
        self._fit_when_shown = False
        self._keeps_focus = False
        """Whether the focus stays where the user is typing when a foot arrives."""
        self._fitted: dict[Subject, ViewCamera] = {}
        """The cameras set by `look` until the user moves one: they adapt to the views' size."""
        self._make_panels(dark)
        self.foot_presenter = FootPresenter(self.foot, shown, foot_display)
        self.insole_presenter = InsolePresenter(self.insole, shown)
        self._presenters: dict[Subject, tuple[ModelView, ModelPresenter]] = {
            Subject.FOOT: (self.foot, self.foot_presenter),
            Subject.INSOLE: (self.insole, self.insole_presenter),
        }
        self._present_panels(shown)
        self.section_follower = SectionFollower(section, tool_controller, self)
        for view, presenter in self._presenters.values():
            self._connect(view, presenter)
            rim.selection_changed.connect(presenter.show_marks)
        self._follow_changes(surface, section, rim)

    def _make_panels(self, dark: bool) -> None:
        """Construct the panels, and pass on what they ask for."""
        self.steps = StepStrip()
        self.patient = PatientView()
        self.patient.action_requested.connect(self.action_requested)
        self.patient.measure_chosen.connect(self.look_at_measure)
        self.notices = NoticeBar()
        self.parameters = ParametersView()
        self.section = SectionChart()
        self.rim = RimChart()
        self.foot = ModelView(Subject.FOOT, "", dark)
        self.insole = ModelView(Subject.INSOLE, tr("Insole"), dark)

    def _present_panels(self, shown: ShownModels) -> None:
        """Construct the presenters of the panels beside the views."""
        case, surface, tools = shown.case, shown.surface, shown.tool_controller
        self._patient_presenter = PatientPresenter(self.patient, case)
        self._warnings_presenter = WarningsPresenter(
            self.patient,
            case=case,
            surface=surface,
            tool_controller=tools,
            rules=self.rules,
            materials=self.materials,
            look_at=self.look_at,
        )
        self._parameters_presenter = ParametersPresenter(
            self.parameters,
            case,
            tools,
            self.pads,
            self.rules,
            rim=self.rim_model,
            plantar=self.plantar,
            materials=self.materials,
            request_action=self.action_requested.emit,
            ask_size=lambda: None if self.ask_size is None else self.ask_size(),
        )
        self._section_presenter = SectionPresenter(
            self.section,
            case=case,
            surface=surface,
            section=shown.section,
            tool_controller=tools,
        )
        self._rim_presenter = RimPresenter(
            self.rim, case=case, rim=self.rim_model, tool_controller=tools
        )

    def _follow_changes(self, surface: InsolePreview, section: SectionModel, rim: RimModel) -> None:
        """Update what the stage itself shows, besides its panels."""
        case, tool_changed = self._case, self._tool_controller.tool_changed
        case.leaving.connect(self._note_typing)
        case.opened.connect(self._fit_later)
        case.foot_changed.connect(self._fit_again)
        surface.changed.connect(self._fit_insole_once)
        self._counterpart.changed.connect(self._fit_counterpart)
        self._counterpart.failed.connect(self.insole.show_warning)
        for signal in (case.selection_changed, case.preview_changed, rim.selection_changed):
            signal.connect(self._show_hint)
        for signal in (tool_changed, case.changed):
            signal.connect(self._show_hint)
            signal.connect(self._forget_highlight)
        for signal in (section.changed, tool_changed):
            signal.connect(self._ask_for_section)
        section.changed.connect(self._show_hint)
        tool_changed.connect(self._show_rear)
        tool_changed.connect(self._ask_for_rim)

    @property
    def panels(self) -> tuple[QWidget, ...]:
        """The panels in reading order."""
        return (
            self.steps,
            self.notices,
            self.patient,
            self.insole,
            self.foot,
            self.parameters,
            self.rim,
            self.section,
        )

    def focus_view(self) -> None:
        """Give the keys to the foot; to the insole while the foot is hidden."""
        if self._case.foot is not None:  # else there is nothing that keys could act on
            shown = self.foot if self.foot.isVisible() else self.insole
            shown.scene.take_focus()

    def look(self, preset: Preset) -> None:
        """Show both subjects completely, from a preset direction."""
        for view, presenter in self._presenters.values():
            if presenter.whole_bounds_mm is not None:
                view.scene.set_camera(view.scene.aim_at(preset, presenter.whole_bounds_mm))
        if self.linked:
            self._link_to_larger()
        self._fitted = self._cameras() if self.linked else {}
        self._announce_cameras()

    def look_at(self, place_mm: tuple[float, float]) -> None:
        """Centre both views on a place (x, y), mm."""
        for view, presenter in self._presenters.values():
            self._fitted = {}
            there = np.array(presenter.place(*place_mm))
            view.scene.set_camera(view.scene.camera.centred(there))

    def look_at_measure(self, key: str) -> None:
        """Show where a measure is taken, and mark it on the foot until something changes."""
        if key == ANGLES:
            self.action_requested.emit("explain_angles")
            return
        found = place_of(key, self._case.record)
        if found is None:
            return
        points, preset = found
        self.look(preset)
        self._fitted = {}
        for view, _ in self._presenters.values():
            view.scene.set_camera(view.scene.camera.centred(points.mean(axis=0)))
        self.foot.show_highlight(points)

    def _forget_highlight(self) -> None:
        self.foot.show_highlight(np.empty((0, 3)))

    def fit(self) -> None:
        """Fit everything into the views, from the current direction."""
        self.look(self.foot.scene.camera.preset)

    def end_keys(self) -> None:
        """Finish the running keyboard gesture."""
        for view, _ in self._presenters.values():
            view.scene.keys.let_go()

    def set_linked(self, linked: bool) -> None:
        """Link the cameras of both views, or unlink them."""
        self.linked = linked
        if linked:
            self._follow_from(Subject.FOOT)

    def set_touch(self, touch: bool) -> None:
        """Set the size at which handles are grabbed, for touch or for a mouse."""
        for view, _ in self._presenters.values():
            view.scene.grab_px = TOUCH_GRAB_PX if touch else GRAB_PX
        self.rim.set_touch(touch)

    def set_dark(self, dark: bool) -> None:
        """Change the colour scheme of the scenes."""
        for view, presenter in self._presenters.values():
            view.scene.set_dark(dark)
            presenter.show_all()
        self.patient.renew_icons()

    def clear(self) -> None:
        """Take away what is shown of the case, and what was chosen for looking at it."""
        self._tool_controller.reset()
        self.section_follower.stop()
        self.cut.show(None)
        self._forget_highlight()
        for view, presenter in self._presenters.values():
            view.scene.keys.forget()
            view.scene.set_camera(ViewCamera())
            presenter.clear()
        for panel in (self.patient, self.parameters):
            panel.verticalScrollBar().setValue(0)
        self.pointed.emit("")

    def close(self) -> None:
        """Free the renderers."""
        self.section_follower.stop()
        for view, _ in self._presenters.values():
            view.scene.close_scene()

    def _connect(self, view: ModelView, presenter: ModelPresenter) -> None:
        view.scene.sink = presenter
        view.scene.start = presenter.start
        self._tool_controller.tool_changed.connect(view.scene.keys.forget)
        view.scene.camera_changed.connect(self._follow)
        view.scene.hovered.connect(self._point)
        view.scene.left.connect(self._point_nowhere)
        view.scene.missed.connect(self._tell_missed)
        view.preset_requested.connect(self.look)
        view.action_requested.connect(self.action_requested)
        presenter.show_all()

    def _follow(self, camera: ViewCamera) -> None:
        subject = next(
            subject
            for subject, (view, _) in self._presenters.items()
            if view.scene is self.sender()
        )
        if camera == self._fitted.get(subject):  # resized, not moved by the user
            self.fit()
            return
        self._fitted = {}
        if self.linked:
            self._follow_from(subject)

    def _follow_from(self, leader: Subject) -> None:
        """Look into the other view as into this one; what stands beside only one moves only it."""
        leading, at = self._presenters[leader]
        for view, presenter in self._presenters.values():
            if view is not leading:
                focal = np.asarray(leading.scene.camera.focal_mm) - at.aside_mm
                view.scene.set_camera(leading.scene.camera.centred(focal + presenter.aside_mm))

    def _link_to_larger(self) -> None:
        """Set one camera for both views that shows the larger subject completely."""
        cameras = {
            subject: view.scene.camera
            for subject, (view, presenter) in self._presenters.items()
            if presenter.bounds_mm is not None
        }
        if cameras:
            self._follow_from(max(cameras, key=lambda subject: cameras[subject].height_mm))

    def _cameras(self) -> dict[Subject, ViewCamera]:
        return {subject: view.scene.camera for subject, (view, _) in self._presenters.items()}

    def _show_rear(self) -> None:
        """Look from behind while the rearfoot is posted: from below no axis can be read."""
        if self._tool_controller.tool.key == "posting":
            has_axis = rear_lines(self._case.record) is not None
            if has_axis and self.foot.scene.camera.preset is Preset.PLANTAR:
                self._before_posting = self._cameras()
                self.look(Preset.POSTERIOR)
        else:
            before, self._before_posting = self._before_posting, {}
            if self.foot.scene.camera.preset is Preset.POSTERIOR:
                self._fitted = {}
                for subject, camera in before.items():
                    self._presenters[subject][0].scene.set_camera(camera)
                self._announce_cameras()

    def _fit_later(self) -> None:
        self._fit_when_shown = True
        self._before_posting = {}
        self.look(Preset.PLANTAR)
        if not self._keeps_focus:
            self.focus_view()
        self._show_hint()

    def _note_typing(self) -> None:
        self._keeps_focus = is_typing()

    def _fit_again(self) -> None:
        """Fit the views to another foot, unless the user has moved them."""
        self._fit_when_shown = self._fit_when_shown or bool(self._fitted)
        self._fit_insole_once()

    def _fit_insole_once(self) -> None:
        if self._fit_when_shown and self.insole_presenter.bounds_mm is not None:
            self._fit_when_shown = False
            self.fit()

    def _fit_counterpart(self) -> None:
        """Fit the views when another counterpart is shown; not what the user looks at closely."""
        kind = self._counterpart.kind
        is_there = kind is Beside.NOTHING or self._counterpart.built is not None
        if is_there and (self._fitted or kind is not self._shown_beside):
            self._shown_beside = kind
            self.fit()

    def _announce_cameras(self) -> None:
        for view, _ in self._presenters.values():
            view.show_scale()

    def _ask_for_section(self) -> None:
        is_asked = self.cut.follows, self._tool_controller.tool.key == "section"
        self.section_wanted.emit(self.cut.plane is not None or any(is_asked))
        if any(now and not before for now, before in zip(is_asked, self._was_asked, strict=True)):
            self.section_chosen.emit()
        self._was_asked = is_asked

    def _ask_for_rim(self) -> None:
        self.rim_wanted.emit(self._tool_controller.tool.key == "rim")

    def _show_hint(self) -> None:
        hint = self._tool_controller.tool.hint(self._case) if self._case.foot is not None else ""
        self.hint_changed.emit(hint)

    def _point(self, event: PointerEvent) -> None:
        self.pointed.emit(self._describe(event))
        self.section_follower.point(event)
        view, _ = self._presenters[event.subject]
        grabbed = next((h for h in view.scene.handles if h.name == event.handle), None)
        if grabbed is not None and not self._tool_controller.is_busy:
            self.hint_changed.emit(grabbed.hint)
        else:
            self._show_hint()

    def _tell_missed(self) -> None:
        """Say how to turn the view: with a tool in the hand, a drag that misses does not."""
        self.hint_changed.emit(
            tr("Nothing to drag here; the right button turns the view, and so does Orbit (O)")
        )

    def _point_nowhere(self) -> None:
        self.pointed.emit("")
        self._show_hint()

    def _describe(self, event: PointerEvent) -> str:
        """Say a place by the names that fields have for it."""
        side = self._case.shown.side
        if event.surface_mm is None or side is None:
            return ""
        x, y, z = event.surface_mm
        return f"{place_text(side, x, y)}   {tr('Height')} {localised(z)} mm"
