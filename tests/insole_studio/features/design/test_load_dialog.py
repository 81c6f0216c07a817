"""What the window of the change of pressure says has room in it, and a screen has room for it."""

from __future__ import annotations

from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from insole_studio.features.design.load.load_dialog import LoadDialog


def test_long_names_of_variants_are_elided_over_their_figures_and_whole_in_the_tip(
    qtbot: QtBot,
) -> None:
    dialog = LoadDialog(is_read=True, parent=None)
    qtbot.addWidget(dialog)
    names = ["Variant Soft cover, relief of the second head", "Variant A"]
    dialog.show_rows((), "", names)
    dialog.show()
    model, across = dialog.table.model(), Qt.Orientation.Horizontal
    long, short = (model.headerData(column, across) for column in (1, 2))
    assert long.startswith("Var")
    assert long.endswith("head (95 %)")  # names differ at their end
    assert "…" in long
    assert long.endswith("head (95 %)")  # where names differ
    assert short == "Variant A (95 %)"
    tips = [model.headerData(column, across, Qt.ItemDataRole.ToolTipRole) for column in (1, 2)]
    assert tips == names
    assert dialog.table.horizontalHeader().length() <= dialog.table.viewport().width()
    dialog.show_rows((), "")
    assert model.headerData(1, across, Qt.ItemDataRole.ToolTipRole) is None
