"""Undo and redo of immutable values, with a description of each change."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Generic, TypeVar

Value = TypeVar("Value")


@dataclass(frozen=True)
class Change(Generic[Value]):
    """One change: the value before and after it, and a description.

    A non-empty `merge_key` identifies consecutive changes that are undone together.
    """

    before: Value
    after: Value
    sentence: str
    merge_key: str


class History(Generic[Value]):
    """Undo and redo stacks. Values are immutable, so a step only swaps them."""

    def __init__(self) -> None:
        self._undone: list[Change[Value]] = []
        self._done: list[Change[Value]] = []
        self._open_key = ""

    def push(self, before: Value, after: Value, sentence: str, merge_key: str = "") -> None:
        """Record a change, which ends the possibility to redo.

        Parameters
        ----------
        sentence
            Description for the user.
        merge_key
            A change with the same non-empty key as the one before is merged into it unless
            `end_merging` was called in between, so that one run of the wheel is one step of undo.
        """
        self._undone.clear()
        if merge_key and merge_key == self._open_key:
            before = self._done.pop().before
        self._open_key = merge_key
        self._done.append(Change(before, after, sentence, merge_key))

    def undo(self) -> Value | None:
        """Step back and return the value to restore; None when there is nothing to undo."""
        self._open_key = ""
        if not self._done:
            return None
        self._undone.append(self._done.pop())
        return self._undone[-1].before

    def redo(self) -> Value | None:
        """Step forward and return the value to restore; None when there is nothing to redo."""
        self._open_key = ""
        if not self._undone:
            return None
        self._done.append(self._undone.pop())
        return self._done[-1].after

    def end_merging(self) -> None:
        """Do not merge the next change into the last one, whatever its key."""
        self._open_key = ""

    def revise(self, revised: Callable[[Value], Value]) -> None:
        """Let all steps lead to other values, such as with what no step is to take back."""
        for changes in (self._done, self._undone):
            changes[:] = [
                replace(change, before=revised(change.before), after=revised(change.after))
                for change in changes
            ]

    def clear(self) -> None:
        """Discard all changes."""
        self._undone.clear()
        self._done.clear()
        self._open_key = ""

    @property
    def undo_sentence(self) -> str:
        """Description of the change that the next undo reverts; empty when there is none."""
        return self._done[-1].sentence if self._done else ""

    @property
    def redo_sentence(self) -> str:
        """Description of the change that the next redo repeats; empty when there is none."""
        return self._undone[-1].sentence if self._undone else ""

    def __len__(self) -> int:
        return len(self._done)
