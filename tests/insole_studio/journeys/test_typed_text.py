"""What is typed and not yet entered is never lost, whatever the user turns to by real events."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from pointing import hold, turn_wheel
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractSlider,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QLineEdit,
    QMenu,
    QPlainTextEdit,
    QScrollBar,
    QSpinBox,
    QToolBar,
    QToolButton,
    QToolTip,
    QWidget,
)
from pytestqt.qtbot import QtBot

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.elements import HeelLift
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.app.bootstrap import Application, build_application
from insole_studio.features.calibrate.stage import CalibrateStage
from insole_studio.features.capture.rows import CaptureOptions, CaptureRow
from insole_studio.features.capture.view import CaptureView
from insole_studio.services.questions import Answer
from insole_studio.user_paths import UserPaths
from insole_studio.widgets.number_field import NumberField

pytestmark = [pytest.mark.slow, pytest.mark.one_window]

KEY, CTRL = Qt.Key, Qt.KeyboardModifier.ControlModifier
NONE = Qt.KeyboardModifier.NoModifier
NOWHERE = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)


def strike(widget: QWidget, key: Qt.Key, modifiers: Qt.KeyboardModifier = NONE) -> None:
    """Press a key of the keyboard, which goes where the focus is."""
    QTest.keyClick(widget.window().windowHandle(), key, modifiers)


def type_into(field: QWidget, text: str) -> None:
    """Put the focus into a field, and replace its text by typing; nothing is entered."""
    window = field.window()
    window.activateWindow()
    QTest.qWaitForWindowActive(window)
    field.setFocus()
    strike(field, KEY.Key_A, CTRL)
    for letter in text:
        QTest.keyClick(window.windowHandle(), letter)


def click(widget: QWidget) -> None:
    """Click with the mouse in the middle of a widget, as the window system does."""
    window = widget.window()
    middle = widget.mapTo(window, widget.rect().center())
    QTest.mouseClick(window.windowHandle(), Qt.MouseButton.LeftButton, NONE, middle)


def patient_field(app: Application, key: str) -> QWidget:
    panel = app.stage.patient
    if key == "notes":
        return panel.findChild(QPlainTextEdit)
    return next(f for f in panel.findChildren(QLineEdit) if f.property("key") == key)


def number(app: Application, key: str) -> NumberField:
    fields = app.stage.parameters.findChildren(NumberField)
    return next(f for f in fields if f.property("key") == key and f.isVisible())


@pytest.fixture(scope="module")
def case_of_two(
    make_foot: Callable[[Side], Foot], tmp_path_factory: pytest.TempPathFactory
) -> Path:
    """A case of two feet, with a heel lift on the left one, which is at hand."""
    feet = tuple(
        FootRecord.begun(make_foot(side), NOWHERE, InsoleDesign(side, grid_mm=2.0)) for side in Side
    )
    lifted = feet[0].with_design(feet[0].design.with_added(HeelLift(height_mm=2.0)))
    record = CaseRecord(Patient(name="Anna Berg"), (lifted, feet[1]), Side.LEFT)
    path = tmp_path_factory.mktemp("case") / "anna.insole"
    write_case(record, path)
    return path


@pytest.fixture
def saved(
    app: Application, settle: Callable[[], None], case_of_two: Path, tmp_path: Path
) -> Application:
    """The window with a copy of that case."""
    path = Path(shutil.copy(case_of_two, tmp_path))
    app.window.resize(1366, 768)
    app.features.case_files.opener.open_path(path)
    settle()
    return app


FIELDS: dict[str, tuple[str, Callable[[CaseRecord], object], object]] = {
    "name": ("Bo Ek", lambda record: record.patient.name, "Bo Ek"),
    "notes": ("sore", lambda record: record.patient.notes, "sore"),
    "visit": ("2026-11-20", lambda record: record.patient.visit, "2026-11-20"),
    "insole.thickness_mm": (
        "4.5",
        lambda record: record.of_side(Side.LEFT).design.thickness_mm,
        4.5,
    ),
    "outline.heel_allowance_mm": (
        "3.5",
        lambda record: record.of_side(Side.LEFT).design.outline.heel_allowance_mm,
        3.5,
    ),
}


def typed_each(app: Application, *keys: str) -> Iterator[Callable[[], bool]]:
    """Type into all fields, or those named; yields, after each, what tells whether the case has it.

    What a turn to something else has done to the case is undone before the next field.
    """
    at_hand = app.case.side
    for key in keys or FIELDS:
        text, value_of, value = FIELDS[key]
        is_number = "." in key
        type_into(number(app, key) if is_number else patient_field(app, key), text)
        assert value_of(app.case.record) != value, key
        yield lambda value_of=value_of, value=value: value_of(app.case.record) == value
        while app.case.history.undo_sentence:
            app.case.undo()
        app.case.take_foot(at_hand)


def toolbar_button(app: Application, key: str) -> QWidget:
    action = app.window.actions_by_key[key]
    bars = app.window.findChildren(QToolBar)
    return next(b for b in (bar.widgetForAction(action) for bar in bars) if b is not None)


def by_shortcut(app: Application) -> None:
    strike(app.window, KEY.Key_S, CTRL)


def by_toolbar(app: Application) -> None:
    click(toolbar_button(app, "save"))


def by_menu(app: Application) -> None:
    bar = app.window.menuBar()
    case_menu = bar.actions()[0]
    place = bar.actionGeometry(case_menu).center()
    window = app.window.windowHandle()
    QTest.mouseClick(window, Qt.MouseButton.LeftButton, NONE, bar.mapTo(app.window, place))
    menu = case_menu.menu()
    assert isinstance(menu, QMenu)
    entry = menu.actionGeometry(app.window.actions_by_key["save"]).center()
    QTest.mouseClick(menu, Qt.MouseButton.LeftButton, NONE, entry)


@pytest.mark.parametrize("save", [by_shortcut, by_toolbar, by_menu])
def test_saving_saves_what_is_typed(
    saved: Application, settle: Callable[[], None], save: Callable[[Application], None]
) -> None:
    for is_entered in typed_each(saved):
        save(saved)
        settle()
        assert is_entered()
        assert not saved.window.isWindowModified()
        stored = read_case(saved.case.path)
        assert stored.patient == saved.case.record.patient
        assert stored.design == saved.case.record.design


def test_closing_the_window_asks_about_what_is_typed(saved: Application, questions) -> None:
    questions.unsaved = Answer.CANCEL
    for number_asked, is_entered in enumerate(typed_each(saved), start=1):
        saved.window.close()
        assert questions.asked == ["unsaved"] * number_asked
        assert is_entered()
        assert saved.window.isVisible()


@pytest.mark.own_window  # for it ends
@pytest.mark.parametrize("key", FIELDS)
def test_quitting_by_key_saves_what_is_typed(
    saved: Application, questions, settle: Callable[[], None], key: str
) -> None:
    is_entered = next(typed_each(saved, key))
    questions.unsaved = Answer.SAVE
    strike(saved.window, KEY.Key_Q, CTRL)
    settle()
    assert questions.asked == ["unsaved"]
    assert is_entered()
    assert read_case(saved.case.path).patient == saved.case.record.patient


def test_another_foot_leaves_what_is_typed_with_its_own(saved: Application) -> None:
    other = saved.case.record.other
    for is_entered in typed_each(saved):
        click(saved.stage.patient.sides.buttons[Side.RIGHT])
        assert saved.case.side is Side.RIGHT
        assert is_entered()
        assert saved.case.record.current.design == other.design


def test_another_variant_leaves_what_is_typed_with_its_own(saved: Application) -> None:
    for is_entered in typed_each(saved):
        buttons = saved.stage.patient.variants.findChildren(QToolButton)
        click(next(b for b in buttons if b.property("action") == "variant_duplicate"))
        assert saved.case.record.current.chosen == "B"
        assert is_entered()
        assert all(
            variant.design.thickness_mm == saved.case.record.design.thickness_mm
            for variant in saved.case.record.current.variants
        )


def test_a_new_case_asks_about_what_is_typed_and_shows_none_of_it(
    saved: Application, questions, settle: Callable[[], None]
) -> None:
    questions.unsaved = Answer.SAVE
    for number_asked, is_entered in enumerate(typed_each(saved), start=1):
        strike(saved.window, KEY.Key_N, CTRL)
        settle()
        assert questions.asked == ["unsaved"] * number_asked
        assert saved.case.record.patient == Patient()
        assert patient_field(saved, "name").text() == ""
        (file,) = [Path(name) for name in saved.services.recent.names]
        saved.features.case_files.opener.open_path(file)
        settle()
        assert is_entered()


def test_the_list_of_corrections_keeps_what_is_typed(saved: Application) -> None:
    for is_entered in typed_each(saved):
        buttons = saved.stage.patient.findChildren(QToolButton)
        click(next(b for b in buttons if b.toolTip() == "Switch on or off" and b.isVisible()))
        assert [c.enabled for c in saved.case.record.design.corrections] == [False]
        assert is_entered()


def test_export_makes_what_is_typed(saved: Application) -> None:
    for is_entered in typed_each(saved):
        click(toolbar_button(saved, "export"))
        stage = saved.features.export.stage
        assert stage is not None
        assert is_entered()
        assert stage.presenter._record is saved.case.record
        stage.close()


def test_a_foot_that_arrives_leaves_what_is_typed(
    app: Application, make_foot: Callable[[Side], Foot], settle: Callable[[], None]
) -> None:
    """The name is typed while the scan is being read."""
    type_into(patient_field(app, "name"), "Bo E")
    app.case.open_foot(make_foot(Side.LEFT), NOWHERE)
    assert app.case.record.patient.name == "Bo E"
    strike(app.window, KEY.Key_K)
    assert patient_field(app, "name").text() == "Bo Ek"
    assert patient_field(app, "name").hasFocus()
    settle()


def test_a_change_from_elsewhere_keeps_what_is_typed(saved: Application) -> None:
    type_into(patient_field(saved, "name"), "Bo E")
    design = saved.case.record.design
    saved.case.apply(replace(design, thickness_mm=5.0), "Edit the insole")
    assert patient_field(saved, "name").text() == "Bo E"
    strike(saved.window, KEY.Key_Tab)
    assert saved.case.record.patient.name == "Bo E"


def test_a_click_into_the_field_itself_enters_nothing(saved: Application) -> None:
    """A number that is not finished, or out of range, can be corrected with the mouse."""
    field = number(saved, "insole.thickness_mm")
    type_into(field, "400")
    place = field.mapTo(saved.window, QPoint(8, field.height() // 2))
    QTest.mouseClick(saved.window.windowHandle(), Qt.MouseButton.LeftButton, NONE, place)
    assert field.cleanText() == "400"
    assert not field.refusal.isVisible()


def test_each_number_that_is_entered_is_a_step_of_undo(
    saved: Application, settle: Callable[[], None]
) -> None:
    field, entered = number(saved, "insole.thickness_mm"), [field_thickness(saved)]
    for text in ("5", "4", "6"):
        type_into(field, text)
        strike(field, KEY.Key_Return)
        entered.append(field_thickness(saved))
    for thickness in reversed(entered[:-1]):
        strike(saved.window, KEY.Key_Z, CTRL)
        assert field_thickness(saved) == thickness
    settle()


def field_thickness(app: Application) -> float:
    return app.case.record.current.design.thickness_mm


def test_a_held_key_and_a_run_of_the_wheel_are_a_step_each(
    saved: Application, settle: Callable[[], None]
) -> None:
    field, before = number(saved, "insole.thickness_mm"), field_thickness(saved)
    type_into(field, "")
    hold(field, KEY.Key_Up, repeats=3)
    held = field_thickness(saved)
    assert held > before
    for after_s in (1.0, 0.1, 0.1):
        turn_wheel(field, 1, after_s=after_s)
    turned = field_thickness(saved)
    assert turned > held
    turn_wheel(field, 1, after_s=1.0)
    hold(field, KEY.Key_Up, repeats=0)
    strike(saved.window, KEY.Key_Z, CTRL)
    strike(saved.window, KEY.Key_Z, CTRL)
    assert field_thickness(saved) == turned
    strike(saved.window, KEY.Key_Z, CTRL)
    assert field_thickness(saved) == held
    strike(saved.window, KEY.Key_Z, CTRL)
    assert field_thickness(saved) == before
    settle()


def all_values(window: QWidget) -> dict[QWidget, object]:
    """What stands in every field of a window."""
    fields = window.findChildren(QAbstractSpinBox)
    combos = window.findChildren(QComboBox)
    sliders = [s for s in window.findChildren(QAbstractSlider) if not isinstance(s, QScrollBar)]
    return (
        {field: field.text() for field in fields}
        | {combo: combo.currentIndex() for combo in combos}
        | {slider: slider.value() for slider in sliders}
    )


def test_no_field_takes_the_wheel_without_the_focus(
    saved: Application, settle: Callable[[], None]
) -> None:
    saved.features.export.open()
    stage = saved.features.export.stage
    assert stage is not None
    settle()
    for window in (saved.window, stage):
        window.activateWindow()
        QTest.qWaitForWindowActive(window)
        if (focused := QApplication.focusWidget()) is not None:
            focused.clearFocus()
        before, steps = all_values(window), len(saved.case.history)
        assert len(before) > 10
        for field in before:
            part = field.findChild(QLineEdit) or field
            turn_wheel(part, 1)
            turn_wheel(part, -1)
            turn_wheel(field, -1)
            assert not field.hasFocus()
        assert all_values(window) == before
        assert len(saved.case.history) == steps


def test_a_tooltip_that_goes_enters_nothing(saved: Application, qtbot: QtBot) -> None:
    field = number(saved, "insole.thickness_mm")
    type_into(field, "400")
    QToolTip.showText(field.mapToGlobal(QPoint(0, 60)), "Thickness", field)
    qtbot.waitUntil(QToolTip.isVisible)
    QToolTip.hideText()
    qtbot.waitUntil(lambda: not QToolTip.isVisible())
    assert field.cleanText() == "400"


def test_selection_and_cursor_stay_after_saving(
    saved: Application, settle: Callable[[], None]
) -> None:
    field = patient_field(saved, "name")
    type_into(field, "Bo Ek")
    for _ in range(2):
        strike(field, KEY.Key_Left, Qt.KeyboardModifier.ShiftModifier)
    by_shortcut(saved)
    settle()
    assert field.hasFocus()
    assert field.selectedText() == "Ek"


def test_the_order_takes_what_is_typed_with_its_keys(
    saved: Application, settle: Callable[[], None]
) -> None:
    saved.controller.run_action("export", False)
    stage = saved.features.export.stage
    draft = stage.view.form.draft
    type_into(draft, "7.5")
    assert stage.presenter._choice.draft_deg != 7.5
    strike(stage, KEY.Key_Return, CTRL)
    assert stage.presenter._choice.draft_deg == 7.5
    type_into(stage.view.form.cutter, "12")
    strike(stage, KEY.Key_W, CTRL)
    assert saved.features.export.stage is None
    assert '"cutter_diameter_mm": 12' in _written_rules(saved)


def _written_rules(app: Application) -> str:
    return (app.services.paths.settings_folder / "export.json").read_text(encoding="utf-8")


@pytest.fixture
def events(app: Application) -> Application:
    """The application, whose events are watched; the stage of a test stands beside its window."""
    return app


CAPTURE_FIELDS = {"notes": ("held", "held"), "frames": ("17", 17), "bursts": ("3", 3)}


@pytest.mark.parametrize("name", CAPTURE_FIELDS)
def test_the_plan_of_a_capture_takes_what_is_typed(
    events: Application, qtbot: QtBot, name: str
) -> None:
    text, value = CAPTURE_FIELDS[name]
    view = CaptureView(2.0)
    qtbot.addWidget(view)
    view.show_options(CaptureOptions())
    view.show_capture(CaptureRow(button="Capture", can_capture=True))
    view.show()
    plans: list[CaptureOptions] = []
    view.options_edited.connect(plans.append)
    field = getattr(view, f"_{name}")
    with qtbot.waitSignal(view.capture_requested):
        type_into(field, text)
        assert plans == []
        strike(view, KEY.Key_F5)
    assert getattr(plans[-1], name) == value


@pytest.fixture
def calibrating(events: Application, qtbot: QtBot, tmp_path: Path) -> Iterator[CalibrateStage]:
    store = SensorStore(tmp_path / "sensors")
    stage = CalibrateStage(
        store, SensorSource(store), tmp_path, ask_folder=lambda: None, ask=lambda _sentence: False
    )
    stage.show()
    yield stage
    stage.close()
    stage.deleteLater()


def _calibrate_field(stage: CalibrateStage, name: str) -> QWidget:
    if name == "serial":
        return stage.view.serial
    fields = stage.view.findChildren(QAbstractSpinBox)
    counts = [f for f in fields if type(f) is QSpinBox]
    return {"columns": counts[0], "square": next(f for f in fields if isinstance(f, NumberField))}[
        name
    ]


CALIBRATE_FIELDS: dict[str, tuple[str, Callable[[CalibrateStage], object], object]] = {
    "serial": ("A00362A", lambda stage: stage.presenter.serial, "A00362A"),
    "columns": ("11", lambda stage: stage.presenter.board.columns, 11),
    "square": ("25.5", lambda stage: stage.presenter.board.square_mm, 25.5),
}


@pytest.mark.parametrize("name", CALIBRATE_FIELDS)
def test_calibration_takes_what_is_typed(calibrating: CalibrateStage, name: str) -> None:
    text, value_of, value = CALIBRATE_FIELDS[name]
    type_into(_calibrate_field(calibrating, name), text)
    assert value_of(calibrating) != value
    click(calibrating.view.choose)
    assert value_of(calibrating) == value


def test_a_program_that_is_told_to_end_keeps_what_is_typed(
    qapp: QApplication, paths: UserPaths, make_foot: Callable[[Side], Foot]
) -> None:
    app = build_application(qapp, paths)
    app.window.show()
    app.case.open_foot(make_foot(Side.LEFT), NOWHERE)
    type_into(patient_field(app, "name"), "Bo Ek")
    app.close()
    (copy,) = paths.autosave_folder.glob("*.insole")
    assert read_case(copy).patient.name == "Bo Ek"
