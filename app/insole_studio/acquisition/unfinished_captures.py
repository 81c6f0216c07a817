"""Captures that were not brought to an end: what they kept is offered again."""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from pathlib import Path

from insole_core.errors import InputError
from insole_core.recording.reader import read_session
from insole_core.recording.session import Manifest
from insole_studio.acquisition.plan_request import PlanRequest, kept_request


@dataclass(frozen=True, eq=False)
class UnfinishedCapture:
    """What a capture has left.

    Parameters
    ----------
    folder
    manifest
        With the views that are finished.
    request
        What was to be captured.
    """

    folder: Path
    manifest: Manifest
    request: PlanRequest

    @property
    def order(self) -> tuple[str, ...]:
        """All views that were wanted."""
        return self.request.plan().views

    def discard(self) -> None:
        """Remove it for ever."""
        shutil.rmtree(self.folder, ignore_errors=True)


def newest_unfinished_capture(folder: Path) -> UnfinishedCapture | None:
    """Find what the last unfinished capture has left in the folder for drafts."""
    found = [draft for path in folder.glob("*/manifest.json") if (draft := _read(path.parent))]
    return max(found, key=lambda draft: draft.manifest.recorded_at, default=None)


def _read(folder: Path) -> UnfinishedCapture | None:
    try:
        manifest = read_session(folder).manifest
    except InputError:
        return None
    request = kept_request(manifest.extra)
    return None if request is None else UnfinishedCapture(folder, manifest, request)
