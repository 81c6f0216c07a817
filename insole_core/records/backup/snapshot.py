"""Opening a snapshot of a record, to check or to restore it."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from insole_core.errors import InputError
from insole_core.messages import joined
from insole_core.records.backup.backup_folder import BackupFolder, BackupReader, SnapshotName
from insole_core.records.backup.backup_key import DamagedBackup, open_key
from insole_core.records.backup.manifest import Manifest


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
