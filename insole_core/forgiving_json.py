"""Lenient reading of JSON that the product writes for itself: a bad entry costs only a warning.

Files that users or other programs write are read strictly, by `json_object`.
"""

from __future__ import annotations

import json
import logging
import sys
from pathlib import Path
from typing import Any, Literal, get_args, get_origin, get_type_hints

from insole_core.regular_file import read_regular

log = logging.getLogger(__name__)


def read_remembered(path: Path) -> dict[str, Any]:
    """Read the entries of a file that the window wrote; empty where it is missing or damaged."""
    try:
        stored = json.loads(read_regular(path))
    except FileNotFoundError:
        return {}
    except (OSError, ValueError, RecursionError) as error:
        log.warning("%s cannot be read, defaults are used: %s", path, error)
        return {}
    if isinstance(stored, dict):
        return stored
    log.warning("%s holds no JSON object {…}, defaults are used", path)
    return {}


def understood(stored: dict[str, Any], kind: type[Any], path: Path) -> dict[str, Any]:
    """Keep the entries that match a field of a dataclass; log a warning for each of a wrong type.

    Parameters
    ----------
    stored
        Entries of a file.
    kind
        The dataclass. Its fields may be strings, numbers, booleans, literals, lists of these, or
        None.
    path
        Of the file, for the warning.

    Returns
    -------
    dict
        Keyword arguments for `kind`; fields without a valid entry are absent.
    """
    hints = get_type_hints(kind)
    known = {key: value for key, value in stored.items() if key in hints}
    for key in [key for key, value in known.items() if not _fits(value, hints[key])]:
        log.warning("%s: %s is not understood: %r", path, key, known.pop(key))
    return known


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
    return type(value) is kind  # isinstance would accept true as an integer
