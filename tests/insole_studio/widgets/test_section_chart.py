"""The cut: what it measures, and what of it is on the screen."""

from __future__ import annotations

import itertools

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


@pytest.mark.parametrize("width", range(220, 760, 20))
def test_the_words_of_its_ruler_never_touch(chart: SectionChart, width: int) -> None:
    chart.resize(width, 130)
    chart.show_cut(TOP, BOTTOM, np.empty((0, 2, 2)), ("Heel", "Toes"))
    words = sorted(chart.ruler_words(), key=lambda word: word[0].left())
    assert words[-1][1] == "mm"
    assert len(words) > 2
    assert all(a.right() < b.left() for (a, _), (b, _) in itertools.pairwise(words))
    assert words[-1][0].right() <= width


SKIN = np.array([[[-30.0, 14.0], [10.0, 10.0]], [[-30.0, 90.0], [10.0, 90.0]]])


def test_the_legend_tells_every_curve_at_a_place(chart: SectionChart) -> None:
    ends = ("Lateral", "Medial")
    chart.show_cut(TOP, BOTTOM, SKIN, ends, cover=TOP - [0.0, 2.0], at_mm=-20.0)
    told = [("Foot", "13.0"), ("Contact surface", "10.0"), ("Cover", "8.0"), ("Underside", "0.0")]
    assert chart.legend() == told
    chart.show_cut(TOP, BOTTOM, SKIN, ends, at_mm=30.0)
    assert chart.legend() == [("Foot", ""), ("Contact surface", "6.0"), ("Underside", "0.0")]
    chart.show_cut(TOP, BOTTOM, SKIN, ends)
    assert chart.legend() == [("Foot", ""), ("Contact surface", ""), ("Underside", "")]


def test_the_pointer_over_the_chart_goes_before_the_place(chart: SectionChart) -> None:
    chart.show_cut(TOP, BOTTOM, SKIN, ("Lateral", "Medial"), at_mm=-40.0)
    assert chart.measured_mm == -40.0
    QTest.mouseMove(chart, QPoint(190, 70))
    QTest.qWait(10)
    assert chart.measured_mm == pytest.approx(-4.0, abs=20.0)
    assert chart.legend()[0] == ("Foot", f"{chart.skin_mm(chart.measured_mm):.1f}")


def test_body_is_painted_and_the_pointer_adds_a_measure(chart: SectionChart) -> None:
    chart.show_sentence("Nothing yet")
    empty = chart.grab().toImage()
    chart.show_cut(TOP, BOTTOM, np.array([[[-30.0, 13.0], [30.0, 13.0]]]), ("Lateral", "Medial"))
    cut = chart.grab().toImage()
    assert cut != empty
    QTest.mouseMove(chart, QPoint(200, 80))
    QTest.qWait(10)
    assert chart.grab().toImage() != cut
