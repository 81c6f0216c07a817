"""Memory of the window over a day: sessions of real size opened in turn, each one exported.

    python -m benchmarks session_memory
    python -c "import benchmarks.session_memory as b; b.main(60)"

Prints the resident memory after each session. Limit: after the first no more than 150 MB are added.
Shown offscreen, and by OpenGL under Xvfb where that is installed. The peer is the same window which
leaves to Python when it collects what a case leaves.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np

from benchmarks._measure import print_table, resident_mb

SESSIONS, FEET = 60, 12
"""How many are opened, and how many different ones there are."""
_CALL = "import sys, benchmarks.session_memory as b; b.measure(*sys.argv[1:])"
_UNDER_XVFB = ("xvfb-run", "-a", "-s", "-screen 0 1366x768x24")


def main(sessions: int = SESSIONS) -> None:
    windows: list[tuple[str, str, Sequence[str]]] = [
        ("the product", "offscreen", ()),
        ("left to Python", "offscreen", ()),
    ]
    if shutil.which(_UNDER_XVFB[0]) is not None:
        windows.append(("the product", "xcb", _UNDER_XVFB))
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            list(pool.map(partial(_simulate, folder), range(FEET)))
        for garbage, platform, under in windows:
            print(f"{garbage}, {platform}:", flush=True)
            empty, *after = _open_in_turn(folder, sessions, garbage, platform, under)
            numbers = [int(n) for n in np.unique([1, sessions // 6, sessions // 2, sessions]) if n]
            shown = ", ".join(f"{after[n - 1]:.0f} ({n})" for n in numbers)
            more = max(after) - after[0]
            rows.append([garbage, platform, f"{empty:.0f}", shown, f"{more:+.0f}"])
    print_table(
        ["garbage of a case", "screen", "MB, empty", "after session", "most after 1 (<= 150)"], rows
    )


def _simulate(folder: Path, number: int) -> None:
    side = ("left", "right")[number % 2]
    path = str(folder / f"{number}.zip")
    subprocess.run(
        [
            sys.executable, "-m", "insole_studio", "simulate", path,
            "--seed", str(number), "--side", side,
        ],
        check=True, stderr=subprocess.DEVNULL,
    )  # fmt: skip


def _open_in_turn(
    folder: Path, sessions: int, garbage: str, platform: str, under: Sequence[str]
) -> list[float]:
    """Return the resident memory of the empty window and after each session, MB."""
    call = [*under, sys.executable, "-c", _CALL, str(folder), str(sessions), garbage]
    figures = []
    with subprocess.Popen(
        call, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
        env={**os.environ, "QT_QPA_PLATFORM": platform},
    ) as process:  # fmt: skip
        assert process.stdout is not None
        for line in process.stdout:
            print(f"  {line}", end="", flush=True)
            figures.append(float(line.split()[-2]))
    if process.returncode:
        raise RuntimeError(f"the window ended with {process.returncode}")
    return figures


def measure(folder: str, sessions: str, garbage: str) -> None:
    """Print the resident memory after each session; in a process of its own."""
    from insole_studio.native_heap import share_one_heap

    share_one_heap()  # before there is a thread, as in the program
    from insole_studio.app.between_events import GarbageCollection
    from insole_studio.app.scripted import ScriptedWindow
    from insole_studio.user_paths import UserPaths

    with tempfile.TemporaryDirectory() as name:
        places = UserPaths(Path(name) / "settings.json", Path(name) / "data" / "autosave")
        with ScriptedWindow(places) as studio:
            if garbage != "the product":
                collection = studio.app.window.findChild(GarbageCollection)
                assert isinstance(collection, GarbageCollection)
                studio.app.case.opened.disconnect(collection.leave_case)
            print("empty", f"{resident_mb():.0f} MB", flush=True)
            for number in range(int(sessions)):
                studio.app.window.actions_by_key["new_case"].trigger()
                studio.open(Path(folder) / f"{number % FEET}.zip")
                studio.place_pelott(0.0, 150.0)
                side = studio.app.case.side
                studio.export(Path(name) / f"{number}.stl")
                print(f"{number + 1:3} {side} {resident_mb():.0f} MB", flush=True)
