"""The table of measures keeps the lines that other measures need as well."""

from __future__ import annotations

import pytest
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

from insole_studio.features.design.patient.measure_grid import MeasureGrid
from insole_studio.features.design.rows import Measure
from insole_studio.widgets.form_parts import LinkLabel

WIDE = Measure("Ball width", ("98.2",), "mm", "across the ball", "ball_width")
TOLD = Measure("of one foot", ())


@pytest.fixture
def grid(qtbot: QtBot) -> MeasureGrid:
    grid = MeasureGrid()
    qtbot.addWidget(grid)
    grid.show()
    grid.show_measures([WIDE, TOLD])
    return grid


def shown(grid: MeasureGrid) -> list[str]:
    labels = [label for label in grid.findChildren(QLabel) if label.isVisible()]
    return [words_of(label) for label in sorted(labels, key=lambda one: (one.y(), one.x()))]


def words_of(label: QLabel) -> str:
    return (
        label.text().split(">")[1].removesuffix("</a")
        if isinstance(label, LinkLabel)
        else label.text()
    )


def link(grid: MeasureGrid) -> LinkLabel:
    (found,) = (one for one in grid.findChildren(LinkLabel) if one.isVisible())
    return found


def test_other_values_and_words_stand_in_the_same_lines(grid: MeasureGrid, qtbot: QtBot) -> None:
    name = link(grid)
    grid.show_measures([Measure("Bredd", ("101.0",), "mm", "trampdyna", "ball_width"), TOLD])
    qtbot.waitUntil(lambda: shown(grid) == ["Bredd", "101.0 mm", "of one foot"])
    assert link(grid) is name
    tips = {label.toolTip() for label in grid.findChildren(QLabel)}
    assert tips == {"trampdyna", ""}
    chosen: list[str] = []
    grid.chosen.connect(chosen.append)
    name.linkActivated.emit("ball_width")
    assert chosen == ["ball_width"]


def test_measures_that_come_back_after_none_are_their_own(grid: MeasureGrid, qtbot: QtBot) -> None:
    name = link(grid)
    grid.show_measures([])
    assert not grid.isVisible()
    grid.show_measures([Measure("Ball width", ("90.1",), "mm", "", "ball_width"), TOLD])
    qtbot.waitUntil(lambda: shown(grid) == ["Ball width", "90.1 mm", "of one foot"])
    assert link(grid) is name


def test_both_feet_have_more_columns_and_quiet_what_is_within_the_error(
    grid: MeasureGrid, qtbot: QtBot
) -> None:
    name = link(grid)
    values = ("98.2", "99.0", "0.5", "−0.8", "0.8")
    both = Measure("Ball width", values, "mm", "", "ball_width", is_within_error=True)
    grid.show_measures([both])
    qtbot.waitUntil(lambda: [text for text in shown(grid) if text in values] == list(values))
    assert link(grid) is not name
    quiet = [label.text() for label in grid.findChildren(QLabel) if label.objectName() == "quiet"]
    assert set(values[2:]) <= set(quiet)
    grid.show_measures([Measure("Ball width", values, "mm", "", "ball_width")])
    quiet = [
        label.text()
        for label in grid.findChildren(QLabel)
        if label.isVisible() and label.objectName() == "quiet"
    ]
    assert "−0.8" not in quiet
