"""Captures that were not completed: their views are offered again."""

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
    """What an unfinished capture left behind.

    Parameters
    ----------
    manifest
        The manifest with the finished views.
    request
        What was to be captured, as requested at the start.
    """

    folder: Path
    manifest: Manifest
    request: PlanRequest

    @property
    def order(self) -> tuple[str, ...]:
        """Return all requested views in order."""
        return self.request.plan().views

    def discard(self) -> None:
        """Remove it permanently."""
        shutil.rmtree(self.folder, ignore_errors=True)


def newest_unfinished_capture(folder: Path) -> UnfinishedCapture | None:
    """Return the latest unfinished capture in the folder for drafts; None if there is none."""
    found = [draft for path in folder.glob("*/manifest.json") if (draft := _read(path.parent))]
    return max(found, key=lambda draft: draft.manifest.recorded_at, default=None)


def _read(folder: Path) -> UnfinishedCapture | None:
    try:
        manifest = read_session(folder).manifest
    except InputError:
        return None
    request = kept_request(manifest.extra)
    return None if request is None else UnfinishedCapture(folder, manifest, request)
