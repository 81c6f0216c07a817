from __future__ import annotations

from collections.abc import Iterator

import pytest
from PySide6.QtWidgets import QApplication, QHeaderView
from pytestqt.qtbot import QtBot

from insole_studio.app.theme import apply_theme
from insole_studio.features.foot.rows import ViewRow
from insole_studio.features.foot.view_table import ViewTable

ROW = ViewRow("top", (200, 100, 100), True, 8, 8, (0.4, 0.5, 1.2), 0.13, 0.7, 10, 0, "", True)


@pytest.fixture
def dark(qapp: QApplication) -> Iterator[None]:
    apply_theme(qapp, dark=True)
    yield
    apply_theme(qapp, dark=False)


@pytest.mark.usefixtures("dark", "swedish")
def test_names_and_numbers_are_whole_and_written_as_the_language_does(qtbot: QtBot) -> None:
    table = ViewTable()
    qtbot.addWidget(table)
    table.resize(900, 200)
    table.show_rows([ROW], "top")
    table.show()
    qtbot.waitExposed(table)
    texts = [table.item(0, column).text() for column in range(table.columnCount())]
    assert texts == ["uppifrån", "8 / 8", "0,13", "0,4", "0,5", "1,2", "± 0,7", "10 / 10", "Bra"]
    cell = table.visualRect(table.model().index(0, 0))
    shown = table.viewport().grab(cell).toImage()
    table.horizontalHeader().setSectionResizeMode(0, QHeaderView.ResizeMode.Fixed)
    table.setColumnWidth(0, cell.width() + 100)
    assert table.viewport().grab(cell).toImage() == shown  # it has no more to show
