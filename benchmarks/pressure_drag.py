"""A pad that is dragged in the window, with the change of the pressure shown and without.

    xvfb-run -a -s "-screen 0 1366x768x24" python -m benchmarks pressure_drag

Limits: 16 ms more for the picture of a move, and the map of a move at most 100 ms behind the hand;
it is in the picture of the move. Under Xvfb the processor draws, where elsewhere a graphics card
does: what the window computes besides is counted by itself, without what VTK draws.
"""

from __future__ import annotations

import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from benchmarks._measure import print_table
from insole_core.geometry.arrays import FloatArray
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
            without = _dragged(app)
            studio.settle()
            app.window.actions_by_key["map_load"].trigger()
            (dialog,) = app.window.findChildren(LoadDialog)
            dialog.was_read.click()
            dialog.go_on.click()
            dialog.weight.setValue(75)
            studio.settle()
            shown = _dragged(app)
    assert len(shown.maps_ms) == len(shown.pictures_ms), "a picture without the map of its move"
    more = float(np.median(shown.pictures_ms) - np.median(without.pictures_ms))
    computed = float(np.median(shown.computed_ms) - np.median(without.computed_ms))
    print_table(
        ["a move of the pad", "median ms", "95 % ms", "limit ms"],
        [
            ["picture, without the map", *_figures(without.pictures_ms), ""],
            ["picture, with the map", *_figures(shown.pictures_ms), ""],
            ["more for the picture", f"{more:.1f}", "", f"{PICTURE_LIMIT_MS:g}"],
            ["drawn by VTK, without the map", *_figures(without.drawn_ms), ""],
            ["drawn by VTK, with the map", *_figures(shown.drawn_ms), ""],
            ["computed besides, without the map", *_figures(without.computed_ms), ""],
            ["computed besides, with the map", *_figures(shown.computed_ms), ""],
            ["more computed", f"{computed:.1f}", "", f"{PICTURE_LIMIT_MS:g}"],
            ["the map is made, after the move", *_figures(shown.maps_ms), f"{MAP_LIMIT_MS:g}"],
        ],
    )


def _figures(times_ms: list[float]) -> tuple[str, str]:
    return f"{np.median(times_ms):.1f}", f"{np.quantile(times_ms, 0.95):.1f}"


@dataclass(frozen=True)
class _Dragged:
    """How long each move took until it was drawn, the processor besides, and until its map was."""

    pictures_ms: list[float] = field(default_factory=list)
    drawn_ms: list[float] = field(default_factory=list)
    computed_ms: list[float] = field(default_factory=list)
    maps_ms: list[float] = field(default_factory=list)


def _clocks() -> FloatArray:
    """Return the seconds on the clock, and those of the processor in this thread."""
    return np.array([time.perf_counter(), time.thread_time()])


def _dragged(app: Application) -> _Dragged:
    """Drag the pad by the mouse in the view of the foot, and return how long its moves took."""
    design, load, found = app.case.record.design, app.stage.load, _Dragged()
    assert design is not None
    (pad,) = design.of(Pelott)
    app.window.actions_by_key["tool_pelott"].trigger()
    hand = app.stage.foot.scene
    centre = np.array([*pad.centre_mm, 0.0])
    ways = [np.array([8 * np.sin(n / 10), 8 * np.cos(n / 10) - 8, 0.0]) for n in range(MOVES + 1)]
    places = [
        QPoint(*np.rint(xy).astype(int).tolist()) for xy in hand.look.pixels_of(centre + ways)
    ]
    canvases = [view.scene._canvas for view in (app.stage.foot, app.stage.insole)]
    now = begun = drawn = np.zeros(2)  # on the clock, and of the processor

    def begin(*_: object) -> None:
        nonlocal begun
        begun = _clocks()

    def end(*_: object) -> None:
        nonlocal drawn
        drawn = drawn + _clocks() - begun

    seen = [
        (window, window.AddObserver(event, note))
        for window in (canvas.plotter.render_window for canvas in canvases)
        for event, note in (("StartEvent", begin), ("EndEvent", end))
    ]

    def note_map() -> None:
        if load.change is not None:
            found.maps_ms.append(1000 * (time.perf_counter() - now[0]))

    QTest.mousePress(hand.surface, Qt.MouseButton.LeftButton, pos=places[0])
    for place in places[1:]:
        QApplication.processEvents()  # so that the move is handled at once
        before, now, drawn = app.case.shown.design, _clocks(), np.zeros(2)
        load.changed.connect(note_map)
        QTest.mouseMove(hand.surface, place)
        load.changed.disconnect(note_map)
        if app.case.shown.design == before:
            continue  # by less than what the hand holds in one pixel
        QApplication.processEvents()
        for canvas in canvases:
            canvas.render_now()
        QApplication.processEvents()
        taken = _clocks() - now
        found.pictures_ms.append(1000 * taken[0])
        found.drawn_ms.append(1000 * drawn[0])
        found.computed_ms.append(1000 * (taken - drawn)[1])
        while time.perf_counter() < now[0] + _PAUSE_S:
            QApplication.processEvents()
    for window, observer in seen:
        window.RemoveObserver(observer)
    QTest.mouseRelease(hand.surface, Qt.MouseButton.LeftButton, pos=places[-1])
    assert app.case.record.design != design, "the pad was not dragged"
    app.case.undo()
    return found
