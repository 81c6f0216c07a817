"""The recently opened files."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, Signal

from insole_studio.settings import Settings


class RecentFiles(QObject):
    """The list of recent files in the settings."""

    changed = Signal()

    def __init__(self, settings: Settings, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._settings = settings

    @property
    def names(self) -> list[str]:
        """Return the paths, the latest first."""
        return self._settings.recent

    def remember(self, path: Path) -> None:
        """Put a path at the head of the list."""
        self._settings.remember(path)
        self.changed.emit()
