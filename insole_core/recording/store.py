"""Access to the files of a session, in a folder or a zip archive."""

from __future__ import annotations

import errno
import zipfile
import zlib
from pathlib import Path, PurePosixPath
from typing import Protocol

from insole_core.errors import InputError
from insole_core.messages import Message
from insole_core.regular_file import open_regular, read_regular

MAX_FILE_BYTES = 64 * 2**20
"""No file of a session is larger: a 1280×1024 colour image has 4 MB before compression."""

MAX_ARCHIVE_BYTES = 8 * 2**30
MAX_ARCHIVE_FILES = 100_000


class Store(Protocol):
    """Read access to named files."""

    def names(self) -> list[str]:
        """Return the names of all files, with forward slashes."""
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
    """The files below a folder."""

    def __init__(self, root: Path) -> None:
        self._root = root

    def names(self) -> list[str]:
        """Return the names of all files, with forward slashes."""
        paths = self._root.rglob("*")
        return sorted(p.relative_to(self._root).as_posix() for p in paths if p.is_file())

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
                raise InputError(_too_large(name)) from error
            raise InputError(
                "{name} cannot be read ({reason}); check the disk and the permissions.",
                name=name,
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
        self._archive = archive
        try:
            with open_regular(archive) as file, zipfile.ZipFile(file) as opened:
                entries = [entry for entry in opened.infolist() if not entry.is_dir()]
        except (zipfile.BadZipFile, OSError, NotImplementedError) as error:
            raise InputError(
                "{archive} is not a readable zip archive; copy it again from its source.",
                archive=archive,
            ) from error
        _check_entries(archive, entries)
        self._prefix = _prefix([entry.filename for entry in entries])
        self._names = sorted(
            entry.filename.removeprefix(self._prefix)
            for entry in entries
            if entry.filename.startswith(self._prefix)
        )

    def names(self) -> list[str]:
        """Return the names of all files, with forward slashes."""
        return self._names

    def read(self, name: str) -> bytes:
        """Return the content of a file.

        Raises
        ------
        InputError
            When it cannot be read, or is larger than any file of a session.
        """
        try:
            # The sizes that the archive states are not trusted: never inflate past the limit.
            with (
                open_regular(self._archive) as packed,
                zipfile.ZipFile(packed) as opened,
                opened.open(self._prefix + name) as file,
            ):
                content = file.read(MAX_FILE_BYTES + 1)
        except (zipfile.BadZipFile, OSError, EOFError, RuntimeError, zlib.error) as error:
            raise InputError(
                "{file} inside {archive} is damaged; copy the archive again from its source.",
                file=name,
                archive=self._archive,
            ) from error
        if len(content) > MAX_FILE_BYTES:
            raise InputError(_too_large(name))
        return content


def _too_large(name: str) -> str:
    return Message(
        "{file} is larger than {limit_mb} MB, which no file of a session is; check what "
        "was put there.",
        file=name,
        limit_mb=MAX_FILE_BYTES // 2**20,
    )


def _check_entries(archive: Path, entries: list[zipfile.ZipInfo]) -> None:
    for entry in entries:
        path = PurePosixPath(entry.filename.replace("\\", "/"))
        if path.is_absolute() or ".." in path.parts or ":" in entry.filename:
            raise InputError(
                '{archive} holds the path "{file}", which leads out of the archive; do not use '
                "this file.",
                archive=archive,
                file=entry.filename,
            )
    total = sum(entry.file_size for entry in entries)
    if total > MAX_ARCHIVE_BYTES or len(entries) > MAX_ARCHIVE_FILES:
        raise InputError(
            "{archive} would unpack to {size_gb:.1f} GB in {files} files, far more than a session "
            "has; do not use this file.",
            archive=archive,
            size_gb=total / 2**30,
            files=len(entries),
        )


def _prefix(names: list[str]) -> str:
    """Return the only top folder, with a slash, where it holds the manifest; otherwise ""."""
    if "manifest.json" in names:
        return ""
    tops = {name.split("/", 1)[0] for name in names if "/" in name}
    top = next(iter(tops)) if len(tops) == 1 else ""
    return f"{top}/" if f"{top}/manifest.json" in names else ""
