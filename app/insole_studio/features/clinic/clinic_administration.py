"""The administration of the clinic's record: its dialogs, the lock, and the backups."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from insole_core.cases.case_record import CaseRecord
from insole_core.errors import InsoleError
from insole_studio.document.record_location import RecordLocation
from insole_studio.features.clinic.backups import Backups
from insole_studio.features.clinic.session_lock import SessionLock
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr, translate_core_message

if TYPE_CHECKING:
    from insole_core.messages import Message
    from insole_core.records.backup.restore import RestoreReport
    from insole_core.records.person import Person
    from insole_core.records.records import Records

UPGRADED = "record-upgraded"
Then = Callable[[], None]


class ClinicAdministration(QObject):
    """Opens the dialogs; each asks the record itself and says what it refuses.

    Parameters
    ----------
    leave_case
        Calls a function once the open case may be replaced by another one.
    keep_now
        Writes the copy of the open case that is on this computer.
    """

    start_requested = Signal()
    """Asks for the start page: the case that was open has been left."""
    patients_hidden = Signal()
    """Asks for nothing to be shown of a patient any more; the open case has been left."""

    def __init__(
        self, services: AppServices, leave_case: Callable[[Then], None], keep_now: Then
    ) -> None:
        super().__init__(services.window)
        self._services = services
        self._clinic = services.clinic
        self._leave_case = leave_case
        self.lock = SessionLock(services, keep_now, self._hide_patients)
        self.backups = Backups(services)
        self.backups.settings_requested.connect(self.open_backup)
        self.lock.restore_requested.connect(self.open_restore)
        self._clinic.upgraded.connect(self._tell_upgrade)

    def open_accounts(self) -> None:
        """Show the accounts, or switch them on."""
        from insole_studio.features.clinic.accounts_dialog import AccountsDialog

        self._check_open()
        dialog = AccountsDialog(self._clinic, self._services.window)
        dialog.lock_minutes_changed.connect(self.lock.set_lock_minutes)
        dialog.open()

    def change_password(self) -> None:
        """Let whoever has signed in choose another password."""
        from insole_studio.features.clinic.account_form import OwnPassword

        author = self.lock.author
        if author is not None:
            form = OwnPassword(author.name, self._clinic, self._services.window)
            form.changed.connect(
                lambda: self._services.messages.say(tr("The password was changed."))
            )
            form.open()

    def open_backup(self) -> None:
        """Show where and when backups are made."""
        from insole_studio.features.clinic.backup_dialog import BackupDialog

        self._check_open()
        services = self._services
        BackupDialog(
            self._clinic, self.backups, services.settings, services.messages, services.window
        ).open()

    def open_restore(self) -> None:
        """Show backups to restore; with accounts, to those who may set up the clinic.

        Nobody may be able to sign in to a damaged record: the passphrase of the backup is enough.
        """
        if self._clinic.has_accounts and not self._clinic.is_read_only:
            self._clinic.ask(
                "clinic-restore",
                _check_may_restore,
                lambda _none: self._show_restore(),
                self._services.messages.show_error,
            )
        else:
            self._show_restore()

    def open_verify(self) -> None:
        """Verify the record."""
        from insole_studio.features.clinic.verify_dialog import VerifyDialog

        self._check_open()
        VerifyDialog(self._clinic, self.backups.jobs, self._services.window).open()

    def open_merge(self) -> None:
        """Merge patients who are in the record twice."""
        from insole_studio.features.clinic.merge_dialog import MergeDialog

        self._check_open()
        MergeDialog(self._clinic, self._services.window).open()

    def open_erase(self, on_page: Person | None = None) -> None:
        """Erase a patient.

        Parameters
        ----------
        on_page
            The patient whose page is shown; None for none.
        """
        from insole_studio.features.clinic.erase_dialog import EraseDialog

        self._check_open()
        kept = self._services.case.kept
        shown = on_page or (None if kept is None else kept.person)
        services = self._services
        EraseDialog(self._clinic, shown, services.leftovers, services.window).open()

    def open_audit(self) -> None:
        """Show the audit log."""
        from insole_studio.features.clinic.audit_dialog import AuditDialog

        self._check_open()
        AuditDialog(self._clinic, self.backups.jobs, self._services.window).open()

    def open_place(self) -> None:
        """Show where the record is."""
        from insole_studio.features.clinic.place_dialog import PlaceDialog

        dialog = PlaceDialog(
            self._clinic, self.backups.jobs, self._services.messages, self._services.window
        )
        dialog.location_chosen.connect(self._move)
        dialog.open()

    def retry(self) -> None:
        """Try again to open a record that could not be opened."""
        self._clinic.open()

    def close(self) -> None:
        """Stop what runs in the background."""
        self.lock.close()
        self.backups.close()

    def _check_open(self) -> None:
        if self._clinic.author is None:
            raise InsoleError("The clinic's record is not open; look at the start page to see why.")

    def _show_restore(self) -> None:
        from insole_studio.features.clinic.restore_dialog import RestoreDialog

        dialog = RestoreDialog(self._services, self.backups)
        dialog.closing_requested.connect(self._let_go)
        dialog.restored.connect(self._note_restored)
        self.lock.ask_after(dialog)
        dialog.open()

    def _let_go(self, then: Then) -> None:
        """Close the record, and the case that is one of its visits, before it is replaced."""

        def let_go() -> None:
            self._leave_visit()
            self.backups.cancel()
            self._clinic.let_go()
            then()

        self._leave_record(let_go)

    def _note_restored(self, _report: RestoreReport) -> None:
        self.start_requested.emit()

    def _tell_upgrade(self, sentence: Message) -> None:
        self._services.notices.put(UPGRADED, translate_core_message(sentence), stays=True)

    def _move(self, location: RecordLocation) -> None:
        """Use the record of another place from now on."""

        def move() -> None:
            self._leave_visit()
            settings = self._services.settings
            settings.record_database, settings.record_contents = location.url, location.contents
            self._services.save_settings()
            self._clinic.reopen(location)

        self._leave_record(move)

    def _leave_record(self, then: Then) -> None:
        """Call `then` once nothing of the open visit can be lost; a case of a file stays open."""
        if self._services.keeper.is_keeping:
            self._leave_case(then)
        else:
            then()

    def _leave_visit(self) -> None:
        if self._services.keeper.is_keeping:
            self._services.case.open(CaseRecord(), None)
            self.start_requested.emit()

    def _hide_patients(self) -> None:
        """Leave the open case at once; what is saved nowhere else waits in its journal.

        Raises
        ------
        OutputError
            When that cannot be written, so that the visit stays.
        """
        self._services.keeper.set_aside()
        self._services.case.open(CaseRecord(), None)
        self.patients_hidden.emit()
        self.start_requested.emit()


def _check_may_restore(records: Records) -> None:
    from insole_core.records.rights import Right, require

    with records.context.database.reading() as connection:
        require(connection, records.who, Right.SET_UP)
