"""Whether the window is light or dark."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication

from insole_studio.settings import Theme


def is_dark(theme: Theme) -> bool:
    """Return whether the theme, or the system if the theme follows it, is dark."""
    if theme == "system":
        return QGuiApplication.styleHints().colorScheme() == Qt.ColorScheme.Dark
    return theme == "dark"
