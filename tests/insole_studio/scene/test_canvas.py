"""The widget that shows the picture of its plotter where Qt has no GL."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from PySide6.QtGui import QColor
from pytestqt.qtbot import QtBot

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
