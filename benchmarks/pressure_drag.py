"""A pad that is dragged in the window, with the change of the pressure shown and without.

    xvfb-run -a -s "-screen 0 2732x768x24" python -m benchmarks pressure_drag

Two windows beside each other show the same case, one of them with the map. Each move of the pad is
made in both, one right after the other in an order that is drawn by lot, and the two are compared
with each other: how busy the machine is meanwhile, both feel alike. Stated are the median of these
differences and the interval in which it lies at 95 %, by resampling the moves.

Limits: 16 ms more for the picture of a move, and the map of a move at most 100 ms behind the hand;
it is in the picture of the move. Under Xvfb the processor draws, where elsewhere a graphics card
does, and waits for whatever else the machine does: so the time of the processor is stated too, in
all threads, and for what the window computes besides that drawing.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PySide6.QtCore import QPoint, QSize, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from benchmarks._measure import print_table
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.elements import Pelott
from insole_studio.app.scripted import ScriptedWindow
from insole_studio.features.design.load.load_dialog import LoadDialog
from insole_studio.scene.scene_view import SceneView
from insole_studio.user_paths import UserPaths

MOVES, TRIED_FIRST = 240, 3
"""Of the pad, and those more at the beginning that are not counted: caches fill."""
PICTURE_LIMIT_MS, MAP_LIMIT_MS = 16.0, 100.0
_SIZE = (1366, 768)
_VIEW = QSize(480, 330)
"""Of every view, pixels: the legend of the map would leave less to draw."""
_PAUSE_S = 0.016
"""Between two moves of a hand."""
_RESAMPLED = 10_000


@dataclass(frozen=True)
class _Move:
    """How long a move took until it was drawn, and what of that VTK took to draw, ms.

    Also the time of the processor in all threads, those in which VTK draws included, and in the
    window's own, without what VTK draws. The map is made when it is handed to the views; NaN
    without one.
    """

    picture_ms: float
    drawn_ms: float
    processor_ms: float
    computed_ms: float
    map_ms: float


def main() -> None:
    with tempfile.TemporaryDirectory() as name, ExitStack() as windows:
        plain, mapped = (
            windows.enter_context(ScriptedWindow(_paths(Path(name) / part), _SIZE))
            for part in ("plain", "mapped")
        )
        mapped.app.window.move(_SIZE[0], 0)
        for studio in (plain, mapped):
            studio.app.window.actions_by_key["open_example"].trigger()
            studio.settle()
        _show_map(mapped)
        _show_alike(plain, mapped)
        pairs = _dragged((plain, mapped))
    without, shown = zip(*pairs, strict=True)
    print_table(
        [f"{len(pairs)} moves of the pad", "without the map", "with it", "more (95 %)", "limit"],
        [
            _row("picture, ms", without, shown, "picture_ms", PICTURE_LIMIT_MS),
            _row("of it drawn by VTK, ms", without, shown, "drawn_ms"),
            _row("processor, all threads, ms", without, shown, "processor_ms"),
            _row("computed besides, ms", without, shown, "computed_ms", PICTURE_LIMIT_MS),
        ],
    )
    maps_ms = [move.map_ms for move in shown]
    print(
        f"the map is made {np.median(maps_ms):.1f} ms after the move, in 95 of 100 moves within "
        f"{np.quantile(maps_ms, 0.95):.1f} ms (limit {MAP_LIMIT_MS:g} ms)"
    )


def _row(
    name: str,
    without: Sequence[_Move],
    shown: Sequence[_Move],
    figure: str,
    limit_ms: float | None = None,
) -> list[str]:
    before, after = (
        np.array([getattr(move, figure) for move in moves]) for moves in (without, shown)
    )
    more = after - before
    lot = np.random.default_rng(0).integers(len(more), size=(_RESAMPLED, len(more)))
    low, high = np.quantile(np.median(more[lot], axis=1), (0.025, 0.975))
    limit = "" if limit_ms is None else f"{limit_ms:g}"
    return [
        name, f"{np.median(before):.1f}", f"{np.median(after):.1f}",
        f"{np.median(more):+.1f} ({low:+.1f} to {high:+.1f})", limit,
    ]  # fmt: skip


def _paths(folder: Path) -> UserPaths:
    folder.mkdir()
    return UserPaths(folder / "settings.json", folder / "autosave")


def _show_map(studio: ScriptedWindow) -> None:
    studio.app.window.actions_by_key["map_load"].trigger()
    (dialog,) = studio.app.window.findChildren(LoadDialog)
    dialog.was_read.click()
    dialog.go_on.click()
    dialog.weight.setValue(75)
    studio.settle()


def _dragged(windows: tuple[ScriptedWindow, ScriptedWindow]) -> list[tuple[_Move, _Move]]:
    """Drag the pad of both windows along one way, and return how long the moves took in each."""
    hands = [_Hand(studio) for studio in windows]
    lots = np.random.default_rng(0)
    pairs = []
    for number in range(1, TRIED_FIRST + MOVES + 1):
        moves: list[_Move | None] = [None, None]
        for one in lots.permutation(2):
            moves[one] = hands[one].moved(number)
        without, shown = moves
        assert hands[0].pad.centre_mm == hands[1].pad.centre_mm, "the windows are dragged apart"
        if without is not None and shown is not None and number > TRIED_FIRST:
            assert np.isfinite(shown.map_ms), "a picture without the map of its move"
            pairs.append((without, shown))
    for hand in hands:
        hand.let_go()
    return pairs


def _clocks() -> FloatArray:
    """Return the seconds on the clock, and of the processor in this thread and in all threads."""
    return np.array([time.perf_counter(), time.thread_time(), time.process_time()])


def _scenes(studio: ScriptedWindow) -> list[SceneView]:
    return [studio.app.stage.foot.scene, studio.app.stage.insole.scene]


def _show_alike(plain: ScriptedWindow, mapped: ScriptedWindow) -> None:
    """Give the views of both windows the same size and camera: as many pixels are drawn."""
    scenes = [scene for studio in (plain, mapped) for scene in _scenes(studio)]
    for scene in scenes:
        scene.setFixedSize(_VIEW)
    while any(scene.size() != _VIEW for scene in scenes):
        QApplication.processEvents()
    for one, other in zip(_scenes(plain), _scenes(mapped), strict=True):
        other.set_camera(one.camera)


class _Hand:
    """The mouse on the pad of a window, in its view of the foot."""

    def __init__(self, studio: ScriptedWindow) -> None:
        self._app = app = studio.app
        app.window.actions_by_key["tool_pelott"].trigger()
        self._surface, look = app.stage.foot.scene.surface, app.stage.foot.scene.look
        ways = [
            np.array([8 * np.sin(n / 10), 8 * np.cos(n / 10) - 8, 0.0])
            for n in range(TRIED_FIRST + MOVES + 1)
        ]
        at_px = np.rint(look.pixels_of(np.array([*self.pad.centre_mm, 0.0]) + ways)).astype(int)
        self._places = [QPoint(*xy) for xy in at_px.tolist()]
        self._canvases = [scene._canvas for scene in _scenes(studio)]
        self._begun = self._drawn = np.zeros(3)
        for canvas in self._canvases:
            canvas.plotter.render_window.AddObserver("StartEvent", self._begin_to_draw)
            canvas.plotter.render_window.AddObserver("EndEvent", self._end_to_draw)
        self._made_s = np.nan
        app.stage.load.changed.connect(self._note_map)
        QTest.mousePress(self._surface, Qt.MouseButton.LeftButton, pos=self._places[0])

    @property
    def pad(self) -> Pelott:
        """As it is shown."""
        design = self._app.case.shown.design
        assert design is not None
        (pad,) = design.of(Pelott)
        return pad

    def moved(self, number: int) -> _Move | None:
        """Move to a place of the way and draw; None where that is within the pixel before."""
        QApplication.processEvents()  # so that the move is handled at once
        before, now = self.pad, _clocks()
        self._drawn, self._made_s = np.zeros(3), np.nan
        QTest.mouseMove(self._surface, self._places[number])
        if self.pad == before:
            return None
        QApplication.processEvents()
        for canvas in self._canvases:
            canvas.render_now()
        QApplication.processEvents()
        taken, drawn = 1000 * (_clocks() - now), 1000 * self._drawn
        while time.perf_counter() < now[0] + _PAUSE_S:
            QApplication.processEvents()
        made_ms = 1000 * (self._made_s - now[0])
        return _Move(taken[0], drawn[0], taken[2], taken[1] - drawn[1], made_ms)

    def let_go(self) -> None:
        """End the drag, which has changed the design."""
        before = self._app.case.record.design
        QTest.mouseRelease(self._surface, Qt.MouseButton.LeftButton, pos=self._places[-1])
        assert self._app.case.record.design != before, "the pad was not dragged"

    def _note_map(self) -> None:
        if self._app.stage.load.change is not None and np.isnan(self._made_s):
            self._made_s = time.perf_counter()

    def _begin_to_draw(self, *_: object) -> None:
        self._begun = _clocks()

    def _end_to_draw(self, *_: object) -> None:
        self._drawn = self._drawn + _clocks() - self._begun
