"""The unrolled rim: stations are chosen, dragged, nudged, added and removed by real events."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from insole_studio.widgets.rim_chart import ChartStation, ChartZone, RimChart, RimGraph

LEFT = Qt.MouseButton.LeftButton
S_MM = np.linspace(0.0, 600.0, 601)
STATIONS = (
    ChartStation(100.0, 20.0),
    ChartStation(300.0, 12.0),
    ChartStation(450.0, 8.0),
)
TEXTS = ("Medial, 40 %", "Behind the heel", "Lateral, 40 %")
ZONES = (
    ChartZone("Medial", 0.0, 220.0),
    ChartZone("Heel", 220.0, 380.0),
    ChartZone("Lateral", 380.0, 540.0),
    ChartZone("Toes", 540.0, 600.0),
)


def graph(stations: tuple[ChartStation, ...] = STATIONS) -> RimGraph:
    knots = sorted((s.s_mm, s.height_mm) for s in stations)
    rim = np.interp(S_MM, *np.transpose(knots))
    flank = np.where(S_MM < 540, 25.0, np.nan)
    return RimGraph(S_MM, rim, flank, stations, ZONES, TEXTS.__getitem__)


@pytest.fixture
def chart(qtbot: QtBot) -> RimChart:
    chart = RimChart()
    qtbot.addWidget(chart)
    chart.resize(660, 160)
    chart.show()
    chart.show_graph(graph(), None)
    return chart


def pixel(chart: RimChart, number: int) -> QPoint:
    station = STATIONS[number]
    return chart.pixel_of(station.s_mm, station.height_mm).toPoint()


@pytest.mark.parametrize(("right", "up", "along_mm", "raised_mm"), [
    (0, 0, 0.0, 0.0), (3, 20, 0.0, 1.0), (40, 0, 1.0, 0.0), (-40, -20, -1.0, -1.0),
])  # fmt: skip
def test_a_drag_moves_the_station_by_its_way(
    chart: RimChart, qtbot: QtBot, right: int, up: int, along_mm: float, raised_mm: float
) -> None:
    """Along the edge only beyond a few pixels: who raises a station does not shift it."""
    start, end = pixel(chart, 1), pixel(chart, 1) + QPoint(right, -up)
    per_px = 1 / (chart.pixel_of(1, 0).x() - chart.pixel_of(0, 0).x())
    up_per_px = 1 / (chart.pixel_of(0, 0).y() - chart.pixel_of(0, 1).y())
    moves: list[tuple[float, float]] = []
    chart.dragged.connect(lambda s, z: moves.append((s, z)))
    with qtbot.waitSignal(chart.grabbed) as grabbed:
        QTest.mousePress(chart, LEFT, pos=start)
    QTest.mouseMove(chart, end)
    with qtbot.waitSignal(chart.released):
        QTest.mouseRelease(chart, LEFT, pos=end)
    assert grabbed.args == [1]
    expected = (300.0 + along_mm * 40 * per_px, 12.0 + raised_mm * 20 * up_per_px)
    assert moves[-1] == pytest.approx(expected, abs=1e-6)


def test_the_scale_stays_during_a_drag(chart: RimChart) -> None:
    QTest.mousePress(chart, LEFT, pos=pixel(chart, 1))
    before = chart.pixel_of(0.0, 10.0)
    higher = (STATIONS[0], ChartStation(300.0, 40.0), STATIONS[2])
    chart.show_graph(graph(higher), 1)
    assert chart.pixel_of(0.0, 10.0) == before
    QTest.mouseRelease(chart, LEFT, pos=pixel(chart, 1))
    chart.show_graph(graph(higher), 1)
    assert chart.pixel_of(0.0, 40.0).y() > 0
    assert chart.pixel_of(0.0, 10.0) != before


def test_escape_gives_a_drag_up(chart: RimChart, qtbot: QtBot) -> None:
    QTest.mousePress(chart, LEFT, pos=pixel(chart, 0))
    with qtbot.waitSignal(chart.cancelled):
        QTest.keyClick(chart, Qt.Key.Key_Escape)
    with qtbot.assertNotEmitted(chart.released):
        QTest.mouseRelease(chart, LEFT, pos=pixel(chart, 0))


@pytest.mark.parametrize(("modifier", "step"), [
    (Qt.KeyboardModifier.NoModifier, 0.5),
    (Qt.KeyboardModifier.ShiftModifier, 5.0),
    (Qt.KeyboardModifier.ControlModifier, 0.05),
])  # fmt: skip
def test_arrow_keys_nudge_the_selected_station(
    chart: RimChart, qtbot: QtBot, modifier: Qt.KeyboardModifier, step: float
) -> None:
    chart.show_graph(graph(), 2)
    for key, right, up in (
        (Qt.Key.Key_Up, 0, 1), (Qt.Key.Key_Down, 0, -1),
        (Qt.Key.Key_Right, 1, 0), (Qt.Key.Key_Left, -1, 0),
    ):  # fmt: skip
        with qtbot.waitSignal(chart.nudged) as nudged:
            QTest.keyClick(chart, key, modifier)
        assert nudged.args == pytest.approx([2, right * step, up * step])


def test_page_keys_choose_in_the_order_along_the_edge(chart: RimChart) -> None:
    shuffled = (STATIONS[2], STATIONS[0], STATIONS[1])
    chart.show_graph(graph(tuple(sorted(shuffled, key=lambda s: s.s_mm))), None)
    chart.show_graph(
        RimGraph(S_MM, S_MM * 0 + 9.0, S_MM * np.nan, shuffled, ZONES, TEXTS.__getitem__), None
    )
    chosen: list[int] = []

    def take(number: int) -> None:
        chosen.append(number)
        chart.show_graph(
            RimGraph(S_MM, S_MM * 0 + 9.0, S_MM * np.nan, shuffled, ZONES, TEXTS.__getitem__),
            number,
        )

    chart.chosen.connect(take)
    for _ in range(4):
        QTest.keyClick(chart, Qt.Key.Key_PageDown)
    QTest.keyClick(chart, Qt.Key.Key_PageUp)
    assert chosen == [1, 2, 0, 1, 0]


def test_stations_are_added_and_removed(chart: RimChart, qtbot: QtBot) -> None:
    with qtbot.waitSignal(chart.added) as added:
        QTest.mouseDClick(chart, LEFT, pos=chart.pixel_of(200.0, 16.0).toPoint())
    assert added.args[0] == pytest.approx(200.0, abs=1.0)
    with qtbot.assertNotEmitted(chart.added):
        QTest.mouseDClick(chart, LEFT, pos=pixel(chart, 0))
    with qtbot.assertNotEmitted(chart.removed):
        QTest.keyClick(chart, Qt.Key.Key_Delete)
    chart.show_graph(graph(), 1)
    with qtbot.waitSignal(chart.removed) as removed:
        QTest.keyClick(chart, Qt.Key.Key_Delete)
    assert removed.args == [1]
    with qtbot.waitSignal(chart.added) as added:
        QTest.keyClick(chart, Qt.Key.Key_Insert)
    assert added.args == [375.0], "midway to the next one"


def test_rim_flank_and_stations_are_painted_and_a_sentence_in_their_place(chart: RimChart) -> None:
    shown = chart.grab().toImage()
    without_flank = RimGraph(
        S_MM, graph().rim_mm, S_MM * np.nan, STATIONS, ZONES, TEXTS.__getitem__
    )
    chart.show_graph(without_flank, None)
    assert chart.grab().toImage() != shown
    chart.show_sentence("As scanned")
    assert chart.grab().toImage() != shown
    assert chart.accessibleDescription() == "As scanned"
    QTest.mouseClick(chart, LEFT, pos=QPoint(200, 80))
    QTest.keyClick(chart, Qt.Key.Key_Up)


def test_what_is_selected_is_said_to_a_screen_reader(chart: RimChart) -> None:
    chart.show_graph(graph(), 1)
    assert chart.accessibleDescription() == TEXTS[1]


@pytest.mark.parametrize("wide", [660, 300, 220])
def test_the_legend_of_a_narrow_chart_is_not_written_over_itself(
    chart: RimChart, wide: int
) -> None:
    chart.resize(wide, 160)
    texts, places = zip(*chart.legend, strict=True)
    for one, following in itertools.pairwise(places):
        assert one.right() <= following.left()
    assert places[-1].right() <= wide
    whole = ("Rim", "Flank of the foot", "mm over the heel")
    assert (texts == whole) is (wide == 660)
    assert all(text.endswith("…") or text in ("", *whole) for text in texts)
