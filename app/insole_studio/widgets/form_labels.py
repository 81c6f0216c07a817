"""The labels of a form, so that the theme can put them level with fields made for fingers."""

from __future__ import annotations

from PySide6.QtWidgets import QFormLayout


def mark_labels(form: QFormLayout) -> None:
    """Let the theme know the labels of a form."""
    for row in range(form.rowCount()):
        item = form.itemAt(row, QFormLayout.ItemRole.LabelRole)
        label = None if item is None else item.widget()
        if label is not None:
            label.setProperty("form", True)
