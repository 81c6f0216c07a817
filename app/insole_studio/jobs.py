"""The one place that starts threads: long work in the background, with progress and cancel."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Generic, TypeVar

from PySide6.QtCore import QObject, Qt, Signal, Slot

from insole_core.progress import Cancelled, Progress

Result = TypeVar("Result")
Task = Callable[[Progress], Result]


@dataclass(frozen=True)
class JobProgress:
    """The state of a running job: fraction done, current step, seconds so far."""

    channel: str
    fraction: float
    text: str
    elapsed_s: float

    @property
    def left_s(self) -> float | None:
        """Return the seconds that remain at the present pace; None while unknown."""
        if self.fraction < 0.05 or self.elapsed_s < 1.0:
            return None
        return self.elapsed_s * (1 - self.fraction) / self.fraction


@dataclass(eq=False)
class Job(Generic[Result]):
    """One running task. Only the newest job of a channel may answer."""

    channel: str
    task: Task[Result]
    done: Callable[[Result], None]
    failed: Callable[[Exception], None]
    started_at: float = field(default_factory=time.monotonic)
    stop: threading.Event = field(default_factory=threading.Event)


class Jobs(QObject):
    """Runs tasks in the background and answers in the thread of the window.

    A task is a function of a `Progress`. Starting a new job in a channel cancels the one before,
    whose answer is dropped even when it arrives late.
    """

    started = Signal(str)
    progressed = Signal(object)
    ended = Signal(str)
    _answered = Signal(object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._pool = ThreadPoolExecutor(max_workers=2, thread_name_prefix="studio-job")
        self._current: dict[str, Job[object]] = {}
        self._answered.connect(self._deliver, Qt.ConnectionType.QueuedConnection)

    def start(
        self,
        channel: str,
        task: Task[Result],
        done: Callable[[Result], None],
        failed: Callable[[Exception], None],
    ) -> None:
        """Run `task`; then call `done` with its result or `failed` with its exception.

        A cancelled job calls neither.

        Parameters
        ----------
        channel
            Starting a task cancels the earlier one in the same channel.
        """
        self.cancel(channel)
        job = Job(channel, task, done, failed)
        self._current[channel] = job  # type: ignore[assignment]
        self.started.emit(channel)
        self._pool.submit(self._run, job)

    def cancel(self, channel: str) -> None:
        """Ask the job of `channel` to stop, and stop listening to it at once."""
        job = self._current.get(channel)
        if job is not None:
            job.stop.set()
            self._end(job)

    @property
    def running(self) -> tuple[str, ...]:
        """The channels of the jobs that have not answered yet."""
        return tuple(self._current)

    def is_running(self, channel: str | None = None) -> bool:
        """Return whether a job of the channel (or any job) has not answered yet."""
        return bool(self._current) if channel is None else channel in self._current

    def close(self) -> None:
        """Cancel everything and wait for the threads."""
        for channel in self.running:
            self.cancel(channel)
        self._pool.shutdown(wait=True, cancel_futures=True)

    def _run(self, job: Job[Result]) -> None:
        progress = Progress(lambda f, text: self._report(job, f, text), job.stop.is_set)
        try:
            progress.step(0.0, "")
            result = job.task(progress)
        except Cancelled:
            self._answer(job, lambda: None)
        except Exception as error:  # noqa: BLE001 - passed to the window, which shows it
            failure = error
            self._answer(job, lambda: job.failed(failure))
        else:
            self._answer(job, lambda: job.done(result))

    def _report(self, job: Job[Result], fraction: float, text: str) -> None:
        news = JobProgress(job.channel, fraction, text, time.monotonic() - job.started_at)
        self._answered.emit(lambda: self._pass_on(job, news))

    def _pass_on(self, job: Job[Result], news: JobProgress) -> None:
        if self._is_current(job):
            self.progressed.emit(news)

    def _answer(self, job: Job[Result], deliver: Callable[[], None]) -> None:
        def in_window() -> None:
            if self._is_current(job):
                self._end(job)
                deliver()

        self._answered.emit(in_window)

    @Slot(object)
    def _deliver(self, answer: Callable[[], None]) -> None:
        # A slot of this object, so that it runs in the thread of the window.
        answer()

    def _is_current(self, job: Job[Result]) -> bool:
        return self._current.get(job.channel) is job

    def _end(self, job: Job[Result]) -> None:
        del self._current[job.channel]
        self.ended.emit(job.channel)
