"""The SHA-256 of a file, by which it is recognised."""

from __future__ import annotations

import hashlib
import sys
from pathlib import Path

from insole_core.progress import SILENT, Cancelled, Progress
from insole_core.regular_file import blocks_of, open_regular


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
