"""Unsaved work of a program that has ended without asking, offered at the next start."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtCore import QDateTime

from insole_core.cases.case_record import CaseRecord
from insole_core.errors import InsoleError
from insole_studio.document.autosave import Autosave
from insole_studio.document.case_lock import CaseInUseError
from insole_studio.document.case_name import case_name
from insole_studio.document.journal import Recovered
from insole_studio.features.case_files.case_guard import CaseGuard
from insole_studio.features.case_files.save_actions import SaveActions
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr

NOTICE = "recovered"


class Recovery:
    """Opens recovered work, says so in the window, and lets the user decide about it."""

    def __init__(
        self,
        services: AppServices,
        saver: SaveActions,
        guard: CaseGuard,
        autosave: Autosave,
        reopen: Callable[[Path], None],
    ) -> None:
        self._case = services.case
        self._notices = services.notices
        self._messages = services.messages
        self._saver = saver
        self._guard = guard
        self._autosave = autosave
        self._reopen = reopen
        self._offered: list[Recovered] = []
        """The cases that no other window is offered while this one is open."""
        self._case.saved_changed.connect(self._drop_when_saved)

    def offer(self, found: Sequence[Recovered]) -> None:
        """Open the first of the recovered cases, unsaved; the others are offered beside it."""
        self._offered += found
        for number, other in enumerate(found[1:]):
            self._offer_other(f"{NOTICE}-{number}", other, _changed_at(other))
        if found:
            self._open(found[0], _changed_at(found[0]))

    def close(self) -> None:
        """Leave what was not decided on to the next window that starts."""
        for recovered in self._offered:
            recovered.release()
        self._offered.clear()

    def _open(self, recovered: Recovered, changed: str) -> None:
        """Open a recovered case, and remove its copy once this window has one of its own."""
        path = self._locked(recovered.path)
        self._case.open(recovered.record, path, unsaved=True, digest=recovered.digest)
        self._tell(changed)
        try:
            self._autosave.write_now()
        except InsoleError as error:  # the copies stay until the case is safe
            self._messages.show_error(error)
        else:
            recovered.discard()

    def _locked(self, path: Path | None) -> Path | None:
        """Lock a file; None where another window has it open, so the work is a case of its own."""
        if path is None:
            return None
        try:
            self._guard.hold(self._guard.take(path))
        except CaseInUseError as error:
            self._messages.show_error(error)
            return None
        return path

    def _tell(self, changed: str) -> None:
        sentence = tr(
            "{name} was not saved when Insole Studio ended last time. "
            "It is open again as it was on {time}."
        )
        self._notices.put(
            NOTICE,
            sentence.format(name=case_name(self._case), time=changed),
            (tr("Save"), self._saver.save),
            (tr("Keep it open"), lambda: None),
            (tr("Discard it…"), lambda: self._ask_to_discard(changed)),
        )

    def _drop_when_saved(self) -> None:
        if not self._case.has_unsaved_changes:
            self._notices.drop(NOTICE)

    def _ask_to_discard(self, changed: str) -> None:
        """Go back to what was saved, or to an empty case, once the user has confirmed it."""
        if not self._messages.questions.may_discard(case_name(self._case)):
            self._tell(changed)
            return
        saved = self._case.path
        self._case.open(CaseRecord(), None)
        if saved is not None and saved.exists():
            self._reopen(saved)

    def _offer_other(self, key: str, recovered: Recovered, changed: str) -> None:
        sentence = tr("{name} was not saved either; it is kept as it was on {time}.")
        self._notices.put(
            key,
            sentence.format(name=_name(recovered), time=changed),
            (
                tr("Open it"),
                lambda: self._saver.after_unsaved(lambda: self._open(recovered, changed)),
            ),
            (tr("Discard it…"), lambda: self._ask_to_discard_other(key, recovered, changed)),
            stays=True,
        )

    def _ask_to_discard_other(self, key: str, recovered: Recovered, changed: str) -> None:
        if self._messages.questions.may_discard(_name(recovered)):
            recovered.discard()
        else:
            self._offer_other(key, recovered, changed)


def _name(recovered: Recovered) -> str:
    if recovered.path is not None:
        return recovered.path.stem
    return recovered.record.patient.name or tr("New case")


def _changed_at(recovered: Recovered) -> str:
    """Return when the copy was written, as the window writes dates."""
    seconds = int(recovered.copies[0].stat().st_mtime)
    moment = QDateTime.fromSecsSinceEpoch(seconds)
    return moment.toString("yyyy-MM-dd HH:mm")
