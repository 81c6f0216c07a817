"""With targets for fingers nothing is cut off, also on a small screen."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from PySide6.QtWidgets import QApplication, QLabel, QScrollArea, QWidget
from pytestqt.qtbot import QtBot

from insole_studio.app.bootstrap import Application
from insole_studio.app.theme import apply_theme
from insole_studio.features.foot.view import FootStageView
from insole_studio.widgets.number_field import NumberField

SMALL = (1366, 728)


@pytest.fixture
def fingers(qapp: QApplication) -> Iterator[None]:
    apply_theme(qapp, dark=False, touch=True)
    yield
    apply_theme(qapp, dark=False)


def cut_numbers(stage: QWidget) -> list[str]:
    """The numbers that are wider than their fields."""
    QApplication.processEvents()
    fields = [field for field in stage.findChildren(NumberField) if field.isVisible()]
    assert len(fields) > 5
    return [
        field.text()
        for field in fields
        if field.lineEdit().width() < field.fontMetrics().horizontalAdvance(field.text())
    ]


@pytest.mark.slow
@pytest.mark.usefixtures("fingers")
def test_the_export_stage_is_whole(opened: Application, settle: Callable[[], None]) -> None:
    opened.window.actions_by_key["export"].trigger()
    stage = opened.features.export.stage
    assert stage is not None
    stage.resize(*SMALL)
    settle()
    assert cut_numbers(stage) == []
    for area in stage.findChildren(QScrollArea):
        content = area.widget()
        assert content.minimumSizeHint().width() <= area.viewport().width()
    stage.jobs.cancel("make")
    stage.close()


@pytest.mark.usefixtures("fingers")
def test_the_foot_stage_is_whole(qtbot: QtBot) -> None:
    view = FootStageView(dark=False)
    qtbot.addWidget(view)
    view.resize(*SMALL)
    view.show()
    assert cut_numbers(view) == []
    labels = [label for label in view.findChildren(QLabel) if label.isVisible() and label.text()]
    assert [x.text() for x in labels if x.width() < x.sizeHint().width()] == []
    assert view.minimumSizeHint().width() <= SMALL[0]
    view.close_scene()


def test_touch_mode_can_be_switched_while_the_window_is_open(
    opened: Application, settle: Callable[[], None], qapp: QApplication
) -> None:
    """The numbers stay readable at once, not only after another tool is taken."""
    opened.window.resize(*SMALL)
    action = opened.window.actions_by_key["touch"]
    try:
        for _ in range(2):  # on, and off again
            action.trigger()
            settle()
            assert cut_numbers(opened.stage.parameters) == []
    finally:
        apply_theme(qapp, dark=False)
