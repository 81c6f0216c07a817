"""The bytes of a scan and of the files that belong to it, from a folder or a zip archive."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from insole_core.errors import InputError
from insole_core.given_file import given_errors, read_given
from insole_core.messages import Message
from insole_core.regular_file import open_regular
from insole_core.zip_archive import ZipArchive

MOST_BYTES = 600_000_000


@dataclass(frozen=True, eq=False)
class ScanContent:
    """One file of a scan, read.

    Parameters
    ----------
    path
        For messages.
    suffix
        In small letters, such as ``.obj``.
    content
    beside
        Returns a file that the scan names, such as its texture; takes its name and a limit in
        bytes, and returns None where there is none in the same folder.
    """

    path: Path
    suffix: str
    content: bytes
    beside: Callable[[str, int], bytes | None]


def file_content(path: Path) -> ScanContent:
    """Read a scan from a file.

    Raises
    ------
    InputError
        When it cannot be read, or is too large.
    """

    def beside(name: str, most_bytes: int) -> bytes | None:
        relative = _inner_name(name)
        if relative is None:
            return None
        wanted = path.parent / relative
        try:
            is_inside = wanted.resolve().is_relative_to(path.parent.resolve())
            if not (is_inside and wanted.is_file()):
                return None
        except (OSError, ValueError):
            return None
        return read_given(wanted, most_bytes)

    with given_errors(path, MOST_BYTES):
        size = path.stat().st_size
    if size > MOST_BYTES:
        raise InputError(
            "{path} is too large for a foot (more than {most_mb} MB); reduce it in the program "
            "that made it.",
            path=path,
            most_mb=MOST_BYTES // 1_000_000,
        )
    with given_errors(path, MOST_BYTES), open_regular(path) as file:
        content = file.read(MOST_BYTES)  # at once: blocks that are joined take twice the memory
    return ScanContent(path, path.suffix.lower(), content, beside)


def archive_content(path: Path, archive: ZipArchive, name: str) -> ScanContent:
    """Read a scan from an archive.

    Raises
    ------
    InputError
        When it is damaged, or too large.
    """
    folder = PurePosixPath(name).parent

    def beside(other: str, most_bytes: int) -> bytes | None:
        relative = _inner_name(other)
        if relative is None:
            return None
        for wanted in (str(folder / relative), PurePosixPath(relative).name):
            if wanted in archive.names:
                return archive.read(wanted, most_bytes)
        return None

    content = archive.read(name, MOST_BYTES)
    return ScanContent(path / name, PurePosixPath(name).suffix.lower(), content, beside)


def _inner_name(name: str) -> str | None:
    """Return the name as one within the same folder; None if it leads out of it.

    Of an absolute path, as programs for Windows write them, the last part counts.
    """
    parts = PurePosixPath(name.strip().strip('"').replace("\\", "/"))
    if not parts.name or "\0" in name:
        return None
    if parts.is_absolute() or ":" in parts.parts[0]:
        return parts.name
    return None if ".." in parts.parts else str(parts)


def padding_note(count: int) -> Message:
    """Say that zero bytes behind a scan do not count."""
    return Message("{count} zero bytes at the end of the file were left out.", count=count)


def unreadable(source: ScanContent, reason: Message) -> InputError:
    """Return the error of a file that is not what its name says, for the caller to raise."""
    return InputError(
        "{path} is no {format} file that can be read ({reason}); it may be damaged or cut off, so "
        "export it again.",
        path=source.path,
        format=source.suffix[1:].upper(),
        reason=reason,
    )
