"""Actions of the clinic's administration."""

from __future__ import annotations

from typing import TYPE_CHECKING

from insole_studio.services.action_record import ActionRecord
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_studio.features.clinic.clinic_administration import ClinicAdministration

OF_ACCOUNTS = ("lock", "change_password")
"""Actions that are shown only while the record has accounts."""

CLINIC_ACTIONS: tuple[ActionRecord[ClinicAdministration], ...] = (
    ActionRecord(
        "lock",
        lambda: tr("Lock, or change user"),
        lambda: tr("Hide the window until somebody signs in; the open case stays"),
        lambda clinic, _on: clinic.lock.lock(),
        shortcut="Ctrl+Alt+L",
    ),
    ActionRecord(
        "change_password",
        lambda: tr("Change my password…"),
        lambda: tr("Choose another password for the account that has signed in"),
        lambda clinic, _on: clinic.change_password(),
    ),
    ActionRecord(
        "accounts",
        lambda: tr("Accounts…"),
        lambda: tr("Who may sign in, and what each of them may do"),
        lambda clinic, _on: clinic.open_accounts(),
    ),
    ActionRecord(
        "audit_log",
        lambda: tr("Audit log…"),
        lambda: tr("Who saw, changed and exported what"),
        lambda clinic, _on: clinic.open_audit(),
    ),
    ActionRecord(
        "merge_patients",
        lambda: tr("Merge duplicate patients…"),
        lambda: tr("Join two entries that turned out to be one person; this can be undone"),
        lambda clinic, _on: clinic.open_merge(),
    ),
    ActionRecord(
        "erase_patient",
        lambda: tr("Erase a patient…"),
        lambda: tr("On request, or after the time of keeping; what the law keeps stays"),
        lambda clinic, _on: clinic.open_erase(),
    ),
    ActionRecord(
        "backup",
        lambda: tr("Backup…"),
        lambda: tr("Back the record up now, or every day"),
        lambda clinic, _on: clinic.open_backup(),
    ),
    ActionRecord(
        "restore_record",
        lambda: tr("Restore from a backup…"),
        lambda: tr("Put the record back as a backup holds it"),
        lambda clinic, _on: clinic.open_restore(),
    ),
    ActionRecord(
        "verify_record",
        lambda: tr("Verify the record…"),
        lambda: tr("Check the audit log, the signatures and all files"),
        lambda clinic, _on: clinic.open_verify(),
    ),
    ActionRecord(
        "record_place",
        lambda: tr("Where the record is…"),
        lambda: tr("On this computer, or on a server that stations share"),
        lambda clinic, _on: clinic.open_place(),
    ),
    ActionRecord(
        "retry_record",
        lambda: tr("Open the record again"),
        lambda: tr("Try again to open a record that could not be opened"),
        lambda clinic, _on: clinic.retry(),
    ),
)
