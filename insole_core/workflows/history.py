"""Undo and redo: a list of values with the sentences that lead from one to the next."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, TypeVar

Value = TypeVar("Value")


@dataclass(frozen=True)
class Change(Generic[Value]):
    """One step: the value before, the value after, and what was done."""

    before: Value
    after: Value
    sentence: str
    merge_key: str


class History(Generic[Value]):
    """What can be undone and redone. Values are immutable, so a step only swaps them."""

    def __init__(self) -> None:
        self._undone: list[Change[Value]] = []
        self._done: list[Change[Value]] = []
        self._open_key = ""

    def push(self, before: Value, after: Value, sentence: str, merge_key: str = "") -> None:
        """Record a step.

        A step that follows one of the same (non-empty) `merge_key` becomes part of it, so that
        ten clicks on a spin box are one undo.
        """
        self._undone.clear()
        if merge_key and merge_key == self._open_key:
            before = self._done.pop().before
        self._open_key = merge_key
        self._done.append(Change(before, after, sentence, merge_key))

    def undo(self) -> Value | None:
        """Step back and give the value from before; None when there is nothing to undo."""
        self._open_key = ""
        if not self._done:
            return None
        self._undone.append(self._done.pop())
        return self._undone[-1].before

    def redo(self) -> Value | None:
        """Step forward again and give the value from after; None when there is nothing to redo."""
        self._open_key = ""
        if not self._undone:
            return None
        self._done.append(self._undone.pop())
        return self._done[-1].after

    def end_merging(self) -> None:
        """Let the next step be one of its own, whatever its key."""
        self._open_key = ""

    def clear(self) -> None:
        """Forget all steps."""
        self._undone.clear()
        self._done.clear()
        self._open_key = ""

    @property
    def undo_sentence(self) -> str:
        """What the next undo takes back; empty when nothing."""
        return self._done[-1].sentence if self._done else ""

    @property
    def redo_sentence(self) -> str:
        """What the next redo does again; empty when nothing."""
        return self._undone[-1].sentence if self._undone else ""

    def __len__(self) -> int:
        return len(self._done)
