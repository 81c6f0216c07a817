"""Access to the files of a session, in a folder or a zip archive."""

from __future__ import annotations

import errno
from functools import cached_property
from itertools import chain
from pathlib import Path, PurePosixPath
from typing import Protocol

from insole_core.errors import InputError
from insole_core.messages import Message
from insole_core.regular_file import read_regular
from insole_core.zip_archive import ZipArchive

MAX_FILE_BYTES = 64 * 2**20
"""No file of a session is larger: a 1280×1024 colour image has 4 MB before compression."""

MAX_ARCHIVE_BYTES = 8 * 2**30
MAX_ARCHIVE_FILES = 100_000
_OF_A_MAC = "__MACOSX/"
"""Holds what macOS knows about the files, beside them."""


class Store(Protocol):
    """Read access to named files."""

    def names(self) -> list[str]:
        """Return the names of all files, with forward slashes."""
        ...

    def place(self, name: str) -> str:
        """Return the name of a file for messages, which says in which session it is."""
        ...

    def read(self, name: str) -> bytes:
        """Return the content of a file.

        Raises
        ------
        InputError
            When it cannot be read, or is larger than any file of a session.
        """
        ...


class FolderStore:
    """The files in a folder and below its ``views``."""

    def __init__(self, root: Path) -> None:
        self._root = root

    def names(self) -> list[str]:
        """Return the names of all files, with forward slashes; they are listed once."""
        return self._names

    @cached_property
    def _names(self) -> list[str]:
        # Not all below the folder: somebody may name one that holds a whole disk.
        paths = chain(self._root.glob("*"), (self._root / "views").rglob("*"))
        return sorted(p.relative_to(self._root).as_posix() for p in paths if p.is_file())

    def place(self, name: str) -> str:
        """Return the path of a file."""
        return str(self._root / name)

    def read(self, name: str) -> bytes:
        """Return the content of a file.

        Raises
        ------
        InputError
            When it cannot be read, or is larger than any file of a session.
        """
        path = self._root / name
        try:
            return read_regular(path, MAX_FILE_BYTES)
        except OSError as error:
            if error.errno == errno.EFBIG:
                raise InputError(_too_large(self.place(name))) from error
            raise InputError(
                "{name} cannot be read ({reason}); check the disk and the permissions.",
                name=self.place(name),
                reason=str(error.strerror),
            ) from error


class ZipStore:
    """The files of a zip archive, below the folder that holds the manifest.

    Raises
    ------
    InputError
        When the archive cannot be read, has paths that lead out of it, or is far too large.
    """

    def __init__(self, archive: Path) -> None:
        self._archive = ZipArchive(str(archive), archive)
        _check_entries(self._archive)
        names = [name for name in self._archive.names if not name.startswith(_OF_A_MAC)]
        self._prefix = _prefix(names)
        self._names = sorted(
            name.removeprefix(self._prefix) for name in names if name.startswith(self._prefix)
        )

    def names(self) -> list[str]:
        """Return the names of all files, with forward slashes."""
        return self._names

    def place(self, name: str) -> str:
        """Return the name of the archive, and of the file in it."""
        return f"{self._archive.name}: {name}"

    def read(self, name: str) -> bytes:
        """Return the content of a file.

        Raises
        ------
        InputError
            When it cannot be read, or is larger than any file of a session.
        """
        return self._archive.read(self._prefix + name, MAX_FILE_BYTES)


def _too_large(name: str) -> str:
    return Message(
        "{file} is larger than {limit_mb} MB, which no file of a session is; check what "
        "was put there.",
        file=name,
        limit_mb=MAX_FILE_BYTES // 2**20,
    )


def _check_entries(archive: ZipArchive) -> None:
    if archive.stated_bytes > MAX_ARCHIVE_BYTES or len(archive.names) > MAX_ARCHIVE_FILES:
        raise InputError(
            "{archive} would unpack to {size_gb:.1f} GB in {files} files, far more than a session "
            "has; do not use this file.",
            archive=archive.name,
            size_gb=archive.stated_bytes / 2**30,
            files=len(archive.names),
        )
    for name in archive.names:
        path = PurePosixPath(name)
        if path.is_absolute() or ".." in path.parts or ":" in name:
            raise InputError(
                '{archive} holds the path "{file}", which leads out of the archive; do not use '
                "this file.",
                archive=archive.name,
                file=name,
            )


def _prefix(names: list[str]) -> str:
    """Return the only top folder, with a slash, where it holds the manifest; otherwise ""."""
    if "manifest.json" in names:
        return ""
    tops = {name.split("/", 1)[0] for name in names if "/" in name}
    top = next(iter(tops)) if len(tops) == 1 else ""
    return f"{top}/" if f"{top}/manifest.json" in names else ""
