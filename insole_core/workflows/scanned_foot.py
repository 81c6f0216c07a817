"""A foot and the scan that it was made from."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path

from insole_core.cases.case_record import ScanSource
from insole_core.foot.foot import Foot
from insole_core.messages import Message
from insole_core.progress import SILENT, Cancelled, Progress
from insole_core.recording.session import Session
from insole_core.recording.store import MAX_ARCHIVE_BYTES
from insole_core.regular_file import blocks_of, open_regular

MANIFEST = "manifest.json"


@dataclass(frozen=True, eq=False)
class ScannedFoot:
    """A foot and its scan; `warnings` are sentences for the user."""

    foot: Foot
    source: ScanSource
    warnings: tuple[str, ...] = ()


def session_source(path: Path, session: Session) -> ScanSource:
    """Return the scan record of a session that was read from `path`."""
    return _source("session", path, session.manifest.recorded_at)


def mesh_source(path: Path) -> ScanSource:
    """Return the scan record of a mesh file."""
    return _source("mesh", path)


def change_of_source(source: ScanSource, progress: Progress = SILENT) -> str:
    """Return a sentence on how a scan changed since it was read; empty when it did not.

    Raises
    ------
    Cancelled
    """
    path = Path(source.path)
    if not path.is_absolute():
        return ""  # a case made on another machine, such as the example
    try:
        if _sha256(_signed_file(path), progress) == source.sha256:
            return ""
    except OSError:
        return Message(
            "The scan {path} is not there any more, or cannot be read; the case holds its "
            "own copy of the foot, so the work can go on.",
            path=path,
        )
    return Message(
        "The scan {path} has changed since this case was made; the case keeps the foot as "
        "it was, open the scan again if the new one is wanted.",
        path=path,
    )


def _source(kind: str, path: Path, recorded_at: str = "") -> ScanSource:
    return ScanSource(kind, str(path.resolve()), _sha256(_signed_file(path)), recorded_at)


def _signed_file(path: Path) -> Path:
    """Return the file whose hash identifies a scan."""
    return path / MANIFEST if path.is_dir() else path


def _sha256(path: Path, progress: Progress = SILENT) -> str:
    """Return the SHA-256 of a regular file.

    Raises
    ------
    OSError
        When it cannot be read, or is larger than any scan.
    Cancelled
    """
    digest = hashlib.sha256()
    with open_regular(path) as file:
        for block in blocks_of(file, MAX_ARCHIVE_BYTES):
            digest.update(block)
            if progress.is_cancelled():
                raise Cancelled
    return digest.hexdigest()
