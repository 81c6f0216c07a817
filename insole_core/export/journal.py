"""Results that take their places together, also when the process is killed in between.

A journal lists the moves before the first one is made. Whoever finds the journal of a process that
no longer runs makes the moves that are missing, or, where that is impossible, takes all of them
back.
"""

from __future__ import annotations

import errno
import json
import logging
import os
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import platformdirs

from insole_core.export.file_mode import PRIVATE_FOLDER
from insole_core.export.sync import sync
from insole_core.export.temporary import is_left, make_file, release, remove, temporary_name

log = logging.getLogger(__name__)

SUFFIX = ".journal"


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
    """

    beside: Path
    path: Path
    old: Path
    replaces: bool

    def make(self) -> None:
        """Put the result in its place; a move that is made already stays so.

        Raises
        ------
        OSError
            When the place cannot be taken.
        """
        if not os.path.lexists(self.beside) and os.path.lexists(self.path):
            if os.path.lexists(self.old) and self._is_old():  # the result is lost
                raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(self.beside))
            return
        if self.replaces and not os.path.lexists(self.old):
            _set_aside(self.path, self.old)
        if os.path.lexists(self.path) and not self._is_old():
            raise FileExistsError(errno.EEXIST, os.strerror(errno.EEXIST), str(self.path))
        self.beside.replace(self.path)

    def _is_old(self) -> bool:
        """Return whether the place still holds what is to be replaced, and nothing newer."""
        return self.replaces and self.path.samefile(self.old)

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
        """Put back what was replaced."""
        if self.replaces and not os.path.lexists(self.old):
            return
        if not os.path.lexists(self.beside) and os.path.lexists(self.path):
            self.path.replace(self.beside)
        if self.replaces and os.path.lexists(self.path):
            self.old.unlink()  # a second name of the file that is still there
        elif self.replaces:
            self.old.replace(self.path)


class NotTakenBack(OSError):  # noqa: N818 - the error it comes from is what is said
    """The moves were neither all made nor all taken back; their journal stays."""


def journals_folder_of_user() -> Path:
    """Return the folder for the journals of this user."""
    return platformdirs.user_state_path("insole-studio", appauthor=False)


def make_moves(moves: Sequence[Move]) -> None:
    """Make all moves or none, also if the process is killed: the next start settles it.

    Raises
    ------
    OSError
        When a place cannot be taken; every place is as it was before.
    """
    journal = _written(moves)
    try:
        _make_all(moves)
    except NotTakenBack:
        if journal is not None:
            release(journal)
        raise
    except BaseException:
        _forget(journal)
        raise
    _drop_old(moves, journal)


def settle_interrupted(folder: Path) -> None:
    """Settle the journals in a folder that were left by processes that no longer run.

    A journal stays while the disk of one of its results is absent.
    """
    for left in _paths_in(folder):
        try:
            if is_left(left.name) and left.suffix == SUFFIX:
                _settle(left)
            elif is_left(left.name):
                left.unlink()  # written by half: no move was made
        except (OSError, ValueError, LookupError, TypeError) as error:
            log.warning("%s cannot be settled: %s", left, error)


def _paths_in(folder: Path) -> list[Path]:
    try:
        return list(folder.iterdir())
    except FileNotFoundError:
        return []
    except OSError as error:  # this user works without journals
        log.warning("%s cannot be looked into: %s", folder, error)
        return []


def _settle(left: Path) -> None:
    journal = left.with_name(temporary_name(left, SUFFIX))
    try:
        left.replace(journal)  # of several processes that try, one succeeds
        moves = [
            Move(
                Path(values["beside"]),
                Path(values["path"]),
                Path(values["old"]),
                values["replaces"],
            )
            for values in json.loads(journal.read_text(encoding="utf-8"))
        ]
        if all(move.path.parent.is_dir() for move in moves):
            _settle_moves(moves, journal)
    finally:
        release(journal)


def _settle_moves(moves: Sequence[Move], journal: Path) -> None:
    try:
        _make_all(moves)
    except NotTakenBack:
        raise
    except OSError as error:
        log.warning("An interrupted export was taken back: %s", error)
        _forget(journal)
    else:
        _drop_old(moves, journal)


def _make_all(moves: Sequence[Move]) -> None:
    try:
        for move in moves:
            move.make()
        _sync_folders(moves)
    except BaseException:
        _take_back(moves)
        raise


def _take_back(moves: Sequence[Move]) -> None:
    try:
        for move in reversed(moves):
            move.take_back()
        _sync_folders(moves)
    except OSError as error:
        raise NotTakenBack(
            error.errno, error.strerror, error.filename, None, error.filename2
        ) from error


def _drop_old(moves: Sequence[Move], journal: Path | None) -> None:
    """Remove what was replaced; what resists now is removed at the next start."""
    try:
        for move in moves:
            remove(move.old)
    except OSError as error:
        log.info("What was replaced is removed later: %s", error)
    else:
        _forget(journal)


def _forget(journal: Path | None) -> None:
    if journal is not None:
        journal.unlink()
        release(journal)


def _sync_folders(moves: Sequence[Move]) -> None:
    for folder in {move.path.parent for move in moves}:
        sync(folder)


def _set_aside(path: Path, old: Path) -> None:
    try:
        os.link(path, old)  # so that the place is never empty
    except OSError:  # a folder, or a disk whose files have one name each
        path.rename(old)


def _written(moves: Sequence[Move]) -> Path | None:
    """Write the journal where every start looks; None where this user has no such place."""
    text = json.dumps([asdict(move) for move in moves], default=str)
    folder = journals_folder_of_user()
    try:
        folder.mkdir(mode=PRIVATE_FOLDER, parents=True, exist_ok=True)
        return _written_in(folder, text)
    except OSError as error:
        log.warning("Without a journal, a kill may leave some of the results: %s", error)
        return None


def _written_in(folder: Path, text: str) -> Path:
    unfinished = make_file(folder, folder)
    try:
        unfinished.write_text(text, encoding="utf-8")
        sync(unfinished)
        journal = unfinished.replace(folder / temporary_name(folder, SUFFIX))
        sync(folder)
    finally:
        unfinished.unlink(missing_ok=True)
        release(unfinished)
    return journal
