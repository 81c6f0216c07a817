"""A foot and the scan that it was made from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.cases.scan_source import NOTHING_SAID, ImportChoice, ScanSource
from insole_core.file_digest import sha256_of
from insole_core.foot.foot import Foot
from insole_core.imprints.form import Form
from insole_core.messages import Message
from insole_core.progress import SILENT, Progress
from insole_core.recording.session import Session
from insole_core.recording.store import MAX_ARCHIVE_BYTES

if TYPE_CHECKING:  # reconstruction begins sooner without the prescription, which is not used
    from insole_core.cases.case_record import FootRecord

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


def mesh_source(path: Path, form: Form = Form.FOOT) -> ScanSource:
    """Return the scan record of a mesh file."""
    return replace(_source("mesh", path), form=form)


def feet_made_of(
    path: Path, feet: Sequence[FootRecord], progress: Progress = SILENT
) -> tuple[FootRecord, ...]:
    """Return those feet of a case that a mesh file shows, wherever it lay then.

    Raises
    ------
    Cancelled
    """
    if path.is_dir() or all(foot.source.kind != "mesh" for foot in feet):
        return ()
    try:
        digest = sha256_of(path, MAX_ARCHIVE_BYTES, progress)
    except OSError:  # whoever reads the scan says what is wrong
        return ()
    shown = (foot for foot in feet if not foot.source.mirrored)
    return tuple(foot for foot in shown if foot.source.sha256 == digest)


def choice_of(feet: Sequence[FootRecord]) -> ImportChoice:
    """Return with which choice a scan gives the feet that were made of it once more.

    Parameters
    ----------
    feet
        One, or both of one scan.
    """
    source = feet[0].source
    choice = source.choice
    if choice == NOTHING_SAID and source.form is not Form.FOOT:  # of a case that kept no choice
        choice = replace(choice, form=source.form)
    return replace(choice, side=feet[0].side if len(feet) == 1 else None)


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
        if sha256_of(_signed_file(path), MAX_ARCHIVE_BYTES, progress) == source.sha256:
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
    digest = sha256_of(_signed_file(path), MAX_ARCHIVE_BYTES)
    return ScanSource(kind, str(path.resolve()), digest, recorded_at)


def _signed_file(path: Path) -> Path:
    """Return the file whose hash identifies a scan."""
    return path / MANIFEST if path.is_dir() else path
