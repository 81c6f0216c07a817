"""Restoring a record from a backup, into either kind of database (decision 0044).

The record is put together beside its place and takes it at the end, or not at all. What was there
is set aside, never removed.
"""

from __future__ import annotations

import io
import logging
import sqlite3
from collections.abc import Callable, Iterator, Mapping, Set
from contextlib import closing, contextmanager
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from functools import partial
from pathlib import Path, PurePosixPath
from typing import TypeAlias

from sqlalchemy import Connection, Table, and_, func, select
from sqlalchemy.exc import SQLAlchemyError

from insole_core.errors import InsoleError, RecordsError
from insole_core.files.atomic import make_output_folder, replacing_file
from insole_core.files.file_safety import PRIVATE_FILE, sync
from insole_core.files.temporary import make_file, release, remove
from insole_core.files.write_errors import output_errors
from insole_core.messages import Message, joined
from insole_core.progress import SILENT, Progress
from insole_core.records.audit import AuditLog, AuditReport, head_of, verify_chain
from insole_core.records.author import Author
from insole_core.records.backup.back_up import BACKED_UP, RESTORED
from insole_core.records.backup.backup_folder import SnapshotName
from insole_core.records.backup.backup_key import damaged
from insole_core.records.backup.portable_rows import insert_pieces, replace_pieces, tables_of
from insole_core.records.backup.snapshot import (
    Manifest,
    OpenedSnapshot,
    SavedFile,
    TableContent,
    open_snapshot,
)
from insole_core.records.checked_values import highest
from insole_core.records.clinic import write_setting
from insole_core.records.content_store import IDENTITY_VALUE, ContentStore
from insole_core.records.context import RecordsContext
from insole_core.records.database import Database
from insole_core.records.head_witness import HeadWitness
from insole_core.records.migrate import check_schema, migrate, schema_of
from insole_core.records.place import RecordsPlace
from insole_core.records.retention import ErasureReason, erase_in
from insole_core.records.sample_patient import holds_only_sample
from insole_core.records.schema import audit, contents, persons

log = logging.getLogger(__name__)

_NO_CHANGE = (BACKED_UP, RESTORED, "signed in", "refused", "seen", "exported", "swept")
"""What the audit log tells without a change of the record."""
_LONGEST_NAME = 200
"""In bytes: temporary names beside it are longer."""
_BESIDE = ("-wal", "-shm")
"""Files that SQLite keeps beside a database."""


class PlaceTaken(RecordsError):  # noqa: N818 - as the other errors of the record
    """There is a record already; whoever wants the backup in its place has to say so."""


@dataclass(frozen=True)
class RestoreReport:
    """What was restored.

    Parameters
    ----------
    left_out
        SHA-256 of large files that were damaged already when the backup was made.
    audit
        Verification of the audit log that was restored.
    set_aside
        Where the record is that was there before.
    erased_again
        Persons who were erased after the backup was made.
    is_erasure_unknown
        Whether the record that was there before could not be asked who was erased.
    files, kept_files
        Settings that were restored, and those that were there already and stay.
    """

    snapshot: SnapshotName
    rows: int
    contents: int
    contents_bytes: int
    left_out: tuple[str, ...]
    audit: AuditReport
    set_aside: Path | None = None
    erased_again: int = 0
    is_erasure_unknown: bool = False
    files: int = 0
    kept_files: int = 0


Revise: TypeAlias = Callable[[SavedFile, bytes], bytes]
_Fill: TypeAlias = Callable[[Database, Set[str]], RestoreReport]
"""Fills a database, and erases from it who is known to be erased."""


def restore(
    folder: Path,
    secret: str,
    place: RecordsPlace,
    who: Author,
    *,
    number: int | None = None,
    replace_existing: bool = False,
    settings: Mapping[str, Path] | None = None,
    revise: Revise | None = None,
    progress: Progress = SILENT,
) -> RestoreReport:
    """Restore a snapshot with all of its files.

    Parameters
    ----------
    secret
        Passphrase, or private key of age.
    place
        An empty place, or a local one whose record is set aside. A database of a server has to be
        empty.
    number
        Of the snapshot; by default the newest one.
    settings
        Folders of the program's settings by name, as for `back_up`; a file that is there stays.
    revise
        Returns what a file of the settings holds on this computer, for what it held on the one
        that the backup was made on.

    Raises
    ------
    WrongSecret, DamagedBackup, InputError
        When the backup cannot be read.
    PlaceTaken
        When there is a record and `replace_existing` is not set, or it is on a server.
    RecordsError, OutputError
        When the place cannot be written. What was there is untouched.
    Cancelled
    """
    opened = open_snapshot(folder, secret, number)
    check_schema(opened.manifest.schema, opened.snapshot.file_name)
    for file in opened.manifest.files:
        _inner_path(file)
    store = ContentStore(place.contents)
    fill = partial(_fill, opened=opened, store=store, who=who, progress=progress.part(0, 0.95))
    if place.is_local:
        report = _restore_file(place, opened.manifest, fill, replace_existing=replace_existing)
    else:
        report = _restore_server(place, opened.manifest, fill)
    HeadWitness(place.contents).forget()
    with _opened(place) as database:
        database.note_head()
    restored, kept = _restore_settings(opened, settings or {}, revise)
    return replace(report, files=restored, kept_files=kept)


def _restore_file(
    place: RecordsPlace, manifest: Manifest, fill: _Fill, *, replace_existing: bool
) -> RestoreReport:
    path = place.database_file.resolve()
    make_output_folder(path.parent)
    is_record = path.exists() and path.stat().st_size > 0
    if is_record and not replace_existing:
        _check_empty(place, manifest)
    erased = _erased_in(place) if is_record else frozenset()
    with output_errors(path):
        beside = make_file(path.parent, path)
    try:
        with _opened(replace(place, url=place.url.set(database=str(beside)))) as database:
            report = fill(database, erased or frozenset())
        set_aside = _set_aside(path) if path.exists() else None
        with output_errors(path):
            sync(beside)
            beside.chmod(PRIVATE_FILE)
            beside.replace(path)
            sync(path.parent)
    finally:
        for name in (beside, *(Path(f"{beside}{suffix}") for suffix in _BESIDE)):
            _try_to_remove(name)
        release(beside)
    return replace(report, set_aside=set_aside, is_erasure_unknown=erased is None)


def _erased_in(place: RecordsPlace) -> Set[str] | None:
    """Return who is erased in the record that is to be set aside; None where it cannot be read."""
    try:
        with _opened(place) as database, database.reading() as connection:
            if schema_of(connection) is None:
                return frozenset()
            query = select(persons.c.id).where(persons.c.is_erased)
            return frozenset(connection.execute(query).scalars())
    except (InsoleError, SQLAlchemyError) as error:
        log.warning("%s cannot be asked who was erased: %s", place.name, error)
        return None


def _restore_server(place: RecordsPlace, manifest: Manifest, fill: _Fill) -> RestoreReport:
    _check_empty(place, manifest)
    with _opened(place) as database:
        return fill(database, frozenset())


@contextmanager
def _opened(place: RecordsPlace) -> Iterator[Database]:
    database = Database(place)
    try:
        yield database
    finally:
        database.close()


def _fill(
    database: Database,
    erased: Set[str],
    *,
    opened: OpenedSnapshot,
    store: ContentStore,
    who: Author,
    progress: Progress,
) -> RestoreReport:
    """Make the tables as they were, fill them, and bring them to this program's."""
    manifest = opened.manifest
    migrate(database, manifest.schema)
    with database.writing() as connection:
        rows = _insert_tables(connection, opened, progress.part(0, 0.3))
        _restore_contents(connection, opened, store, progress.part(0.3, 1))
        report = RestoreReport(
            opened.snapshot,
            rows,
            manifest.contents,
            manifest.contents_bytes,
            manifest.damaged,
            verify_chain(connection, {manifest.audit_seq: manifest.audit_hash}),
        )
        write_setting(connection, IDENTITY_VALUE, store.identity())
    migrate(database)
    with database.writing() as connection:
        context = RecordsContext(database, store, who)
        count = _erase_again(connection, {*erased, *opened.newest.erased}, context)
        AuditLog.append(connection, who, RESTORED, "record", f"snapshot {opened.snapshot.number}")
    return replace(report, erased_again=count)


def _erase_again(connection: Connection, erased: Set[str], context: RecordsContext) -> int:
    """Erase whoever is known to be erased: by the newest snapshot, or the record there was."""
    query = select(persons.c.id).where(~persons.c.is_erased, persons.c.merged_into.is_(None))
    there = set(connection.execute(query).scalars())
    coming = sorted(there.intersection(erased))
    for person_id in coming:
        today = datetime.now(UTC).date()
        erase_in(connection, context, person_id, ErasureReason.REQUEST, today)
    return len(coming)


def _insert_tables(connection: Connection, opened: OpenedSnapshot, progress: Progress) -> int:
    """Insert the rows of all tables; return their number."""
    saved = {table.name: table for table in opened.manifest.tables}
    tables = tables_of(connection)
    if saved.keys() != {table.name for table in tables}:
        raise damaged(opened.snapshot.file_name)
    for table, step in zip(tables, progress.parts(len(tables)), strict=True):
        step.step(0.0, "Restoring the table {table}", table=table.name)
        _insert_table(connection, table, saved[table.name], opened)
    return sum(table.rows for table in saved.values())


def _insert_table(
    connection: Connection, table: Table, saved: TableContent, opened: OpenedSnapshot
) -> None:
    pieces = map(opened.reader.read_rows, saved.pieces)
    try:
        if connection.execute(select(func.count()).select_from(table)).scalar_one() > 0:
            count = replace_pieces(connection, table, saved.columns, pieces)
        else:
            count = insert_pieces(connection, table, saved.columns, pieces)
    except (ValueError, KeyError, TypeError) as error:
        raise damaged(f"{opened.snapshot.file_name}, {table.name}") from error
    if count != saved.rows:
        raise damaged(f"{opened.snapshot.file_name}, {table.name}")


def _restore_contents(
    connection: Connection, opened: OpenedSnapshot, store: ContentStore, progress: Progress
) -> None:
    left_out = set(opened.manifest.damaged)
    query = select(contents.c.sha256).order_by(contents.c.sha256)
    wanted = [name for name in connection.execute(query).scalars() if name not in left_out]
    for index, sha256 in enumerate(wanted):
        progress.step(
            index / len(wanted), "Restoring files ({done} of {all})", done=index, all=len(wanted)
        )
        store.receive(sha256, partial(opened.reader.copy_file, sha256))


def _restore_settings(
    opened: OpenedSnapshot, settings: Mapping[str, Path], revise: Revise | None
) -> tuple[int, int]:
    """Return the numbers of files that were restored, and that were there already."""
    restored = kept = 0
    for file in opened.manifest.files:
        if file.group not in settings:
            continue
        path = settings[file.group] / _inner_path(file)
        if path.exists():
            kept += 1
            continue
        content = io.BytesIO()
        opened.reader.copy_file(file.sha256, content)
        held = content.getvalue()
        make_output_folder(path.parent)
        with replacing_file(path) as beside:
            beside.write_bytes(held if revise is None else revise(file, held))
        restored += 1
    return restored, kept


def _inner_path(file: SavedFile) -> PurePosixPath:
    path = PurePosixPath(file.name)
    is_long = any(len(part.encode()) > _LONGEST_NAME for part in path.parts)
    if not path.parts or path.is_absolute() or ".." in path.parts or is_long:
        raise damaged(file.name[:_LONGEST_NAME])
    return path


def _check_empty(place: RecordsPlace, manifest: Manifest) -> None:
    """Refuse to replace a record, unless nothing was ever entered: that of a new machine.

    A local one may hold the sample patient, which comes with the first start.

    Raises
    ------
    PlaceTaken
    """
    try:
        with _opened(place) as database, database.reading() as connection:
            if schema_of(connection) is None or head_of(connection)[0] == 0:
                return
            if place.is_local and holds_only_sample(connection):
                return
            comparison = _compared(connection, place, manifest)
    except (InsoleError, SQLAlchemyError) as error:
        log.warning("%s cannot be read before it is replaced: %s", place.name, error)
        comparison = Message("{place} holds a record that cannot be read.", place=place.name)
    if place.is_local:
        raise PlaceTaken(
            "{comparison} Restore to an empty place, or let this record be set aside.",
            comparison=comparison,
        )
    raise PlaceTaken("{comparison} Restore to an empty database.", comparison=comparison)


def _compared(connection: Connection, place: RecordsPlace, manifest: Manifest) -> Message:
    """Say which of record and backup is newer, and by what; backups and readings are no change."""
    seq = manifest.audit_seq
    head_seq, _ = head_of(connection)
    if head_seq < seq:
        return Message(
            "{place} holds a record with {count} entries fewer in its audit log than the backup.",
            place=place.name,
            count=seq - head_seq,
        )
    last_common = select(audit.c.hash).where(audit.c.seq == seq)
    if connection.execute(last_common).scalar() not in (None, manifest.audit_hash):
        return Message("{place} holds another record than the backup.", place=place.name)
    newer = and_(audit.c.seq > seq, audit.c.action.not_in(_NO_CHANGE))
    query = select(func.count(), highest(audit.c.at)).where(newer)
    count, last_at = connection.execute(query).one()
    if count == 0:
        return Message(
            "{place} holds the record as the backup has it: nothing was changed since.",
            place=place.name,
        )
    kinds = select(audit.c.subject_kind, func.count()).where(newer).group_by(audit.c.subject_kind)
    by_kind = connection.execute(kinds.order_by(func.count().desc())).all()
    return Message(
        "{place} holds a record that is newer than the backup: {count} entries of its audit log "
        "are not in it, the last of {last_at} UTC ({kinds}).",
        place=place.name,
        count=count,
        last_at=str(last_at)[:16].replace("T", " "),
        kinds=joined([Message("{what} {count}", what=kind, count=n) for kind, n in by_kind]),
    )


def _set_aside(path: Path) -> Path:
    """Rename a database to a name that says until when it was used."""
    _close_journal(path)
    moment = datetime.now(UTC).strftime("%Y-%m-%d %H.%M.%S")
    aside = path.with_name(f"{path.stem} until {moment}{path.suffix}")
    with output_errors(path):
        for suffix in ("", *_BESIDE):
            beside = Path(f"{path}{suffix}")
            if beside.exists():
                beside.rename(f"{aside}{suffix}")
    return aside


def _close_journal(path: Path) -> None:
    """Bring a database into one file, which succeeds only if no other program has it open.

    Raises
    ------
    RecordsError
    """
    try:
        with closing(sqlite3.connect(f"{path.resolve().as_uri()}?mode=rw", uri=True)) as file:
            file.execute("PRAGMA journal_mode=DELETE")
    except sqlite3.OperationalError as error:
        if getattr(error, "sqlite_errorcode", None) == sqlite3.SQLITE_BUSY:
            raise RecordsError(
                "{path} is open in another program; close all windows of Insole Studio, then try "
                "again.",
                path=path,
            ) from error
        log.warning("%s is set aside as it is: %s", path, error)
    except sqlite3.DatabaseError as error:
        log.warning("%s is damaged and set aside as it is: %s", path, error)


def _try_to_remove(path: Path) -> None:
    try:
        remove(path)
    except OSError as error:
        log.warning("%s cannot be removed yet: %s", path, error)
