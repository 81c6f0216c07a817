"""The widget that shows the picture of its plotter, with and without GL of Qt."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from insole_studio.app.graphics import LEAST_OPENGL
from insole_studio.scene.canvas import Canvas, make_canvas


@pytest.fixture
def canvas(qtbot: QtBot) -> Iterator[Canvas]:
    built = make_canvas(lambda: None)
    built.resize(60, 40)
    built.show()
    yield built
    built.close_plotter()
    built.deleteLater()


def shown_color(canvas: Canvas) -> QColor:
    return canvas.grab().toImage().pixelColor(30, 20)


@pytest.mark.drawn
def test_it_draws_when_it_is_asked_and_not_before(canvas: Canvas, qtbot: QtBot) -> None:
    canvas.plotter.set_background("red")
    canvas.request_render()
    qtbot.waitUntil(lambda: shown_color(canvas) == QColor("red"))
    canvas.plotter.set_background("blue")
    qtbot.wait(10)
    assert shown_color(canvas) == QColor("red")
    canvas.request_render()
    qtbot.waitUntil(lambda: shown_color(canvas) == QColor("blue"))


@pytest.mark.drawn
def test_it_draws_in_the_size_it_gets(canvas: Canvas, qtbot: QtBot) -> None:
    canvas.resize(90, 50)
    qtbot.waitUntil(lambda: canvas.plotter.window_size == [90, 50])


def test_a_closed_one_is_asked_in_vain(canvas: Canvas, qtbot: QtBot) -> None:
    canvas.close_plotter()
    canvas.request_render()
    qtbot.wait(10)
    assert canvas.plotter is None


@pytest.mark.display
def test_what_is_asked_for_is_drawn_once(canvas: Canvas, qtbot: QtBot) -> None:
    """With real GL: drawing twice would keep what an undo has moved in its old place longer."""
    qtbot.waitExposed(canvas)
    canvas.plotter.set_background("red")
    qtbot.waitUntil(lambda: shown_color(canvas) == QColor("red"))
    drawn: list[str] = []
    canvas.plotter.renderer.AddObserver("EndEvent", lambda _renderer, event: drawn.append(event))
    canvas.plotter.set_background("blue")
    canvas.request_render()
    canvas.request_render()
    qtbot.waitUntil(lambda: len(drawn) > 0)
    for _ in range(5):
        QApplication.processEvents()
    assert len(drawn) == 1
    assert shown_color(canvas) == QColor("blue")


@pytest.mark.display
def test_a_view_leaves_the_format_that_the_program_begins_with(canvas: Canvas, qtlog: Any) -> None:
    """Set again, it would be told at each start in the terminal, as something that may go wrong."""
    assert canvas.surface.format().version() >= LEAST_OPENGL
    assert [record.message for record in qtlog.records if "format" in record.message] == []


@pytest.mark.display
def test_what_nobody_asked_for_is_aimed_too(qtbot: QtBot) -> None:
    """The first picture of an insole was taken from within it: its colour all over the view."""
    aimed: list[int] = []
    canvas = make_canvas(lambda: aimed.append(1))
    try:
        drawn: list[int] = []
        canvas.plotter.renderer.AddObserver("EndEvent", lambda *_: drawn.append(len(aimed)))
        canvas.resize(60, 40)
        canvas.show()
        qtbot.waitUntil(lambda: len(drawn) > 0)
        assert min(drawn) > 0
        last, count = drawn[-1], len(drawn)
        canvas.request_render()
        qtbot.waitUntil(lambda: len(drawn) > count)
        assert drawn[count] == last + 1, "once for a picture"
    finally:
        canvas.close_plotter()
        canvas.deleteLater()
