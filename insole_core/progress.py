"""Progress and cancellation for long computations, independent of any user interface."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from insole_core.messages import Message, Value


class Cancelled(Exception):  # noqa: N818 - not an error
    """The user asked for the running work to stop; nothing half-done remains."""


def _ignore(_fraction: float, _text: str) -> None:
    """Discard a report."""


def _never() -> bool:
    return False


@dataclass(frozen=True)
class Progress:
    """Reports the progress of a computation, and stops it when it is cancelled.

    Parameters
    ----------
    report
        Called with the overall fraction done (0 to 1) and a short message.
    is_cancelled
        Called at every step; when it returns true, the step raises `Cancelled`.
    start, end
        The part of the whole that this computation covers.
    """

    report: Callable[[float, str], None] = _ignore
    is_cancelled: Callable[[], bool] = _never
    start: float = 0.0
    end: float = 1.0

    def step(self, fraction: float, template: str, /, **values: Value) -> None:
        """Report that `fraction` of this computation is done, and what comes next.

        Parameters
        ----------
        fraction
            Of this computation, 0 to 1.
        template, values
            Of the `Message` that is reported: ``"Placing the view {view}", view=name``.

        Raises
        ------
        Cancelled
            When the user has asked to stop.
        """
        if self.is_cancelled():
            raise Cancelled(template)
        message = Message(template, **values)
        self.report(self.start + fraction * (self.end - self.start), message)

    def part(self, start: float, end: float) -> Progress:
        """Return the progress of a sub-computation that covers `start` to `end` of this one."""
        width = self.end - self.start
        return Progress(
            self.report, self.is_cancelled, self.start + start * width, self.start + end * width
        )

    def about(self, template: str, /, **values: Value) -> Progress:
        """Return the same progress, each of whose messages says what it is about.

        Parameters
        ----------
        template, values
            Of a `Message` around each one that is reported, which it calls ``step``:
            ``"The {side} foot: {step}", side=side``.
        """
        return replace(
            self,
            report=lambda done, step: self.report(done, Message(template, step=step, **values)),
        )

    def parts(self, count: int) -> tuple[Progress, ...]:
        """Return the progress of `count` sub-computations of equal size, in order."""
        return tuple(self.part(i / count, (i + 1) / count) for i in range(count))


SILENT = Progress()
"""For callers that neither show progress nor cancel."""
