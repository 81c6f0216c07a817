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


class StopRequest:
    """Raises `Stopped` at the first signal; those that follow do not disturb the cleaning up."""

    def __init__(self) -> None:
        self._number: int | None = None

    def heed_signals(self) -> None:
        """Be called by the signals, except those that the caller had switched off, like `nohup`."""
        for number in STOP_SIGNALS:
            if not is_switched_off(number):
                signal.signal(number, self._stop)

    def check(self) -> None:
        """Raise `Stopped` if a signal came and the work goes on.

        Libraries that catch everything drop it, as trimesh does while it looks for what it can
        import; so does Python while it deletes an object.
        """
        if self._number is not None:
            raise Stopped(self._number)

    def _stop(self, number: int, _frame: object) -> NoReturn:
        for other in STOP_SIGNALS:
            signal.signal(other, signal.SIG_IGN)
        self._number = number
        raise Stopped(number)
