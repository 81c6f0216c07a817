"""Save the case, and ask before unsaved work is lost."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

from insole_core.cases.case_file import write_case
from insole_core.progress import Progress
from insole_core.workflows.file_kind import CASE_SUFFIX
from insole_studio.document.case_name import case_name, file_stem
from insole_studio.services.app_services import AppServices
from insole_studio.services.file_kinds import case_kinds
from insole_studio.services.questions import Answer
from insole_studio.texts import tr

CHANNEL = "save"
Then: TypeAlias = Callable[[], None]


def _nothing() -> None:
    pass


class SaveActions:
    """Writes the case in the background."""

    def __init__(self, services: AppServices) -> None:
        self._services = services
        self._case = services.case
        self._messages = services.messages
        self._recent = services.recent

    def save(self) -> None:
        """Save to the file of the case; let the user choose one if there is none."""
        if self._case.path is None:
            self.ask_save()
        else:
            self.save_to(self._case.path)

    def ask_save(self, then: Then = _nothing) -> None:
        """Let the user choose a file, save, and then call `then`."""
        suggestion = f"{file_stem(self._case)}{CASE_SUFFIX}"
        path = self._messages.questions.file_to_write(suggestion, case_kinds())
        if path is not None:
            self.save_to(path, then)

    def save_to(self, path: Path, then: Then = _nothing) -> None:
        """Save in the background, then call `then`."""
        record = self._case.record

        def write(progress: Progress) -> None:
            progress.step(0.0, tr("Saving the case"))
            write_case(record, path)

        def saved(_done: None) -> None:
            self._case.mark_saved(record, path)
            self._recent.remember(path)
            then()

        self._services.run(CHANNEL, write, saved)

    def after_unsaved(self, then: Then) -> None:
        """Call `then` once no unsaved work can be lost."""
        if not self._case.has_unsaved_changes or self._case.is_empty:
            then()
            return
        answer = self._messages.questions.about_unsaved(case_name(self._case))
        if answer is Answer.DISCARD:
            then()
        elif answer is Answer.SAVE and self._case.path is not None:
            self.save_to(self._case.path, then)
        elif answer is Answer.SAVE:
            self.ask_save(then)
