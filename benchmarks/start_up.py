"""From the start of the process to a window that is painted and answers, beside its libraries.

    python -m benchmarks start_up

Limits: 1.3 times the import of PySide6.QtWidgets and pyvistaqt alone, 450 MB, and 0.25 s for
`insole-studio --help`. Best of five, in turn, on the platform of QT_QPA_PLATFORM (or offscreen).
The first start is one in an empty home, without byte code of anything: the worst that can happen
after an installation that did not compile it, as `make` does.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from argparse import Namespace
from contextlib import suppress

from benchmarks._measure import print_table, resident_mb

ROUNDS = 5
FIRST = "first start, no byte code"
_CALL = "import benchmarks.start_up as b; b.{}()"
_ENVIRONMENT = {"QT_QPA_PLATFORM": "offscreen", **os.environ}
_POLL_MS = 10
_HOMES = ("HOME", "XDG_CACHE_HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME")


def main() -> None:
    calls = {
        "libraries alone": ["-c", _CALL.format("import_libraries")],
        "window painted": ["-c", _CALL.format("paint_window")],
        FIRST: ["-c", _CALL.format("paint_window")],
        "the rest loaded": ["-c", _CALL.format("load_rest")],
        "--help": ["-m", "insole_studio", "--help"],
    }
    found: dict[str, list[tuple[float, str]]] = {title: [] for title in calls}
    for _ in range(ROUNDS):
        for title, call in calls.items():
            with tempfile.TemporaryDirectory() as empty:
                found[title].append(_run(call, _new_home(empty) if title == FIRST else {}))
    alone, _ = min(found["libraries alone"])
    rows = []
    for title, runs in found.items():
        seconds, megabytes = min(runs)
        rows.append([title, f"{seconds:.2f}", f"{seconds / alone:.2f}", megabytes])
    print_table(["process", "seconds", "times the libraries", "MB"], rows)


def _new_home(empty: str) -> dict[str, str]:
    return dict.fromkeys((*_HOMES, "PYTHONPYCACHEPREFIX"), empty)


def _run(call: list[str], environment: dict[str, str]) -> tuple[float, str]:
    """Seconds to the first line, and the memory it tells, if it tells any."""
    start = time.perf_counter()
    with subprocess.Popen(
        [sys.executable, *call],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env={**_ENVIRONMENT, **environment},
        text=True,
    ) as process:
        assert process.stdout is not None
        line = process.stdout.readline()
        seconds = time.perf_counter() - start
        process.stdout.read()
    if process.returncode != 0:
        raise RuntimeError(f"{' '.join(call)} failed")
    return seconds, line.strip() if line.strip().isdigit() else ""


def import_libraries() -> None:
    """Import what any window of this kind needs."""
    import PySide6.QtWidgets  # noqa: F401
    import pyvistaqt  # noqa: F401

    _tell()


def paint_window() -> None:
    """Open the window as a user does; tell when it is painted and takes events."""
    from PySide6.QtCore import QEvent, QObject, QTimer
    from PySide6.QtWidgets import QApplication

    qt = QApplication([])

    class FirstPaint(QObject):
        def eventFilter(self, watched: QObject, event: QEvent) -> bool:
            if event.type() == QEvent.Type.Paint and type(watched).__name__ == "MainWindow":
                qt.removeEventFilter(self)
                QTimer.singleShot(0, qt, _tell)
                QTimer.singleShot(0, qt, qt.quit)
            return False

    watch = FirstPaint()
    qt.installEventFilter(watch)
    _open_window()


def load_rest() -> None:
    """Open the window; tell when all is loaded that the first foot needs."""
    from PySide6.QtCore import QTimer
    from PySide6.QtWidgets import QApplication

    qt = QApplication([])
    poll = QTimer(qt)

    def look() -> None:
        from insole_studio.app.between_events import MODULES

        if sys.modules.keys() >= set(MODULES):
            poll.stop()
            _tell()
            qt.quit()

    poll.timeout.connect(look)
    poll.start(_POLL_MS)
    _open_window()


def _open_window() -> None:
    from insole_core.progress import Progress
    from insole_studio.cli import window

    with tempfile.TemporaryDirectory() as name:
        os.environ.update(dict.fromkeys(_HOMES, name))
        with suppress(SystemExit):
            window.run(Namespace(path=None, emulate=None), Progress())


def _tell() -> None:
    print(f"{resident_mb():.0f}", flush=True)
