"""Making backups of the whole record: when one is due, and which ones are kept (decision 0044)."""

from __future__ import annotations

import hashlib
import io
import json
import logging
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from functools import partial
from importlib.metadata import version
from pathlib import Path
from typing import Final

from sqlalchemy import Connection, Table, func, select

from insole_core.errors import OutputError, RecordsError
from insole_core.files.temporary import is_temporary
from insole_core.given_file import read_given
from insole_core.progress import SILENT, Progress
from insole_core.records.audit import AuditLog, head_of
from insole_core.records.backup.backup_folder import (
    BackupFolder,
    BackupWriter,
    KnownSnapshot,
    SnapshotName,
)
from insole_core.records.backup.backup_key import BackupKey
from insole_core.records.backup.portable_rows import pieces_of, tables_of
from insole_core.records.backup.snapshot import Manifest, SavedFile, TableContent
from insole_core.records.clinic import setting_of, write_setting
from insole_core.records.content_store import ContentStore, DamagedContent
from insole_core.records.context import RecordsContext
from insole_core.records.database import Database
from insole_core.records.migrate import schema_of
from insole_core.records.rights import Right, require
from insole_core.records.sample_patient import count_patients
from insole_core.records.schema import audit, contents, orders, persons, visits

_ALL_OF_DAYS: Final = 30

log = logging.getLogger(__name__)

KEY_VALUE: Final = "backup_key"
"""Key of the clinic's settings."""
BACKED_UP: Final = "backed up"
RESTORED: Final = "restored"
"""In the audit log."""
_MOST_SETTINGS_BYTES: Final = 2**30
_SUBJECT: Final = "record"

_DAYS_OF_WEEK = 7


@dataclass(frozen=True)
class KeepRule:
    """All backups of the last days, then the last good one of each month.

    Parameters
    ----------
    days
        So many of the newest ones stay in any case, also if the clock says that they are old.
    months
        With backups, for how many one is kept; None for all.
    """

    days: int = _ALL_OF_DAYS
    months: int | None = None


def superfluous(
    snapshots: Sequence[KnownSnapshot], rule: KeepRule, now: datetime
) -> list[SnapshotName]:
    """Return the snapshots that go by a rule; the newest good one never does.

    Parameters
    ----------
    now
        With its time zone.
    """
    newest_first = sorted(snapshots, key=lambda known: known.name.number, reverse=True)
    since = now - timedelta(days=rule.days)
    kept = {known.name for known in newest_first[: rule.days]}
    kept.update(known.name for known in newest_first if known.name.made_at > since)
    kept.update([known.name for known in newest_first if known.is_good][:1])
    kept.update(_of_months(newest_first)[: rule.months])
    return [known.name for known in newest_first if known.name not in kept]


def _of_months(newest_first: Sequence[KnownSnapshot]) -> list[SnapshotName]:
    """Return one snapshot of each month, its last good one if there is any, the newest first."""
    chosen: dict[tuple[int, int], KnownSnapshot] = {}
    for known in newest_first:
        month = known.name.made_at.year, known.name.made_at.month
        if month not in chosen or (known.is_good and not chosen[month].is_good):
            chosen[month] = known
    return [known.name for known in chosen.values()]


@dataclass(frozen=True)
class BackupReport:
    """What a backup has written.

    Parameters
    ----------
    place
        Of the record, as sentences name it.
    patients, visits, orders
        How many it holds; a sample patient is none.
    written_objects, written_bytes
        What was new.
    damaged
        SHA-256 of large files that were missing or damaged in the record: they are not in the
        backup.
    removed_snapshots
        How many old backups were removed.
    """

    snapshot: SnapshotName
    place: str
    patients: int
    visits: int
    orders: int
    rows: int
    contents: int
    contents_bytes: int
    written_objects: int
    written_bytes: int
    damaged: tuple[str, ...]
    removed_snapshots: int = 0


def key_of_backups(context: RecordsContext) -> BackupKey | None:
    """Return the key of the record's backups; None until they are set up."""
    with context.database.reading() as connection:
        return key_in(connection)


def key_in(connection: Connection) -> BackupKey | None:
    """Do the same in a transaction of the caller."""
    values = setting_of(connection, KEY_VALUE)
    return None if values is None else BackupKey.from_json(values)


def last_backup_at(database: Database, *, good: bool = False) -> datetime | None:
    """Return when the record was in a backup last, by its audit log; None for never.

    Any station may have made it; a record that was restored was in one by then.

    Parameters
    ----------
    good
        Leave out those that lack files, since the record had lost them.
    """
    query = select(audit.c.at, audit.c.details).where(audit.c.action.in_((BACKED_UP, RESTORED)))
    with database.reading() as connection:
        for at, details in connection.execute(query.order_by(audit.c.seq.desc())):
            if not (good and json.loads(details).get("damaged")):
                return datetime.fromisoformat(at)
    return None


def set_up_backups(context: RecordsContext, key: BackupKey) -> None:
    """Let the record be backed up with a key from now on; folders of another key stay as they are.

    Raises
    ------
    NotAllowed
    """
    with context.database.writing() as connection:
        require(connection, context.author, Right.SET_UP)
        write_setting(connection, KEY_VALUE, key.as_json())
        AuditLog.seal(connection, context.author, "clinic", [KEY_VALUE])
        context.log(connection, "set up backups", _SUBJECT, key.recipient)


def back_up(
    context: RecordsContext,
    folder: Path,
    settings: Mapping[str, Path] | None = None,
    progress: Progress = SILENT,
    *,
    keep: KeepRule | None = None,
) -> BackupReport:
    """Add a snapshot of the record to a folder, which grows by what is new.

    The tables are read in one transaction, so that they are of one moment; the work of others
    goes on. Every file is read again after it was written. Large files that are damaged in the
    record are left out and named, so that the rest is safe.

    Parameters
    ----------
    settings
        Folders with the settings of the program, by name; those that are absent are left out.
    keep
        Which of the backups before stay; None for all.

    Raises
    ------
    RecordsError
        When backups are not set up, or the folder is that of another record.
    OutputError
        When the folder cannot be written; the snapshots before stay as they are.
    Cancelled
    """
    key = key_of_backups(context)
    if key is None:
        raise RecordsError("Backups have no passphrase yet; choose one first.")
    made_at = datetime.now(UTC)
    with BackupWriter(BackupFolder(folder), key) as writer:
        with context.database.reading() as connection:
            require(connection, context.author, Right.BACK_UP)
            patients = count_patients(connection)
            source = _Source(connection, context.contents, writer, patients)
            manifest = source.write_all(made_at, settings or {}, progress)
        snapshot = writer.finish(made_at, manifest.as_json(), len(manifest.damaged))
        removed = 0 if keep is None else _prune(writer, keep, made_at)
    with context.database.writing() as connection:
        context.log(
            connection,
            BACKED_UP,
            _SUBJECT,
            f"snapshot {snapshot.number}",
            audit_seq=manifest.audit_seq,
            damaged=len(manifest.damaged),
            removed=removed,
        )
    rows = {table.name: table.rows for table in manifest.tables}
    return BackupReport(
        snapshot,
        context.database.place.name,
        patients,
        rows[visits.name],
        rows[orders.name],
        sum(rows.values()),
        manifest.contents,
        manifest.contents_bytes,
        writer.written_objects,
        writer.written_bytes,
        manifest.damaged,
        removed,
    )


def _prune(writer: BackupWriter, keep: KeepRule, now: datetime) -> int:
    """Remove old backups; the new one is made, also where they cannot be removed."""
    try:
        return writer.prune(partial(superfluous, rule=keep, now=now))
    except OutputError as error:
        log.warning("old backups were not removed: %s", error)
        return 0


@dataclass(frozen=True)
class _Source:
    """A moment of the record on its way into a backup."""

    connection: Connection
    store: ContentStore
    writer: BackupWriter
    patients: int

    def write_all(
        self, made_at: datetime, settings: Mapping[str, Path], progress: Progress
    ) -> Manifest:
        """Write what is new, and return what the snapshot consists of."""
        tables = tuple(self._write_tables(progress.part(0, 0.3)))
        wrong = self._write_contents(progress.part(0.3, 0.98))
        files = tuple(self._write_settings(settings))
        seq, last_hash = head_of(self.connection)
        size = func.coalesce(func.sum(contents.c.size), 0)  # none where nothing was stored yet
        total = self.connection.execute(select(func.count(), size)).one()
        erased = self.connection.execute(select(persons.c.id).where(persons.c.is_erased)).scalars()
        return Manifest(
            made_at=made_at.isoformat(),
            program_version=version("insole-studio"),
            schema=schema_of(self.connection) or "",
            audit_seq=seq,
            audit_hash=last_hash,
            tables=tables,
            files=files,
            contents=total[0],
            contents_bytes=int(total[1]),
            damaged=wrong,
            erased=tuple(sorted(erased)),
            patients=self.patients,
        )

    def _write_tables(self, progress: Progress) -> Iterator[TableContent]:
        tables = tables_of(self.connection)
        for table, step in zip(tables, progress.parts(len(tables)), strict=True):
            yield self._write_table(table, step)

    def _write_table(self, table: Table, progress: Progress) -> TableContent:
        pieces, rows = [], 0
        for content, count in pieces_of(self.connection, table):
            progress.step(0.0, "Backing up the tables ({rows} rows of {table})",
                          rows=rows, table=table.name)  # fmt: skip
            sha256 = hashlib.sha256(content).hexdigest()
            self.writer.put_rows(sha256, content)
            pieces.append(sha256)
            rows += count
        return TableContent(table.name, tuple(table.c.keys()), rows, tuple(pieces))

    def _write_contents(self, progress: Progress) -> tuple[str, ...]:
        """Write the large files that are new; return those that cannot be read."""
        query = select(contents.c.sha256).order_by(contents.c.sha256)
        wanted = self.connection.execute(query).scalars().all()
        wrong = []
        for index, sha256 in enumerate(wanted):
            progress.step(
                index / len(wanted),
                "Backing up files ({done} of {all})",
                done=index,
                all=len(wanted),
            )
            try:
                self.writer.put_file(sha256, partial(self.store.open, sha256))
            except DamagedContent:
                wrong.append(sha256)
        return tuple(wrong)

    def _write_settings(self, settings: Mapping[str, Path]) -> Iterator[SavedFile]:
        for group, folder in settings.items():
            for path in _files_in(folder):
                content = read_given(path, _MOST_SETTINGS_BYTES)
                sha256 = hashlib.sha256(content).hexdigest()
                self.writer.put_file(sha256, partial(io.BytesIO, content))
                name = path.relative_to(folder).as_posix()
                yield SavedFile(group, name, sha256, len(content))


def _files_in(folder: Path) -> list[Path]:
    found = (Path(place, name) for place, _, names in os.walk(folder) for name in names)
    return sorted(path for path in found if path.is_file() and not is_temporary(path.name))


@dataclass(frozen=True)
class BackupSchedule:
    """An hour of every day, or of one day of the week, by the clock of the computer.

    Parameters
    ----------
    weekday
        0 for Monday to 6 for Sunday; None for every day.
    hour
        0 to 23.
    """

    weekday: int | None
    hour: int

    def latest(self, now: datetime) -> datetime:
        """Return the last scheduled moment that has come.

        Parameters
        ----------
        now
            In the time zone of the schedule.
        """
        moment = now.replace(hour=self.hour, minute=0, second=0, microsecond=0)
        if moment > now:
            moment -= timedelta(days=1)
        if self.weekday is not None:
            moment -= timedelta(days=(moment.weekday() - self.weekday) % _DAYS_OF_WEEK)
        return moment

    def is_due(self, newest: datetime | None, now: datetime) -> bool:
        """Return whether a backup has to be made, also one that was missed.

        Parameters
        ----------
        newest
            When the last one was made. One from the future was made by a clock that was wrong.
        """
        if newest is None or newest - now > timedelta(hours=1):
            return True
        return newest < self.latest(now)
