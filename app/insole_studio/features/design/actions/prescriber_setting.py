"""The prescriber: stored in every correction and in the settings."""

from __future__ import annotations

from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr


class PrescriberSetting:
    """The name of the prescriber."""

    def __init__(self, services: AppServices) -> None:
        self._services = services
        self._case = services.case
        self._case.author = services.settings.author

    def ask(self) -> None:
        """Let the user enter the prescriber."""
        name = self._services.messages.questions.text(
            tr("Who prescribes?"), tr("Stands in every correction from now on."), self._case.author
        )
        if name is not None:
            self._case.author = self._services.settings.author = name
            self._services.save_settings()
