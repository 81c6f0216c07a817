"""The cut: what it measures, and what of it is on the screen."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QPoint
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from insole_studio.widgets.section_chart import SectionChart

TOP = np.array([[-40.0, 8.0], [0.0, 12.0], [40.0, 4.0]])
BOTTOM = TOP * [1.0, 0.0]


@pytest.fixture
def chart(qtbot: QtBot) -> SectionChart:
    chart = SectionChart()
    qtbot.addWidget(chart)
    chart.resize(400, 160)
    chart.show()
    return chart


def test_it_measures_the_material(chart: SectionChart) -> None:
    chart.show_cut(TOP, BOTTOM, np.empty((0, 2, 2)), ("Lateral", "Medial"))
    assert chart.thickness_mm(-20.0) == pytest.approx(10.0)
    assert chart.thickness_mm(20.0) == pytest.approx(8.0)
    assert chart.thickness_mm(50.0) is None


def test_body_is_painted_and_the_pointer_adds_a_measure(chart: SectionChart) -> None:
    chart.show_sentence("Nothing yet")
    empty = chart.grab().toImage()
    chart.show_cut(TOP, BOTTOM, np.array([[[-30.0, 13.0], [30.0, 13.0]]]), ("Lateral", "Medial"))
    cut = chart.grab().toImage()
    assert cut != empty
    QTest.mouseMove(chart, QPoint(200, 80))
    QTest.qWait(10)
    assert chart.grab().toImage() != cut
