"""A bounded, thread-safe cache of recent results."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable
from threading import Lock
from typing import Any, TypeVar

_Result = TypeVar("_Result")


class Memo:
    """Cache of the most recently used results of each kind; thread-safe.

    A memo is part of the value that its results are derived from and is freed with it, so that
    nothing of a closed foot is kept.

    Parameters
    ----------
    size
        Number of results kept for each kind; the least recently used one is dropped first.
    """

    def __init__(self, size: int) -> None:
        self._size = size
        self._kinds: dict[str, OrderedDict[Hashable, Any]] = {}
        self._lock = Lock()

    def get(self, kind: str, key: Hashable, make: Callable[[], _Result]) -> _Result:
        """Return the cached result, or compute it.

        Two threads that ask for the same result at once may both compute it, since neither waits
        for the other; both get the same object.

        Parameters
        ----------
        kind
            Name of the computation; each kind has its own bound.
        key
            Everything the result depends on.
        make
            Computes the result; called without holding the lock.
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
        """Return the cached result of a kind and key, or None."""
        with self._lock:
            results = self._kinds.get(kind)
            if results is None or key not in results:
                return None
            results.move_to_end(key)
            return results[key]
