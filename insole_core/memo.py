"""A bounded, thread-safe cache of recent results."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable, Iterable, Iterator
from dataclasses import fields, is_dataclass
from threading import Lock
from typing import Any, TypeVar

import numpy as np
import scipy

_Result = TypeVar("_Result")


class Memo:
    """Cache of the most recently used results of each kind; thread-safe.

    A memo is part of the value that its results are derived from and is freed with it, so that
    nothing of a closed foot is kept.

    Parameters
    ----------
    size
        Number of results kept for each kind; the least recently used one is dropped first.
    most_bytes
        Of the arrays in the results of one kind; if there are more, fewer are kept, but `least`.
    least
        Number of results that are kept whatever their size; by default all.
    """

    def __init__(
        self, size: int, *, most_bytes: int | None = None, least: int | None = None
    ) -> None:
        self._size, self._most_bytes = size, most_bytes
        self._least = size if least is None else least
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
            while self._is_too_much(results):
                results.popitem(last=False)
        return shared

    def _is_too_much(self, results: OrderedDict[Hashable, Any]) -> bool:
        if len(results) > self._size:
            return True
        if self._most_bytes is None or len(results) <= self._least:
            return False
        return array_bytes(results) > self._most_bytes

    def known(self, kind: str, key: Hashable) -> Any | None:
        """Return the cached result of a kind and key, or None."""
        with self._lock:
            results = self._kinds.get(kind)
            if results is None or key not in results:
                return None
            results.move_to_end(key)
            return results[key]


def array_bytes(value: Any) -> int:
    """Return the size of all arrays in a value; those that it holds twice count once."""
    return sum({id(array): array.nbytes for array in _arrays(value)}.values())


def _arrays(value: Any) -> Iterator[np.ndarray[Any, Any]]:
    """Iterate over the arrays in fields, in sparse matrices, in tuples, lists and dicts."""
    if isinstance(value, np.ndarray):
        yield value
        return
    parts: Iterable[Any] = ()
    if scipy.sparse.issparse(value):
        parts = vars(value).values()
    elif isinstance(value, dict):
        parts = value.values()
    elif isinstance(value, tuple | list):
        parts = value
    elif is_dataclass(value) and not isinstance(value, type):
        parts = (getattr(value, f.name) for f in fields(value))
    for part in parts:
        yield from _arrays(part)
