"""Atomic output: write beside the destination, then rename.

What is written concerns a patient: only its owner may read it, from the first byte on. Whoever
shares a file or a folder with others sets its mode once; replacing it keeps the mode.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from insole_core.errors import OutputError
from insole_core.files.file_safety import PRIVATE_FILE, PRIVATE_FOLDER
from insole_core.files.temporary import is_temporary, is_unfinished, make_folder, release, remove
from insole_core.files.transaction import FindForeign, Transaction, any_file
from insole_core.files.write_errors import describe, output_errors
from insole_core.regular_file import open_regular

__all__ = [
    "PRIVATE_FILE",
    "PRIVATE_FOLDER",
    "copy_into",
    "make_output_folder",
    "make_private_folder",
    "replacing_file",
    "replacing_folder",
    "scratch_folder",
    "write_private",
    "write_text",
]


@contextmanager
def replacing_file(path: Path) -> Iterator[Path]:
    """Yield a path beside `path` to write to; on success it replaces `path`.

    A file that a `Transaction` has opened, or that lies in a folder of one, is written directly.

    Raises
    ------
    OutputError
        When the place cannot be written (no such folder, no permission, no space). Whatever was
        there before is untouched, and no temporary file remains.
    """
    if is_unfinished(path):
        with _blamed_on(path):
            yield path
        return
    with Transaction() as transaction:
        beside = transaction.file(path)
        with _blamed_on(path):
            yield beside


@contextmanager
def replacing_folder(path: Path, find_foreign: FindForeign = any_file) -> Iterator[Path]:
    """Do the same as `replacing_file` for a folder with everything in it.

    Parameters
    ----------
    find_foreign
        Tells an earlier output of the same kind, which may be replaced, from any other folder.
    """
    with Transaction() as transaction:
        beside = transaction.folder(path, find_foreign)
        with _blamed_on(path):
            yield beside


def copy_into(folder: Path, source: Path) -> None:
    """Copy all that a folder holds into an unfinished one, but for what a killed program left.

    Raises
    ------
    OSError
        The first one; `shutil.copytree` would go on and forget which it was.
    """
    for place, folders, files in os.walk(source):
        folders[:] = [name for name in folders if not is_temporary(name)]
        within = folder / Path(place).relative_to(source)
        for name in folders:
            (within / name).mkdir(exist_ok=True)
        for name in files:
            if not is_temporary(name):
                _copy(Path(place, name), within / name)


def _copy(path: Path, target: Path) -> None:
    """Copy a file; a pipe or a device in its place has no end."""
    try:
        source = open_regular(path)
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from error
    with source, target.open("wb") as written:
        shutil.copyfileobj(source, written)


@contextmanager
def scratch_folder(path: Path) -> Iterator[Path]:
    """Yield an empty folder beside the file `path` for its parts; it is removed at the end."""
    with output_errors(path):
        folder = make_folder(path.parent, path)
    try:
        with _blamed_on(path):
            yield folder
    finally:
        remove(folder)
        release(folder)


def write_text(text: str, path: Path) -> None:
    """Write a text as UTF-8, atomically, its lines ended as they are on every system.

    Raises
    ------
    OutputError
        When the place cannot be written; a file that was there before is untouched.
    """
    with replacing_file(path) as beside:
        beside.write_text(text, encoding="utf-8", newline="\n")


def make_private_folder(path: Path) -> None:
    """Make a folder, and those above it that are missing, for its owner only.

    Raises
    ------
    OSError
        When it cannot be made. A folder that is there stays as it is.
    """
    if not path.is_dir():
        make_private_folder(path.parent)
        path.mkdir(mode=PRIVATE_FOLDER, exist_ok=True)


def make_output_folder(path: Path) -> None:
    """Do the same as `make_private_folder` for results of the user.

    Raises
    ------
    OutputError
        When it cannot be made.
    """
    with output_errors(path):
        make_private_folder(path)


def write_private(path: Path, content: bytes) -> None:
    """Write a file into an unfinished folder, for its owner only.

    Raises
    ------
    OSError
        When it cannot be written.
    """
    with open(path, "wb", opener=_private) as file:
        file.write(content)


def _private(path: str, flags: int) -> int:
    return os.open(path, flags, PRIVATE_FILE)


@contextmanager
def _blamed_on(path: Path) -> Iterator[None]:
    """Take errors without a file name for those of writing `path`."""
    try:
        yield
    except OSError as error:
        if error.filename is not None or error.errno is None:
            raise
        raise OutputError(describe(path, error)) from error
