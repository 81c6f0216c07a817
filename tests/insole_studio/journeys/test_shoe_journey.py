"""A shoe is chosen by size or last, seen round the insole, trimmed to, and undone."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from canned_questions import CannedQuestions
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from insole_core.foot import measures
from insole_core.formats.stl import write_stl
from insole_core.geometry.side import Side
from insole_studio.app.bootstrap import Application
from insole_studio.features.design.shoe.shoe_dialog import ShoeDialog
from insole_studio.widgets.form_parts import ComboBox
from tests.insole_core.insole.test_shoes import last

pytestmark = pytest.mark.one_window

Settle = Callable[[], None]


def pick(box: ComboBox, value: str) -> None:
    """Choose an entry as the user does."""
    box.setCurrentIndex(box.findData(value))
    box.activated.emit(box.currentIndex())


@pytest.fixture
def dialog(opened: Application) -> ShoeDialog:
    opened.window.actions_by_key["choose_shoe"].trigger()
    (shown,) = opened.window.findChildren(ShoeDialog)
    return shown


@pytest.fixture
def length_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Take the foot, which has no toes, for one whose length is known."""
    monkeypatch.setattr(measures, "is_length_seen", lambda _landmarks: True)


def type_in(field: object, text: str) -> None:
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Tab)


@pytest.mark.usefixtures("length_seen")
def test_a_shoe_by_size_is_trimmed_to_and_undone(
    opened: Application, dialog: ShoeDialog, settle: Settle
) -> None:
    pick(dialog.kind, "size")
    assert dialog.size_field.value() == 40.0  # (250 + 15) mm / 6.67 mm, to the half
    type_in(dialog.size_field, "36")
    assert "wider than the shoe EU 36, regular" in dialog.note.text()
    dialog.trim.click()
    assert "wider" not in dialog.note.text()
    QTest.mouseClick(dialog.take_button, Qt.MouseButton.LeftButton)
    settle()
    shoe = opened.case.record.design.outline.shoe
    assert (shoe.name, shoe.trim) == ("EU 36, regular", True)
    opened.window.actions_by_key["undo"].trigger()
    assert opened.case.record.design.outline.shoe is None
    opened.window.actions_by_key["redo"].trigger()
    opened.window.actions_by_key["choose_shoe"].trigger()
    (again,) = opened.window.findChildren(ShoeDialog)
    assert again.kind.currentText() == "EU 36, regular"
    assert again.trim.isChecked()
    pick(again.kind, "any")
    again.accept()
    assert opened.case.record.design.outline.shoe is None


def test_a_size_that_does_not_exist_cannot_be_used(dialog: ShoeDialog) -> None:
    pick(dialog.kind, "size")
    type_in(dialog.size_field, "70")
    assert "goes from 16 to 50" in dialog.note.text()
    assert not dialog.take_button.isEnabled()
    dialog.reject()


def test_no_size_follows_from_a_length_that_is_a_guess(dialog: ShoeDialog) -> None:
    """The foot on the bench has no toes."""
    pick(dialog.kind, "size")
    assert "no size is proposed" in dialog.note.text()
    assert not dialog.take_button.isEnabled()
    type_in(dialog.size_field, "41")
    assert "no size is proposed" not in dialog.note.text()
    assert dialog.take_button.isEnabled()
    dialog.reject()


def test_the_size_of_an_outline_is_asked_for_where_the_length_is_a_guess(
    opened: Application, questions: CannedQuestions
) -> None:
    def choose() -> None:
        fields = opened.stage.parameters.findChildren(ComboBox)
        pick(next(c for c in fields if c.property("key") == "outline.source"), "shoe_size")

    def outline() -> tuple[str, float | None]:
        found = opened.case.record.design.outline
        return found.source, found.shoe_size_eu

    choose()  # and give it up
    assert "no size is proposed" in questions.asked[-1]
    assert outline() == ("foot", None)
    questions.given = {"size": "410"}
    choose()
    assert outline() == ("foot", None)
    questions.given = {"size": "41,5"}
    choose()
    assert outline() == ("shoe_size", 41.5)


@pytest.mark.parametrize("is_right", [False, True])
def test_a_last_is_read_and_its_side_is_checked(
    opened: Application,
    dialog: ShoeDialog,
    questions: CannedQuestions,
    settle: Settle,
    tmp_path: Path,
    is_right: bool,
) -> None:
    foot_side = opened.case.side
    assert foot_side is not None
    side = foot_side if is_right else foot_side.other
    path = tmp_path / "last 40.stl"
    write_stl(last(Side(side)), path)
    questions.path = path
    pick(dialog.kind, "last")
    assert not dialog.take_button.isEnabled()
    dialog.browse.click()
    settle()
    if is_right:
        dialog.accept()
        assert opened.case.record.design.outline.shoe.name == "last 40"
    else:
        assert f"is a last for the {side} foot" in dialog.note.text()
        assert not dialog.take_button.isEnabled()
        dialog.reject()


def test_where_the_insole_is_wider_is_drawn(
    opened: Application, dialog: ShoeDialog, settle: Settle
) -> None:
    pick(dialog.kind, "size")
    type_in(dialog.size_field, "36")
    dialog.accept()
    settle()
    lines = opened.stage.insole_presenter._shoe_lines
    assert lines is not None
    assert lines.faults
    assert "wider" in lines.text
    opened.window.actions_by_key["undo"].trigger()
    settle()
    assert opened.stage.insole_presenter._shoe_lines is None
