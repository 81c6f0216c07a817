"""The legend tells what has no value, also where its title finds no room."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtGui import QColor
from pytestqt.qtbot import QtBot

from insole_studio.scene.coloring import MISSING, Coloring
from insole_studio.widgets.legend import Legend

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


def test_a_scale_that_ends_before_the_values_says_so(qtbot: QtBot) -> None:
    legend = Legend()
    qtbot.addWidget(legend)
    legend.resize(430, 22)
    pictures = []
    for is_clipped in (False, True):
        legend.show_coloring(replace(COLORING, is_clipped=is_clipped))
        pictures.append(legend.grab().toImage())
    assert pictures[0] != pictures[1]


def _has_swatch(legend: Legend) -> bool:
    image = legend.grab().toImage()
    row = [image.pixelColor(x, 11) for x in range(image.width())]
    return sum(color == QColor(MISSING) for color in row) >= 14
