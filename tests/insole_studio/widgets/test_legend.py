"""The legend tells what has no value, also where its title finds no room."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QApplication, QFrame, QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from insole_studio.scene.coloring import MISSING, Coloring, Swatch
from insole_studio.widgets.legend import BAR_PX, LEAST_BAR_PX, Legend, SwatchLegend

COLORING = Coloring(np.zeros(3), (0.0, 2.0), "Standard deviation of every vertex")


@pytest.mark.parametrize("width", [430, 900])
def test_missing_values_have_a_swatch(qtbot: QtBot, width: int) -> None:
    legend = Legend()
    qtbot.addWidget(legend)
    legend.resize(width, 22)
    legend.show_coloring(COLORING)
    assert not _has_swatch(legend)
    wide = legend.sizeHint().width()
    legend.show_coloring(replace(COLORING, missing="not measured"))
    assert _has_swatch(legend)
    assert legend.sizeHint().width() > wide + 14


def test_where_there_is_little_room_the_strip_is_short_and_both_limits_are_whole(
    qtbot: QtBot,
) -> None:
    legend = Legend()
    qtbot.addWidget(legend)
    legend.show_coloring(replace(COLORING, limits=(-100.0, 100.0)))
    lefts = []
    for width in (430, legend.minimumSizeHint().width()):  # no room for the title in either
        legend.resize(width, 22)
        image = legend.grab().toImage()
        ground = image.pixelColor(0, 0)
        ink = [x for x in range(width) if any(image.pixelColor(x, y) != ground for y in range(22))]
        lefts.append(width - ink[0])
        assert ink[0] > 0
    assert lefts[0] - lefts[1] == BAR_PX - LEAST_BAR_PX


def test_a_scale_that_ends_before_the_values_says_so(qtbot: QtBot) -> None:
    legend = Legend()
    qtbot.addWidget(legend)
    legend.resize(430, 22)
    pictures = []
    for is_clipped in (False, True):
        legend.show_coloring(replace(COLORING, is_clipped=is_clipped))
        pictures.append(legend.grab().toImage())
    assert pictures[0] != pictures[1]


def test_other_values_on_the_same_scale_lay_nothing_out_anew(qtbot: QtBot) -> None:
    panel, legend, laid_out = QWidget(), Legend(), []

    class Watch(QObject):
        def eventFilter(self, _watched: QObject, event: QEvent) -> bool:  # noqa: N802
            if event.type() is QEvent.Type.LayoutRequest:
                laid_out.append(event)
            return False

    watch = Watch()
    qtbot.addWidget(panel)
    panel.installEventFilter(watch)
    QVBoxLayout(panel).addWidget(legend)
    panel.show()
    legend.show_coloring(COLORING)
    QApplication.processEvents()
    before = len(laid_out)
    legend.show_coloring(replace(COLORING, values=np.ones(3)))  # as at each step of a drag
    QApplication.processEvents()
    assert len(laid_out) == before
    legend.show_coloring(replace(COLORING, missing="not measured"))
    QApplication.processEvents()
    assert len(laid_out) > before


def test_stripes_tell_colours_apart_that_are_alike_in_print(qtbot: QtBot) -> None:
    legend = SwatchLegend()
    qtbot.addWidget(legend)
    swatches = [
        Swatch("plain", "#a0a0a0"),
        Swatch("slanted", "#e0e0e0", "#606060"),
        Swatch("level", "#e0e0e0", "#606060", is_slanted=False),
    ]
    legend.show_swatches(swatches)
    legend.resize(400, 22)
    legend.show()
    squares = [one.grab().toImage() for one in legend.findChildren(QFrame) if one.width() == 14]
    assert len(squares) == len(swatches)
    plain, slanted, level = (
        [[image.pixelColor(x, y).red() for x in range(3, 11)] for y in range(3, 11)]
        for image in squares
    )
    assert {red for row in plain for red in row} == {0xA0}
    for lines in (slanted, list(zip(*slanted, strict=True))):
        assert max(max(line) - min(line) for line in lines) >= 0x60
    assert all(len(set(row)) == 1 for row in level)
    assert len({tuple(row) for row in level}) > 1


def _has_swatch(legend: Legend) -> bool:
    image = legend.grab().toImage()
    row = [image.pixelColor(x, 11) for x in range(image.width())]
    return sum(color == QColor(MISSING) for color in row) >= 14
