"""A button of a dialog that Enter in a field does not press."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import SignalInstance
from PySide6.QtWidgets import QPushButton


def plain_button(
    text: str, run: Callable[..., object] | SignalInstance | None = None
) -> QPushButton:
    """Return a button that only a click on it or Space presses; `run` is what it does."""
    button = QPushButton(text)
    button.setAutoDefault(False)
    if run is not None:
        button.clicked.connect(run)
    return button
