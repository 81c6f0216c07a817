"""Save the case, and ask before unsaved work is lost."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

from insole_core.errors import OutputError
from insole_core.progress import Progress
from insole_core.workflows.file_kind import CASE_SUFFIX
from insole_studio.document.case_lock import CaseInUseError
from insole_studio.document.case_names import case_name, file_stem
from insole_studio.document.record_keeper import KeepState
from insole_studio.features.case_files.case_guard import CaseGuard, ChangedOnDiskError, FileState
from insole_studio.services.app_services import AppServices
from insole_studio.services.files import Kept, case_kinds
from insole_studio.services.questions import Answer, Unsaved
from insole_studio.texts import tr

CHANNEL = "save"
Then: TypeAlias = Callable[[], None]


def _nothing() -> None:
    pass


class SaveActions:
    """Writes the case in the background."""

    def __init__(self, services: AppServices, guard: CaseGuard) -> None:
        self._services = services
        self._guard = guard
        self._case = services.case
        self._messages = services.messages
        self._recent = services.recent

    def save(self) -> None:
        """Save to the file of the case; let the user choose one if there is none to write to.

        A visit of the clinic's record saves itself: it is kept as a version, for a reason.
        """
        if self._services.keeper.is_keeping:
            self._ask_reason()
        else:
            self._save()

    def _ask_reason(self) -> None:
        reason = self._messages.questions.text(
            tr("Keep this version"), tr("Why is it kept? The next change begins a new version."), ""
        )
        if reason is not None:
            self._services.keeper.keep_version(reason.strip() or tr("Kept"))

    def ask_save(self, then: Then = _nothing) -> None:
        """Let the user choose a file, save, and then call `then`."""
        suggestion = f"{file_stem(self._case)}{CASE_SUFFIX}"
        path = self._messages.questions.file_to_write(suggestion, case_kinds(), Kept.CASES)
        if path is not None:
            self.save_to(path, then)

    def save_to(self, path: Path, then: Then = _nothing, *, replace: bool = False) -> None:
        """Save in the background, then call `then`.

        Parameters
        ----------
        replace
            Whether the file may be replaced although another program has changed it.
        """
        record = self._case.record
        is_own = self._guard.lock_of(path) is not None
        known = self._case.digest if is_own and not replace else ""

        def write(progress: Progress) -> FileState:
            progress.step(0.0, tr("Saving the case"))
            return self._guard.write(record, path, known)

        def saved(state: FileState) -> None:
            keeper = self._services.keeper
            if keeper.is_keeping and keeper.state is not KeepState.REFUSED:
                state.lock.release()  # a copy to send: the case stays the visit of the record
                self._messages.say(tr("A copy was written: {name}").format(name=path.name))
                then()
                return
            self._guard.hold(state.lock)
            self._case.mark_saved(record, path, state.digest)
            self._recent.remember(path)
            then()

        self._services.jobs.start(CHANNEL, write, saved, lambda e: self._failed(e, path, then))

    def cancel(self) -> None:
        """Leave a save to itself: its case is left, and the next one must not get its file."""
        self._services.jobs.cancel(CHANNEL)

    def _save(self, then: Then = _nothing) -> None:
        if self._case.path is None or self._case.is_read_only:
            self.ask_save(then)
        else:
            self.save_to(self._case.path, then)

    def _failed(self, error: Exception, path: Path, then: Then) -> None:
        """Offer another name where this one cannot be written; the work stays open."""
        questions = self._messages.questions
        if isinstance(error, ChangedOnDiskError):
            answer = questions.about_changed_file(str(error))
        elif isinstance(error, OutputError | CaseInUseError):
            answer = questions.about_failed_save(str(error))
        else:
            self._messages.show_error(error)
            return
        if answer is Unsaved.ELSEWHERE:
            self.ask_save(then)
        elif answer is Unsaved.REPLACE:
            self.save_to(path, then, replace=True)

    def after_unsaved(self, then: Then) -> None:
        """Call `then` once no unsaved work can be lost."""
        if self._services.keeper.is_keeping:
            self._services.keeper.leave(then)
            return
        if not self._case.has_unsaved_changes or self._case.is_empty:
            then()
            return
        answer = self._messages.questions.about_unsaved(case_name(self._case))
        if answer is Answer.DISCARD:
            then()
        elif answer is Answer.SAVE:
            self._save(then)
