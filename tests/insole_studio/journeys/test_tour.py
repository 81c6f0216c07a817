"""The tour: it leads through a whole insole by what the user really does."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from pointing import LEFT, drag, pixel
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton, QWidget
from pytestqt.qtbot import QtBot

from insole_core.insole.elements import Pelott
from insole_studio.app.bootstrap import Application
from insole_studio.features.design.tools.key_point_tool import shown_points
from insole_studio.widgets.tour import Tour


@pytest.fixture
def tour(app: Application) -> Tour:
    """The tour, begun from the menu or by its key."""
    app.window.resize(1366, 768)
    app.window.actions_by_key["tour"].trigger()
    (begun,) = app.window.findChildren(Tour)
    return begun


def title(tour: Tour) -> str:
    return tour.shown.title


def target(tour: Tour) -> QWidget:
    widget = tour.shown.target()
    assert widget is not None
    assert widget.isVisible()
    return widget


def click(widget: QWidget) -> None:
    QTest.mouseClick(widget, LEFT)


@pytest.mark.slow
def test_it_leads_from_the_first_page_to_a_written_file(
    app: Application,
    tour: Tour,
    settle: Callable[[], None],
    questions,
    tmp_path: Path,
    qtbot: QtBot,
) -> None:
    def reached(expected: str) -> None:
        qtbot.waitUntil(lambda: title(tour) == expected)
        settle()

    assert app.window.page is app.features.records.start
    assert title(tour) == "A scan"
    click(target(tour))
    reached("The foot")
    click(target(tour))
    reached("The landmarks")
    view = app.stage.foot.scene
    assert target(tour) is app.stage.foot
    place = pixel(view, *shown_points(app.case)["metatarsal_head_1"])
    drag(view, place, place + QPoint(4, -4), place + QPoint(8, -8))
    reached("The design")
    click(target(tour))
    reached("A pelott")
    design = app.case.record.design
    assert design is not None
    (pelott,) = (c for c in design.corrections if isinstance(c, Pelott))
    place = pixel(view, *pelott.centre_mm)
    drag(view, place, place + QPoint(4, 8), place + QPoint(4, 16))
    reached("The numbers")
    QTest.keyClick(view.surface, Qt.Key.Key_Up)
    reached("The section")
    click(target(tour))
    reached("The cut")
    act = pixel(view, 0.0, 120.0)
    drag(view, act, act + QPoint(0, 4), act + QPoint(0, 8))
    reached("The profile")
    assert target(tour) is app.stage.section  # and it waits until that has been read
    (on,) = [b for b in tour.findChildren(QPushButton) if b.text() == "Next"]
    click(on)
    reached("Check & export")
    click(target(tour))
    reached("The file")
    questions.path = tmp_path / "insole.stl"
    stage = app.features.export.stage
    assert stage is not None
    qtbot.waitUntil(stage.view.export.isEnabled)
    click(target(tour))
    reached("Done")
    assert list(tmp_path.glob("*.stl"))
    stage.close()
    (finish,) = [b for b in tour.findChildren(QPushButton) if b.text() == "Finish"]
    click(finish)
    assert app.settings.tour_seen
    assert not tour.isVisible()


def test_it_is_left_at_any_time_and_blocks_nothing(app: Application, tour: Tour) -> None:
    assert not tour.isModal()
    assert app.window.isEnabled()
    app.window.actions_by_key["tour"].trigger()
    assert app.window.findChildren(Tour) == [tour]  # the same one, with the focus
    QTest.keyClick(tour, Qt.Key.Key_Escape)
    assert not tour.isVisible()
    assert app.settings.tour_seen


def skip(tour: Tour) -> None:
    (button,) = [b for b in tour.findChildren(QPushButton) if b.text() in ("Skip", "Next")]
    QTest.keyClick(button, Qt.Key.Key_Space)


@pytest.fixture
def tour_of_own(opened: Application) -> Tour:
    """The tour, begun while a case of one's own is open."""
    opened.window.resize(1366, 768)
    opened.window.actions_by_key["tour"].trigger()
    (begun,) = opened.window.findChildren(Tour)
    return begun


def test_with_a_case_of_ones_own_it_points_at_what_is_there(
    opened: Application, tour_of_own: Tour, settle: Callable[[], None], qtbot: QtBot
) -> None:
    record = opened.case.record
    skip(tour_of_own)
    settle()
    assert opened.window.page is None
    assert opened.case.record is record
    while title(tour_of_own) != "The profile":
        target(tour_of_own)
        skip(tour_of_own)
    opened.window.actions_by_key["patients"].trigger()
    skip(tour_of_own)
    qtbot.waitUntil(opened.stage.steps.isVisible)
    middle = opened.stage.steps.mapToGlobal(opened.stage.steps.rect().center())
    assert abs(tour_of_own.geometry().center().x() - middle.x()) < opened.window.width() / 2


def test_escape_leads_back_to_the_case(opened: Application, tour_of_own: Tour) -> None:
    assert opened.window.page is opened.features.records.start
    QTest.keyClick(tour_of_own, Qt.Key.Key_Escape)
    assert opened.window.page is None


def test_skipping_the_first_stop_opens_the_example(
    app: Application, tour: Tour, settle: Callable[[], None]
) -> None:
    skip(tour)
    settle()
    assert title(tour) == "The foot"
    assert app.case.foot is not None
    target(tour)
