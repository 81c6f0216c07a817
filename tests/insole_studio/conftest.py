"""What the tests of the window share: a foot, an application, its record, a check for leaks."""

from __future__ import annotations

import gc
import threading
from collections import defaultdict
from collections.abc import Callable, Iterator
from functools import cache, partial
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pyrage
import pytest
from canned_questions import CannedQuestions
from coarse_designs import begin_coarse
from found_once import SharedResults, share_results
from hands import MANUAL, MANUAL_SIZE, SMALL_SIZE, Hands
from one_window import OneWindow
from postgres_server import PostgresServer, binaries, running_server
from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot
from stations import begin_migrated, keep_quickly, migrated_database

from benchmarks._measure import resident_mb
from insole_core.cases.scan_source import ScanSource
from insole_core.evaluation.report_files import WRITERS, write_json
from insole_core.foot import foot as foot_module
from insole_core.foot.foot import Foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.records import records as open_module
from insole_core.records.records import Records
from insole_studio.app.bootstrap import Application, build_application, qt_application
from insole_studio.app.scripted import ScriptedWindow, export_at_stage
from insole_studio.features.design.models import model_presenter
from insole_studio.features.export import export_actions
from insole_studio.scene.canvas import ImageCanvas
from insole_studio.settings import Settings, save_settings
from insole_studio.texts import load_language, translate_core_message
from insole_studio.user_paths import UserPaths
from tests.patience import PATIENCE_MS

LENGTH_MM = 250.0
MOST_MB = 1000.0
"""Of a process between two modules, half of it what it imports."""
KEPT_BYTES = 24_000_000
"""Of a kind that is derived from a foot: a quarter of what the product keeps."""
MAKE_FILE = open_module._make_file


@cache  # what the core keeps of a foot, its landmarks and its sole, then serves every test
def plantar_foot(side: Side) -> Foot:
    """A sole of 80 × 250 mm that faces the ground, its arch on the medial side only."""
    x, y = np.meshgrid(np.linspace(-40, 40, 41), np.linspace(0, LENGTH_MM, 126))
    medial = side.medial_sign * x / 40
    arch = 12 * np.exp(-(((y - 110) / 40) ** 2)) * np.clip(medial, 0, 1)
    vertices = np.stack([x.ravel(), y.ravel(), arch.ravel()], axis=1)
    index = np.arange(x.size, dtype=np.int32).reshape(x.shape)
    a, b = index[:-1, :-1].ravel(), index[:-1, 1:].ravel()
    c, d = index[1:, 1:].ravel(), index[1:, :-1].ravel()
    triangles = np.concatenate([np.stack([a, c, b], 1), np.stack([a, d, c], 1)])
    colors = np.full(vertices.shape, (220, 180, 160), dtype=np.uint8)
    return Foot(side, TriangleMesh(vertices, triangles, colors), np.eye(4), LENGTH_MM)


@pytest.fixture(scope="session")
def kept() -> SharedResults:
    return SharedResults()


@pytest.fixture(scope="module", autouse=True)
def same_results(kept: SharedResults) -> Iterator[None]:
    """Let the core find and make the same things once for all tests, until they take too much."""
    with pytest.MonkeyPatch.context() as patch:
        share_results(kept, patch, [(model_presenter, "contour_lines")], [export_actions])
        patch.setattr(foot_module, "_MOST_BYTES", KEPT_BYTES)
        yield
    if resident_mb() > MOST_MB:
        kept.forget()
        plantar_foot.cache_clear()


@pytest.fixture(scope="session", autouse=True)
def quick_records(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Let a new record begin as a copy of one whose tables are made already, and keep quickly."""
    content = migrated_database(tmp_path_factory.mktemp("migrated")).read_bytes()
    with pytest.MonkeyPatch.context() as patch:
        begin_migrated(patch, content)
        keep_quickly(patch)
        yield


@pytest.fixture
def unmade_tables(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a new record begin empty, as in the product, which makes its tables."""
    monkeypatch.setattr(open_module, "_make_file", MAKE_FILE)


@pytest.fixture
def forget_results(kept: SharedResults) -> Callable[[], None]:
    """For tests that watch how something is found or made."""
    return kept.forget


@pytest.fixture(scope="session")
def undraw_reports() -> Callable[[pytest.MonkeyPatch], None]:
    """Let reports hold their numbers only; drawing takes longer than most calibrations."""

    def undraw(patch: pytest.MonkeyPatch) -> None:
        for suffix in (".html", ".pdf"):
            patch.setitem(WRITERS, suffix, write_json)

    return undraw


@pytest.fixture
def undrawn_reports(undraw_reports, monkeypatch: pytest.MonkeyPatch) -> None:
    """For tests that say nothing of how a report looks."""
    undraw_reports(monkeypatch)


@pytest.fixture
def quick_passphrases(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a passphrase open a key in no time: age makes it as slow as a second on any machine."""
    known: dict[str, pyrage.x25519.Identity] = defaultdict(pyrage.x25519.Identity.generate)

    def encrypt(content: bytes, phrase: str) -> bytes:
        return pyrage.encrypt(content, [known[phrase].to_public()])

    def decrypt(content: bytes, phrase: str) -> bytes:
        return pyrage.decrypt(content, [known[phrase]])

    monkeypatch.setattr(pyrage, "passphrase", SimpleNamespace(encrypt=encrypt, decrypt=decrypt))


@pytest.fixture(autouse=True)
def no_leaks(shared_window: OneWindow | None) -> Iterator[None]:
    """No widget and no thread survives its test, but for a window that its module shares."""
    before = set(threading.enumerate())
    gc.collect()  # else the freeze keeps forever what the test before has left in a cycle
    gc.freeze()  # what was there before need not be looked through again: collecting is quick
    gc.disable()  # as in the product, where nothing is collected in the midst of an event
    yield
    gc.enable()
    if QApplication.instance() is not None:
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        gc.collect()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        widgets = [
            widget
            for widget in QApplication.topLevelWidgets()
            if shared_window is None or not shared_window.holds(widget)
        ]
        names = [f"{type(widget).__name__} {widget.windowTitle()!r}" for widget in widgets]
        for widget in widgets:  # so that what one test leaves is not told by each after it
            widget.deleteLater()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        assert names == []
    if shared_window is not None:  # its threads end with it
        return
    left = [thread.name for thread in set(threading.enumerate()) - before if thread.is_alive()]
    assert [name for name in left if name.startswith("studio-job")] == []


@pytest.fixture(scope="session")
def qapp_cls() -> Callable[[list[str]], QApplication]:
    """Let Qt's application be made as the product makes it."""
    return lambda _arguments: qt_application()


@pytest.fixture
def qtbot(qtbot: QtBot) -> QtBot:
    """Let Qt's bot wait as long as all tests do, and not five seconds only."""
    for name in ("waitUntil", "waitSignal", "waitExposed"):
        setattr(qtbot, name, partial(getattr(qtbot, name), timeout=PATIENCE_MS))
    return qtbot


@pytest.fixture(autouse=True)
def undrawn(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let scenes draw only where a test asks for their picture, or is marked as drawn.

    Without GL a picture takes longer than all that it shows.
    """
    if request.node.get_closest_marker("drawn") is None:
        monkeypatch.setattr(ImageCanvas, "render_now", aim_only)


@pytest.fixture
def coarse(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let designs begin with a coarse grid, unless a test is marked as fine.

    What a window or a command does with an insole is the same.
    """
    if request.node.get_closest_marker("fine") is None:
        begin_coarse(monkeypatch)


def aim_only(canvas: ImageCanvas) -> None:
    """Do all of drawing but the pixels."""
    if canvas.plotter is not None and canvas.isVisible():
        canvas.aim()


@pytest.fixture
def swedish(qapp: QApplication) -> Iterator[Callable[[str], str]]:
    """Let the window speak Swedish; gives what says a message of the core so."""
    load_language(qapp, "sv")
    yield translate_core_message
    load_language(qapp, "en")


@pytest.fixture(scope="module")
def one_window(tmp_path_factory: pytest.TempPathFactory) -> Iterator[OneWindow]:
    """The window of all tests of a module that are marked to share it."""
    window = OneWindow(tmp_path_factory.mktemp("window"))
    yield window
    window.close()


@pytest.fixture
def shared_window(request: pytest.FixtureRequest, one_window: OneWindow) -> OneWindow | None:
    """The window of the module, for a test that shares it; for another one it is closed."""
    marks, used = {mark.name for mark in request.node.iter_markers()}, set(request.fixturenames)
    # What draws, or speaks another language, does so from its start.
    is_alone = marks & {"own_window", "drawn"} or "swedish" in used
    if "one_window" in marks and "app" in used and not is_alone:
        return one_window
    one_window.close()
    return None


@pytest.fixture
def paths(tmp_path: Path, shared_window: OneWindow | None) -> UserPaths:
    if shared_window is not None:
        return shared_window.paths
    return UserPaths(tmp_path / "config" / "settings.json", tmp_path / "data" / "autosave")


@pytest.fixture(scope="session")
def make_foot() -> Callable[[Side], Foot]:
    return plantar_foot


@pytest.fixture
def small_session() -> Path:
    return Path(__file__).parents[1] / "data" / "sessions" / "left_small.zip"


@pytest.fixture
def questions() -> CannedQuestions:
    return CannedQuestions()


@pytest.fixture
def app(
    qapp: QApplication,
    qtbot: QtBot,
    paths: UserPaths,
    questions: CannedQuestions,
    shared_window: OneWindow | None,
    coarse: None,
) -> Iterator[Application]:
    """The whole application on an empty case, shown."""
    if shared_window is not None:
        yield shared_window.take(questions)
        shared_window.put_back()
        return
    built = build_application(qapp, paths)
    built.services.messages.questions = questions  # type: ignore[assignment]
    built.window.resize(960, 640)  # fewer pixels for the software renderer
    built.window.show()
    qtbot.waitExposed(built.window)
    yield built
    for dialog in list(built.services.messages.dialogs):
        dialog.done(0)
    built.autosave.forget()
    built.close()


@pytest.fixture
def hands(qapp: QApplication, paths: UserPaths, coarse: None) -> Iterator[Hands]:
    """A user before the empty window."""
    if MANUAL:  # its folder is named after its language, but for the English one
        language = "sv" if Path(MANUAL).name == "sv" else "en"
        save_settings(Settings(language=language), paths.settings_file)
    with ScriptedWindow(paths, MANUAL_SIZE if MANUAL else SMALL_SIZE) as studio:
        yield Hands(studio)


@pytest.fixture
def settle(qtbot: QtBot, app: Application) -> Callable[[], None]:
    """Wait until all background work is done and delivered."""

    def wait() -> None:
        qtbot.waitUntil(lambda: not (app.jobs.is_running() or app.autosave.is_writing))

    return wait


@pytest.fixture
def export(app: Application, questions: CannedQuestions) -> Callable[[Path], Path]:
    """Order at the export stage what it offers, and give the one file of the solid."""

    def order(path: Path) -> Path:
        questions.path = path
        (written,) = export_at_stage(app)
        return written

    return order


@pytest.fixture
def opened(app: Application, settle: Callable[[], None]) -> Application:
    """The application with a left foot on the bench and its insole built."""
    app.case.open_foot(plantar_foot(Side.LEFT), ScanSource("mesh", "/nowhere/foot.ply", "0" * 64))
    settle()
    return app


@pytest.fixture
def clinic(app: Application, qtbot: QtBot) -> Application:
    """The application on its start page, with a new record."""
    record = app.services.clinic
    app.window.resize(1366, 768)
    app.features.records.show_start()
    record.open()
    qtbot.waitUntil(lambda: record.is_open)
    return app


@pytest.fixture
def records(clinic: Application) -> Records:
    """The record that the window has open, to look into it from outside."""
    return clinic.services.clinic.ask_now(lambda found: found)


@pytest.fixture
def rest(qtbot: QtBot, clinic: Application) -> Callable[[], None]:
    """Wait until the record and the window have nothing left to do."""

    def is_at_rest() -> bool:
        all_jobs = (
            clinic.services.clinic.jobs,
            clinic.jobs,
            clinic.features.clinic.backups.jobs,
        )
        return not any(jobs.is_running() for jobs in all_jobs)

    def wait() -> None:
        qtbot.waitUntil(is_at_rest)

    return wait


@pytest.fixture(scope="session")
def postgres() -> Iterator[PostgresServer]:
    """A server for the whole session."""
    if binaries() is None:
        pytest.skip("PostgreSQL is not installed")
    with running_server() as server:
        yield server


@pytest.fixture
def postgres_url(postgres: PostgresServer) -> Iterator[str]:
    """The address of an empty database of this test alone."""
    postgres.execute("CREATE DATABASE records")
    yield postgres.url("records")
    postgres.execute("DROP DATABASE records WITH (FORCE)")
