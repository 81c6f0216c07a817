"""Files of unknown origin: reading them, only regular ones and never past a limit; digests."""

from __future__ import annotations

import errno
import hashlib
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Final

from insole_core.errors import InputError, UsageError, unreadable
from insole_core.progress import SILENT, Cancelled, Progress
from insole_core.regular_file import blocks_of, open_regular, read_regular

_TWICE: Final = "{path} is named twice; name each session once."


def check_once(paths: Sequence[Path], sentence: str = _TWICE) -> None:
    """Check that nothing is named twice, under whatever name.

    Parameters
    ----------
    sentence
        On the ``{path}`` that is.

    Raises
    ------
    UsageError
    """
    before: set[Path] = set()
    for path in paths:
        place = path.resolve()
        if place in before:
            raise UsageError(sentence, path=path)
        before.add(place)


def read_given(path: Path, most_bytes: int) -> bytes:
    """Read a file that somebody named.

    Parameters
    ----------
    most_bytes
        No file of this kind is larger.

    Raises
    ------
    InputError
        When it is no regular file, cannot be read, or is larger.
    """
    with given_errors(path, most_bytes):
        return read_regular(path, most_bytes)


@contextmanager
def given_errors(path: Path, most_bytes: int) -> Iterator[None]:
    """Turn errors of reading a file that somebody named into one sentence.

    Parameters
    ----------
    most_bytes
        No file of this kind is larger.

    Raises
    ------
    InputError
    """
    try:
        yield
    except (OSError, ValueError) as error:  # ValueError: a name that no file can have
        if isinstance(error, OSError) and error.errno == errno.EFBIG:
            raise InputError(
                "{path} is larger than {limit_mb} MB, which no file of its kind is; choose another "
                "file.",
                path=path,
                limit_mb=most_bytes // 2**20,
            ) from error
        raise unreadable(path, error) from error


def sha256_of(path: Path, limit: int = sys.maxsize, progress: Progress = SILENT) -> str:
    """Return the SHA-256 of a regular file, in hexadecimal.

    Parameters
    ----------
    limit
        Most bytes that are read.

    Raises
    ------
    OSError
        When there is none, it cannot be read, or is larger.
    Cancelled
    """
    digest = hashlib.sha256()
    with open_regular(path) as file:
        for block in blocks_of(file, limit):
            digest.update(block)
            if progress.is_cancelled():
                raise Cancelled
    return digest.hexdigest()
