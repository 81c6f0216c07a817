"""Results that are kept because they are asked for again soon."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable
from threading import Lock
from typing import Any, TypeVar

_Result = TypeVar("_Result")


class Memo:
    """Keeps the last few results of each kind; any thread may ask.

    A memo is a part of the value that its results are derived from, and goes with it: nothing is
    kept of a foot that is closed.

    Parameters
    ----------
    size
        So many results of a kind are kept; the one that was not asked for longest goes first.
    """

    def __init__(self, size: int) -> None:
        self._size = size
        self._kinds: dict[str, OrderedDict[Hashable, Any]] = {}
        self._lock = Lock()

    def get(self, kind: str, key: Hashable, make: Callable[[], _Result]) -> _Result:
        """Give the result of a kind that is kept under a key, or make it.

        Two threads that ask for the same at once may both make it, since nobody waits for what
        another one makes; they are given the same object.
        """
        kept: _Result | None = self.known(kind, key)
        if kept is not None:
            return kept
        made = make()
        with self._lock:
            results = self._kinds.setdefault(kind, OrderedDict())
            shared: _Result = results.setdefault(key, made)
            while len(results) > self._size:
                results.popitem(last=False)
        return shared

    def known(self, kind: str, key: Hashable) -> Any | None:
        """Give the result that is kept under a key; None where there is none."""
        with self._lock:
            results = self._kinds.get(kind)
            if results is None or key not in results:
                return None
            results.move_to_end(key)
            return results[key]
