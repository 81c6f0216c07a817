"""How long a test waits: until what it waits for has happened, and no longer than a minute.

A minute is enough on the busiest machine, and costs nothing on any other one. Qt's bot of the tests
of the window waits as long by itself.
"""

from __future__ import annotations

import time
from collections.abc import Callable

PATIENCE_S = 60
PATIENCE_MS = 1000 * PATIENCE_S


def wait_for(has_happened: Callable[[], object]) -> None:
    """Wait without handling the events of a window."""
    limit_s = time.monotonic() + PATIENCE_S
    while not has_happened():
        assert time.monotonic() < limit_s, f"not within {PATIENCE_S} s"
        time.sleep(0.005)
