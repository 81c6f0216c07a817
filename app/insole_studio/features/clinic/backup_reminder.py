"""When the start page reminds of a backup, and in which words."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import TYPE_CHECKING

from insole_studio.settings import BackupDay
from insole_studio.texts import moment_text, tr

if TYPE_CHECKING:
    from insole_core.records.records import Records

INTERVALS = 2
"""So many may pass without a backup."""
WEEK = timedelta(days=7)


@dataclass(frozen=True)
class BackupFacts:
    """What the record knows of its backups.

    Parameters
    ----------
    last
        When any station has made one; None for never.
    has_patients
        Whether there is anything to lose; a sample patient is not.
    """

    last: datetime | None
    has_patients: bool


def read_facts(records: Records) -> BackupFacts:
    """Return what the record knows of its backups; anybody may know it."""
    from insole_core.records.backup.back_up import last_backup_at
    from insole_core.records.sample_patient import has_patients

    with records.context.database.reading() as connection:
        has_some = has_patients(connection)
    return BackupFacts(last_backup_at(records.context.database), has_some)


def reminder_text(facts: BackupFacts, day: BackupDay, now: datetime) -> str:
    """Return the sentence of the start page; empty while all is well.

    Parameters
    ----------
    day
        Of the plan of this station; backups that are made by hand only are expected every week.
    """
    if facts.last is None:
        if not facts.has_patients:
            return ""
        return tr("There is no backup yet: what is in the record is lost if its disk fails.")
    if not is_overdue(facts.last, day, now):
        return ""
    sentence = tr("The last backup is of {moment}; what was entered since is in no other place.")
    return sentence.format(moment=moment_text(facts.last))


def is_overdue(last: datetime, day: BackupDay, now: datetime) -> bool:
    """Return whether a backup is older than two intervals of a plan."""
    return now - last > INTERVALS * (timedelta(days=1) if day == "daily" else WEEK)
