"""Reading files of unknown origin: only regular files, and never past a limit."""

from __future__ import annotations

from pathlib import Path

from insole_core.errors import InputError


def read_given(path: Path, most_bytes: int) -> bytes:
    """Read a file that somebody named.

    A pipe or a device would wait or go on for ever, so nothing but a regular file is opened.

    Parameters
    ----------
    most_bytes
        No file of this kind is larger.

    Raises
    ------
    InputError
        When it is no regular file, cannot be read, or is larger.
    """
    try:
        if path.exists() and not path.is_file():
            raise InputError("{path} is no file; choose a file.", path=path)
        with path.open("rb") as file:
            content = file.read(most_bytes + 1)
    except (OSError, ValueError) as error:  # ValueError: a name that no file can have
        raise InputError(
            "{path} cannot be read: {reason}; check the name of the file.",
            path=path,
            reason=str(getattr(error, "strerror", error)),
        ) from error
    if len(content) > most_bytes:
        raise InputError(
            "{path} is larger than {limit_mb} MB, which no file of its kind is; choose another "
            "file.",
            path=path,
            limit_mb=most_bytes // 2**20,
        )
    return content
