"""The designed rim of the shown insole, and which of its stations is selected."""

from __future__ import annotations

import operator
from dataclasses import replace
from typing import Any, Protocol

import numpy as np
import scipy
from PySide6.QtCore import QObject, Signal

from insole_core.errors import DesignError
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.insole.fields import Place
from insole_core.insole.finishing.finished import FinishedSurface
from insole_core.insole.finishing.rim_curve import PlacedStation, Rim, RimCurve
from insole_core.insole.finishing.toe_zone import toe_line
from insole_core.insole.outline.insole_outline import insole_outline
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.rim_sliders import finish_of
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_studio.document.case import Case

BESIDE_MM = 2.5
"""The edge of a full-length insole, this far from that of a short one, is part of it."""


class FinishedInsole(Protocol):
    """What the rim is read from: the preview."""

    changed: Any

    @property
    def finished(self) -> FinishedSurface | None: ...  # noqa: D102


class RimModel(QObject):
    """The rim as graph, views and fields share it."""

    changed = Signal()
    """Rim, stations or selection have changed."""
    selection_changed = Signal()

    def __init__(self, case: Case, surface: FinishedInsole, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._case = case
        self._surface = surface
        self._selected: int | None = None
        self._curve: RimCurve | None = None
        self._curve_of: tuple[object, ...] = ()
        """Rim and stations of the curve, which is computed once for each."""
        self._reached: BoolArray = np.zeros(0, dtype=bool)
        self._reached_of: tuple[object, ...] = ()
        self._toe_line: tuple[Place, ...] = ()
        self._toe_line_of: tuple[object, ...] = ()
        self._known_outline: FloatArray | None = None
        self._outline_of: tuple[object, ...] = ()
        case.foot_changed.connect(self._forget)
        case.changed.connect(self.changed)
        case.preview_changed.connect(self.changed)
        surface.changed.connect(self.changed)

    @property
    def finish(self) -> Finish | None:
        """The finish of the shown design."""
        design = self._case.shown.design
        return None if design is None else design.finish

    @property
    def rim(self) -> Rim | None:
        """What the stations refer to; None while no finished insole is built."""
        finished = self._surface.finished
        return None if self.finish is None or finished is None else finished.rim

    @property
    def curve(self) -> RimCurve | None:
        """The rim through the stations of the shown design; None if two of them collide.

        A heel cup among the corrections sets the stations round the heel.
        """
        rim, design = self.rim, self._case.shown.design
        finish = None if design is None else finish_of(design)
        if rim is None or finish is None:
            return None
        stations = finish.rim
        if self._curve_of != (rim, stations):
            self._curve_of = rim, stations
            self._curve = self._built_curve(stations) or _curve_through(rim, stations)
        return self._curve

    def _built_curve(self, wanted: tuple[RimStation, ...]) -> RimCurve | None:
        """Return the rim that the insole was just built with, if it has these stations."""
        built = self._surface.finished
        if built is None:
            return None
        stations = {placed.number: placed.station for placed in built.curve.stations}
        return built.curve if stations == dict(enumerate(wanted)) else None

    @property
    def placed(self) -> dict[int, PlacedStation]:
        """The stations on their places, by their number in the finish.

        Those that a heel cup has added before them are none of the finish.
        """
        curve, finish = self.curve, self.finish
        if curve is None or finish is None:
            return {}
        added = len(curve.stations) - len(finish.rim)
        own = (placed for placed in curve.stations if finish.rim and placed.number >= added)
        return {p.number - added: replace(p, number=p.number - added) for p in own}

    @property
    def placed_in_reach(self) -> dict[int, PlacedStation]:
        """Those of the stations that the insole reaches."""
        curve, reached = self.curve, self.reached
        if curve is None:
            return {}
        step_mm, count = curve.edge.step_mm, len(reached)
        return {
            number: placed
            for number, placed in self.placed.items()
            if reached[round(placed.arc_mm / step_mm) % count]
        }

    @property
    def reached(self) -> BoolArray:
        """(n,) whether the insole reaches each point of the edge; a short one ends before."""
        curve, outline = self.curve, self._outline
        if curve is None or outline is None:
            return np.zeros(0, dtype=bool)
        if not _same(self._reached_of, (curve.edge, outline)):
            away, _ = scipy.spatial.KDTree(outline).query(curve.edge.points_mm)
            self._reached_of = curve.edge, outline
            self._reached = np.asarray(away < BESIDE_MM)
        return self._reached

    @property
    def toe_line(self) -> tuple[Place, ...]:
        """Where the toe zone of the shown design begins; empty where the toes are as scanned."""
        finish, foot, outline = self.finish, self._case.foot, self._outline
        if finish is None or foot is None or outline is None or finish.toe_zone == "as_scanned":
            return ()
        key = foot, outline, finish.toe_line_mm
        if not _same(self._toe_line_of, key):
            line = toe_line(foot, outline, finish.toe_line_mm)
            self._toe_line = tuple((float(x), float(y)) for x, y in line)
            self._toe_line_of = key
        return self._toe_line

    @property
    def _outline(self) -> FloatArray | None:
        """The outline (n, 2) of the shown insole, mm; the same array while it does not change."""
        record = self._case.shown
        design, foot = record.design, record.foot
        if design is None or foot is None:
            return None
        trim = None if design.shell is None else (design.shell.trim_mm,)
        key = foot, design.outline, trim, record.annotations
        if self._outline_of != key:
            self._outline_of = key
            try:
                self._known_outline = insole_outline(foot, design, landmarks_of(record))
            except DesignError:  # the preview says why, and shows the insole before
                return self._known_outline
        return self._known_outline

    @property
    def selected(self) -> int | None:
        """Number of the selected station in the finish."""
        finish, number = self.finish, self._selected
        if finish is None or number is None or number >= len(finish.rim):
            return None
        return number

    @property
    def station(self) -> RimStation | None:
        """The selected station."""
        finish, number = self.finish, self.selected
        return None if finish is None or number is None else finish.rim[number]

    def select(self, number: int | None) -> None:
        """Select a station, or none."""
        if number != self._selected:
            self._selected = number
            self.selection_changed.emit()
            self.changed.emit()

    def _forget(self) -> None:
        self._selected, self._curve, self._known_outline = None, None, None
        self._curve_of = self._reached_of = self._toe_line_of = self._outline_of = ()
        self.changed.emit()


def _same(known: tuple[object, ...], wanted: tuple[object, ...]) -> bool:
    """Return whether a result was computed from the very same objects."""
    return len(known) == len(wanted) and all(map(operator.is_, known, wanted))


def _curve_through(rim: Rim, stations: tuple[RimStation, ...]) -> RimCurve | None:
    try:
        return rim.curve(stations)
    except DesignError:  # the preview says why, and how to get out of it
        return None


def with_stations(design: InsoleDesign, stations: tuple[RimStation, ...]) -> InsoleDesign:
    """Return a finished design with another rim."""
    assert design.finish is not None, "a design as scanned has no rim of its own"
    return replace(design, finish=replace(design.finish, rim=stations))
