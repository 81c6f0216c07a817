"""Parsing of JSON of unknown origin: bounded, each key once, no text that cannot be written."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable
from typing import Any

from insole_core.errors import InputError

MOST_BYTES = 16 * 2**20
"""A case with a hundred variants has 1 MB."""


def load_strictly(text: bytes, parse_constant: Callable[[str], Any] | None = None) -> Any:
    """Return the values of a JSON text.

    Parameters
    ----------
    parse_constant
        As for `json.loads`: takes NaN and the infinities, which are no JSON.

    Raises
    ------
    ValueError, RecursionError
        When it is no JSON.
    InputError
        When it is far too long, a key stands twice in one object, or a text holds half a character.
    """
    if len(text) > MOST_BYTES:
        raise InputError(
            "it is longer than {limit_mb} MB; check what was put there.",
            limit_mb=MOST_BYTES // 2**20,
        )
    values = json.loads(text, object_pairs_hook=_without_doubles, parse_constant=parse_constant)
    if b"\\u" in text:
        _check_characters(values)
    return values


def _without_doubles(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    content = dict(pairs)
    if len(content) < len(pairs):
        counts = Counter(key for key, _ in pairs)
        twice = next(key for key, count in counts.items() if count > 1)
        raise InputError('the key "{twice}" stands twice in one object; keep one.', twice=twice)
    return content


def _check_characters(values: Any) -> None:
    """Refuse an escaped half of a surrogate pair, which no file or paper could hold."""
    try:
        json.dumps(values, ensure_ascii=False).encode()
    except UnicodeEncodeError as error:
        raise InputError(
            "a text in it holds half a character (\\{half}); write it again.",
            half=f"u{ord(error.object[error.start]):04x}",
        ) from error
