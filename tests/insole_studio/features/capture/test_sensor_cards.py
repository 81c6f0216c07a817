"""The cards of all sensors fit beside the buttons of the capture stage, whatever the screen."""

from __future__ import annotations

from itertools import pairwise

import pytest
from PySide6.QtCore import QPoint, QRect
from PySide6.QtWidgets import QPushButton, QWidget
from pytestqt.qtbot import QtBot

from insole_studio.features.capture.rows import VIEWS_OF_BOTH, SensorRow
from insole_studio.features.capture.sensor_card import SensorCard
from insole_studio.features.capture.view import CaptureView


@pytest.fixture
def view(qtbot: QtBot) -> CaptureView:
    shown = CaptureView(5.0)
    qtbot.addWidget(shown)
    shown.show()
    return shown


def rows(count: int) -> list[SensorRow]:
    facts = "30 frames/s, 0 lost · warm in 15 min · 27% measured · markers 16 of 24"
    return [SensorRow(f"A{n}", view, view, facts) for n, view in enumerate(VIEWS_OF_BOTH[:count])]


def place(widget: QWidget, within: QWidget) -> QRect:
    return QRect(widget.mapTo(within, QPoint(0, 0)), widget.size())


@pytest.mark.parametrize(
    ("count", "width", "height", "columns", "scrolls"),
    [
        (3, 1366, 700, 3, False),
        (6, 1366, 700, 3, False),
        (6, 1920, 1020, 3, False),
        (6, 2560, 1300, 6, False),
        (7, 1366, 560, 4, True),
        (6, 740, 500, 2, True),
    ],
)
def test_cards_wrap_and_scroll_beside_the_buttons(
    view: CaptureView,
    qtbot: QtBot,
    count: int,
    width: int,
    height: int,
    columns: int,
    scrolls: bool,
) -> None:
    view.resize(width, height)
    view.show_sensors(rows(count))
    assert view.minimumSizeHint().width() <= width
    cards = view.findChildren(SensorCard)
    bar = view._grid.verticalScrollBar()
    qtbot.waitUntil(lambda: len({card.x() for card in cards}) == columns)
    qtbot.waitUntil(lambda: (bar.maximum() > 0) is scrolls)
    assert (view.width(), view.height()) == (width, height)
    for card in cards:
        across = place(card, view)
        assert 0 <= across.left() <= across.right() < width
    for one, other in pairwise(cards):
        assert not one.geometry().intersects(other.geometry())
    use = next(b for b in view.findChildren(QPushButton) if b.text() == "Use this scan")
    assert view.rect().contains(place(use, view))


def test_a_sensor_that_is_unplugged_leaves_no_gap(view: CaptureView, qtbot: QtBot) -> None:
    view.resize(1366, 700)
    view.show_sensors(rows(4))
    view.show_sensors(rows(3))
    qtbot.waitUntil(lambda: place(view._cards["A2"], view).right() > 1366 - 40)
    assert len({card.x() for card in view._cards.values()}) == 3
