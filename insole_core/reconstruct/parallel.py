"""Run the same work for several views, three at a time, or two different works at once."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

_View = TypeVar("_View")
_Result = TypeVar("_Result")
_Other = TypeVar("_Other")

VIEWS_AT_ONCE = 3
"""The arrays of a view are large, so numpy, OpenCV and Embree run outside the interpreter's lock
most of the time. With two at a time the third of three views would have a processor to itself while
the other idles; more fill the memory rather than the processors."""


def for_views(work: Callable[[_View], _Result], views: Iterable[_View]) -> list[_Result]:
    """Call `work` for every view, in parallel; return the results in the order of the views."""
    with ThreadPoolExecutor(VIEWS_AT_ONCE) as pool:
        return list(pool.map(work, views))


def both(first: Callable[[], _Result], second: Callable[[], _Other]) -> tuple[_Result, _Other]:
    """Run two independent calls at once and return both results when both have ended.

    If both fail, the error of the second is raised: it runs in the caller's thread.
    """
    with ThreadPoolExecutor(1) as pool:
        beside = pool.submit(first)
        other = second()
        return beside.result(), other
