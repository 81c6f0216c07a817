"""From opening a session to its foot in the window, each run in a process of its own.

    python -m benchmarks window_foot
    python -c "import benchmarks.window_foot as b; b.main('SESSION', …)"

Goal: the foot at most 0.8 s after the files are read. Shown offscreen. The peer is the command
`reconstruct` as a whole process, which reads, reconstructs and writes the same foot.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from benchmarks._measure import print_table, recorded_session, run_process
from insole_studio.__main__ import LINEAR_ALGEBRA_THREADS

RUNS = 5
_CALL = "import sys, benchmarks.window_foot as b; b.measure(*sys.argv[1:])"


def main(*sessions: str) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        paths = [Path(session) for session in sessions] or [recorded_session(folder)]
        rows = []
        for path in paths:
            runs = np.array([_run(path) for _ in range(RUNS)])
            command = ["reconstruct", str(path), "--out", str(folder / "foot.ply")]
            peer = [run_process(command).seconds for _ in range(RUNS)]
            figures = [*np.median(runs, axis=0), runs[:, -1].min(), np.median(peer)]
            rows.append([path.name, *(f"{figure:.2f}" for figure in figures)])
    print_table(
        [
            "s, medians", "files read", "foot after that (<= 0.8)", "its best", "reconstruct"
        ],
        rows,
    )  # fmt: skip


def _run(session: Path) -> list[float]:
    one_thread = dict.fromkeys(LINEAR_ALGEBRA_THREADS, "1")  # as the program sets them
    done = subprocess.run(
        [sys.executable, "-c", _CALL, str(session)], check=True, capture_output=True, text=True,
        env={**os.environ, **one_thread, "QT_QPA_PLATFORM": "offscreen"},
    )  # fmt: skip
    return [float(word) for word in done.stdout.split()[-2:]]


def measure(session: str) -> None:
    """Print the seconds until the files are read, and from then until the design has the foot."""
    from importlib import import_module

    from insole_studio.app.between_events import MODULES
    from insole_studio.app.scripted import ScriptedWindow
    from insole_studio.features.foot.presenter import READING
    from insole_studio.lean_numpy import unlist_parts_on_demand
    from insole_studio.native_heap import share_one_heap
    from insole_studio.user_paths import UserPaths

    share_one_heap()
    unlist_parts_on_demand()
    for module in MODULES:  # as the window does while nobody waits
        import_module(module)
    times: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as name:
        places = UserPaths(Path(name) / "settings.json", Path(name) / "autosave")
        with ScriptedWindow(places) as studio:
            foot = studio.app.features.foot

            def note(what: str) -> None:
                times.setdefault(what, time.perf_counter())

            studio.app.jobs.ended.connect(note)
            foot.foot_made.connect(lambda _foot: note("foot"))
            note("start")
            foot.open_session(Path(session))
            studio.settle()
    print(times[READING] - times["start"], times["foot"] - times[READING])
