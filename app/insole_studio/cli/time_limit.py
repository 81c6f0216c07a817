"""Ends what does not end by itself, and tells where it stood."""

from __future__ import annotations

import faulthandler
import sys
import threading
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager

GRACE_S = 10.0
"""Then the process ends even where a library, such as that of graphics, holds the interpreter."""


@contextmanager
def time_limit(seconds: float, give_up: Callable[[str], None]) -> Iterator[None]:
    """Call a function if the block takes too long.

    Parameters
    ----------
    seconds
        The most that the block may take.
    give_up
        Called in a thread of its own with where each thread of the program stands, to tell it and
        end the process. If that does not happen within `GRACE_S`, the process writes it to stderr
        and ends with exit code 1.
    """
    timer = threading.Timer(seconds, lambda: give_up(_where_threads_stand()))
    timer.daemon = True
    timer.start()
    if sys.__stderr__ is not None:
        faulthandler.dump_traceback_later(seconds + GRACE_S, exit=True, file=sys.__stderr__)
    try:
        yield
    finally:
        timer.cancel()
        faulthandler.cancel_dump_traceback_later()


def _where_threads_stand() -> str:
    names = {thread.ident: thread.name for thread in threading.enumerate()}
    own = threading.get_ident()
    return "\n".join(
        f"{names.get(ident, ident)}:\n{''.join(traceback.format_stack(frame))}"
        for ident, frame in sys._current_frames().items()
        if ident != own
    )
