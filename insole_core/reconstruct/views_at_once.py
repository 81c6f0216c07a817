"""The same work for several views, three at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

_View = TypeVar("_View")
_Result = TypeVar("_Result")

VIEWS_AT_ONCE = 3
"""The arrays of a view are large, so numpy, OpenCV and Embree run outside the interpreter's lock
most of the time. With two at a time the third of three views would have a processor to itself while
the other idles; more fill the memory rather than the processors."""


def for_views(work: Callable[[_View], _Result], views: Iterable[_View]) -> list[_Result]:
    """Give the results in the order of the views."""
    with ThreadPoolExecutor(VIEWS_AT_ONCE) as pool:
        return list(pool.map(work, views))
