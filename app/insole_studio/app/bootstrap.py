"""The composition root: the one place that constructs long-lived objects."""

from __future__ import annotations

import logging
import signal
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import TracebackType

import platformdirs
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication

from insole_core.errors import OutputError, UsageError
from insole_core.geometry.side import Side
from insole_core.insole.prescription.clinic_rules import load_rules
from insole_core.reconstruct import RegistrationLimits
from insole_core.solids.shop import read_shop
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_core.workflows.clinic_export_rules import ClinicExportRules
from insole_core.workflows.last_order import LastOrder
from insole_core.workflows.pad_library import load_pads
from insole_studio.acquisition.capture_plan import parse_assignment
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.app.action_context import ActionContext
from insole_studio.app.appearance import Appearance
from insole_studio.app.help_actions import HelpActions
from insole_studio.app.key_reference import key_sections
from insole_studio.app.keyboard_navigation import KeyboardNavigation
from insole_studio.app.main_controller import MainController
from insole_studio.app.main_window import MainWindow
from insole_studio.app.status_bar import StatusBar
from insole_studio.app.theme import apply_theme, is_dark
from insole_studio.document.autosave import Autosave, find_recovered
from insole_studio.document.case import Case
from insole_studio.document.insole_preview import InsolePreview
from insole_studio.document.section_plane import SectionModel
from insole_studio.document.side_by_side import SideBySide
from insole_studio.features.calibrate.stage import CalibrateStage
from insole_studio.features.capture.capture_window import CaptureWindow
from insole_studio.features.capture.stage import CaptureStage
from insole_studio.features.case_files.open_actions import OpenActions
from insole_studio.features.case_files.save_actions import SaveActions
from insole_studio.features.case_files.scan_monitor import ScanMonitor
from insole_studio.features.compare.stage import CompareStage
from insole_studio.features.design.actions.edit_actions import EditActions
from insole_studio.features.design.actions.feet_actions import FeetActions
from insole_studio.features.design.actions.measure_actions import MeasureActions
from insole_studio.features.design.actions.prescriber_setting import PrescriberSetting
from insole_studio.features.design.actions.prescription_actions import PrescriptionActions
from insole_studio.features.design.actions.repeat_actions import RepeatActions
from insole_studio.features.design.actions.side_by_side_actions import SideBySideActions
from insole_studio.features.design.actions.variant_actions import VariantActions
from insole_studio.features.design.correction_names import pad_text
from insole_studio.features.design.stage import DesignStage
from insole_studio.features.design.tools.brush_tool import BrushTool
from insole_studio.features.design.tools.free_hand_tool import FreeHandTool
from insole_studio.features.design.tools.key_point_tool import KeyPointTool
from insole_studio.features.design.tools.orbit_tool import OrbitTool
from insole_studio.features.design.tools.outline_tool import OutlineTool
from insole_studio.features.design.tools.pelott_tool import PelottTool
from insole_studio.features.design.tools.plane_tool import PlaneTool
from insole_studio.features.design.tools.posting_tool import PostingTool
from insole_studio.features.design.tools.section_tool import SectionTool
from insole_studio.features.design.tools.tool import Tool
from insole_studio.features.design.tools.tool_controller import ToolController
from insole_studio.features.design.tools.turn_tool import TurnTool
from insole_studio.features.export.export_actions import AskPath, ExportActions, MayReplace
from insole_studio.features.export.stage import ExportStage
from insole_studio.features.foot.foot_window import FootWindow
from insole_studio.features.foot.stage import ReconstructStage
from insole_studio.jobs import Jobs
from insole_studio.services.app_services import AppServices
from insole_studio.services.notices import Notices
from insole_studio.services.recent_files import RecentFiles
from insole_studio.services.stage_window import StageWindow
from insole_studio.services.user_messages import UserMessages
from insole_studio.settings import Settings, load_settings, save_settings
from insole_studio.texts import load_language

log = logging.getLogger(__name__)

APPLICATION = "insole-studio"
DEFAULT_SIZE = (1366, 768)


@dataclass(frozen=True)
class UserPaths:
    """Where the application keeps what it remembers."""

    settings_file: Path
    autosave_folder: Path

    @property
    def data_folder(self) -> Path:
        """Holds calibrated sensors, drafts of captures, and captured sessions."""
        return self.autosave_folder.parent

    @classmethod
    def of_user(cls) -> UserPaths:
        """Give the places of this user on this platform."""
        config = platformdirs.user_config_path(APPLICATION, appauthor=False)
        data = platformdirs.user_data_path(APPLICATION, appauthor=False)
        return cls(config / "settings.json", data / "autosave")


@dataclass(frozen=True, eq=False)
class Application:
    """Everything that lives as long as the window."""

    studio: MainController
    window: MainWindow
    stage: DesignStage
    case: Case
    surface: InsolePreview
    tool_controller: ToolController
    jobs: Jobs
    autosave: Autosave
    settings: Settings
    places: UserPaths

    def close(self) -> None:
        """Stop the threads, free the renderers, remember the settings."""
        self.studio.rooms.capture.close()
        self.studio.rooms.exporting.close()
        self.studio.rooms.compare.close()
        self.studio.rooms.foot.close()
        self.jobs.close()
        self.autosave.close()
        self.stage.close()
        _remember(self.settings, self.places.settings_file)
        self.window.close_for_good()
        self.window.deleteLater()


def build_application(
    application: QApplication, places: UserPaths, emulate: Path | None = None
) -> Application:
    """Construct the window and everything behind it; nothing is shown yet.

    Parameters
    ----------
    application
    places
    emulate
        A recorded session that plays as live sensors; None for the real ones.
    """
    settings = load_settings(places.settings_file)
    load_language(application, settings.language)
    dark = is_dark(settings.theme)
    apply_theme(application, dark, settings.touch)
    jobs = Jobs()
    case = Case()
    surface = InsolePreview(case, jobs)
    counterpart = SideBySide(case, jobs, surface.builder)
    section, pads, rules = SectionModel(), load_pads(), load_rules()
    tool_controller = ToolController(case, make_tools(section))
    stage = DesignStage(
        case=case,
        surface=surface,
        section=section,
        counterpart=counterpart,
        tool_controller=tool_controller,
        pads=pads,
        rules=rules,
        dark=dark,
    )
    status = StatusBar(jobs)
    window = MainWindow(stage, status, [pad_text(pad) for pad in pads])
    autosave = Autosave(case, jobs, places.autosave_folder)
    stage.pointed.connect(status.show_place)
    stage.hint_changed.connect(status.show_hint)
    status.cancel_requested.connect(jobs.cancel)
    remember = partial(_remember, settings, places.settings_file)
    messages, recent = UserMessages(window), RecentFiles(settings, window)
    services = AppServices(case, jobs, messages, Notices(stage.notices, window))
    saving = SaveActions(services, recent)
    place = SensorSource(_sensor_store(places), emulate)
    feet = FeetActions(case)
    foot = FootWindow(partial(_make_foot_stage, settings, jobs, messages))
    rooms = ActionContext(
        window=window,
        stage=stage,
        messages=messages,
        opening=OpenActions(
            services,
            recent=recent,
            saving=saving,
            autosave=autosave,
            reconstruct=foot.open_session,
        ),
        saving=saving,
        exporting=ExportActions(services, partial(_make_export, settings, places, case), window),
        editing=EditActions(case, tool_controller),
        navigating=KeyboardNavigation(case, stage, tool_controller),
        prescribing=PrescriptionActions(
            case, tool_controller, pads, rules.pelott_usual_behind_heads_mm, messages
        ),
        measuring=MeasureActions(case, messages),
        feet=feet,
        variants=VariantActions(case, messages),
        comparing=SideBySideActions(case, stage, counterpart),
        repeating=RepeatActions(services, recent, feet, window),
        authorship=PrescriberSetting(case, settings, messages, remember),
        notices=services.notices,
        appearance=Appearance(
            frame=window,
            stage=stage,
            settings=settings,
            messages=messages,
            remember=remember,
            parent=window,
        ),
        guide=HelpActions(window, stage, settings, remember, key_sections),
        capture=CaptureWindow(partial(_make_capture, settings, places, place)),
        calibrate=StageWindow(
            partial(
                CalibrateStage, _sensor_store(places), place, places.data_folder / "calibrations"
            )
        ),
        compare=StageWindow(lambda: CompareStage(case, is_dark(settings.theme))),
        foot=foot,
    )
    ScanMonitor(services, window)
    studio = MainController(
        rooms=rooms,
        window=window,
        case=case,
        tool_controller=tool_controller,
        autosave=autosave,
        settings=settings,
        recent=recent,
    )
    window.check_action("contours", True)
    window.check_action("dark", dark)
    window.check_action("touch", settings.touch)
    window.check_action(f"language_{settings.language}", True)
    rooms.appearance.set_touch(settings.touch)
    window.resize(*DEFAULT_SIZE)
    window.arrange()
    window.restore_layout(settings.window_geometry, settings.window_docks)
    return Application(
        studio, window, stage, case, surface, tool_controller, jobs, autosave, settings, places
    )


def _sensor_store(places: UserPaths) -> SensorStore:
    return SensorStore(places.data_folder / "sensors")


def _make_capture(settings: Settings, places: UserPaths, place: SensorSource) -> CaptureStage:
    """Take the sensors into use, with the views they had last time."""

    def remember(assignment: Sequence[tuple[str, str]]) -> None:
        settings.capture_views = [f"{view}={serial}" for view, serial in assignment]

    return CaptureStage(
        place=place,
        # Emulated sensors have the views of their recording.
        assignment=() if place.emulate else _remembered_views(settings),
        folder=places.data_folder,
        remember=(lambda _assignment: None) if place.emulate else remember,
    )


def _make_foot_stage(settings: Settings, jobs: Jobs, messages: UserMessages) -> ReconstructStage:
    """Begin with the limits of last time."""

    def remember(limits: RegistrationLimits) -> None:
        settings.largest_residual_mm = limits.residual_mm
        settings.largest_reprojection_px = limits.reprojection_px
        settings.largest_displacement_mm = limits.displacement_mm

    return ReconstructStage(
        jobs=jobs,
        limits=RegistrationLimits(
            residual_mm=settings.largest_residual_mm,
            reprojection_px=settings.largest_reprojection_px,
            displacement_mm=settings.largest_displacement_mm,
        ),
        remember=remember,
        ask=partial(_ask_to_open, messages),
        dark=is_dark(settings.theme),
        touch=settings.touch,
    )


def _ask_to_open(messages: UserMessages, sentence: str) -> bool:
    return messages.questions.open_anyway(sentence)


def _remembered_views(settings: Settings) -> tuple[tuple[str, str], ...]:
    try:
        return parse_assignment(settings.capture_views)
    except UsageError as error:
        log.warning("the views of the sensors are forgotten: %s", error)
        return ()


def _make_export(
    settings: Settings, places: UserPaths, case: Case, ask_path: AskPath, may_replace: MayReplace
) -> ExportStage:
    shop, folder = read_shop(), places.settings_file.parent
    return ExportStage(
        case=case,
        rules=ClinicExportRules(folder / "export.json"),
        shop=shop,
        ask_path=ask_path,
        may_replace=may_replace,
        memory=LastOrder(folder / "order.json", shop),
        dark=is_dark(settings.theme),
    )


def make_tools(section: SectionModel) -> tuple[Tool, ...]:
    """Give one of every tool."""
    return (
        OrbitTool(),
        KeyPointTool(),
        TurnTool(),
        PelottTool(),
        FreeHandTool(),
        PostingTool(),
        OutlineTool(),
        BrushTool(),
        PlaneTool(),
        SectionTool(section),
    )


def _remember(settings: Settings, path: Path) -> None:
    """Write the settings; a place that cannot be written costs a warning only."""
    try:
        save_settings(settings, path)
    except OutputError as error:
        log.warning("the settings are not remembered: %s", error)


def run_application(
    paths: Sequence[Path],
    places: UserPaths | None = None,
    side: Side | None = None,
    emulate: Path | None = None,
) -> int:
    """Open the window, then the paths, and stay until the user closes.

    Parameters
    ----------
    paths
        Of which the first is opened: a case, a session or a mesh.
    places
        By default those of the user.
    side
        Of a mesh; asked for where it is not given.
    emulate
        A recorded session that plays as live sensors.

    Returns
    -------
    int
        The exit code.
    """
    qt = qt_application()
    qt.setQuitOnLastWindowClosed(False)  # the studio says when: saving may take a moment
    app = build_application(qt, places or UserPaths.of_user(), emulate)
    sys.excepthook = _show_unexpected(app.studio)
    app.studio.closed.connect(qt.quit)
    app.window.show()
    for recovered in find_recovered(app.places.autosave_folder)[:1]:
        app.studio.rooms.opening.offer_recovered(recovered)
    if not app.settings.tour_seen:
        QTimer.singleShot(0, app.window, app.studio.rooms.guide.begin_tour)
    if paths:
        QTimer.singleShot(0, app.window, lambda: app.studio.rooms.opening.open_path(paths[0], side))
    _quit_on_signals(qt)
    try:
        return int(qt.exec())
    finally:
        sys.excepthook = sys.__excepthook__
        app.close()


def qt_application() -> QApplication:
    """Give the running application of Qt, or begin it."""
    running = QApplication.instance()
    if isinstance(running, QApplication):
        return running
    application = QApplication(sys.argv[:1])
    application.setApplicationName("Insole Studio")
    application.setApplicationDisplayName("Insole Studio")
    return application


def _quit_on_signals(qt: QApplication) -> None:
    """End on SIGTERM and Ctrl-C; the case stays in the autosave folder and is offered again."""
    for name in (signal.SIGTERM, signal.SIGINT):
        signal.signal(name, lambda _number, _frame: qt.quit())
    # Inside Qt's loop Python only handles a signal when it gets a turn.
    turn = QTimer(qt)
    turn.timeout.connect(lambda: None)
    turn.start(200)


def _show_unexpected(
    studio: MainController,
) -> Callable[[type[BaseException], BaseException, TracebackType | None], None]:
    """Show an exception that nobody caught: no slot may lose one."""

    def hook(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        sys.__excepthook__(kind, error, trace)
        if isinstance(error, Exception):
            studio.rooms.messages.show_error(error)

    return hook
