from __future__ import annotations

import threading
from collections.abc import Iterator

import pytest
from PySide6.QtCore import QThread
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from insole_core.errors import InputError
from insole_core.progress import Progress
from insole_studio.jobs import JobProgress, Jobs
from tests.patience import PATIENCE_S


@pytest.fixture
def jobs(qapp: QApplication) -> Iterator[Jobs]:
    jobs = Jobs()
    yield jobs
    jobs.close()


def wait(qtbot: QtBot, jobs: Jobs) -> None:
    qtbot.waitUntil(lambda: not jobs.is_running())


def test_a_result_arrives_in_the_thread_of_the_window(jobs: Jobs, qtbot: QtBot) -> None:
    results: list[tuple[int, bool]] = []
    main = QThread.currentThread()
    jobs.start(
        "sum",
        lambda _progress: 42,
        lambda answer: results.append((answer, QThread.currentThread() is main)),
        pytest.fail,
    )
    wait(qtbot, jobs)
    assert results == [(42, True)]


def test_progress_is_told(jobs: Jobs, qtbot: QtBot) -> None:
    heard: list[JobProgress] = []
    jobs.progressed.connect(heard.append)

    def work(progress: Progress) -> None:
        progress.step(0.4, "Fusing views")

    jobs.start("work", work, lambda _: None, pytest.fail)
    wait(qtbot, jobs)
    assert [(news.channel, news.fraction, news.text) for news in heard][-1] == (
        "work",
        0.4,
        "Fusing views",
    )


@pytest.mark.parametrize("error", [InputError("no such foot"), ZeroDivisionError()])
def test_no_exception_is_lost(jobs: Jobs, qtbot: QtBot, error: Exception) -> None:
    failures: list[Exception] = []

    def work(_progress: Progress) -> None:
        raise error

    jobs.start("work", work, lambda _: pytest.fail("it failed"), failures.append)
    wait(qtbot, jobs)
    assert failures == [error]


def test_a_late_answer_is_dropped(jobs: Jobs, qtbot: QtBot) -> None:
    answers: list[str] = []
    go_on = threading.Event()

    def stubborn(_progress: Progress) -> str:
        go_on.wait(PATIENCE_S)
        return "old"

    jobs.start("work", stubborn, answers.append, pytest.fail)
    jobs.start("work", lambda _progress: "new", answers.append, pytest.fail)
    wait(qtbot, jobs)
    go_on.set()
    qtbot.wait(50)
    assert answers == ["new"]


def test_cancelled_work_stops_at_its_next_step(jobs: Jobs, qtbot: QtBot) -> None:
    begun, stopped = threading.Event(), threading.Event()

    def endless(progress: Progress) -> None:
        begun.set()
        try:
            while True:
                progress.step(0.5, "Working")
                threading.Event().wait(0.001)
        finally:
            stopped.set()

    jobs.start("work", endless, lambda _: pytest.fail("cancelled"), pytest.fail)
    assert begun.wait(PATIENCE_S)
    jobs.cancel("work")
    assert not jobs.is_running()
    assert stopped.wait(PATIENCE_S)


def test_time_left_is_told_once_it_is_known() -> None:
    assert JobProgress("a", 0.25, "", 3.0).left_s == pytest.approx(9.0)
    assert JobProgress("a", 0.0, "", 3.0).left_s is None
    assert JobProgress("a", 0.5, "", 0.2).left_s is None
