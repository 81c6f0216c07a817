"""The sample patient: there at the first start, removed and brought back by one action each."""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from insole_core.cases.case_record import CaseRecord
from insole_studio.document.clinic_record import RecordState
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_core.records.person import Person
    from insole_core.records.records import Records

log = logging.getLogger(__name__)

Then = Callable[[], None]


class SamplePatient(QObject):
    """Adds, shows and removes the invented patient.

    Parameters
    ----------
    leave_case
        Calls a function once the open case may be replaced by another one.
    show_person, show_start
        Show the page of a person, or that of all patients.
    """

    def __init__(
        self,
        services: AppServices,
        leave_case: Callable[[Then], None],
        show_person: Callable[[str], None],
        show_start: Then,
    ) -> None:
        super().__init__(services.window)
        self._services = services
        self._clinic = services.clinic
        self._leave_case = leave_case
        self._show_person = show_person
        self._show_start = show_start

    def add_at_first_start(self) -> None:
        """Add the sample once the record of this computer is open, if it never held anybody.

        One on which nothing was tried yet follows the language of the window.
        """
        self._clinic.state_changed.connect(self._add_if_new)
        self._add_if_new()

    def show(self) -> None:
        """Show the page of the sample; bring it back where it was removed."""
        texts = _texts()

        def ensure(records: Records) -> Person:
            from insole_core.workflows.records.sample_patient import ensure_sample

            return ensure_sample(records, *texts)

        self._clinic.write(
            ensure,
            lambda person: self._show_person(person.id),
            self._services.messages.show_error,
        )

    def ask_to_remove(self) -> None:
        """Remove the sample with all that was tried on it, after a question."""
        if not self._services.messages.questions.may_remove_sample():
            return
        kept = self._services.case.kept
        if kept is not None and kept.person.is_sample:
            self._leave_case(self._close_and_remove)
        else:
            self._remove()

    def _close_and_remove(self) -> None:
        self._services.case.open(CaseRecord(), None)
        self._remove()

    def _remove(self) -> None:
        def remove(records: Records) -> None:
            from insole_core.records.sample_patient import remove_sample

            remove_sample(records.context)

        def removed(_none: None) -> None:
            self._show_start()
            self._services.messages.say(
                tr("The sample patient is removed; Help ▸ Sample patient brings it back.")
            )

        self._clinic.write(remove, removed, self._services.messages.show_error)

    def _add_if_new(self) -> None:
        if self._clinic.state is not RecordState.OPEN:
            return
        self._clinic.state_changed.disconnect(self._add_if_new)
        if self._clinic.location.is_shared or self._clinic.is_read_only:
            return
        texts = _texts()

        def add(records: Records) -> None:
            from insole_core.records.sample_patient import is_untouched
            from insole_core.workflows.records.sample_patient import ensure_sample, renew_sample

            if is_untouched(records.context):
                ensure_sample(records, *texts)
            else:
                renew_sample(records, *texts)

        self._clinic.write(add, lambda _none: None, _note_failure)


def _texts() -> tuple[str, str, str]:
    """Return name, notes and findings of the sample in the language of the window."""
    return (
        tr("Anna Example (sample patient)"),
        tr("Invented, to try the program with: nothing here concerns a real person."),
        tr("Forefoot pain when walking."),
    )


def _note_failure(error: Exception) -> None:
    """A first start goes on without a sample, which the Help menu offers."""
    log.warning("the sample patient was not added: %s", error)
