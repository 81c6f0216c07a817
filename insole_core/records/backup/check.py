"""Checking a backup: by the digests of its files, or by decrypting all of a snapshot."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from insole_core.progress import SILENT, Cancelled, Progress
from insole_core.records.backup.backup_folder import BackupFolder, SnapshotName
from insole_core.records.backup.backup_key import DamagedBackup
from insole_core.records.backup.snapshot import OpenedSnapshot, contents_in, open_snapshot
from insole_core.records.schema import contents


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
