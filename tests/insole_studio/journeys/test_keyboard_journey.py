"""The standard case by keys alone, through the real window: no mouse, no call of an action."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog, QLineEdit, QWidget
from pytestqt.qtbot import QtBot
from real_dialogs import paste_path

from insole_core.insole.elements import Pelott, Posting
from insole_core.insole.prescription.design import InsoleDesign
from insole_studio.app.scripted import ScriptedWindow
from insole_studio.features.design.tools.key_point_tool import confidence, shown_points
from insole_studio.services.questions import Questions
from insole_studio.user_paths import UserPaths
from insole_studio.widgets.form_parts import Fold

pytestmark = pytest.mark.slow

KEY = Qt.Key
CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
MOST_TRIES = 300
NONE = Qt.KeyboardModifier.NoModifier


class Keyboard:
    """Strikes keys; they go where the focus is, as those of a user do."""

    def __init__(self, studio: ScriptedWindow, qtbot: QtBot) -> None:
        self.studio = studio
        self._qtbot = qtbot
        self.app = studio.app

    def strike(self, key: Qt.Key, modifiers: Qt.KeyboardModifier = NONE, times: int = 1) -> None:
        for _ in range(times):
            QTest.keyClick(_active().windowHandle(), key, modifiers)
            self.studio.settle()

    def type(self, text: str) -> None:
        for letter in text:
            QTest.keyClick(_active().windowHandle(), letter)
        self.strike(KEY.Key_Return)

    def answering_file(self, path: Path) -> None:
        """Paste a path into the file dialog that comes next."""
        QTimer.singleShot(100, lambda: _paste_path(path))

    def wait_for(self, is_done: Callable[[], bool]) -> None:
        self._qtbot.waitUntil(is_done)
        self.studio.settle()


def _active() -> QWidget:
    window = QApplication.activeWindow()
    assert window is not None
    return window


def _paste_path(path: Path, tries: int = MOST_TRIES) -> None:
    """Paste into the dialog once it is there, and press Enter until it is gone."""
    dialog = QApplication.activeModalWidget()
    if isinstance(dialog, QFileDialog) and dialog.isVisible():
        field = dialog.focusWidget()
        if not isinstance(field, QLineEdit) or tries == 0:  # one can type at once
            dialog.reject()  # or the test would wait for ever
            raise AssertionError(f"{path} is not taken, {field} has the focus")
        if field.text() != str(path):
            paste_path(field, path)
        QTest.keyClick(field, KEY.Key_Return)
        if not dialog.isVisible():
            return
        tries -= 1
    QTimer.singleShot(100, lambda: _paste_path(path, tries))


@pytest.fixture
def keyboard(
    qapp: QApplication, qtbot: QtBot, paths: UserPaths, coarse: None
) -> Iterator[Keyboard]:
    with ScriptedWindow(paths, (960, 640)) as studio:
        # The real dialogs: they are answered by keys as well.
        studio.app.services.messages.questions = Questions(studio.app.window)
        studio.app.window.activateWindow()
        QTest.qWaitForWindowActive(studio.app.window)
        yield Keyboard(studio, qtbot)


def test_the_standard_case_by_keys_alone(
    keyboard: Keyboard, small_session: Path, tmp_path: Path
) -> None:
    app, case, strike = keyboard.app, keyboard.app.case, keyboard.strike
    keyboard.answering_file(small_session)
    strike(KEY.Key_M, CTRL)
    keyboard.wait_for(lambda: case.foot is not None)
    strike(KEY.Key_Return, CTRL)  # the foot stage has nothing to be put right
    keyboard.wait_for(lambda: _active() is app.window)
    assert QApplication.focusWidget() is app.stage.foot.scene.surface

    strike(KEY.Key_K)
    strike(KEY.Key_PageDown, times=3)
    name = "metatarsal_head_1"
    assert app.stage.foot.scene.keys.handle == f"point:{name}"
    before = shown_points(case)[name]
    strike(KEY.Key_Up, times=4)
    strike(KEY.Key_Return)
    assert shown_points(case)[name][1] == pytest.approx(before[1] + 2.0, abs=0.02)
    assert len(case.history) == 1  # what the arrows did is one step
    strike(KEY.Key_K, CTRL)
    assert confidence(case, "heel_centre") == 1.0

    strike(KEY.Key_P)
    strike(KEY.Key_Return)
    pad = _only_pad(keyboard)
    strike(KEY.Key_Left)
    strike(KEY.Key_Up, SHIFT)
    strike(KEY.Key_Plus)
    strike(KEY.Key_Minus, CTRL)
    moved = _only_pad(keyboard)
    x, y = pad.centre_mm
    right = app.stage.foot.scene.look.right[0]
    assert moved.centre_mm == pytest.approx((x - 0.5 * right, y + 5.0), abs=0.011)
    assert moved.height_mm == pytest.approx(pad.height_mm + 0.4)

    strike(KEY.Key_T)
    strike(KEY.Key_F2)
    keyboard.type("4")
    strike(KEY.Key_Escape)
    strike(KEY.Key_O)
    strike(KEY.Key_F2)
    _go_to(keyboard, "insole.thickness_mm")
    keyboard.type("4,5")
    strike(KEY.Key_Escape)

    strike(KEY.Key_S)
    strike(KEY.Key_Return)
    assert app.stage.section.isVisible()
    before_mm = app.stage.insole_presenter._section.plane
    strike(KEY.Key_Up, times=2)
    assert app.stage.insole_presenter._section.plane != before_mm

    strike(KEY.Key_E, CTRL)
    stage = app.features.export.stage
    assert stage is not None
    keyboard.wait_for(lambda: stage.view.export.isEnabled() and _active() is stage)
    keyboard.answering_file(tmp_path / "insole.stl")
    strike(KEY.Key_Return, CTRL)
    keyboard.wait_for(lambda: case.record is app.features.export.exported)
    stage.activateWindow()  # as a window manager does when a dialog is gone
    keyboard.wait_for(lambda: _active() is stage)
    strike(KEY.Key_W, CTRL)
    assert app.features.export.stage is None

    design = case.record.design
    assert design is not None
    posting = design.corrections[1]
    assert isinstance(posting, Posting)
    assert (posting.rearfoot_deg, design.thickness_mm) == (4.0, 4.5)
    assert (tmp_path / "insole-left.stl").stat().st_size > 5e5


MANUAL = Path(__file__).parents[3] / "docs" / "manual" / "keyboard.md"
NAMES = {
    "Enter": KEY.Key_Return, "Esc": KEY.Key_Escape, "PgDn": KEY.Key_PageDown,
    "arrows": KEY.Key_Up, "+": KEY.Key_Plus,
}  # fmt: skip
"""Keys that the manual writes otherwise than Qt."""


def manual_path() -> dict[str, list[str]]:
    """Return the keys of the manual's standard case by what they do."""
    section = MANUAL.read_text("utf-8").split("## The standard case")[1].split("##")[0]
    lines = (line.strip("|").split("|") for line in section.splitlines() if line.startswith("| "))
    rows = ((what.strip(), keys.strip()) for what, keys in lines)
    return {what: keys.split(", ") for what, keys in rows if what}


def follow(keyboard: Keyboard, keys: list[str]) -> None:
    """Strike the keys of a row of the manual; a number is typed as it stands there."""
    for name in keys:
        if name[0].isdigit():
            for digit in name:
                QTest.keyClick(_active().windowHandle(), digit)
        elif name in NAMES:
            keyboard.strike(NAMES[name])
        else:
            combination = QKeySequence(name.replace("Enter", "Return"))[0]
            keyboard.strike(combination.key(), combination.keyboardModifiers())


def test_the_keys_of_the_manual_lead_where_it_says(
    keyboard: Keyboard, small_session: Path, tmp_path: Path
) -> None:
    """Followed letter by letter: what is typed gets into the field that the manual means."""
    app, case = keyboard.app, keyboard.app.case
    *path, (last, export) = manual_path().items()
    assert [what.split()[0] for what, _ in path] == [
        "Open", "Landmarks:", "A", "4°", "Thickness,", "A",
    ]  # fmt: skip
    keyboard.answering_file(small_session)
    follow(keyboard, path[0][1])
    keyboard.wait_for(lambda: case.foot is not None)
    keyboard.strike(KEY.Key_Return, CTRL)
    keyboard.wait_for(lambda: _active() is app.window)
    for _, keys in path[1:]:
        follow(keyboard, keys)
    design = case.record.design
    assert design is not None
    assert (design.thickness_mm, design.grid_mm) == (4.5, InsoleDesign(design.side).grid_mm)
    assert [type(c) for c in design.corrections] == [Pelott, Posting]
    assert design.corrections[1].rearfoot_deg == 4.0
    assert app.stage.section.isVisible()
    assert last == "Check and export"
    follow(keyboard, export[:1])
    stage = app.features.export.stage
    assert stage is not None
    keyboard.wait_for(lambda: stage.view.export.isEnabled() and _active() is stage)
    keyboard.answering_file(tmp_path / "insole.stl")
    follow(keyboard, export[1:])
    keyboard.wait_for(lambda: case.record is app.features.export.exported)
    assert (tmp_path / "insole-left.stl").stat().st_size > 5e5


def test_tab_follows_the_meaning_and_thickness_is_typed_whatever_is_selected(
    keyboard: Keyboard, small_session: Path
) -> None:
    case = keyboard.app.case
    keyboard.answering_file(small_session)
    keyboard.strike(KEY.Key_M, CTRL)
    keyboard.wait_for(lambda: case.foot is not None)
    keyboard.strike(KEY.Key_Return, CTRL)
    keyboard.wait_for(lambda: _active() is keyboard.app.window)
    keyboard.strike(KEY.Key_F2)
    found = []
    parameters = keyboard.app.stage.parameters
    while (focused := QApplication.focusWidget()) and parameters.isAncestorOf(focused):
        if isinstance(focused, Fold):
            keyboard.strike(KEY.Key_Space)  # what is for experts is opened on the way
        else:
            found.append(focused.property("key"))
        keyboard.strike(KEY.Key_Tab)
    assert found[:3] == ["device.cup", "device.flange", "device.fill"]
    insole = found.index("insole.thickness_mm")
    assert found[insole : insole + 4] == [
        "insole.thickness_mm", "insole.bottom", "insole.max_height_mm", "layers.cover_mm",
    ]  # fmt: skip
    expert = found.index("finish.toe_line_mm")
    assert found[expert - 1].startswith("outline.")
    assert found[-1] == "insole.grid_mm"

    for number, (tool, thickness) in enumerate(zip("OPUB", (4.5, 5.0, 5.5, 6.0), strict=True)):
        keyboard.strike(getattr(KEY, f"Key_{tool}"))
        if number == 1:
            keyboard.strike(KEY.Key_Return)
        keyboard.strike(KEY.Key_F2, SHIFT)
        keyboard.type(f"{thickness:g}")
        keyboard.strike(KEY.Key_Escape)
        assert case.record.design is not None
        design = case.record.design
        assert (design.thickness_mm, design.grid_mm) == (
            thickness,
            InsoleDesign(design.side).grid_mm,
        )


def _only_pad(keyboard: Keyboard) -> Pelott:
    design = keyboard.app.case.record.design
    assert design is not None
    (pad,) = design.corrections
    assert isinstance(pad, Pelott)
    return pad


def _go_to(keyboard: Keyboard, key: str) -> None:
    """Tab on to a field."""
    for _ in range(30):
        focused = QApplication.focusWidget()
        if focused is not None and focused.property("key") == key:
            return
        keyboard.strike(KEY.Key_Tab)
    raise AssertionError(f"Tab does not lead to {key}")
