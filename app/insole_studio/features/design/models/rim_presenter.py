"""Presenter of the rim as an unrolled graph."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.insole.finishing.edge import Edge
from insole_core.insole.finishing.rim_curve import PlacedStation, Rim, RimCurve, moved_station
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import HEADS_ALONG
from insole_studio.document.case import Case
from insole_studio.document.rim_model import RimModel, with_stations
from insole_studio.features.design.rim_texts import station_text
from insole_studio.features.design.tools.rim_tool import (
    add_station,
    nudge_station,
    remove_station,
)
from insole_studio.features.design.tools.tool_controller import ToolController
from insole_studio.scene.pointer import AnyGesture
from insole_studio.texts import tr
from insole_studio.widgets.rim_chart import ChartStation, ChartZone, RimGraph

HEEL_ZONE = 0.2
"""Share of each border that counts as heel."""


class RimPanel(Protocol):
    """The graph as its presenter sees it, with the signals it emits."""

    chosen: Any
    grabbed: Any
    dragged: Any
    released: Any
    cancelled: Any
    nudged: Any
    added: Any
    removed: Any

    def show_sentence(self, sentence: str) -> None: ...  # noqa: D102
    def show_graph(self, graph: RimGraph, selected: int | None) -> None: ...  # noqa: D102


class RimPresenter:
    """Shows the rim whenever it changes, and turns drags in the graph into undo steps.

    The graph begins beside the 1st metatarsal head and goes along the medial border, round the
    heel, along the lateral border and round the toes: so each zone is in one piece.
    """

    def __init__(
        self, panel: RimPanel, *, case: Case, rim: RimModel, tool_controller: ToolController
    ) -> None:
        self._panel = panel
        self._case = case
        self._rim = rim
        self._tool_controller = tool_controller
        self._shown: tuple[object, ...] = ()
        panel.chosen.connect(self.choose)
        panel.grabbed.connect(self.grab)
        panel.dragged.connect(self.drag)
        panel.released.connect(self.release)
        panel.cancelled.connect(tool_controller.cancel)
        panel.nudged.connect(self.nudge)
        panel.added.connect(self.add)
        panel.removed.connect(self.remove)
        rim.changed.connect(self.show)
        self.show()

    def show(self) -> None:
        """Show the rim, or how to obtain one."""
        rim, curve, selected = self._rim.rim, self._rim.curve, self._rim.selected
        if rim is None or curve is None:
            self._shown = ()
            self._panel.show_sentence(self._next_step())
            return
        state = curve, self._rim.reached, selected
        if len(self._shown) != len(state) or any(
            a is not b for a, b in zip(self._shown, state, strict=True)
        ):
            self._shown = state  # one change may be told by several signals
            self._panel.show_graph(
                _graph(rim, curve, self._rim.placed, self._rim.reached), selected
            )

    def choose(self, number: int) -> None:
        """Select a station everywhere, and offer it in the views as well."""
        self._rim.select(None if number < 0 else number)
        if number >= 0 and self._tool_controller.tool.key != "rim":
            self._tool_controller.take("rim")

    def grab(self, number: int) -> None:
        """Begin to drag a station."""
        rim, design = self._rim.rim, self._case.record.design
        if rim is not None and design is not None and design.finish is not None:
            self._tool_controller.begin(self._carry(design, rim, number))

    def drag(self, s_mm: float, height_mm: float) -> None:
        """Let the station that is held follow."""
        self._tool_controller.drag((s_mm, height_mm))

    def release(self) -> None:
        """Keep the station where it is."""
        self._tool_controller.drag(None)

    def nudge(self, number: int, along_mm: float, up_mm: float) -> None:
        """Move a station by a step of the arrow keys."""
        nudge_station(self._case, self._rim, number, along_mm, up_mm)

    def add(self, s_mm: float) -> None:
        """Add a station on the rim."""
        if self._rim.rim is not None:
            add_station(self._case, self._rim, _arc_mm(self._rim.rim.edge, s_mm))

    def remove(self, number: int) -> None:
        """Remove a station."""
        remove_station(self._case, self._rim, number)

    def _carry(self, design: InsoleDesign, rim: Rim, number: int) -> AnyGesture:
        """Preview the rim at each place of the station; the last one is kept."""
        assert design.finish is not None
        changed = design
        while (place := (yield)) is not None:
            arc_mm = _arc_mm(rim.edge, place[0])
            stations = moved_station(rim, design.finish.rim, number, arc_mm, place[1])
            changed = with_stations(design, stations)
            self._case.preview(changed)
        self._case.apply(changed, tr("Change the rim"))

    def _next_step(self) -> str:
        design = self._case.shown.design
        if design is None:
            return tr("The rim appears here as soon as there is a foot.")
        if design.finish is None:
            return tr("As scanned: the rim is that of the foot. Choose a device to design it.")
        return tr("The insole is being built…")


def _graph(
    rim: Rim, curve: RimCurve, placed: dict[int, PlacedStation], reached: BoolArray
) -> RimGraph:
    edge = rim.edge
    first = int(np.searchsorted(edge.arc_mm, edge.medial_head_mm))
    s_mm = np.append(np.sort(_s_mm(edge, edge.arc_mm)), edge.length_mm)

    def unrolled(values: NDArray[Any]) -> NDArray[Any]:
        rolled = np.roll(values, -first)
        return np.append(rolled, rolled[0])

    stations = [placed[number] for number in sorted(placed)]
    return RimGraph(
        s_mm,
        unrolled(curve.height_mm),
        unrolled(rim.flank_mm),
        tuple(_station(edge, placed) for placed in stations),
        _zones(edge),
        lambda number: station_text(stations[number]),
        tuple(_parts(s_mm, ~unrolled(reached))),
    )


def _parts(s_mm: FloatArray, wanted: BoolArray) -> Iterator[tuple[float, float]]:
    """Yield the ends of each run of wanted points."""
    turns = np.diff(np.concatenate([[0], wanted.astype(np.int8), [0]]))
    for first, end in zip(np.flatnonzero(turns == 1), np.flatnonzero(turns == -1), strict=True):
        yield float(s_mm[first]), float(s_mm[end - 1])


def _station(edge: Edge, placed: PlacedStation) -> ChartStation:
    s_mm = float(_s_mm(edge, np.array(placed.arc_mm)))
    return ChartStation(s_mm, placed.height_mm)


def _zones(edge: Edge) -> tuple[ChartZone, ...]:
    """Return the anatomical parts, named, from the 1st metatarsal head on."""
    marks = [
        0.0,
        *(
            float(_s_mm(edge, np.array(edge.arc_of(border, along))))
            for border, along in (
                ("medial", HEEL_ZONE),
                ("lateral", HEEL_ZONE),
                ("lateral", HEADS_ALONG),
            )
        ),
        edge.length_mm,
    ]
    names = (tr("Medial"), tr("Heel"), tr("Lateral"), tr("Toes"))
    return tuple(
        ChartZone(name, start, end)
        for name, start, end in zip(names, marks[:-1], marks[1:], strict=True)
    )


def _s_mm(edge: Edge, arc_mm: FloatArray) -> FloatArray:
    """Return places in the graph: mm behind the 1st metatarsal head, round the heel."""
    return np.asarray((arc_mm - edge.medial_head_mm) % edge.length_mm)


def _arc_mm(edge: Edge, s_mm: float) -> float:
    return (s_mm + edge.medial_head_mm) % edge.length_mm
