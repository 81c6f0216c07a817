"""Who prescribes: stamped into every correction, and remembered."""

from __future__ import annotations

from collections.abc import Callable

from insole_studio.document.case import Case
from insole_studio.services.user_messages import UserMessages
from insole_studio.settings import Settings
from insole_studio.texts import tr


class PrescriberSetting:
    """Knows the one who sits before the window."""

    def __init__(
        self, case: Case, settings: Settings, messages: UserMessages, remember: Callable[[], None]
    ) -> None:
        self._case = case
        self._settings = settings
        self._messages = messages
        self._remember = remember
        case.author = settings.author

    def ask(self) -> None:
        """Let the user type who prescribes from now on."""
        name = self._messages.questions.text(
            tr("Who prescribes?"), tr("Stands in every correction from now on."), self._case.author
        )
        if name is not None:
            self._case.author = self._settings.author = name
            self._remember()
