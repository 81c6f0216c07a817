"""The services shared by all features of the window."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QMainWindow

from insole_core.errors import OutputError
from insole_studio.document.case import Case
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.document.record_keeper import RecordKeeper
from insole_studio.document.record_maintenance import ErasedLeftovers
from insole_studio.jobs import Jobs, Result, Task
from insole_studio.services.files import RecentFiles
from insole_studio.services.user_messages import Notices, UserMessages
from insole_studio.settings import Settings, Theme, save_settings
from insole_studio.user_paths import UserPaths

log = logging.getLogger(__name__)


def is_dark(theme: Theme) -> bool:
    """Return whether the theme, or the system if the theme follows it, is dark."""
    if theme == "system":
        return QGuiApplication.styleHints().colorScheme() == Qt.ColorScheme.Dark
    return theme == "dark"


@dataclass(frozen=True, eq=False)
class AppServices:
    """The open case, the clinic's record, background jobs, messages to the user, and settings."""

    case: Case
    clinic: ClinicRecord
    keeper: RecordKeeper
    jobs: Jobs
    window: QMainWindow
    messages: UserMessages
    notices: Notices
    recent: RecentFiles
    settings: Settings
    paths: UserPaths
    leftovers: ErasedLeftovers

    @property
    def dark(self) -> bool:
        """Whether the theme is dark."""
        return is_dark(self.settings.theme)

    def run(self, channel: str, task: Task[Result], done: Callable[[Result], None]) -> None:
        """Run a task in the background, then call `done` with its result; errors are shown.

        Parameters
        ----------
        channel
            A new task cancels the earlier one in the same channel.
        """
        self.jobs.start(channel, task, done, self.messages.show_error)

    def save_settings(self) -> None:
        """Write the settings; failing to write costs only a warning."""
        try:
            save_settings(self.settings, self.paths.settings_file)
        except OutputError as error:
            log.warning("the settings are not saved: %s", error)
