"""The window's own feature: appearance and help."""

from __future__ import annotations

from dataclasses import dataclass

from insole_studio.app.appearance import Appearance
from insole_studio.app.help_actions import HelpActions
from insole_studio.app.main_window import MainWindow


@dataclass(frozen=True, eq=False)
class WindowFeature:
    """The main window, its appearance and its help."""

    window: MainWindow
    appearance: Appearance
    help: HelpActions
