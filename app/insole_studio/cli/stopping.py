"""Stopping a command by a signal: cleaned up as after an error, whichever signal it was."""

from __future__ import annotations

import signal
from typing import NoReturn

from insole_studio.stop_signals import STOP_SIGNALS, is_switched_off


class Stopped(KeyboardInterrupt):
    """The user or the system asked the command to stop.

    Attributes
    ----------
    number
        Of the signal.
    outcome
        What became of the work, as the end of a sentence; whoever keeps a part of it says where.
    """

    def __init__(self, number: int) -> None:
        super().__init__()
        self.number = number
        self.outcome = "nothing was written."

    @property
    def exit_code(self) -> int:
        """The exit code, as shells count it."""
        return 128 + self.number


def stop_on_signals() -> None:
    """Raise `Stopped` at the first signal; those that follow do not disturb the cleaning up.

    A signal that the caller had switched off, like `nohup`, stays off.
    """
    for number in STOP_SIGNALS:
        if not is_switched_off(number):
            signal.signal(number, _stop)


def _stop(number: int, _frame: object) -> NoReturn:
    for other in STOP_SIGNALS:
        signal.signal(other, signal.SIG_IGN)
    raise Stopped(number)
