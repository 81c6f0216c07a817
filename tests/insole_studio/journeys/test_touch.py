"""With targets for fingers nothing is cut off, also on a small screen."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QApplication,
    QLabel,
    QMenu,
    QPushButton,
    QScrollArea,
    QToolBar,
    QToolButton,
    QWidget,
)
from pytestqt.qtbot import QtBot

from insole_studio.app.bootstrap import Application
from insole_studio.app.theme import apply_theme
from insole_studio.features.foot.view import FootStageView
from insole_studio.widgets.number_field import NumberField

pytestmark = pytest.mark.one_window

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


@pytest.mark.usefixtures("fingers")
def test_many_notices_leave_the_status_line_on_the_screen(
    opened: Application, qtbot: QtBot
) -> None:
    window, notices = opened.window, opened.services.notices
    window.resize(*SMALL)
    for number in range(6):
        notices.put(
            f"{number}", "The scan was changed. " * 8, ("Open it", str), ("Discard it…", str)
        )
    status = window.statusBar()
    qtbot.waitUntil(lambda: opened.stage.notices.verticalScrollBar().maximum() > 0)
    assert window.height() == SMALL[1]
    assert status.geometry().bottom() < SMALL[1]
    assert status.isVisible()
    last = opened.stage.notices.findChildren(QPushButton)[-1]
    opened.stage.notices.ensureWidgetVisible(last)
    QTest.mouseClick(last, Qt.MouseButton.LeftButton)
    assert [notice.key for notice in notices.notices] == ["0", "1", "2", "3", "4"]


@pytest.mark.usefixtures("fingers")
@pytest.mark.own_window
def test_every_menu_is_one_column_on_the_screen(opened: Application, qtbot: QtBot) -> None:
    """Long ones scroll: Qt would break them into columns."""
    menus = [menu for menu in opened.window.menuBar().findChildren(QMenu) if menu.actions()]
    assert len(menus) > 5
    scrolled = 0
    for menu in menus:
        menu.popup(QPoint(0, 0))
        qtbot.waitExposed(menu)
        room = menu.screen().availableGeometry()
        shown = [action for action in menu.actions() if action.isVisible()]
        assert len({menu.actionGeometry(action).left() for action in shown}) == 1
        assert menu.height() <= room.height()
        scrolled += menu.actionGeometry(shown[-1]).bottom() > menu.height()
        menu.setActiveAction(shown[-1])
        assert menu.rect().contains(menu.actionGeometry(shown[-1]))
        menu.close()
    assert scrolled >= 1


def labelled_tools(application: Application) -> list[str]:
    """The tools of the toolbar whose labels are shown beside their icons."""
    buttons = application.window.findChild(QToolBar, "toolbar").findChildren(QToolButton)
    beside = Qt.ToolButtonStyle.ToolButtonTextBesideIcon
    return [button.text() for button in buttons if button.toolButtonStyle() == beside]


def test_the_tools_keep_their_labels_when_touch_mode_comes_and_goes(
    opened: Application, settle: Callable[[], None], qapp: QApplication
) -> None:
    opened.window.resize(*SMALL)
    opened.window.show()
    labelled: list[list[str]] = []
    try:
        for _ in range(4):
            opened.window.actions_by_key["touch"].trigger()
            settle()
            QTest.qWait(50)
            toolbar = opened.window.findChild(QToolBar, "toolbar")
            assert toolbar.sizeHint().width() <= opened.window.width()
            labelled.append(labelled_tools(opened))
        opened.features.case_files.opener.new_case()
        settle()
        labelled.append(labelled_tools(opened))
    finally:
        apply_theme(qapp, dark=False)
    assert len(labelled[0]) > 8
    assert labelled[0] == labelled[2]
    assert labelled[1] == labelled[3] == labelled[4]


def test_a_narrow_window_hides_only_the_last_labels_of_the_tools(
    opened: Application, settle: Callable[[], None]
) -> None:
    opened.window.resize(1600, 728)
    opened.window.show()
    settle()
    QTest.qWait(50)
    every = labelled_tools(opened)
    toolbar = opened.window.findChild(QToolBar, "toolbar")
    opened.window.resize(toolbar.sizeHint().width() - 100, 728)
    settle()
    QTest.qWait(50)
    left = labelled_tools(opened)
    assert toolbar.sizeHint().width() <= opened.window.width()
    assert left == every[: len(left)]
    assert 1 <= len(every) - len(left) <= 3


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
