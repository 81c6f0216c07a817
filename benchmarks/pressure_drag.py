"""A pad that is dragged in the window, with the change of the pressure shown and without.

    xvfb-run -a -s "-screen 0 1366x768x24" python -m benchmarks pressure_drag

Limits: 16 ms more for the picture of a move, and the map of a move at most 100 ms behind it. Under
Xvfb the picture is drawn by the processor, so it and the model share its cores.
"""

from __future__ import annotations

import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
from PySide6.QtWidgets import QApplication

from benchmarks._measure import print_table
from insole_core.insole.elements import Pelott
from insole_studio.app.bootstrap import Application
from insole_studio.app.scripted import ScriptedWindow
from insole_studio.features.design.load.load_dialog import LoadDialog
from insole_studio.user_paths import UserPaths

MOVES = 60
PICTURE_LIMIT_MS, MAP_LIMIT_MS = 16.0, 100.0
_PAUSE_S = 0.016
"""Between two moves of a hand."""


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        paths = UserPaths(folder / "settings.json", folder / "autosave")
        with ScriptedWindow(paths, (1366, 768)) as studio:
            app = studio.app
            app.window.actions_by_key["open_example"].trigger()
            studio.settle()
            without, _ = _dragged(app)
            studio.settle()
            app.window.actions_by_key["map_load"].trigger()
            (dialog,) = app.window.findChildren(LoadDialog)
            dialog.was_read.click()
            dialog.go_on.click()
            dialog.weight.setValue(75)
            studio.settle()
            shown, behind = _dragged(app)
    more = float(np.median(shown) - np.median(without))
    print_table(
        ["a move of the pad", "median ms", "95 % ms", "limit ms"],
        [
            ["picture, without the map", *_figures(without), ""],
            ["picture, with the map", *_figures(shown), ""],
            ["more for the picture", f"{more:.1f}", "", f"{PICTURE_LIMIT_MS:g}"],
            ["the map, behind the move", *_figures(behind), f"{MAP_LIMIT_MS:g}"],
        ],
    )


def _figures(times_ms: list[float]) -> tuple[str, str]:
    return f"{np.median(times_ms):.1f}", f"{np.quantile(times_ms, 0.95):.1f}"


def _dragged(app: Application) -> tuple[list[float], list[float]]:
    """Return how long each move took to be drawn, and how far each map was behind its move."""
    design, load = app.case.record.design, app.stage.load
    assert design is not None
    (pad,) = design.of(Pelott)
    pictures: list[float] = []
    behind: list[float] = []
    moved_at: list[float] = []
    began = 0.0

    def arrived() -> None:
        """Count the map of the last move that had been made when its computation began."""
        nonlocal began
        if load.change is not None and moved_at:
            behind.append(1000 * (time.perf_counter() - (began or moved_at[0])))
            began = moved_at[-1]

    load.changed.connect(arrived)
    for move in range(MOVES):
        x, y = pad.centre_mm
        place = (x + 8 * np.sin(move / 8), y + 8 * np.cos(move / 8))
        start = time.perf_counter()
        moved_at.append(start)
        app.case.preview(design.with_changed(replace(pad, centre_mm=place)))
        QApplication.processEvents()
        app.stage.insole.scene._canvas.render_now()
        pictures.append(1000 * (time.perf_counter() - start))
        until = start + _PAUSE_S
        while time.perf_counter() < until:
            QApplication.processEvents()
    load.changed.disconnect(arrived)
    app.case.end_preview()
    return pictures, behind
