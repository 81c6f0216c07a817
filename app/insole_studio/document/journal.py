"""The files that hold unsaved work: each is a case with where it comes from, in one archive.

A journal takes its place as a whole or not at all, so the case in it and what it is to be stored
over always belong together. Whoever works with one holds its lock, which ends with the process.
"""

from __future__ import annotations

import json
import logging
import os
import time
import uuid
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import CaseRecord
from insole_core.errors import InsoleError, OutputError
from insole_core.files.file_lock import FileLock
from insole_core.files.temporary import is_temporary
from insole_core.forgiving_json import Complain, rename_unreadable
from insole_core.geometry.side import Side
from insole_core.json_object import JsonObject
from insole_core.messages import Message
from insole_core.strict_json import MOST_BYTES
from insole_core.workflows.file_kind import CASE_SUFFIX
from insole_core.zip_archive import ZipArchive
from insole_studio.document.kept_visit import UnkeptVisit

log = logging.getLogger(__name__)

DAMAGED_DAYS = 30
"""How long a journal that cannot be read is kept."""
_ORIGIN_NAME = "origin.json"
_DAY_S = 86_400


@dataclass(frozen=True)
class Origin:
    """Where the case of a journal comes from; empty for a case never saved.

    Parameters
    ----------
    path, digest
        Of its file; the SHA-256 is empty where it is unknown.
    visit
        The visit of the clinic's record that it is; None for a case of a file.
    """

    path: str = ""
    digest: str = ""
    visit: UnkeptVisit | None = None

    def to_json(self) -> dict[str, object]:
        """Return it as values for `json.dumps`."""
        content: dict[str, object] = {"path": self.path, "digest": self.digest}
        if self.visit is not None:
            content["visit"] = self.visit.to_json()
        return content

    @classmethod
    def from_json(cls, stored: JsonObject) -> Origin:
        """Return it from what `to_json` gave.

        Raises
        ------
        InputError
            When it is none.
        """
        if stored.has("visit"):
            return cls(visit=UnkeptVisit.from_json(stored.object("visit")))
        path = stored.path_text("path", empty=True)
        digest = stored.text("digest", empty=True)
        return cls(path, digest) if _is_case_file(path) else cls()


@dataclass(frozen=True, eq=False)
class Recovered:
    """A case left behind by a program that has ended, which no other window is offered meanwhile.

    Parameters
    ----------
    path
        The file it was opened from; None for a case never saved.
    copies
        The files to remove once the case is safe.
    lock
        Keeps other windows from the copies until it is released.
    digest
        SHA-256 of that file when it was last read or written; empty where that is unknown.
    visit
        The visit of the clinic's record that it is; None for a case of a file.
    """

    record: CaseRecord
    path: Path | None
    copies: tuple[Path, ...]
    lock: FileLock
    digest: str = ""
    visit: UnkeptVisit | None = None

    def discard(self) -> None:
        """Remove the copies."""
        remove_files(*self.copies)
        self.release()

    def release(self) -> None:
        """Leave the copies, if they are still there, to the next window that starts."""
        self.lock.release()


def write_journal(
    record: CaseRecord,
    origin: Origin,
    beside: Path,
    packed: Mapping[Side, bytes] = MappingProxyType({}),
) -> None:
    """Write a journal to a path that `replacing_file` gave.

    Parameters
    ----------
    packed
        As for `write_case`.

    Raises
    ------
    OutputError
        When it cannot be written.
    """
    write_case(record, beside, packed)
    with zipfile.ZipFile(beside, "a") as archive:
        archive.writestr(_ORIGIN_NAME, json.dumps(origin.to_json()))


def new_journal(folder: Path) -> Path:
    """Return the path of a journal that does not exist yet."""
    return folder / f"{uuid.uuid4().hex}{CASE_SUFFIX}"


def journal_lock(copy: Path) -> FileLock:
    """Return the lock of a journal, not taken yet."""
    return FileLock(copy.with_suffix(".lock"))


def find_recovered(folder: Path, complain: Complain = log.warning) -> list[Recovered]:
    """Return the cases left by programs that no longer run, newest first, each of them held.

    Parameters
    ----------
    complain
        Called with a sentence for the user on each journal that is damaged, when it is found and
        when it is removed.
    """
    _settle_damaged(folder, complain)
    found = []
    for copy in _journals_in(folder):
        lock = journal_lock(copy)
        if _is_held_elsewhere(lock):
            continue
        recovered = _recover(copy, lock, complain) if copy.exists() else None
        if recovered is None:
            lock.release()
        else:
            found.append(recovered)
    _sweep_locks(folder)
    return found


def remove_files(*paths: Path) -> None:
    """Remove files; one that stays costs only a warning."""
    for path in paths:
        try:
            path.unlink(missing_ok=True)
        except OSError as error:
            log.warning("%s cannot be removed: %s", path, error)


def _journals_in(folder: Path) -> list[Path]:
    """Return the journals in a folder, newest first.

    What is being written beside one has a hidden name, and is none.
    """
    by_age = []
    for copy in folder.glob(f"*{CASE_SUFFIX}"):
        try:
            by_age.append((copy.stat().st_mtime, copy))
        except OSError as error:  # its holder has just removed it
            log.info("%s cannot be looked at: %s", copy, error)
    return [copy for _time, copy in sorted(by_age, reverse=True) if not is_temporary(copy.name)]


def _is_held_elsewhere(lock: FileLock) -> bool:
    """Take a lock if it is free; return whether a running program has it.

    It does not count as held if the folder takes no lock at all.
    """
    try:
        return not lock.acquire()
    except OutputError as error:
        log.warning("a journal is read without its lock: %s", error)
        return False


def _recover(copy: Path, lock: FileLock, complain: Complain) -> Recovered | None:
    """Read a journal; None for one that is damaged, which is kept under another name."""
    try:
        record = read_case(copy)
    except InsoleError as error:
        log.warning("%s cannot be recovered: %s", copy, error)
        kept = rename_unreadable(copy)
        _touch(kept)
        complain(
            Message(
                "The copy {path} of unsaved work is damaged; it is kept as {kept} for {days} days.",
                path=copy,
                kept=kept,
                days=DAMAGED_DAYS,
            )
        )
        return None
    origin = _origin_of(copy)
    path = Path(origin.path) if origin.path else None
    copies = copy, _origin_beside(copy)
    return Recovered(record, path, copies, lock, origin.digest, origin.visit)


def _origin_of(copy: Path) -> Origin:
    """Read where a case comes from; it is intact, so a loss of this must not hide it."""
    try:
        return Origin.from_json(_stored_origin(copy))
    except InsoleError as error:
        log.warning("the file of a recovered case is not known: %s", error)
        return Origin()


def _stored_origin(copy: Path) -> JsonObject:
    archive = ZipArchive(str(copy), copy)
    if _ORIGIN_NAME in archive.names:
        content = archive.read(_ORIGIN_NAME, MOST_BYTES)
        return JsonObject.parse(f"{copy}: {_ORIGIN_NAME}", content)
    return JsonObject.read(_origin_beside(copy))


def _origin_beside(copy: Path) -> Path:
    """Return where programs of before 2026-11-26 kept the origin."""
    return copy.with_suffix(".json")


def _is_case_file(text: str) -> bool:
    """Return whether a text is the absolute path of a case file."""
    try:
        os.fsencode(text)
    except UnicodeEncodeError:
        return False
    path = Path(text)
    return path.is_absolute() and path.suffix.lower() == CASE_SUFFIX and "\0" not in text


def _settle_damaged(folder: Path, complain: Complain) -> None:
    """Take back what was set aside as damaged but is whole; remove the rest after some time.

    Programs of before 2026-11-26 set aside what another window was writing.
    """
    for left in folder.glob(f"*{CASE_SUFFIX}.broken-*"):
        try:
            _settle(left, complain)
        except OSError as error:  # another window settles it as well, or nobody may
            log.warning("%s stays as it is: %s", left, error)


def _settle(left: Path, complain: Complain) -> None:
    try:
        read_case(left)
    except InsoleError:
        _end(left, complain)
    else:
        left.rename(new_journal(left.parent))


def _end(left: Path, complain: Complain) -> None:
    if time.time() - left.stat().st_mtime > DAMAGED_DAYS * _DAY_S:
        remove_files(left)
        complain(
            Message(
                "{path}, a copy of unsaved work that is damaged, was kept for {days} days and is "
                "removed now.",
                path=left,
                days=DAMAGED_DAYS,
            )
        )


def _touch(path: Path) -> None:
    try:
        os.utime(path)
    except OSError as error:
        log.warning("the date of %s cannot be set: %s", path, error)


def _sweep_locks(folder: Path) -> None:
    """Remove the locks of programs that were killed when nothing was unsaved."""
    for left in folder.glob("*.lock"):
        lock = FileLock(left)
        if not left.with_suffix(CASE_SUFFIX).exists() and not _is_held_elsewhere(lock):
            remove_files(left.with_suffix(".json"))
            lock.release()
