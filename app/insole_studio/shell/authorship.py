"""Who prescribes: stamped into every correction, and remembered."""

from __future__ import annotations

from collections.abc import Callable

from insole_studio.settings import Settings
from insole_studio.shell.dialogue import Dialogue
from insole_studio.texts import tr
from insole_studio.workbench.case import Case


class Authorship:
    """Knows the one who sits before the window."""

    def __init__(
        self, case: Case, settings: Settings, dialogue: Dialogue, remember: Callable[[], None]
    ) -> None:
        self._case = case
        self._settings = settings
        self._dialogue = dialogue
        self._remember = remember
        case.author = settings.author

    def ask(self) -> None:
        """Let the user type who prescribes from now on."""
        name = self._dialogue.questions.text(
            tr("Who prescribes?"), tr("Stands in every correction from now on."), self._case.author
        )
        if name is not None:
            self._case.author = self._settings.author = name
            self._remember()
