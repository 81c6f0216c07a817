"""Results that take their places together, also when the process is killed in between.

A journal lists the moves before the first one is made. Whoever finds the journal of a process that
no longer runs makes the moves that are missing, or, where that is impossible, takes all of them
back. Once all are made, the journal only says what is still to be removed.
"""

from __future__ import annotations

import errno
import filecmp
import json
import logging
import os
import shutil
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from itertools import count
from pathlib import Path
from typing import Any, Self, TypeVar

from insole_core.files.file_safety import PRIVATE_FILE, PRIVATE_FOLDER, sync
from insole_core.files.temporary import (
    NOTE_SUFFIX,
    is_left,
    make_file,
    release,
    remove,
    state_folder_of_user,
    sweep_noted,
    temporary_name,
)

log = logging.getLogger(__name__)
_T = TypeVar("_T")

SUFFIX = ".journal"
"""Of a journal whose moves may be made in part."""
MADE_SUFFIX = ".made"
"""Of a journal whose moves are all made; what they replaced may still be there."""
_FAT_NS = 2_000_000_000
"""Times of files on FAT, once read from the disk, are rounded down to multiples of this."""


@dataclass(frozen=True)
class Move:
    """A finished result and the place it takes.

    Parameters
    ----------
    beside
        The result, on the same disk.
    old
        Where what it replaces is kept until all moves of its journal are made.
    replaces
        Whether there is something to replace.
    modified_ns
        When the result was last written, by which it is told from what somebody else puts in its
        place later; None if that is unknown.
    """

    beside: Path
    path: Path
    old: Path
    replaces: bool
    modified_ns: int | None = None

    @classmethod
    def from_json(cls, values: dict[str, Any]) -> Self:
        """Read a move from a journal."""
        return cls(
            Path(values["beside"]),
            Path(values["path"]),
            Path(values["old"]),
            values["replaces"],
            values.get("modified_ns"),
        )

    def make(self) -> None:
        """Put the result in its place; a move that is made already stays so.

        Raises
        ------
        OSError
            When the place cannot be taken.
        """
        if self._is_made():
            return
        if self.replaces and not os.path.lexists(self.old):
            _keep(self.path, self.old)
        if os.path.lexists(self.path) and not self._is_old():
            raise FileExistsError(errno.EEXIST, os.strerror(errno.EEXIST), str(self.path))
        self.beside.replace(self.path)

    def _is_made(self) -> bool:
        if os.path.lexists(self.beside) or not os.path.lexists(self.path):
            return False
        return not self._is_old() or self._holds_result()

    def _is_old(self) -> bool:
        """Return whether the place still holds what is to be replaced, and nothing newer."""
        if not self.replaces or not os.path.lexists(self.old):
            return False
        if self.path.samefile(self.old):
            return True
        both_files = self.path.is_file() and self.old.is_file()
        return both_files and filecmp.cmp(self.path, self.old, shallow=False)

    def _holds_result(self) -> bool:
        """Return whether the place is known to hold the result, and nothing newer."""
        if self.modified_ns is None:
            return False
        on_fat_ns = self.modified_ns - self.modified_ns % _FAT_NS
        return self.path.lstat().st_mtime_ns in (self.modified_ns, on_fat_ns)

    def make_at_once(self) -> None:
        """Put a single file, or a folder where there is none, in its place: no half of it exists.

        Raises
        ------
        OSError
            When the place cannot be taken.
        """
        self.beside.replace(self.path)
        sync(self.path.parent)

    def take_back(self) -> None:
        """Put back what was replaced; what somebody else has put there meanwhile stays.

        Raises
        ------
        OSError
            When the place cannot be taken. The move may be taken back or made again.
        """
        if self.replaces and not os.path.lexists(self.old):
            return
        is_moved = not os.path.lexists(self.beside) and os.path.lexists(self.path)
        if is_moved and (self.modified_ns is None or self._holds_result()):
            self.path.replace(self.beside)
        if not self.replaces:
            return
        if not os.path.lexists(self.path):
            self.old.replace(self.path)
        elif self.old.is_dir() and not self.old.is_symlink():  # the only copy
            self.old.rename(_free_name(self.path))
        else:
            self.old.unlink()  # a second name or a copy of what somebody replaced


class Journal:
    """The moves of one transaction, on the disk until all are made or all are taken back.

    Attributes
    ----------
    is_open
        Whether only some of the moves may be made: what they need must stay for the next start.
    """

    def __init__(self, moves: Sequence[Move]) -> None:
        self._moves = moves
        self._path: Path | None = None
        self.is_open = False

    def make_moves(self) -> None:
        """Make all moves or none, also if the process is killed: the next start settles it.

        Raises
        ------
        OSError
            When a place cannot be taken. Every place is as it was before, unless the journal is
            still open.
        """
        self.is_open = True
        try:
            self._write()
            _make_all(self._moves)
            self._path = _marked_as_made(self._path)
        except BaseException as error:
            self._take_back(error)
            raise
        self.is_open = False
        _drop_old(self._moves, self._path)

    def release(self) -> None:
        """Let the next start settle the journal, if it is still there."""
        if self._path is not None:
            release(self._path)

    def _write(self) -> None:
        """Write the journal where every start looks, if this user has such a place."""
        text = json.dumps([asdict(move) for move in self._moves], default=str)
        folder = state_folder_of_user()
        try:
            folder.mkdir(mode=PRIVATE_FOLDER, parents=True, exist_ok=True)
            unfinished = make_file(folder, folder)
            try:
                unfinished.write_text(text, encoding="utf-8", newline="\n")
                sync(unfinished)
                self._path = folder / temporary_name(folder, SUFFIX)
                unfinished.replace(self._path)
            finally:
                unfinished.unlink(missing_ok=True)
                release(unfinished)
            sync(folder)
        except OSError as error:
            log.warning("Without a journal, a kill may leave some of the results: %s", error)
            _forget(self._path)
            self._path = None

    def _take_back(self, error: BaseException) -> None:
        """Take the moves back after an error, and close the journal if that succeeds."""
        try:
            interruption = _take_back_to_the_end(self._moves)
        except OSError as resistance:  # the first error is the one to be told
            log.warning("The next start completes or takes back what is left: %s", resistance)
            return
        _forget(self._path)
        self.is_open = False
        if interruption is not None:
            raise interruption from error


def settle_interrupted(folder: Path) -> frozenset[Path]:
    """Settle the journals that processes left which no longer run, and remove what else they left.

    A journal stays while the disk of one of its results is absent.

    Returns
    -------
    frozenset of Path
        The unfinished results that journals still need, also those of living processes.
    """
    found = [left for left in _paths_in(folder) if is_left(left.name)]
    for left in found:
        if left.suffix != NOTE_SUFFIX:
            _try(_settle, left)
    needed = frozenset(
        move.beside
        for journal in _paths_in(folder)
        if journal.suffix == SUFFIX
        for move in _try(_moves_of, journal) or ()
    )
    for left in found:
        if left.suffix == NOTE_SUFFIX:
            _try(partial(sweep_noted, needed=needed), left)
    return needed


def _try(step: Callable[[Path], _T], left: Path) -> _T | None:
    """Take a step with what was left; None, and a line in the log, if that is impossible."""
    try:
        return step(left)
    except (OSError, ValueError, LookupError, TypeError, AttributeError) as error:
        log.warning("%s cannot be settled: %s", left, error)
        return None


def _paths_in(folder: Path) -> list[Path]:
    try:
        return list(folder.iterdir())
    except FileNotFoundError:
        return []
    except OSError as error:  # this user works without journals
        log.warning("%s cannot be looked into: %s", folder, error)
        return []


def _moves_of(journal: Path) -> list[Move]:
    return [Move.from_json(move) for move in json.loads(journal.read_text(encoding="utf-8"))]


def _settle(left: Path) -> None:
    if left.suffix not in (SUFFIX, MADE_SUFFIX):
        left.unlink()  # written by half: no move was made
        return
    journal = left.with_name(temporary_name(left, left.suffix))
    try:
        left.replace(journal)  # of several processes that try, one succeeds
        moves = _moves_of(journal)
        if all(move.path.parent.is_dir() for move in moves):
            _settle_moves(moves, journal)
    finally:
        release(journal)


def _settle_moves(moves: Sequence[Move], journal: Path) -> None:
    if journal.suffix == MADE_SUFFIX:
        _drop_old(moves, journal)
        return
    try:
        _make_all(moves)
    except OSError as error:
        _take_back(moves)
        log.warning("An interrupted export was taken back: %s", error)
        _forget(journal)
    else:
        _drop_old(moves, _marked_as_made(journal))


def _make_all(moves: Sequence[Move]) -> None:
    for move in moves:
        move.make()
    _sync_folders(moves)


def _take_back(moves: Sequence[Move]) -> None:
    for move in reversed(moves):
        move.take_back()
    _sync_folders(moves)


def _take_back_to_the_end(moves: Sequence[Move]) -> BaseException | None:
    """Take all moves back, also if somebody interrupts that; return the interruption."""
    try:
        _take_back(moves)
    except Exception:
        raise
    except BaseException as interruption:  # noqa: BLE001 - raised again when all is as it was
        _take_back(moves)
        return interruption
    return None


def _drop_old(moves: Sequence[Move], journal: Path | None) -> None:
    """Remove what was replaced; what resists now is removed at the next start.

    The results are in their places: nothing that fails here is an error of theirs.
    """
    try:
        kept = [move.old for move in moves if not _is_removed(move.old)]
        if not kept:
            _forget(journal)
    finally:
        if journal is not None:
            release(journal)


def _marked_as_made(journal: Path | None) -> Path | None:
    """Rename a journal, so that nobody takes back what its user knows as done."""
    if journal is None:
        return None
    made = journal.with_name(temporary_name(journal, MADE_SUFFIX))
    try:
        journal.replace(made)
    except OSError as error:
        log.warning("%s cannot be renamed: %s", journal, error)
        release(made)
        return journal
    release(journal)
    return made


def _is_removed(old: Path) -> bool:
    try:
        remove(old)
    except OSError as error:
        log.warning("%s, which was replaced, cannot be removed yet: %s", old, error)
        return False
    return True


def _forget(journal: Path | None) -> None:
    """Remove a journal that has nothing more to say; one that resists does no harm."""
    if journal is None:
        return
    try:
        journal.unlink(missing_ok=True)
    except OSError as error:
        log.warning("%s cannot be removed: %s", journal, error)
    release(journal)


def _sync_folders(moves: Sequence[Move]) -> None:
    for folder in {move.path.parent for move in moves}:
        sync(folder)


def _keep(path: Path, old: Path) -> None:
    """Keep what is replaced under a second name; the place of a file is never empty."""
    if path.is_dir():
        path.rename(old)
        return
    try:
        os.link(path, old)
    except OSError:  # a disk whose files have one name each
        os.close(os.open(old, os.O_CREAT | os.O_EXCL | os.O_WRONLY, PRIVATE_FILE))
        shutil.copyfile(path, old)
        shutil.copystat(path, old)
        sync(old)


def _free_name(path: Path) -> Path:
    """Return a visible name beside a path that nothing has yet."""
    names = (path.with_name(f"{path.name} ({number})") for number in count(2))
    return next(name for name in names if not os.path.lexists(name))
