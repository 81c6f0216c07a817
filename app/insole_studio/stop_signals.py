"""The signals that ask a program to stop."""

from __future__ import annotations

import signal

STOP_SIGNALS = tuple(
    getattr(signal, name)
    for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
    if hasattr(signal, name)
)
"""Ctrl-C, the end of the session, the terminal closed; those that this system knows."""


def is_switched_off(number: int) -> bool:
    """Return whether the caller wants a signal to be ignored, as `nohup` does."""
    return signal.getsignal(number) is signal.SIG_IGN
