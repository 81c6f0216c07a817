"""Walk the journeys of the manual in the real window, by real events, and keep what is seen."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

import numpy as np
from dialog_pictures import fill_record, open_record, shown_windows
from hand import HANDS, Keys, pixel
from PySide6.QtCore import QElapsedTimer, QEventLoop, QPoint, Qt, QTimer
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractItemView,
    QApplication,
    QDialog,
    QFileDialog,
    QLineEdit,
    QPushButton,
    QToolButton,
    QWidget,
)

from insole_core.cases.case_file import read_case
from insole_core.formats.ply import write_ply
from insole_core.insole.elements import Pelott, Posting
from insole_core.resources import resource_path
from insole_core.workflows.foot_landmarks import metatarsal_line
from insole_studio.app.scripted import ScriptedWindow, wait_for
from insole_studio.document.case_lock import take_lock
from insole_studio.document.journal import find_recovered
from insole_studio.features.import_scan.import_dialog import ImportDialog
from insole_studio.features.records.patient_dialogs import NewPatientDialog
from insole_studio.languages import Language
from insole_studio.services.questions import Questions
from insole_studio.settings import Settings, Theme, save_settings
from insole_studio.texts import tr
from insole_studio.user_paths import UserPaths
from insole_studio.widgets.number_field import NumberField

EXAMPLE = resource_path("example/example.insole")
LOOK_MS, DRAWN_MS, LIVE_MS = 100, 250, 4000
PATIENCE_MS = 90_000
SCALED = (3840, 2160)
"""The screen that is used at scale 2 unless another scale is asked for."""


@dataclass(frozen=True)
class Circumstances:
    """On what screen, in what language and theme, and with what hand."""

    size: tuple[int, int] = (1366, 768)
    language: Language = "en"
    theme: Theme = "light"
    hand: str = "mouse"
    scale: float = 1.0
    """Device pixels of a pixel of the window."""

    @property
    def name(self) -> str:
        """Name of the folder of the pictures."""
        width, height = self.size
        return f"{width}x{height}-{self.scale:g}-{self.language}-{self.theme}-{self.hand}"

    @property
    def room(self) -> tuple[int, int]:
        """Width and height of the screen, px of the window."""
        return int(self.size[0] / self.scale), int(self.size[1] / self.scale)


def walk(
    circumstances: Circumstances, session: Path, folder: Path, names: Sequence[str]
) -> list[Path]:
    """Walk journeys, and return the pictures.

    Parameters
    ----------
    session
        A scan of the left foot of the example's patient.
    folder
        The pictures come into a folder in it.
    names
        Of the journeys, as in `JOURNEYS`.
    """
    os.environ["QT_SCALE_FACTOR"] = str(circumstances.scale)
    target = folder / circumstances.name
    target.mkdir(parents=True, exist_ok=True)
    taken: list[Path] = []
    for name in names:
        with tempfile.TemporaryDirectory() as home, window(circumstances, Path(home), session) as w:
            JOURNEYS[name](Walk(w, circumstances, target, taken), session)
    return taken


@contextmanager
def window(circumstances: Circumstances, home: Path, session: Path) -> Iterator[ScriptedWindow]:
    """Open the window as its user has set it, with its real dialogs."""
    paths = UserPaths(home / "config/settings.json", home / "data/autosave")
    hand = HANDS[circumstances.hand]
    settings = Settings(
        theme=circumstances.theme,
        language=circumstances.language,
        touch=hand.touch,
        tour_seen=True,
        recent=[f"/patients/{name}.insole" for name in ("Anna Berg", "Bo Ek", "Cia Alm")],
    )
    paths.settings_file.parent.mkdir(parents=True)
    save_settings(settings, paths.settings_file)
    fill_record(paths, circumstances.language)
    dark = circumstances.theme == "dark"
    with ScriptedWindow(paths, circumstances.room, dark, emulate=session) as studio:
        studio.app.services.messages.questions = Questions(studio.app.window)
        studio.app.window.move(0, 0)
        studio.app.window.activateWindow()
        studio.settle()
        yield studio


class Walk:
    """One window on its way, and the pictures of it."""

    def __init__(
        self, studio: ScriptedWindow, circumstances: Circumstances, folder: Path, taken: list[Path]
    ) -> None:
        self.studio, self.app = studio, studio.app
        self.hand = HANDS[circumstances.hand](studio.app.window, studio.settle)
        self._circumstances, self._folder, self._taken = circumstances, folder, taken

    def see(self, name: str, after_ms: int = DRAWN_MS) -> None:
        """Take a picture of the screen, with all windows and dialogs on it."""
        QTest.qWait(after_ms)
        screen = QGuiApplication.primaryScreen()
        picture = screen.grabWindow(0, 0, 0, *self._circumstances.room)
        path = self._folder / f"{len(self._taken) + 1:02}-{name}.png"
        picture.save(str(path))
        self._taken.append(path)

    @contextmanager
    def asked(self, name: str, answer: Callable[[QDialog], None]) -> Iterator[None]:
        """Take a picture of the dialog that comes inside the context, and answer it."""
        timer = QTimer()
        waited: list[QDialog] = []

        def look() -> None:
            dialog = QApplication.activeModalWidget()
            if isinstance(dialog, QDialog) and dialog.isVisible() and not waited:
                waited.append(dialog)
                timer.stop()
                self.see(name)
                answer(dialog)

        timer.timeout.connect(look)
        timer.start(LOOK_MS)
        try:
            yield
            self.until(lambda: bool(waited))
        finally:
            timer.stop()
        self.studio.settle()

    def until(self, is_so: Callable[[], bool]) -> None:
        """Wait until something is so."""
        clock = QElapsedTimer()
        clock.start()
        while not is_so():
            if clock.hasExpired(PATIENCE_MS):
                raise TimeoutError(f"nothing came after {self._taken[-1]}")
            QTest.qWait(LOOK_MS)

    def open(self, name: str, key: str, path: Path) -> None:
        """Open a file by an action, and type its path."""
        with self.asked(name, lambda dialog: type_path(dialog, path)):
            self.hand.choose(key)

    def field(self, key: str) -> NumberField:
        """Return a field below the views."""
        fields = self.app.stage.parameters.findChildren(NumberField)
        return next(f for f in fields if f.property("key") == key)

    def stage(self, feature: str) -> QWidget:
        """Return the window of a stage, once it is open and its work is done."""
        holder = getattr(self.app.features, feature)
        self.until(lambda: holder.stage is not None)
        stage: QWidget = holder.stage
        stage.move(0, 0)
        jobs = getattr(stage, "jobs", None)
        if jobs is not None:
            wait_for(jobs)
        return stage


def refuse(dialog: QDialog) -> None:
    """Press Escape."""
    QTest.keyClick(dialog, Qt.Key.Key_Escape)


def type_path(dialog: QDialog, path: Path) -> None:
    """Type a path into a file dialog and press Enter, until the dialog takes it."""
    assert isinstance(dialog, QFileDialog)
    (field,) = dialog.findChildren(QLineEdit, "fileNameEdit")
    while dialog.isVisible():
        field.selectAll()
        QTest.keyClicks(field, str(path))
        for view in dialog.findChildren(QAbstractItemView):
            view.clearSelection()  # else Enter takes the folders selected while the path was typed
        QTest.keyClick(field, Qt.Key.Key_Return)
        QApplication.processEvents(QEventLoop.ProcessEventsFlag.AllEvents, LOOK_MS)


def walk_standard_case(walk: Walk, _session: Path) -> None:
    """From the empty window to the exported insole, and every tool once."""
    hand, app = walk.hand, walk.app
    walk.see("start")
    hand.open_menu(app.window.menuBar().actions()[0])
    walk.see("menu")
    QTest.keyClick(QApplication.activePopupWidget() or app.window, Qt.Key.Key_Escape)
    hand.choose("open_example")
    walk.see("example")
    foot = app.stage.foot.scene
    hand.choose("tool_key_point")
    walk.see("landmarks")
    hand.choose("confirm_landmarks")
    hand.choose("tool_pelott")
    line = metatarsal_line(app.case.record)
    assert line is not None
    x, y, _ = line[1]
    hand.tap(foot, (x, y - 45.0))
    walk.see("pelott")
    hand.choose("tool_posting")
    hand.type(walk.field("posting.rearfoot_deg"), "4")
    walk.see("posting")
    hand.choose("tool_section")
    hand.tap(foot, (x, y - 42.0))
    hand.choose("map_thickness")
    walk.see("section")
    hand.choose("map_none")
    hand.choose("tool_brush")
    way = [pixel(foot, np.array([x + dx, y - 90.0])) for dx in (-15, 0, 15)]
    hand.carry(foot, *way)
    walk.see("brush")
    hand.let_go(foot, way[-1])
    hand.choose("tool_outline")
    walk.see("outline")
    drag_outline(walk)
    hand.choose("tool_turn")
    walk.see("turn")
    hand.choose("tool_orbit")
    hand.choose("look_medial")
    hand.choose("map_height")
    walk.see("medial-height-map")
    hand.choose("tour")
    walk.see("tour")
    QTest.keyClick(QApplication.activeWindow() or app.window, Qt.Key.Key_Escape)
    hand.choose("keys")
    walk.see("keys")
    for dialog in shown_windows(QDialog):
        refuse(dialog)


def drag_outline(walk: Walk) -> None:
    """Drag a point of the outline, and look before it is let go."""
    scene, hand = walk.app.stage.insole.scene, walk.hand
    if isinstance(hand, Keys):
        scene = walk.app.stage.foot.scene
        scene.surface.setFocus()
        QTest.keyClick(scene.surface, Qt.Key.Key_PageDown)
        for _ in range(3):
            QTest.keyClick(scene.surface, Qt.Key.Key_Right, Qt.KeyboardModifier.ShiftModifier)
        walk.see("outline-drag")
        QTest.keyClick(scene.surface, Qt.Key.Key_Return)
        return
    handle = next(h for h in scene.handles if h.name == "outline:5")
    start = pixel(scene, np.array(handle.position_mm))
    hand.carry(scene, start, start + QPoint(8, 0), start + QPoint(16, 0))
    walk.see("outline-drag")
    hand.let_go(scene, start + QPoint(16, 0))


def walk_two_feet(walk: Walk, session: Path) -> None:
    """A second foot, variants, the foot stage, export of a pair, and its own blocks."""
    hand, app = walk.hand, walk.app
    hand.choose("open_example")
    walk.open("open-scan", "open_archive", session)
    stage = app.features.foot.stage
    assert stage is not None
    walk.stage("foot")
    walk.see("foot-stage")
    stage.close()
    app.window.activateWindow()
    walk.studio.settle()
    walk.see("two-feet")
    hand.choose("foot_right")
    hand.choose("copy_to_other")
    hand.choose("beside_foot")
    hand.choose("map_difference")
    walk.see("feet-beside")
    hand.choose("variant_duplicate")
    change_variant(walk)
    hand.choose("beside_variant")
    walk.see("variants-beside")
    hand.choose("beside_nothing")
    hand.choose("map_none")
    see_export(walk)
    see_comparison(walk)


def see_export(walk: Walk) -> None:
    """Check & export: a pair, in one block, and the dialogs of the stage."""
    hand, app = walk.hand, walk.app
    hand.choose("export")
    walk.stage("export")
    walk.see("export-pair")
    export = app.features.export.stage
    assert export is not None
    form = export.view.form
    form.kind.setFocus()
    QTest.keyClick(form.kind, Qt.Key.Key_Down)
    wait_for(export.jobs)
    form.block.setFocus()
    for _ in range(3):
        QTest.keyClick(form.block, Qt.Key.Key_Down)
        wait_for(export.jobs)
    walk.see("export-blocks")
    parts = [b for b in export.view.findChildren(QToolButton) if b.property("part")]
    hand.click(parts[-1])
    wait_for(export.jobs)
    walk.see("export-nested")
    with walk.asked("own-blocks", refuse):
        hand.click(form.own_blocks)
    with walk.asked("responsible", refuse):
        hand.click(form.responsible)
    export.close()
    app.window.activateWindow()


def see_comparison(walk: Walk) -> None:
    """Compare an insole with its foot, then the other two."""
    walk.hand.choose("compare")
    compare = walk.app.features.compare.stage
    assert compare is not None
    walk.stage("compare")
    walk.see("compare")
    for which, steps in (("a", 1), ("b", 2)):
        source = compare.view.sources[which]
        source.setFocus()
        for _ in range(steps):
            QTest.keyClick(source, Qt.Key.Key_Down)
        wait_for(compare.jobs)
    walk.see("compared")
    compare.close()


def change_variant(walk: Walk) -> None:
    """Make the pad of the variant higher."""
    case = walk.app.case
    design = case.record.design
    assert design is not None
    for correction in design.corrections:
        if isinstance(correction, Pelott):
            design = design.with_changed(replace(correction, height_mm=9.0))
        if isinstance(correction, Posting):
            design = design.with_changed(replace(correction, rearfoot_deg=2.0))
    case.apply(design, "Change the variant")
    walk.studio.settle()


def walk_questions(walk: Walk, _session: Path) -> None:
    """What the window asks and tells: unsaved work, recovered work, a case in use, a scan."""
    hand, app = walk.hand, walk.app
    folder = app.services.paths.data_folder
    case = folder / "Anna Berg.insole"
    hand.choose("open_example")
    with walk.asked("save-as", lambda dialog: type_path(dialog, case)):
        hand.choose("save_as")
    hand.choose("add_heel_lift")
    app.autosave.write_now()
    walk.studio.settle()
    with walk.asked("unsaved", lambda dialog: press(dialog, tr("Discard changes"))):
        hand.choose("new_case")
    hand.choose("open_example")
    scan = folder / "scan 17.ply"
    assert app.case.foot is not None
    write_ply(app.case.foot.mesh, scan)
    other = case.with_name("Bo Ek.insole")
    other.write_bytes(case.read_bytes())
    lock = take_lock(other, folder / "locks")
    hand.choose("new_case")
    with walk.asked("in-use", refuse):
        app.features.case_files.opener.open_path(other)
    lock.release()
    with walk.asked("scan-import", refuse):
        app.features.case_files.opener.open_path(scan)
    broken = folder / "broken.insole"
    broken.write_bytes(b"no case")
    with walk.asked("error", refuse):
        app.features.case_files.opener.open_path(broken)
    offer_recovered(walk, case)


def offer_recovered(walk: Walk, case: Path) -> None:
    """Start as after a crash: with the autosaved case of a window that is gone."""
    app = walk.app
    app.features.case_files.opener.open_path(case)
    walk.studio.settle()
    walk.hand.choose("add_heel_lift")
    app.autosave.write_now()
    walk.studio.settle()
    folder = app.services.paths.autosave_folder
    for copy in (*folder.glob("*.insole"), *folder.glob("*.json")):
        shutil.copy(copy, folder / f"gone{copy.suffix}")
    with walk.asked("unsaved-again", lambda dialog: press(dialog, tr("Discard changes"))):
        walk.hand.choose("new_case")
    app.features.case_files.recovery.offer(find_recovered(folder))
    walk.studio.settle()
    walk.see("recovered")


def press(window: QWidget, text: str) -> None:
    """Press the button of a window with a text."""
    QTest.mouseClick(button(window, text), Qt.MouseButton.LeftButton)


def button(window: QWidget, text: str) -> QPushButton:
    """Return the button of a window with a text."""
    return next(b for b in window.findChildren(QPushButton) if b.text() == text)


def walk_stages(walk: Walk, _session: Path) -> None:
    """Capture with emulated sensors, calibrate, print boards."""
    hand, app = walk.hand, walk.app
    hand.choose("capture")
    capture = app.features.capture.stage
    assert capture is not None
    walk.stage("capture")
    take = button(capture, tr("Capture"))
    walk.until(take.isEnabled)
    walk.see("capture", LIVE_MS)
    hand.click(take)
    use = button(capture, tr("Use this scan"))
    walk.until(use.isEnabled)
    walk.see("captured", LIVE_MS)
    capture.close()
    app.window.activateWindow()
    hand.choose("calibrate")
    calibrate = app.features.calibrate.stage
    assert calibrate is not None
    walk.stage("calibrate")
    walk.see("calibrate")
    calibrate.view.steps.setCurrentRow(1)
    walk.see("calibrate-pictures")
    with walk.asked("print-boards", refuse):
        calibrate.print_boards()
    calibrate.close()


def walk_day(walk: Walk, _session: Path) -> None:
    """A patient of the day: from the list of patients to the order, in twelve pages."""
    hand, app = walk.hand, walk.app
    open_record(walk.studio)
    walk.see("patients")
    start = app.features.records.start
    assert start is not None
    hand.click(start.new_patient)
    dialog = next(shown_windows(NewPatientDialog))
    QTest.keyClicks(dialog.name, "Eva Öberg")
    walk.see("new-patient")
    QTest.keyClick(dialog, Qt.Key.Key_Return)
    walk.until(lambda: app.window.page is app.features.records.person)
    wait_for(app.services.clinic.jobs)
    walk.see("patient")
    hand.choose("new_visit")
    walk.until(lambda: app.case.kept is not None)
    walk.see("visit")
    import_scan(walk)
    line = metatarsal_line(app.case.record)
    assert line is not None
    x, y, _ = line[1]
    hand.choose("tool_pelott")
    hand.tap(app.stage.foot.scene, (x, y - 45.0))
    walk.see("pelott")
    hand.choose("tool_posting")
    hand.type(walk.field("posting.rearfoot_deg"), "4")
    hand.choose("tool_section")
    hand.tap(app.stage.foot.scene, (x, y - 42.0))
    hand.choose("map_thickness")
    walk.see("section")
    hand.choose("variant_duplicate")
    change_variant(walk)
    hand.choose("beside_variant")
    walk.see("variants")
    hand.choose("beside_nothing")
    see_order(walk)


def import_scan(walk: Walk) -> None:
    """Open the scan of another program, and say which foot it is."""
    hand, app = walk.hand, walk.app
    scan = app.services.paths.data_folder / "scan 17.ply"
    scan.parent.mkdir(parents=True, exist_ok=True)
    foot = read_case(EXAMPLE).feet[0].foot
    write_ply(foot.mesh, scan)
    app.features.case_files.opener.open_path(scan)
    walk.studio.settle()
    asked = next(shown_windows(ImportDialog))
    walk.see("scan")
    hand.click(asked.sides[foot.side])
    hand.click(asked.open_button)
    walk.see("foot")


def see_order(walk: Walk) -> None:
    """Check & export, then the list of orders."""
    hand, app = walk.hand, walk.app
    hand.choose("export")
    walk.stage("export")
    stage = app.features.export.stage
    assert stage is not None
    walk.see("export")
    order = app.services.paths.data_folder / "insole"
    with walk.asked("export-to", lambda dialog: type_path(dialog, order)):
        hand.click(stage.view.export)
    wait_for(stage.jobs)
    stage.close()
    app.window.activateWindow()
    walk.studio.settle()
    hand.choose("orders")
    wait_for(app.services.clinic.jobs)
    walk.see("orders")


JOURNEYS: Final[dict[str, Callable[[Walk, Path], None]]] = {
    "day": walk_day,
    "standard": walk_standard_case,
    "feet": walk_two_feet,
    "questions": walk_questions,
    "stages": walk_stages,
}
