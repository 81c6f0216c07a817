"""A click on a heading sorts a table; rows that come later are sorted as well."""

from __future__ import annotations

from pointing import click_heading
from pytestqt.qtbot import QtBot

from insole_studio.widgets.row_table import RowTable, TableRow


def keys(table: RowTable) -> str:
    return "".join(row.key for row in table.rows)


def test_a_click_on_a_heading_sorts(qtbot: QtBot) -> None:
    table = RowTable(("Name", "Order"))
    qtbot.addWidget(table)
    table.resize(400, 200)
    table.show()
    rows = [
        TableRow("a", ("Öberg", "A 10")),
        TableRow("b", ("anna", "")),
        TableRow("c", ("Berg", "A 9")),
    ]
    table.show_rows(rows)
    table.selectRow(2)
    click_heading(table, 1)
    assert keys(table) == "cab"
    assert table.current_key == "c"
    click_heading(table, 1)
    assert keys(table) == "acb"
    table.show_rows([*rows, TableRow("d", ("Ek", "A 11"))])
    assert keys(table) == "dacb"
    click_heading(table, 1)
    assert keys(table) == "abcd"
    click_heading(table, 0)
    assert keys(table)[:2] == "bc"
