"""A pressure map comes under a foot: asked, aligned, painted, moved, relieved, undone."""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from canned_questions import CannedQuestions
from PIL import Image
from pointing import LEFT, drag, pixel
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from insole_core.cases.case_record import CaseRecord, FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_core.pressure.alignment import SolePrint
from insole_core.pressure.laid_map import Placement
from insole_core.pressure.read_pressure import read_pressure
from insole_studio.app.bootstrap import Application
from insole_studio.features.design.models.color_maps import MapKind
from insole_studio.features.design.plantar.plantar_dialogs import PictureDialog, PressureDialog
from insole_studio.widgets.form_parts import ComboBox
from insole_studio.widgets.number_field import NumberField

pytestmark = pytest.mark.one_window

Settle = Callable[[], None]


def act(app: Application, key: str) -> None:
    app.window.actions_by_key[key].trigger()


def pick(box: ComboBox, value: str) -> None:
    """Choose an entry as the user does."""
    box.setCurrentIndex(box.findData(value))
    box.activated.emit(box.currentIndex())


def written_plate(app: Application, path: Path, kpa_per_mm: float = 70) -> Path:
    """Write the heights of the sole as pressures of 6 mm cells, toes first; seen from above."""
    assert app.case.foot is not None
    sole = SolePrint.of(app.case.foot).heights_mm[::3, ::3]
    kpa = np.round(np.clip(7 - sole, 0, None)[::-1] * kpa_per_mm, 1)
    rows = "\n".join(";".join(str(value) for value in row) for row in kpa)
    path.write_text(f"unit: kPa\npitch_mm: 6\n{rows}\n")
    return path


def asked(
    app: Application,
    questions: CannedQuestions,
    settle: Settle,
    path: Path,
    kpa_per_mm: float = 70,
) -> PressureDialog:
    """Open a plate of the left foot, and answer what its dialog asks."""
    questions.path = written_plate(app, path, kpa_per_mm)
    act(app, "lay_pressure")
    settle()
    (dialog,) = app.window.findChildren(PressureDialog)
    pick(dialog.side, "left")
    pick(dialog.seen_from, "above")
    return dialog


@pytest.fixture
def laid(
    opened: Application, questions: CannedQuestions, settle: Settle, tmp_path: Path
) -> Application:
    """The application with a pressure map under its left foot."""
    questions.path = written_plate(opened, tmp_path / "plate.csv")
    act(opened, "lay_pressure")
    settle()
    (dialog,) = opened.window.findChildren(PressureDialog)
    assert not dialog.lay_button.isEnabled()
    pick(dialog.side, "left")
    assert not dialog.lay_button.isEnabled()
    pick(dialog.seen_from, "above")
    QTest.mouseClick(dialog.lay_button, LEFT)
    settle()
    return opened


def test_a_map_is_laid_painted_and_undone(laid: Application, settle: Settle) -> None:
    pressure = laid.case.record.plantar.pressure
    assert pressure is not None
    assert abs(pressure.placement.turn_deg) < 5
    design = laid.features.design
    assert design.side_by_side.map_kind is MapKind.PRESSURE
    assert laid.window.actions_by_key["map_pressure"].isChecked()
    assert laid.stage.tool_controller.tool.key == "plantar"
    act(laid, "undo")
    assert laid.case.record.plantar.pressure is None
    act(laid, "redo")
    assert laid.case.record.plantar.pressure is pressure
    laid.stage.parameters.proposal_chosen.emit("plantar.remove")
    assert laid.case.record.plantar.pressure is None


def notices(app: Application) -> list[str]:
    return [notice.key for notice in app.services.notices.notices]


@pytest.mark.own_window  # a map that was chosen stays so without a foot, where none can be chosen
@pytest.mark.parametrize("way", ["undo", "remove", "new case"])
def test_what_was_doubtful_about_a_map_ends_with_it(
    opened: Application, questions: CannedQuestions, settle: Settle, tmp_path: Path, way: str
) -> None:
    dialog = asked(opened, questions, settle, tmp_path / "plate.csv", kpa_per_mm=1)
    QTest.mouseClick(dialog.lay_button, LEFT)
    settle()
    assert opened.case.record.plantar.pressure is not None
    assert "plantar-doubt" in notices(opened)
    ways: dict[str, Callable[[], object]] = {
        "undo": lambda: act(opened, "undo"),
        "remove": lambda: opened.stage.parameters.proposal_chosen.emit("plantar.remove"),
        "new case": lambda: opened.case.open(CaseRecord(), None),
    }
    ways[way]()
    assert "plantar-doubt" not in notices(opened)


def test_the_map_follows_the_mouse_and_the_keys(laid: Application, settle: Settle) -> None:
    before = laid.case.record.plantar.pressure
    assert before is not None
    view = laid.stage.foot.scene
    act(laid, "look_plantar")
    steps = laid.case.history.undo_sentence
    drag(view, pixel(view, 0.0, 60.0), pixel(view, 10.0, 75.0))
    settle()
    after = laid.case.record.plantar.pressure
    assert after is not None
    moved = after.placement.middle_mm - before.placement.middle_mm
    assert moved == pytest.approx([10.0, 15.0], abs=1.5)
    assert laid.case.history.undo_sentence != steps
    view.take_focus()
    QTest.keyClick(view.surface, Qt.Key.Key_Up, Qt.KeyboardModifier.ShiftModifier)
    nudged = laid.case.record.plantar.pressure
    assert nudged is not None
    assert nudged.placement.y_mm == pytest.approx(after.placement.y_mm + 5.0)
    laid.stage.parameters.field_edited.emit("plantar.turn_deg", 12.5)
    turned = laid.case.record.plantar.pressure
    assert turned is not None
    assert turned.placement == Placement(nudged.placement.x_mm, nudged.placement.y_mm, 12.5)


def test_a_relief_is_proposed_and_never_made_by_itself(laid: Application, settle: Settle) -> None:
    design = laid.case.record.design
    assert design is not None
    assert not [pad for pad in design.corrections if isinstance(pad, Pelott)]
    laid.stage.parameters.field_edited.emit("plantar.threshold", 100.0)
    laid.stage.parameters.proposal_chosen.emit("plantar.relieve-3")
    settle()
    relieved = laid.case.record.design
    assert relieved is not None
    (pad,) = [pad for pad in relieved.corrections if isinstance(pad, Pelott)]
    assert pad.kind == "relief_head_3"
    act(laid, "undo")
    assert laid.case.record.design == design


def test_a_picture_is_scaled_by_two_clicks(
    opened: Application, questions: CannedQuestions, settle: Settle, tmp_path: Path
) -> None:
    assert opened.case.foot is not None
    sole = SolePrint.of(opened.case.foot).heights_mm[::-1]
    grey = np.where(sole < 6, 40, 230).astype(np.uint8)
    path = tmp_path / "ink.png"
    Image.fromarray(np.stack([grey] * 3, axis=-1)).save(path)
    questions.path = path
    act(opened, "lay_pressure")
    settle()
    (dialog,) = opened.window.findChildren(PictureDialog)
    pick(dialog.side, "left")
    pick(dialog.seen_from, "above")
    assert not dialog.lay_button.isEnabled()
    view = dialog.picture
    shown = view._place()
    for share in (0.1, 0.9):
        y = shown.top() + round(share * shown.height())
        QTest.mouseClick(view, LEFT, pos=QPoint(shown.center().x(), y))
    dialog.distance.setValue(15.0)
    assert "mm long, and a picture of a foot" in dialog.warning.text()
    assert not dialog.lay_button.isEnabled()
    dialog.distance.setValue(0.8 * 2.0 * grey.shape[0])  # cells of 2 mm
    QTest.mouseClick(dialog.lay_button, LEFT)
    settle()
    picture = opened.case.record.plantar.picture
    assert picture is not None
    assert picture.pitch_mm == pytest.approx(2.0, rel=0.02)
    assert abs(picture.placement.turn_deg) < 5
    assert opened.case.record.plantar.pressure is None


def test_a_map_without_a_foot_of_its_side_is_told(
    opened: Application, questions: CannedQuestions, settle: Settle, tmp_path: Path
) -> None:
    questions.path = written_plate(opened, tmp_path / "plate.csv")
    act(opened, "lay_pressure")
    settle()
    (dialog,) = opened.window.findChildren(PressureDialog)
    pick(dialog.side, "right")
    pick(dialog.seen_from, "above")
    QTest.mouseClick(dialog.lay_button, LEFT)
    settle()
    assert opened.case.record.plantar.pressure is None
    (told,) = opened.services.messages.dialogs
    assert "no right foot" in told.text()


@pytest.mark.parametrize("is_aligning", [True, False])
def test_a_map_never_comes_into_the_next_case(
    opened: Application,
    questions: CannedQuestions,
    settle: Settle,
    tmp_path: Path,
    is_aligning: bool,
) -> None:
    dialog = asked(opened, questions, settle, tmp_path / "plate.csv")
    if is_aligning:
        QTest.mouseClick(dialog.lay_button, LEFT)
    assert opened.case.foot is not None
    source = ScanSource("mesh", "/nowhere/next.ply", "1" * 64)
    foot = FootRecord.begun(copy(opened.case.foot), source)
    opened.case.open(CaseRecord.of_foot(foot), None)
    settle()
    now = opened.case.record.of_side(Side.LEFT)
    assert now is not None
    assert now.source == source
    assert now.plantar.pressure is None
    assert not [one for one in opened.window.findChildren(PressureDialog) if one.isVisible()]


def test_a_foot_changed_while_its_map_is_aligned_stays(
    opened: Application, questions: CannedQuestions, settle: Settle, tmp_path: Path
) -> None:
    dialog = asked(opened, questions, settle, tmp_path / "plate.csv")
    QTest.mouseClick(dialog.lay_button, LEFT)
    before = opened.case.record.of_side(Side.LEFT)
    assert before is not None
    changed = replace(before, foot=copy(before.foot))
    opened.case.apply(changed, "Scan again")
    settle()
    now = opened.case.record.of_side(Side.LEFT)
    assert now is not None
    assert now.foot is changed.foot
    assert now.plantar.pressure is None
    (told,) = opened.services.messages.dialogs
    assert "lay it again" in told.text()


def test_the_only_foot_is_chosen_and_return_cancels_nothing_while_something_is_open(
    opened: Application, questions: CannedQuestions, settle: Settle, tmp_path: Path
) -> None:
    questions.path = written_plate(opened, tmp_path / "plate.csv")
    act(opened, "lay_pressure")
    settle()
    (dialog,) = opened.window.findChildren(PressureDialog)
    assert dialog.side.currentData() == "left"
    assert dialog.open_questions() == ["Seen from"]
    for widget in (dialog.seen_from, dialog):
        QTest.keyClick(widget, Qt.Key.Key_Return)
        assert dialog.isVisible()
    pick(dialog.seen_from, "above")
    QTest.keyClick(dialog.seen_from, Qt.Key.Key_Return)
    settle()
    foot = opened.case.record.of_side(Side.LEFT)
    assert foot is not None
    assert foot.plantar.pressure is not None


def test_another_map_of_a_file_is_shown(opened: Application, qtbot: QtBot, tmp_path: Path) -> None:
    (long,) = read_pressure(written_plate(opened, tmp_path / "plate.csv"))
    long = replace(long, values=np.repeat(long.values, 3, axis=0))
    short = replace(long, values=long.values[:1])
    dialog = PressureDialog("plates.csv", (long, short), (), None)
    qtbot.addWidget(dialog)
    pick(dialog.kind, "frame")
    dialog.frame.setValue(3)
    pick(dialog.which, "1")
    assert dialog.frame.value() == 1
    assert dialog.recording is short


def test_a_threshold_does_not_come_to_the_next_patient(laid: Application, settle: Settle) -> None:
    def shown() -> float:
        fields = laid.stage.parameters.findChildren(NumberField)
        (field,) = (
            one for one in fields if one.property("key") == "plantar.threshold" and one.isVisible()
        )
        return field.value()

    usual = shown()
    laid.stage.parameters.field_edited.emit("plantar.threshold", usual - 50.0)
    record = laid.case.record
    laid.case.open(CaseRecord(), None)
    laid.case.open(record, None)
    settle()
    act(laid, "tool_plantar")
    settle()
    assert shown() == usual
