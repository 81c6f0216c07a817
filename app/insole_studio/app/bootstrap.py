"""The composition root: the one place that constructs long-lived objects."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType

from PySide6.QtCore import QSize, Qt, QTimer
from PySide6.QtGui import QIcon
from PySide6.QtWidgets import QApplication

from insole_core.errors import OutputError
from insole_core.geometry.side import Side
from insole_core.messages import Message, joined
from insole_core.resources import resource_path
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.acquisition.tunings import TUNING_FILE, Tunings
from insole_studio.acquisition.warm_up import WARM_UP_FILE
from insole_studio.app.actions import ACTIONS
from insole_studio.app.appearance import Appearance
from insole_studio.app.application_events import ApplicationEvents
from insole_studio.app.between_events import GarbageCollection, Preload
from insole_studio.app.crash_reports import CrashReports
from insole_studio.app.features import Features, make_features
from insole_studio.app.graphics import can_draw, prepare_software_rendering, share_contexts
from insole_studio.app.help_actions import HelpActions
from insole_studio.app.key_reference import key_sections
from insole_studio.app.main_controller import MainController
from insole_studio.app.main_window import MainWindow
from insole_studio.app.status_bar import StatusBar
from insole_studio.app.theme import apply_theme
from insole_studio.app.window_actions import WindowFeature
from insole_studio.document.autosave import Autosave
from insole_studio.document.case import Case
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.document.hand_over import HandOver
from insole_studio.document.journal import find_recovered
from insole_studio.document.record_keeper import RecordKeeper
from insole_studio.document.record_location import RecordLocation
from insole_studio.document.record_maintenance import ErasedLeftovers, RecordMaintenance
from insole_studio.features.design.design import make_design_stage
from insole_studio.features.design.pad_menu import pad_menu
from insole_studio.features.design.stage import DesignStage
from insole_studio.jobs import Jobs
from insole_studio.log_file import log_to
from insole_studio.native_heap import return_freed_memory
from insole_studio.services.app_services import AppServices, is_dark
from insole_studio.services.files import LastFolders, RecentFiles
from insole_studio.services.user_messages import Notices, UserMessages
from insole_studio.settings import Settings, load_settings
from insole_studio.stop_signals import STOP_SIGNALS, is_switched_off
from insole_studio.texts import load_language
from insole_studio.user_paths import UserPaths
from insole_studio.widgets.screen_room import bounded
from insole_studio.widgets.text_fields import commit_typed_text

DEFAULT_SIZE = (1366, 768)
SIGNAL_POLL_MS = 200
CANNOT_DRAW = 3
"""Exit code of a program without 3-D views, which was left or started anew."""


@dataclass(frozen=True, eq=False)
class Application:
    """All objects that live as long as the window."""

    services: AppServices
    features: Features
    main: WindowFeature
    controller: MainController
    autosave: Autosave
    hand_over: HandOver
    maintenance: RecordMaintenance
    complaints: list[Message]
    """What was set aside at the start because it could not be read, to be told to the user."""
    events: ApplicationEvents

    @property
    def case(self) -> Case:
        """The open case."""
        return self.services.case

    @property
    def jobs(self) -> Jobs:
        """The background jobs."""
        return self.services.jobs

    @property
    def settings(self) -> Settings:
        """The settings kept between two starts."""
        return self.services.settings

    @property
    def window(self) -> MainWindow:
        """The main window."""
        return self.main.window

    @property
    def stage(self) -> DesignStage:
        """The panels of the main window."""
        return self.features.design.stage

    def recover(self) -> None:
        """Take up the work that programs which no longer run have left unsaved."""
        found = find_recovered(self.services.paths.autosave_folder, self.complaints.append)
        self.hand_over.take([left for left in found if left.visit is not None])
        self.features.case_files.recovery.offer([left for left in found if left.visit is None])

    def close(self) -> None:
        """Keep unsaved work, stop the threads, free the renderers, save the settings."""
        commit_typed_text()
        self.autosave.keep_now()  # sensors and threads may take longer than a shutdown waits
        self.events.close()
        self.features.close_windows()
        self.hand_over.close()
        self.features.records.close()
        self.maintenance.close()
        self.services.clinic.close()
        self.jobs.close()
        self.autosave.close()
        self.features.case_files.close()
        self.stage.close()
        self.services.save_settings()
        self.window.close_for_good()
        self.window.deleteLater()


def build_application(
    application: QApplication, paths: UserPaths, emulate: Path | None = None
) -> Application:
    """Construct the window and everything behind it; nothing is shown yet.

    Parameters
    ----------
    application
        The running Qt application.
    paths
        The files and folders of the user.
    emulate
        Recorded session to play back as live sensors; None uses the real ones.
    """
    garbage = GarbageCollection()  # first: it may not collect in the midst of what follows
    complaints: list[Message] = []
    settings = load_settings(paths.settings_file, complaints.append)
    load_language(application, settings.language)
    dark = is_dark(settings.theme)
    apply_theme(application, dark, settings.touch)
    case, jobs = Case(), Jobs()
    # Once all that listens has let go of the case before.
    case.opened.connect(return_freed_memory, Qt.ConnectionType.QueuedConnection)
    stage = make_design_stage(case, jobs, dark)
    window = _make_window(stage, jobs)
    garbage.setParent(window)
    case.opened.connect(garbage.leave_case)
    location = RecordLocation(
        paths.records_folder, settings.record_database, settings.record_contents
    )
    clinic = ClinicRecord(location, Jobs(window), window, had_accounts=settings.record_had_accounts)
    autosave = Autosave(case, Jobs(window), paths.autosave_folder)
    recent = RecentFiles(settings, window)
    services = AppServices(
        case=case,
        clinic=clinic,
        keeper=RecordKeeper(case, clinic, autosave, window),
        jobs=jobs,
        window=window,
        messages=UserMessages(window, LastFolders(settings)),
        notices=Notices(stage.notices, window),
        recent=recent,
        settings=settings,
        paths=paths,
        leftovers=ErasedLeftovers(paths, settings, recent.changed.emit),
    )
    # The end of the session, of which systems without signals tell in this way.
    application.commitDataRequest.connect(autosave.keep_now, Qt.ConnectionType.DirectConnection)
    source = SensorSource(
        SensorStore(paths.sensors_folder),
        emulate,
        warm_up_file=paths.sensors_folder / WARM_UP_FILE,
        tunings=Tunings(paths.sensors_folder / TUNING_FILE),
    )
    features = make_features(services, stage, autosave, source)
    main = WindowFeature(
        window,
        Appearance(services, window, stage),
        HelpActions(services, window, features, key_sections),
    )
    controller = MainController(services, features, main, autosave)
    if not _show_settings(main, settings, dark):
        complaints.append(
            Message("The arrangement of the window is damaged, so it has its usual one.")
        )
    hand_over = HandOver(clinic, paths.autosave_folder, window)
    controller.connect_hand_over(hand_over)
    maintenance = RecordMaintenance(clinic, services.leftovers, window)
    events = ApplicationEvents(application)  # last: making a window sends thousands of events
    events.help_requested.connect(main.help.show_manual_about)
    events.gesture_began.connect(case.end_merging)
    events.gesture_began.connect(features.foot.end_merging)
    events.gesture_began.connect(features.capture.end_merging)
    return Application(
        services, features, main, controller, autosave, hand_over, maintenance, complaints, events
    )


def _make_window(stage: DesignStage, jobs: Jobs) -> MainWindow:
    status = StatusBar(jobs)
    stage.pointed.connect(status.show_place)
    stage.hint_changed.connect(status.show_hint)
    return MainWindow(stage, status, pad_menu(stage.pads), ACTIONS)


def _show_settings(main: WindowFeature, settings: Settings, dark: bool) -> bool:
    """Show the settings; return whether the arrangement of the window was intact."""
    window = main.window
    window.check_action("contours", True)
    window.check_action("dark", dark)
    window.check_action("touch", settings.touch)
    window.check_action("software_rendering", settings.software_rendering)
    window.check_action(f"language_{settings.language}", True)
    main.appearance.set_touch(settings.touch)
    window.resize(bounded(window, QSize(*DEFAULT_SIZE)))
    window.arrange()
    return window.restore_layout(settings.window_geometry, settings.window_docks)


def run_application(
    paths: Sequence[Path],
    user_paths: UserPaths | None = None,
    side: Side | None = None,
    emulate: Path | None = None,
) -> int:
    """Open the window and the first of the given paths; return when the user closes the window.

    Parameters
    ----------
    paths
        Cases, sessions or meshes; only the first is opened.
    user_paths
        By default those of the current user.
    side
        Side of a mesh; the user is asked if it is None.
    emulate
        Recorded session to play back as live sensors.

    Returns
    -------
    int
        The exit code.
    """
    if user_paths is None:
        user_paths = UserPaths.of_user()
        user_paths.make_private()
    is_software = prepare_software_rendering(user_paths)
    qt = qt_application()
    qt.setQuitOnLastWindowClosed(False)  # the controller decides: saving may take a moment
    if not can_draw(qt, user_paths, is_software=is_software):
        return CANNOT_DRAW
    app = build_application(qt, user_paths, emulate)
    opener = app.features.case_files.opener
    crashes = CrashReports(user_paths.crashes_folder)
    crashes.begin()
    sys.excepthook = _show_unexpected(app.services.messages, crashes)
    app.controller.closed.connect(qt.quit)
    app.features.records.show_start()
    app.window.show()
    Preload(app.window)
    app.recover()
    crashes.offer(app.services)
    app.main.help.offer_news()
    QTimer.singleShot(0, app.window, app.services.clinic.open)
    try:
        user_paths.check_writable()
    except OutputError as error:
        app.complaints.append(
            Message("Neither settings nor unsaved work can be kept: {reason}", reason=error.message)
        )
    if app.complaints:
        app.services.messages.show_sentence(joined(app.complaints, " "))
    app.features.records.sample.add_at_first_start()
    app.main.help.offer_tour()
    app.events.file_requested.connect(lambda name: opener.open_path(Path(name), None))
    if paths:
        QTimer.singleShot(0, app.window, lambda: opener.open_path(paths[0], side))
    _quit_on_signals(qt)
    try:
        with log_to(user_paths.log_file):
            return int(qt.exec())
    finally:
        sys.excepthook = sys.__excepthook__
        app.close()
        crashes.end()


def qt_application() -> QApplication:
    """Return the running Qt application, or create it."""
    running = QApplication.instance()
    if isinstance(running, QApplication):
        return running
    share_contexts()
    application = QApplication(sys.argv[:1])
    application.setApplicationName("Insole Studio")
    application.setApplicationDisplayName("Insole Studio")
    application.setDesktopFileName("insole-studio")
    application.setWindowIcon(QIcon(str(resource_path("icons/insole-studio.svg"))))
    return application


def _quit_on_signals(qt: QApplication) -> None:
    """Quit on Ctrl-C and the like; the autosaved case is offered at the next start."""
    for number in STOP_SIGNALS:
        if not is_switched_off(number):
            signal.signal(number, lambda number, _frame: qt.exit(128 + number))
    # Inside Qt's event loop Python handles signals only when the interpreter gets to run.
    turn = QTimer(qt)
    turn.timeout.connect(lambda: None)
    turn.start(SIGNAL_POLL_MS)


def _show_unexpected(
    messages: UserMessages, crashes: CrashReports
) -> Callable[[type[BaseException], BaseException, TracebackType | None], None]:
    """Return an exception hook that reports uncaught exceptions, those of slots included."""

    def hook(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        sys.__excepthook__(kind, error, trace)
        if isinstance(error, Exception):
            crashes.write(error)
            messages.show_error(error)

    return hook
