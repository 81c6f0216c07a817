"""The labels of a form, marked so that the theme aligns them with fields enlarged for touch."""

from __future__ import annotations

from PySide6.QtWidgets import QFormLayout


def mark_labels(form: QFormLayout) -> None:
    """Mark the labels of a form for the theme's style sheet."""
    for row in range(form.rowCount()):
        item = form.itemAt(row, QFormLayout.ItemRole.LabelRole)
        label = None if item is None else item.widget()
        if label is not None:
            label.setProperty("form", True)
