"""The window's theme, language and layout, as kept in the settings."""

from __future__ import annotations

from PySide6.QtCore import QObject, QTimer
from PySide6.QtWidgets import QApplication

from insole_studio.app.main_window import MainWindow
from insole_studio.app.theme import apply_theme
from insole_studio.features.design.stage import DesignStage
from insole_studio.languages import Language
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr

LAYOUT_REST_MS = 600


class Appearance(QObject):
    """Theme, touch mode, language, linked views, and the positions of the panels."""

    def __init__(self, services: AppServices, window: MainWindow, stage: DesignStage) -> None:
        super().__init__(window)
        self._services = services
        self._settings = services.settings
        self._window = window
        self._stage = stage
        self._layout_rest = QTimer(self)
        self._layout_rest.setSingleShot(True)
        self._layout_rest.setInterval(LAYOUT_REST_MS)
        self._layout_rest.timeout.connect(self.remember_layout)

    def set_linked(self, linked: bool) -> None:
        """Link the cameras of the two views, or unlink them."""
        self._settings.linked_views = linked
        self._stage.set_linked(linked)
        self._services.save_settings()

    def set_dark(self, dark: bool) -> None:
        """Change the theme."""
        self._settings.theme = "dark" if dark else "light"
        self._apply_theme()
        self._window.renew_icons()
        self._stage.set_dark(dark)
        self._services.save_settings()

    def set_touch(self, touch: bool) -> None:
        """Enlarge the controls for touch, or restore their usual size."""
        self._settings.touch = touch
        self._apply_theme()
        self._stage.set_touch(touch)
        self._services.save_settings()

    def set_software_rendering(self, software: bool) -> None:
        """Draw with the processor or the graphics card; it takes effect at the next start."""
        self._settings.software_rendering = software
        self._services.save_settings()
        self._services.messages.say(
            tr("The processor draws from the next start on.")
            if software
            else tr("The graphics card draws from the next start on.")
        )

    def set_language(self, language: Language) -> None:
        """Set the language; it takes effect at the next start."""
        self._settings.language = language
        self._services.save_settings()
        self._services.messages.say(tr("The window speaks this language from the next start on."))

    def note_layout(self) -> None:
        """Schedule saving the layout once the panels stop moving."""
        self._layout_rest.start()

    def remember_layout(self) -> None:
        """Save the current layout of the panels."""
        self._layout_rest.stop()
        layout = self._window.layout_state()
        self._settings.window_geometry, self._settings.window_docks = layout
        self._services.save_settings()

    def _apply_theme(self) -> None:
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        apply_theme(application, self._services.dark, self._settings.touch)
