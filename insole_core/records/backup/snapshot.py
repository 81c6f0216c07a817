"""A snapshot of the record: what it consists of, and opening it."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Self

from insole_core.errors import InputError, RecordsError
from insole_core.messages import joined
from insole_core.records.backup.backup_folder import BackupFolder, BackupReader, SnapshotName
from insole_core.records.backup.backup_key import DamagedBackup, damaged, open_key

FORMAT = 1
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
            if values.pop("format") != FORMAT:
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
    snapshots = {snapshot.number: snapshot for snapshot in backups.snapshots()}
    if not snapshots or (number is not None and number not in snapshots):
        raise InputError(
            "{folder} holds no snapshot {number}; it has: {numbers}.",
            folder=folder,
            number="" if number is None else number,
            numbers=joined(map(str, snapshots)) if snapshots else "-",
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
