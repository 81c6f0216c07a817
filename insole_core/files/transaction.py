"""The results of one command, which take their places together."""

from __future__ import annotations

import errno
import logging
import math
import os
import shutil
import stat
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Self, TypeAlias

from insole_core.errors import InputError, InsoleError, OutputError, UsageError
from insole_core.files.file_safety import sync_tree, take_mode
from insole_core.files.journal import (
    Journal,
    Move,
    settle_interrupted,
)
from insole_core.files.temporary import (
    is_unfinished,
    make_file,
    make_folder,
    named_path,
    release,
    remove,
    replaced_name,
    state_folder_of_user,
    sweep,
)
from insole_core.files.write_errors import FULL, describe, output_errors

log = logging.getLogger(__name__)

FindForeign: TypeAlias = Callable[[Path], str | None]
"""Returns the name of a file in a folder that is no earlier output of the same kind; None if there
is none."""

_OF_WRITING = (*FULL, errno.EFBIG, errno.EROFS)
"""Errors that cannot come from reading."""


def any_file(folder: Path) -> str | None:
    """Return the name of any file: only an empty folder may be replaced."""
    return min(os.listdir(folder), default=None)  # noqa: PTH208 - a generator would stay open


def nothing_foreign(_folder: Path) -> None:
    """Return None: the folder is the product's own, or its files are kept."""


@dataclass(frozen=True)
class _Output:
    """A result on its way: the path that was named, the real one, and the one to write to."""

    named: Path
    path: Path
    beside: Path
    find_foreign: FindForeign | None
    """None for a file."""

    def prepare(self) -> None:
        """Check the place once more, as hours may have passed, and complete what takes it."""
        if self.find_foreign is None:
            check_file(self.named)
        else:
            check_folder(self.named, self.find_foreign)
        take_mode(self.beside, self.path)
        sync_tree(self.beside)

    def move(self) -> Move:
        """Return the move to the final place."""
        old = self.path.with_name(replaced_name())
        modified_ns = self.beside.lstat().st_mtime_ns
        return Move(self.beside, self.path, old, os.path.lexists(self.path), modified_ns)


class Transaction:
    """Results that take their places together, or not at all.

    A context that makes every result durable and puts it in its place at the end; after an error
    it removes what was written. Whatever was there before is untouched until all are complete.
    """

    def __init__(self) -> None:
        self._outputs: list[_Output] = []
        self._journal = Journal([])

    def file(self, path: Path) -> Path:
        """Return a path beside `path` to write to.

        Raises
        ------
        OutputError
            When the place cannot be written (no such folder, no permission, no space).
        UsageError
            When another result has the same path.
        """
        return self._open(path, None)

    def folder(self, path: Path, find_foreign: FindForeign = any_file) -> Path:
        """Return a folder beside `path` to write into.

        Parameters
        ----------
        find_foreign
            Tells an earlier output of the same kind, which may be replaced, from any other folder.

        Raises
        ------
        OutputError
            When the place cannot be written, or holds other files.
        UsageError
            When another result has the same path.
        """
        return self._open(path, find_foreign)

    def _open(self, named: Path, find_foreign: FindForeign | None) -> Path:
        path = Path(os.path.realpath(named))
        if any(_is_same(path, other.path) for other in self._outputs):
            raise UsageError(
                "{path} is named for two results; give each of them a name of its own.", path=named
            )
        if find_foreign is None:
            check_file(named)
        else:
            check_folder(named, find_foreign)
        with output_errors(named):
            make = make_file if find_foreign is None else make_folder
            beside = make(path.parent, named)
        self._outputs.append(_Output(named, path, beside, find_foreign))
        sweep(path.parent, settle_interrupted(state_folder_of_user()))
        return beside

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        _kind: type[BaseException] | None,
        error: BaseException | None,
        _trace: TracebackType | None,
    ) -> None:
        try:
            if error is None:
                self._publish()
            elif isinstance(error, OSError) and (explained := self._explained(error)) is not None:
                raise explained from error
        finally:
            self._clean_up()

    def _clean_up(self) -> None:
        """Remove the temporary files, unless the next start needs them to settle the journal.

        What cannot be removed now is swept later: that is no error of the results.
        """
        with ExitStack() as steps:  # each is taken, also if one of them is interrupted
            steps.callback(self._journal.release)
            for output in self._outputs:
                steps.callback(release, output.beside)
                if not self._journal.is_open:
                    steps.callback(_try_to_remove, output.beside)

    def _publish(self) -> None:
        try:
            for output in self._outputs:
                output.prepare()
            moves = [output.move() for output in self._outputs]
            if len(moves) == 1 and (not moves[0].replaces or moves[0].beside.is_file()):
                moves[0].make_at_once()
            elif moves:
                self._journal = Journal(moves)
                self._journal.make_moves()
        except OSError as error:
            raise OutputError(describe(self._place_of(error), error)) from error

    def _explained(self, error: OSError) -> InsoleError | None:
        """Return the sentence about an error of the work; None if it says nothing of a file."""
        paths = _paths_of(error)
        written = next(filter(is_unfinished, paths), None)
        if written is None and self._outputs and error.errno in _OF_WRITING:
            written = self._fullest().named
        if written is not None:
            return OutputError(describe(written, error))
        if not paths:
            return None
        return InputError(
            "{path} cannot be read ({reason}); check that it is there and that you may read it.",
            path=paths[0],
            reason=error.strerror or str(error),
        )

    def _place_of(self, error: OSError) -> Path:
        """Return what the user calls the result that could not take its place."""
        taken = {output.path: output.named for output in self._outputs}
        named = (taken.get(path, named_path(path)) for path in _paths_of(error))
        return next(named, self._outputs[0].named)

    def _fullest(self) -> _Output:
        """Return the result on the disk with the least room."""
        return min(self._outputs, key=lambda output: _room(output.path.parent))


def _room(folder: Path) -> float:
    """Return the free bytes on the disk of a folder; many for one that is gone meanwhile."""
    try:
        return shutil.disk_usage(folder).free
    except OSError:
        return math.inf


def _try_to_remove(path: Path) -> None:
    try:
        remove(path)
    except OSError as error:
        log.warning("%s cannot be removed yet: %s", path, error)


def _paths_of(error: OSError) -> list[Path]:
    names = (error.filename, error.filename2)
    return [Path(os.fsdecode(name)) for name in names if name is not None]


def check_file(path: Path) -> None:
    """Check that a file may be made at a place, or that the one there may be replaced.

    Raises
    ------
    OutputError
        Also where writing to the file would fail although renaming another over it might succeed,
        and where the place is a link: what it leads to may be anybody's.
    """
    with output_errors(path):
        _check_no_link(path)
        real = Path(os.path.realpath(path))
        _check_parent(real)
        if real.is_dir():
            raise _os_error(errno.EISDIR)
        if real.is_file():
            os.close(os.open(real, os.O_WRONLY))
        elif real.exists():
            raise _os_error(errno.ENXIO)


def check_folder(path: Path, find_foreign: FindForeign) -> None:
    """Check that a folder may be made at a place, or that the one there may be replaced.

    Raises
    ------
    OutputError
        When it holds other files than an earlier output, when somebody works in it, or when the
        place takes no folder or is a link.
    """
    with output_errors(path):
        _check_no_link(path)
        real = Path(os.path.realpath(path))
        _check_parent(real)
        if real.exists() and not real.is_dir():
            raise _os_error(errno.ENOTDIR)
        foreign = find_foreign(real) if real.exists() else None
    if _is_worked_in(real):
        raise OutputError(
            "{path} is the folder that you work in, or holds it; name a folder within it.",
            path=path,
        )
    if foreign is not None:
        raise OutputError(
            "{path} is not replaced: it holds {name}, which is not part of an earlier result; "
            "choose a new or an empty folder.",
            path=path,
            name=foreign,
        )


def _check_no_link(path: Path) -> None:
    """Check that a place is itself, and not the name of another; links on the way to it may be."""
    if path.is_symlink():
        raise OutputError(
            "{path} is a link to {target}, which is not replaced through it; give the result "
            "another name, or name {target} itself.",
            path=path,
            target=Path(os.path.realpath(path)),
        )


def _is_worked_in(folder: Path) -> bool:
    try:
        return Path.cwd().is_relative_to(folder)
    except FileNotFoundError:  # the working folder is gone
        return False


def _check_parent(path: Path) -> None:
    if not stat.S_ISDIR(path.parent.stat().st_mode):
        raise _os_error(errno.ENOTDIR)


def _os_error(number: int) -> OSError:
    return OSError(number, os.strerror(number))


def _is_same(path: Path, other: Path) -> bool:
    """Tell whether two paths are one file, also on a disk that does not heed capitals."""
    if str(path).casefold() == str(other).casefold():
        return True
    return path.exists() and other.exists() and path.samefile(other)
