"""Lenient reading of JSON that the product writes for itself: a bad entry costs only a warning.

Files that users or other programs write are read strictly, by `json_object`.
"""

from __future__ import annotations

import json
import logging
import sys
from collections.abc import Callable, Container, Mapping
from pathlib import Path
from typing import Any, Literal, TypeAlias, get_args, get_origin

from insole_core.errors import InputError
from insole_core.messages import Message
from insole_core.regular_file import read_regular

log = logging.getLogger(__name__)

MAX_BYTES = 2**20
"""No file that the window writes for itself is larger."""

Complain: TypeAlias = Callable[[Message], object]


def remembered(
    path: Path,
    kinds: Mapping[str, Any],
    complain: Complain = log.warning,
    *,
    leave: bool = False,
) -> dict[str, Any]:
    """Read the entries of a file that have the right type; it may be missing.

    A file that is damaged, or has entries of wrong types, is renamed, so that it is neither
    overwritten nor read again; what is understood is returned all the same.

    Parameters
    ----------
    kinds
        Type of each entry, such as the type hints of a dataclass: strings, numbers, booleans,
        literals, lists of these, or None. Other entries are ignored.
    complain
        Called with a sentence for the user if something is not understood.
    leave
        Leave the file as it is, whatever is wrong with it.

    Returns
    -------
    dict
        The valid entries.
    """
    keep = _left if leave else rename_unreadable
    try:
        stored = _read(path)
    except FileNotFoundError:
        return {}
    except (OSError, ValueError, RecursionError) as error:
        log.warning("%s cannot be read, defaults are used: %s", path, error)
        complain(
            Message(
                "{path} is damaged or cannot be read, so the defaults are used; the file is kept "
                "as {kept}.",
                path=path,
                kept=keep(path),
            )
        )
        return {}
    known = {key: value for key, value in stored.items() if key in kinds}
    wrong = sorted(key for key, value in known.items() if not _fits(value, kinds[key]))
    if wrong:
        log.warning("%s: not understood: %s", path, {key: stored[key] for key in wrong})
        complain(
            Message(
                "{path}: {entries} cannot be understood, so the defaults are used for them; the "
                "file is kept as {kept}.",
                path=path,
                entries=", ".join(wrong),
                kept=keep(path),
            )
        )
    return {key: value for key, value in known.items() if key not in wrong}


def entries_of_others(path: Path, own: Container[str]) -> dict[str, Any]:
    """Return the entries of a file other than our own, such as those of a newer version.

    Whoever writes the file puts them back. They are empty if the file cannot be read.
    """
    try:
        stored = _read(path)
    except (OSError, ValueError, RecursionError):
        return {}
    return {key: value for key, value in stored.items() if key not in own}


def rename_unreadable(path: Path) -> Path:
    """Rename a file that cannot be used, and return its new path; the old where that fails."""
    return set_aside(path, "broken")


def _left(path: Path) -> Path:
    return path


def set_aside(path: Path, why: str) -> Path:
    """Rename a file so that it is no longer read, and return its new path; the old if that fails.

    A device stays: an administrator may name one, and others use it.

    Parameters
    ----------
    why
        A word that the new name ends with.
    """
    if path.is_char_device() or path.is_block_device():
        return path
    for number in range(1, 1000):
        kept = path.with_name(f"{path.name}.{why}-{number}")
        if kept.exists():
            continue
        try:
            path.rename(kept)
        except OSError as error:
            log.warning("%s cannot be renamed: %s", path, error)
            return path
        return kept
    return path


def keep_unreadable(path: Path, load: Callable[[], object]) -> None:
    """Rename a file that is about to be replaced, if it holds what `load` cannot read."""
    try:
        load()
    except InputError:
        rename_unreadable(path)


def _read(path: Path) -> dict[str, Any]:
    stored = json.loads(read_regular(path, MAX_BYTES))
    if isinstance(stored, dict):
        return stored
    raise ValueError("no JSON object {…}")


def _fits(value: Any, kind: Any) -> bool:
    of = get_args(kind)
    if get_origin(kind) is Literal:
        return value in of
    if get_origin(kind) is list:
        return isinstance(value, list) and all(_fits(one, of[0]) for one in value)
    if of:
        return any(_fits(value, one) for one in of)
    if kind is float:
        return type(value) in (int, float) and abs(value) <= sys.float_info.max
    if kind is str:
        return isinstance(value, str) and _is_text(value)
    return type(value) is kind  # isinstance would accept true as an integer


def _is_text(value: str) -> bool:
    """Return whether a text can be written and shown; JSON can hold halves of characters."""
    try:
        value.encode()
    except UnicodeEncodeError:
        return False
    return "\0" not in value
