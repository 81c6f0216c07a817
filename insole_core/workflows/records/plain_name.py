"""Names of files and folders that every system takes as they are."""

from __future__ import annotations

import re
from itertools import chain, count
from pathlib import Path, PurePosixPath
from typing import Final

_PLAIN: Final = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.+-]{0,99}")


def plain_name(name: str, otherwise: str) -> str:
    """Return a name if it can be that of a file everywhere; what people typed becomes no path.

    Parameters
    ----------
    otherwise
        Is returned in its place, with the suffix of the name.
    """
    if _PLAIN.fullmatch(name) and not name.endswith("."):
        return name
    suffix = PurePosixPath(name).suffix
    return f"{otherwise}{suffix}" if _PLAIN.fullmatch(suffix[1:]) else otherwise


def free_folder(parent: Path, name: str, otherwise: str) -> Path:
    """Return a folder that is not there yet, named by `plain_name`, and numbered if need be."""
    plain = plain_name(name, otherwise)
    names = chain((plain,), (f"{plain}-{number}" for number in count(2)))
    return next(parent / name for name in names if not (parent / name).exists())
