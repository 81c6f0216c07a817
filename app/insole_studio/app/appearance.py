"""How the window looks and speaks; the settings remember it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer
from PySide6.QtWidgets import QApplication

from insole_studio.app.theme import apply_theme, is_dark
from insole_studio.features.design.stage import DesignStage
from insole_studio.services.user_messages import UserMessages
from insole_studio.settings import Language, Settings
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_studio.app.main_window import MainWindow

LAYOUT_REST_MS = 600


class Appearance(QObject):
    """Theme, touch, language, linked views, and where the panels are."""

    def __init__(
        self,
        *,
        frame: MainWindow,
        stage: DesignStage,
        settings: Settings,
        messages: UserMessages,
        remember: Callable[[], None],
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._frame = frame
        self._stage = stage
        self._settings = settings
        self._messages = messages
        self._remember = remember
        self._layout_rest = QTimer(self)
        self._layout_rest.setSingleShot(True)
        self._layout_rest.setInterval(LAYOUT_REST_MS)
        self._layout_rest.timeout.connect(self.remember_layout)

    def set_linked(self, linked: bool) -> None:
        """Let the views move together or not."""
        self._settings.linked_views = linked
        self._stage.set_linked(linked)
        self._remember()

    def set_dark(self, dark: bool) -> None:
        """Change the theme."""
        self._settings.theme = "dark" if dark else "light"
        self._apply_theme()
        self._frame.renew_icons()
        self._stage.set_dark(dark)
        self._remember()

    def set_touch(self, touch: bool) -> None:
        """Make the targets large enough for fingers, or small again."""
        self._settings.touch = touch
        self._apply_theme()
        self._stage.set_touch(touch)
        self._remember()

    def set_language(self, language: Language) -> None:
        """Speak another language from the next start on."""
        self._settings.language = language
        self._remember()
        self._messages.say(tr("The window speaks this language from the next start on."))

    def note_layout(self) -> None:
        """Remember where the panels are, once they rest."""
        self._layout_rest.start()

    def remember_layout(self) -> None:
        """Remember where the panels are now."""
        self._layout_rest.stop()
        layout = self._frame.layout_state()
        self._settings.window_geometry, self._settings.window_docks = layout
        self._remember()

    def _apply_theme(self) -> None:
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        apply_theme(application, is_dark(self._settings.theme), self._settings.touch)
