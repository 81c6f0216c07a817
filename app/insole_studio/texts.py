"""The one door through which every text of the window goes, so that it can be translated."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication


def tr(text: str) -> str:
    """Give `text` in the language of the window."""
    return QCoreApplication.translate("studio", text)
