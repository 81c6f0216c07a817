"""A snapshot of the record: what it consists of, opening it, and checking it."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Self

from insole_core.errors import InputError, RecordsError
from insole_core.messages import joined
from insole_core.progress import SILENT, Cancelled, Progress
from insole_core.records.backup.backup_folder import BackupFolder, BackupReader, SnapshotName
from insole_core.records.backup.backup_key import DamagedBackup, damaged, open_key
from insole_core.records.schema import contents

FORMAT = 2
_READ_FORMATS = (1, FORMAT)
_SHA256 = re.compile(r"[0-9a-f]{64}")
_SCHEMA = re.compile(r"(?!0000)[0-9]{4}")
_LONGEST_TEXT = 4096


@dataclass(frozen=True)
class TableContent:
    """The rows of a table.

    Parameters
    ----------
    columns
        Names, in the order of the values of a row.
    pieces
        SHA-256 of each piece, in order.
    """

    name: str
    columns: tuple[str, ...]
    rows: int
    pieces: tuple[str, ...]


@dataclass(frozen=True)
class SavedFile:
    """A file of the settings.

    Parameters
    ----------
    group
        Which folder it is from, such as "settings".
    name
        Path within the folder, with slashes.
    """

    group: str
    name: str
    sha256: str
    size: int


@dataclass(frozen=True)
class Manifest:
    """The content of a snapshot.

    Parameters
    ----------
    made_at
        UTC.
    schema
        Revision of the tables.
    audit_seq, audit_hash
        Last line of the audit log.
    contents, contents_bytes
        Large files that the tables refer to.
    damaged
        SHA-256 of those that were missing or damaged when the backup was made, and are not in it.
    erased
        Ids of erased persons, who stay erased when an earlier snapshot is restored.
    patients
        Number of real patients; None in a backup of an older program.
    """

    made_at: str
    program_version: str
    schema: str
    audit_seq: int
    audit_hash: str
    tables: tuple[TableContent, ...]
    files: tuple[SavedFile, ...]
    contents: int
    contents_bytes: int
    damaged: tuple[str, ...] = ()
    erased: tuple[str, ...] = ()
    patients: int | None = None

    def as_json(self) -> bytes:
        """Return the manifest as a snapshot holds it."""
        return json.dumps({"format": FORMAT, **asdict(self)}, ensure_ascii=False).encode()

    @classmethod
    def from_json(cls, content: bytes, name: str) -> Self:
        """Read a manifest that was authenticated.

        Raises
        ------
        RecordsError
            When it comes from a newer program.
        DamagedBackup
        """
        try:
            values: dict[str, Any] = json.loads(content)
            if values.pop("format") not in _READ_FORMATS:
                raise RecordsError(
                    "The backup {name} comes from a newer Insole Studio; install the newest "
                    "version.",
                    name=name,
                )
            tables = [TableContent(**_tuples(table)) for table in values.pop("tables")]
            files = [SavedFile(**file) for file in values.pop("files")]
            manifest = cls(tables=tuple(tables), files=tuple(files), **_tuples(values))
            is_sound = manifest._is_sound()
        except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
            raise damaged(name) from error
        if not is_sound:
            raise damaged(name)
        return manifest

    def _is_sound(self) -> bool:
        """Return whether all values are of their kinds: only the key says who has written them."""
        tables, files = self.tables, self.files
        sha256 = (
            *(piece for table in tables for piece in table.pieces),
            *(file.sha256 for file in files),
            *self.damaged,
        )
        texts = (
            self.made_at, self.program_version, self.audit_hash, *self.erased,
            *(text for table in tables for text in (table.name, *table.columns)),
            *(text for file in files for text in (file.group, file.name)),
        )  # fmt: skip
        counts = (
            self.audit_seq, self.contents, self.contents_bytes,
            *(() if self.patients is None else (self.patients,)),
            *(table.rows for table in tables), *(file.size for file in files),
        )  # fmt: skip
        return (
            all(map(_SHA256.fullmatch, sha256))
            and all(len(text) <= _LONGEST_TEXT and text.isprintable() for text in texts)
            and all(type(count) is int and 0 <= count < 2**63 for count in counts)
            and _SCHEMA.fullmatch(self.schema) is not None
        )


def _tuples(values: dict[str, Any]) -> dict[str, Any]:
    return {
        key: tuple(value) if isinstance(value, list) else value for key, value in values.items()
    }


@dataclass(frozen=True)
class OpenedSnapshot:
    """A snapshot that can be read."""

    snapshot: SnapshotName
    manifest: Manifest
    reader: BackupReader
    newest: Manifest
    """Of the newest snapshot: who was erased by then stays erased."""


def open_snapshot(folder: Path, secret: str, number: int | None = None) -> OpenedSnapshot:
    """Open a snapshot with its passphrase or private key.

    Raises
    ------
    WrongSecret
        When it does not open the backup.
    InputError
        When there is no such snapshot.
    DamagedBackup
        When the snapshot cannot be read.
    """
    backups = BackupFolder(folder)
    head = backups.head()
    snapshots = backups.finished_snapshots()
    if number is not None and number not in snapshots:
        raise InputError(
            "{folder} holds no snapshot {number}; it has: {numbers}.",
            folder=folder,
            number=number,
            numbers=joined(map(str, snapshots)),
        )
    reader = BackupReader(backups, open_key(head.locked, secret))
    newest = snapshots[max(snapshots)]
    chosen = newest if number is None else snapshots[number]
    manifest = Manifest.from_json(reader.manifest(chosen), chosen.file_name)
    try:
        latest = Manifest.from_json(reader.manifest(newest), newest.file_name)
    except DamagedBackup:
        latest = manifest
    return OpenedSnapshot(chosen, manifest, reader, latest)


def contents_in(piece: bytes, columns: Sequence[str]) -> dict[str, int]:
    """Return size in bytes by SHA-256 of the large files that a piece of their table names."""
    sha256, size = columns.index("sha256"), columns.index("size")
    rows = map(json.loads, piece.splitlines())
    return {row[sha256]: row[size] for row in rows}


@dataclass(frozen=True)
class CheckReport:
    """What the check of a backup has read.

    Parameters
    ----------
    damaged
        Names of what is missing, or is not what was written.
    """

    snapshot: SnapshotName
    rows: int
    contents: int
    contents_bytes: int
    damaged: tuple[str, ...]

    @property
    def is_sound(self) -> bool:
        """Whether everything can be restored."""
        return not self.damaged


def check_backup(
    folder: Path, secret: str, number: int | None = None, progress: Progress = SILENT
) -> CheckReport:
    """Read and decrypt all of a snapshot, as restoring it would.

    Parameters
    ----------
    secret
        Passphrase, or private key of age.
    number
        Of the snapshot; by default the newest one.

    Raises
    ------
    WrongSecret, InputError
    DamagedBackup
        When the snapshot itself cannot be read. What it refers to is told in the report.
    Cancelled
    """
    opened = open_snapshot(folder, secret, number)
    wrong: list[str] = []
    rows, wanted = _check_rows(opened, wrong, progress.part(0, 0.3))
    wanted |= {file.sha256: file.size for file in opened.manifest.files}
    for sha256 in opened.manifest.damaged:
        wanted.pop(sha256, None)
    _check_files(opened, sorted(wanted), wrong, progress.part(0.3, 1))
    return CheckReport(opened.snapshot, rows, len(wanted), sum(wanted.values()), tuple(wrong))


def _check_rows(
    opened: OpenedSnapshot, wrong: list[str], progress: Progress
) -> tuple[int, dict[str, int]]:
    """Return the number of rows, and sizes of large files by SHA-256; add to what is wrong."""
    rows = 0
    wanted: dict[str, int] = {}
    for table in opened.manifest.tables:
        progress.step(0.0, "Checking the tables of the backup")
        for piece in table.pieces:
            try:
                content = opened.reader.read_rows(piece)
            except DamagedBackup as error:
                wrong.append(error.part)
                continue
            rows += content.count(b"\n")
            if table.name == contents.name:
                wanted |= contents_in(content, table.columns)
    return rows, wanted


def _check_files(
    opened: OpenedSnapshot, names: list[str], wrong: list[str], progress: Progress
) -> None:
    with Path(os.devnull).open("wb") as nowhere:
        for index, sha256 in enumerate(names):
            progress.step(index / len(names), "Checking the files of the backup")
            try:
                opened.reader.copy_file(sha256, nowhere)
            except DamagedBackup as error:
                wrong.append(error.part)


def damaged_files(folder: Path, progress: Progress = SILENT) -> tuple[str, ...]:
    """Name the files of a folder that are not what was written; this needs no passphrase.

    Raises
    ------
    InputError
        When the folder holds no backup.
    Cancelled
    """
    backups = BackupFolder(folder)
    backups.head()
    wrong = []
    for path, is_sound in backups.damaged_objects(progress.is_cancelled):
        if not is_sound:
            wrong.append(str(path.relative_to(folder)))
    if progress.is_cancelled():
        raise Cancelled
    return tuple(wrong)
