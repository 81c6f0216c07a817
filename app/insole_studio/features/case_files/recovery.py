"""Unsaved work of a program that has ended without asking, offered at the next start."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import count
from pathlib import Path

from PySide6.QtCore import QDateTime

from insole_core.cases.case_record import CaseRecord
from insole_core.errors import InsoleError
from insole_core.visible_text import visible_line
from insole_studio.document.autosave import Autosave
from insole_studio.document.case_lock import CaseInUseError
from insole_studio.document.case_names import case_name
from insole_studio.document.journal import Recovered
from insole_studio.features.case_files.case_guard import CaseGuard
from insole_studio.features.case_files.save_actions import SaveActions
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr

NOTICE, STUCK = "recovered", "stuck"


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
        self._clinic = services.clinic
        self._notices = services.notices
        self._messages = services.messages
        self._saver = saver
        self._guard = guard
        self._autosave = autosave
        self._reopen = reopen
        self._offered: list[Recovered] = []
        """The cases that no other window is offered while this one is open."""
        self._held: list[Recovered] = []
        """Those that wait until somebody may see them."""
        self._undecided: dict[str, Recovered] = {}
        """Those that are offered by a notice, by its key."""
        self._numbers = count()
        self._stuck = 0
        self._case.saved_changed.connect(self._drop_when_saved)
        self._clinic.state_changed.connect(self._offer_held)

    def offer(self, found: Sequence[Recovered]) -> None:
        """Offer recovered cases, as soon as somebody is here who may see patients.

        The first is opened, unsaved, where no other case is open; the others are offered beside it.
        """
        self._offered += found
        self._held += found
        self._offer_held()

    def show_stuck(
        self, journals: Sequence[Recovered], give_up: Callable[[Recovered], bool]
    ) -> None:
        """Tell of changes of visits that the record does not take, in place of those told before.

        Parameters
        ----------
        give_up
            Called with one that is to be a case of its own; returns whether it may.
        """
        for number in range(self._stuck):
            self._notices.drop(f"{STUCK}-{number}")
        self._stuck = len(journals)
        self._tell_held(STUCK, bool(journals) and self._clinic.hides_patients)
        if not self._clinic.hides_patients:
            for number, journal in enumerate(journals):
                self._tell_stuck(f"{STUCK}-{number}", journal, give_up)

    def hide(self) -> None:
        """Take away what is offered, until somebody is here who may see patients."""
        for key, recovered in self._undecided.items():
            self._notices.drop(key)
            self._held.append(recovered)
        self._undecided.clear()
        self._offer_held()

    def close(self) -> None:
        """Leave what was not decided on to the next window that starts."""
        for recovered in self._offered:
            recovered.release()
        self._offered.clear()

    def _offer_held(self) -> None:
        self._tell_held(NOTICE, bool(self._held) and self._clinic.hides_patients)
        if self._clinic.hides_patients:
            return
        held, self._held = self._held, []
        if held and self._case.is_empty:
            first = held.pop(0)
            self._open(first, _changed_at(first))
        for other in held:
            self._offer_other(f"{NOTICE}-{next(self._numbers)}", other, _changed_at(other))

    def _tell_held(self, kind: str, is_held: bool) -> None:
        """Say that there is unsaved work, to somebody who may not see whose it is."""
        if is_held:
            sentence = tr(
                "There is unsaved work on this computer. It is kept, and offered as soon as "
                "somebody who treats patients has signed in."
            )
            self._notices.put(f"{kind}-held", sentence, stays=True)
        else:
            self._notices.drop(f"{kind}-held")

    def _tell_stuck(
        self, key: str, journal: Recovered, give_up: Callable[[Recovered], bool]
    ) -> None:
        changed = _changed_at(journal)
        sentence = tr(
            "{name}: what was changed on {time} is not in the record yet. It waits on this "
            "computer until the record takes it."
        )

        def open_alone() -> None:
            if give_up(journal):
                self._offered.append(journal)
                self._open(journal, changed)

        self._notices.put(
            key,
            sentence.format(name=_name(journal), time=changed),
            (tr("Open it as a case"), lambda: self._saver.after_unsaved(open_alone)),
            stays=True,
        )

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
            on_pages=True,
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
        self._undecided[key] = recovered

        def open_it() -> None:
            self._undecided.pop(key, None)
            self._open(recovered, changed)

        self._notices.put(
            key,
            sentence.format(name=_name(recovered), time=changed),
            (tr("Open it"), lambda: self._saver.after_unsaved(open_it)),
            (tr("Discard it…"), lambda: self._ask_to_discard_other(key, recovered, changed)),
            stays=True,
        )

    def _ask_to_discard_other(self, key: str, recovered: Recovered, changed: str) -> None:
        if self._messages.questions.may_discard(_name(recovered)):
            self._undecided.pop(key, None)
            recovered.discard()
        else:
            self._offer_other(key, recovered, changed)


def _name(recovered: Recovered) -> str:
    if recovered.path is not None:
        return visible_line(recovered.path.stem)
    return recovered.record.patient.name or tr("New case")


def _changed_at(recovered: Recovered) -> str:
    """Return when the copy was written, as the window writes dates."""
    seconds = int(recovered.copies[0].stat().st_mtime)
    moment = QDateTime.fromSecsSinceEpoch(seconds)
    return moment.toString("yyyy-MM-dd HH:mm")
