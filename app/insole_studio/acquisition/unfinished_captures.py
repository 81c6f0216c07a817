"""Captures that were not used: whoever works on one holds it, and the others are offered again."""

from __future__ import annotations

import shutil
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from datetime import date, datetime
from itertools import chain, count
from pathlib import Path

from insole_core.errors import InputError
from insole_core.files.atomic import make_output_folder
from insole_core.files.file_lock import FileLock
from insole_core.recording.reader import read_session
from insole_core.recording.session import Manifest
from insole_studio.acquisition.capture_plan import PlanRequest, kept_request
from insole_studio.acquisition.draft import is_abandoned
from insole_studio.acquisition.messages import ViewStatus

_GONE = "{folder} holds no unfinished capture; it was used or discarded, or never was one."
KEPT_DAYS = 30
"""How long a capture is kept after its last view, unless it is used or discarded before."""
_DAY_S = 86_400
_TARGET_LOCK = ".insole-studio-capture-"


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

    @property
    def kept_until(self) -> date:
        """Return the day on which it is removed."""
        return datetime.fromtimestamp(_ends_at(self.folder)).date()

    @property
    def views(self) -> tuple[ViewStatus, ...]:
        """Return the finished views."""
        frames = self.request.frames
        return tuple(
            ViewStatus(shot.view, shot.serial, frames, frames, True, place=shot.place)
            for shot in self.request.plan().shots
            if shot.view in self.manifest.views
        )


@dataclass(frozen=True)
class HeldDraft:
    """The folder of a draft that nobody else may work on until it is released."""

    folder: Path
    lock: FileLock

    def release(self) -> None:
        """Let others work on it."""
        self.lock.release()

    def discard(self) -> None:
        """Remove it permanently."""
        shutil.rmtree(self.folder, ignore_errors=True)
        self.release()


class Drafts:
    """The drafts in one folder; each is held by the window or command that works on it."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def begin(self, name: str) -> HeldDraft:
        """Hold a new draft, whose folder does not exist yet.

        Parameters
        ----------
        name
            Of the folder; a number is added where it is taken.

        Raises
        ------
        OutputError
            When there is no place for drafts.
        """
        make_output_folder(self._folder)
        candidates = chain((name,), (f"{name}-{number}" for number in count(2)))
        return next(
            held
            for candidate in candidates
            if (held := _free(self._folder / candidate)) is not None
        )

    def left(self) -> list[UnfinishedCapture]:
        """Return the unfinished captures that nobody works on, the latest first."""
        found = [
            draft
            for path in self._folder.glob("*/manifest.json")
            if not _is_held(path.parent) and (draft := read_unfinished(path.parent))
        ]
        return sorted(found, key=lambda draft: draft.manifest.recorded_at, reverse=True)

    def sweep(self) -> int:
        """Remove what captures left that were killed before their first view, or are too old.

        Returns
        -------
        int
            How many with finished views were removed.
        """
        ended = 0
        for folder in self._folder.glob("*/"):
            with suppress(OSError):  # another window sweeps as well
                ended += _sweep(folder)
        return ended


def _sweep(folder: Path) -> bool:
    """Remove a draft whose time is over; return whether it had finished views."""
    if not (is_abandoned(folder) or _has_ended(folder)):
        return False
    with _lock(folder) as lock:
        is_free = lock.acquire()
        is_empty = is_abandoned(folder)  # as it is now that nobody else works on it
        if not is_free or not (is_empty or _has_ended(folder)):
            return False
        shutil.rmtree(folder, ignore_errors=True)
    return not is_empty


def _has_ended(folder: Path) -> bool:
    """Return whether a folder is a draft, damaged or not, whose time is over."""
    return (folder / "views").is_dir() and _ends_at(folder) < time.time()


def _ends_at(folder: Path) -> float:
    """Return when the time of a draft is over; that of one that is gone begins now."""
    parts = (folder, folder / "views", folder / "manifest.json")
    changed = max((at for at in map(_changed_at, parts) if at is not None), default=time.time())
    return changed + KEPT_DAYS * _DAY_S


def _changed_at(path: Path) -> float | None:
    try:
        return path.stat().st_mtime
    except OSError:  # another window has used or discarded it
        return None


def hold_draft(folder: Path) -> HeldDraft:
    """Hold an existing draft.

    Raises
    ------
    InputError
        When another window or command works on it, or it is not there.
    OutputError
        When its place cannot be written.
    """
    if not folder.is_dir():
        raise InputError(_GONE, folder=folder)
    held = HeldDraft(folder, _lock(folder))
    if not held.lock.acquire():
        raise InputError(
            "{folder} is in use by another window or command; finish or close that one first.",
            folder=folder,
        )
    return held


def hold_unfinished(folder: Path) -> tuple[HeldDraft, UnfinishedCapture]:
    """Hold an unfinished capture that was offered, and read it as it is now.

    Raises
    ------
    InputError
        When another window or command works on it, or has used or discarded it.
    OutputError
        When its place cannot be written.
    """
    held = hold_draft(folder)
    with ExitStack() as on_failure:
        on_failure.callback(held.release)
        left = read_unfinished(folder)
        if left is None:
            raise InputError(_GONE, folder=folder)
        on_failure.pop_all()
    return held, left


@contextmanager
def holding_target(path: Path) -> Iterator[None]:
    """Keep other captures from the same destination until this one is done.

    Raises
    ------
    InputError
        When another capture is writing there.
    OutputError
        When the place cannot be written.
    """
    place = path.resolve()
    _sweep_locks(place.parent)
    with FileLock(place.with_name(f"{_TARGET_LOCK}{place.name}.lock")) as lock:
        if not lock.acquire():
            raise InputError(
                "Another capture is to be written to {path}; wait until it has ended, or choose "
                "another name.",
                path=path,
            )
        yield


def _sweep_locks(folder: Path) -> None:
    """Remove the locks of destinations that killed captures left: nobody holds them."""
    with suppress(OSError):  # another capture sweeps as well
        for left in folder.glob(f"{_TARGET_LOCK}*.lock"):
            with FileLock(left) as lock:
                lock.acquire()


def read_unfinished(folder: Path) -> UnfinishedCapture | None:
    """Read an unfinished capture; None if the folder is none, or is damaged."""
    try:
        manifest = read_session(folder).manifest
    except InputError:
        return None
    request = kept_request(manifest.extra)
    return None if request is None else UnfinishedCapture(folder, manifest, request)


def _lock(folder: Path) -> FileLock:
    place = folder.resolve()
    return FileLock(place.with_name(f"{place.name}.lock"))


def _free(folder: Path) -> HeldDraft | None:
    """Hold a draft that does not exist yet; None if its name is taken."""
    held = HeldDraft(folder, _lock(folder))
    if not held.lock.acquire():
        return None
    if folder.exists():
        held.release()
        return None
    return held


def _is_held(folder: Path) -> bool:
    with _lock(folder) as lock:
        return not lock.acquire()
