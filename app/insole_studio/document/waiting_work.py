"""What was done and the record could not take yet: a small file each, until the record has it.

As with the journals of cases (`journal`), every window holds the lock of its own folder. One whose
lock is free was left by a program that ended, and the next window that can store it takes it over.
"""

from __future__ import annotations

import json
import logging
import uuid
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from insole_core.errors import InsoleError, OutputError
from insole_core.files.atomic import make_private_folder, replacing_file
from insole_core.files.file_lock import FileLock
from insole_core.files.temporary import is_temporary
from insole_core.files.write_errors import output_errors
from insole_core.forgiving_json import rename_unreadable
from insole_core.json_object import JsonObject
from insole_studio.document.journal import remove_files
from insole_studio.texts import fill, tr, translate_core_message

log = logging.getLogger(__name__)

_VISIT = "visit"


@dataclass(frozen=True)
class LeftWork:
    """A piece of work that a program has left which ended before the record had it."""

    key: str
    visit_id: str
    content: JsonObject


class WaitingWork:
    """The waiting work of one kind and one window, each piece of a visit and with a key.

    Parameters
    ----------
    folder
        Of all windows, for this kind; the folder of this window is made in it when it is needed.
    tell
        Called with a sentence for the user about work that can never be stored.
    """

    def __init__(self, folder: Path, tell: Callable[[str], object]) -> None:
        self._all = folder
        self._tell = tell
        self._own = folder / uuid.uuid4().hex
        self._lock: FileLock | None = None

    def keep(self, key: str, visit_id: str, work: Mapping[str, Any]) -> None:
        """Write a piece of work in place of the one with its key; return when it is on the disk.

        A disk that takes nothing must not keep the work from being stored in the record.
        """
        try:
            self._take_own()
            with replacing_file(self._own / f"{key}.json") as beside:
                text = json.dumps({**work, _VISIT: visit_id}, ensure_ascii=False)
                beside.write_text(text, encoding="utf-8", newline="\n")
        except OutputError as error:
            log.warning("waiting work cannot be kept: %s", error)

    def drop(self, key: str) -> None:
        """Forget a piece of work: the record has it, or it is not wanted any more."""
        remove_files(self._own / f"{key}.json")

    def set_aside(self, key: str, error: InsoleError) -> None:
        """Keep a piece of work that can never be stored under another name, and tell of it."""
        self._set_aside(self._own / f"{key}.json", error)

    def _set_aside(self, path: Path, error: InsoleError) -> None:
        log.warning("waiting work is set aside: %s", error)
        sentence = tr("What waited for the record cannot be stored: {reason} It is kept as {path}.")
        reason = translate_core_message(str(error))
        self._tell(fill(sentence, reason=reason, path=rename_unreadable(path)))

    def take_over(self) -> list[LeftWork]:
        """Return what programs have left that ended, the oldest first; it is this window's now."""
        taken = []
        for folder, lock in _left_in(self._all, self._own):
            with lock:
                taken += [left for path in _works_in(folder) if (left := self._taken(path))]
                _remove_empty(folder)
        return taken

    def _taken(self, path: Path) -> LeftWork | None:
        """Move a piece of work here; None for one that cannot be, or that is worked on here."""
        try:
            left = _read(path)
        except InsoleError as error:
            self._set_aside(path, error)
            return None
        try:
            self._take_own()
            own = self._own / path.name
            if own.exists():
                return None
            path.replace(own)
        except (OSError, OutputError) as error:
            log.warning("waiting work stays where it is: %s", error)
            return None
        return left

    def close(self) -> None:
        """Leave what still waits to the next window that starts."""
        if self._lock is not None:
            _remove_empty(self._own)
            self._lock.release()
            self._lock = None

    def _take_own(self) -> None:
        if self._lock is None:
            with output_errors(self._own):
                make_private_folder(self._all)
                self._lock = FileLock(self._own.with_suffix(".lock"))
                self._lock.acquire()  # before there is a folder that another window could take
                make_private_folder(self._own)


def forget_visits(folder: Path, visit_ids: Collection[str]) -> None:
    """Remove the waiting work of visits that were erased, but for that of other windows.

    Parameters
    ----------
    folder
        Of all windows, for one kind.
    """
    for left, lock in _left_in(folder, None):
        with lock:
            remove_files(*(path for path in _works_in(left) if _may_be_of(visit_ids, path)))
            remove_files(*left.glob("*.broken-*"))  # whose they are is not known
            _remove_empty(left)


def _left_in(folder: Path, own: Path | None) -> Iterator[tuple[Path, FileLock]]:
    """Yield the folders that no running window holds, each with its lock, which is taken."""
    for left in sorted(folder.glob("*")):
        lock = FileLock(left.with_suffix(".lock"))
        if left == own or not left.is_dir():
            continue
        try:
            is_free = lock.acquire()
        except OutputError as error:
            log.warning("waiting work is not looked at: %s", error)
            continue
        if is_free:
            yield left, lock


def _works_in(folder: Path) -> list[Path]:
    return [path for path in sorted(folder.glob("*.json")) if not is_temporary(path.name)]


def _read(path: Path) -> LeftWork:
    content = JsonObject.read(path)
    return LeftWork(path.stem, content.text(_VISIT), content)


def _may_be_of(visit_ids: Collection[str], path: Path) -> bool:
    """Return whether a piece of work is of one of the visits; of a damaged one nobody knows."""
    try:
        return _read(path).visit_id in visit_ids
    except InsoleError as error:
        log.warning("waiting work cannot be read: %s", error)
        return True


def _remove_empty(folder: Path) -> None:
    try:
        folder.rmdir()
    except OSError:  # something still waits in it
        return
