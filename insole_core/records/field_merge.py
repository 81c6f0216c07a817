"""Fields that two stations have changed: what differs is put together, what collides is asked."""

from __future__ import annotations

import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import replace
from enum import Enum, auto
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

    Value = TypeVar("Value", bound=DataclassInstance)


def merge_fields(
    before: Value, mine: Value, theirs: Value, names: Sequence[str]
) -> tuple[Value, tuple[str, ...]]:
    """Return theirs with what was changed in mine alone, and the fields that both have changed.

    Parameters
    ----------
    before
        What both changes are based on.
    names
        Of the fields to merge; all others are theirs.

    Returns
    -------
    tuple
        In a field that both have changed to different values, the first holds theirs.
    """
    changed = [n for n in names if not _are_equal(getattr(mine, n), getattr(before, n))]
    collided = tuple(
        name
        for name in changed
        if not _are_equal(getattr(theirs, name), getattr(before, name))
        and not _are_equal(getattr(theirs, name), getattr(mine, name))
    )
    taken = {name: getattr(mine, name) for name in changed if name not in collided}
    return replace(theirs, **taken), collided


class FieldChoice(Enum):
    """Which value of a field counts that two stations have changed."""

    MINE = auto()
    THEIRS = auto()
    BOTH = auto()
    """Theirs, and mine below it: for a text of several lines."""


def settle_fields(theirs: Value, mine: Value, choices: Mapping[str, FieldChoice]) -> Value:
    """Return theirs with the chosen value of each field."""
    chosen: dict[str, Any] = {}
    for name, choice in choices.items():
        if choice is FieldChoice.MINE:
            chosen[name] = getattr(mine, name)
        elif choice is FieldChoice.BOTH:
            chosen[name] = f"{getattr(theirs, name)}\n{getattr(mine, name)}"
    return replace(theirs, **chosen)


def _are_equal(one: object, other: object) -> bool:
    """Return whether two values are stored as the same one."""
    if isinstance(one, str) and isinstance(other, str):
        return _as_stored(one) == _as_stored(other)
    return one == other


def _as_stored(text: str) -> str:
    return unicodedata.normalize("NFC", text.replace("\r\n", "\n").replace("\r", "\n")).strip()
