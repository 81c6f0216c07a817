"""The rim tool: its stations, the toe line and the front edge of a short shell, dragged."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from insole_core.cases.case_record import CaseRecord
from insole_core.errors import DesignError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.insole.fields import Place, ranges_of
from insole_core.insole.finishing.rim_curve import (
    PlacedStation,
    Rim,
    added_station,
    moved_station,
    raised_station,
)
from insole_core.insole.finishing.toe_zone import HeadsParabola
from insole_core.insole.grips import place_at
from insole_core.insole.outline.insole_outline import insole_outline
from insole_core.insole.outline.trim_line import trim_points
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_limits import check_design
from insole_core.insole.prescription.finish import Finish
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_studio.document.case import Case
from insole_studio.document.rim_model import RimModel, with_stations
from insole_studio.features.design.rim_texts import station_text
from insole_studio.features.design.tools.tool import (
    NUDGE_MM,
    ContextMenuItem,
    SurfaceContext,
    Tool,
)
from insole_studio.scene.pointer import Gesture, Handle, Phase, PointerEvent
from insole_studio.scene.view_camera import ViewTransform
from insole_studio.texts import tr

PREFIX, TOE_LINE, TRIM = "rim:", "toe_line", "trim:"
TOE_LINE_STEP_MM = 0.5
NEAR_MM = 12.0
"""Largest distance from the edge at which a double click adds a station."""
LOCK_PX = 4.0
"""How far a drag goes before it is decided whether it raises the station or moves it."""
LEAST_SEEN = 0.35
"""Least length of a unit vector on the screen for drags along it."""


def _shown_trim_points(record: CaseRecord) -> tuple[Place, ...]:
    """Return the points of the trim line; none where the insole has no such line."""
    design = record.design
    if design is None or design.shell is None or record.foot is None:
        return ()
    if design.outline.source == "drawn" or design.outline.extent != "three_quarter":
        return ()
    return trim_points(design.shell, design.side, landmarks_of(record))


def _carry_trim_point(case: Case, number: int, press: PointerEvent) -> Gesture:
    """Let a point of the trim line follow the pointer, as far as that leaves a shell."""
    design, points = case.record.design, _shown_trim_points(case.record)
    start, event = press.place_mm(0.0), press
    assert design is not None
    kept = design
    while event.phase is not Phase.RELEASE:
        event = yield
        now = event.place_mm(0.0)
        if start is None or now is None:
            continue
        moved = place_at(np.array(points[number]) + (now - start)[:2])
        wanted = _with_point(design, points, number, moved)
        if _is_possible(case.record, wanted):
            kept = wanted
        case.preview(kept)
    case.apply(kept, tr("Move the trim line"))


def _with_point(
    design: InsoleDesign, points: tuple[Place, ...], number: int, place: Place
) -> InsoleDesign:
    assert design.shell is not None
    moved = (*points[:number], place, *points[number + 1 :])
    return replace(design, shell=replace(design.shell, trim_mm=moved))


def _is_possible(record: CaseRecord, design: InsoleDesign) -> bool:
    assert record.foot is not None
    try:
        check_design(design)
        insole_outline(record.foot, design, landmarks_of(record))
    except DesignError:
        return False
    return True


@dataclass(frozen=True)
class _Axes:
    """Directions on the screen (2,) in which a station is raised, and moved along the edge."""

    up: FloatArray
    along: FloatArray


class RimTool(Tool):
    """Tool that shapes the rim; a station is selected in graph, views and fields alike."""

    key = "rim"

    def __init__(self, rim: RimModel) -> None:
        self._rim = rim

    def reset(self) -> None:
        """Forget which station was selected."""
        self._rim.select(None)

    @property
    def sketch(self) -> tuple[Place, ...]:
        """The line at which the toe zone begins."""
        return self._rim.toe_line

    @property
    def selection(self) -> object:
        """The selected station."""
        return self._rim.selected

    def hint(self, case: Case) -> str:
        """Return one short sentence on what the user can do now."""
        design = case.shown.design
        if design is not None and design.finish is None:
            return tr("This insole is as scanned; choose a device to design its rim")
        return tr(
            "Drag a station of the rim to raise it, or along the edge; double click adds or "
            "removes one"
        )

    def handles(self, case: Case, surface: SurfaceContext) -> tuple[Handle, ...]:
        """Return the stations as handles, the selected one larger; toe line and trim line."""
        hint = tr("Drag to raise the rim here, or to move the station along the edge")
        placed, selected = self._rim.placed_in_reach, self._rim.selected
        line = self._rim.toe_line
        spots = {f"{PREFIX}{number}": station.place_mm for number, station in placed.items()}
        hints = dict.fromkeys(spots, hint)
        if selected in placed:
            hints[f"{PREFIX}{selected}"] = station_text(placed[selected])
        if line:
            spots[TOE_LINE] = line[len(line) // 2]
            hints[TOE_LINE] = tr("Drag to move the line at which the toe zone begins")
        for number, place in enumerate(_shown_trim_points(case.shown)):
            spots[f"{TRIM}{number}"] = place
            hints[f"{TRIM}{number}"] = tr("Drag to move the front edge of the shell")
        places = surface.places(np.array(list(spots.values())).reshape(-1, 2))
        return tuple(
            Handle(
                name,
                (float(x), float(y), float(z)),
                hints[name],
                "move" if name == f"{PREFIX}{selected}" else "size",
            )
            for name, (x, y, z) in zip(spots, places, strict=True)
        )

    def press(self, case: Case, event: PointerEvent, _surface: SurfaceContext) -> Gesture | None:
        """Select and grab a station."""
        number, rim, design = _number(event), self._rim.rim, case.record.design
        if design is not None and case.foot is not None and event.handle == TOE_LINE:
            return _carry_toe_line(case, design, HeadsParabola.of(case.foot), event)
        if design is not None and event.handle is not None and event.handle.startswith(TRIM):
            return _carry_trim_point(case, int(event.handle.removeprefix(TRIM)), event)
        if number is None or rim is None or design is None:
            return None
        self._rim.select(number)
        return _carry(case, design, rim, self._rim.placed[number], event)

    def double_click(self, case: Case, event: PointerEvent, _surface: SurfaceContext) -> bool:
        """Remove the station under the pointer, or add one at the edge."""
        number = _number(event)
        if number is not None:
            remove_station(case, self._rim, number)
            return True
        arc_mm = self._arc_at(event)
        return arc_mm is not None and add_station(case, self._rim, arc_mm)

    def offers(
        self, case: Case, event: PointerEvent, _surface: SurfaceContext
    ) -> tuple[ContextMenuItem, ...]:
        """Return the items for a double click's action."""
        number, arc_mm = _number(event), self._arc_at(event)
        if number is not None:
            remove = partial(remove_station, case, self._rim, number)
            return (ContextMenuItem(tr("Remove this station"), remove, removes=True),)
        if arc_mm is None:
            return ()
        add = partial(self._add, case, arc_mm)
        return (ContextMenuItem(tr("Add a station here"), add),)

    def wheel(self, case: Case, event: PointerEvent, steps: float) -> bool:
        """Raise the station under the pointer; by key the selected one."""
        number = self._rim.selected if event.by_key else _number(event)
        if number is None:
            return False
        return raise_station(case, number, steps * NUDGE_MM * (0.2 if event.fine else 1.0))

    def nudge(self, case: Case, event: PointerEvent, right: int, up: int) -> bool:
        """Raise the selected station by up and down, move it along the edge by left and right."""
        if self._rim.selected is None:
            return False
        step = NUDGE_MM * (10.0 if event.coarse else 1.0) * (0.1 if event.fine else 1.0)
        return nudge_station(case, self._rim, self._rim.selected, right * step, up * step)

    def _add(self, case: Case, arc_mm: float) -> None:
        add_station(case, self._rim, arc_mm)

    def _arc_at(self, event: PointerEvent) -> float | None:
        """Return the place of the edge near the pointer, as an arc length."""
        rim, place = self._rim.rim, event.place_mm(0.0)
        if rim is None or place is None:
            return None
        arc_mm = rim.edge.nearest_arc_mm(*place[:2])
        away = np.hypot(*(np.array(rim.edge.point_at(arc_mm)) - place[:2]))
        return arc_mm if away < NEAR_MM else None


def add_station(case: Case, rim: RimModel, arc_mm: float) -> bool:
    """Add a station on the rim as it runs, and select it; return False where one is near."""
    design = case.record.design
    if rim.rim is None or design is None or design.finish is None:
        return False
    stations = added_station(rim.rim, design.finish.rim, arc_mm)
    if stations is None:
        return False
    case.apply(with_stations(design, stations), tr("Add a station to the rim"))
    rim.select(len(stations) - 1)
    return True


def remove_station(case: Case, rim: RimModel, number: int) -> None:
    """Remove a station."""
    design = case.record.design
    assert design is not None
    assert design.finish is not None
    stations = design.finish.rim
    rim.select(None)
    kept = (*stations[:number], *stations[number + 1 :])
    case.apply(with_stations(design, kept), tr("Remove a station of the rim"))


def raise_station(case: Case, number: int, by_mm: float) -> bool:
    """Raise a station; steps in a row are one undo step."""
    design = case.record.design
    if design is None or design.finish is None:
        return False
    stations = raised_station(design.finish.rim, number, by_mm)
    case.apply(with_stations(design, stations), _raised(), f"rim:{number}:height")
    return True


def nudge_station(case: Case, rim: RimModel, number: int, along_mm: float, up_mm: float) -> bool:
    """Move a station along the edge, from the medial border over the heel, and up.

    Steps in a row are one undo step.
    """
    if along_mm == 0:
        return raise_station(case, number, up_mm)
    design, placed = case.record.design, rim.placed.get(number)
    if design is None or design.finish is None or rim.rim is None or placed is None:
        return False
    arc_mm = placed.arc_mm + along_mm
    stations = moved_station(rim.rim, design.finish.rim, number, arc_mm, placed.height_mm + up_mm)
    case.apply(with_stations(design, stations), _moved(), f"rim:{number}:along")
    return True


def _carry(
    case: Case, design: InsoleDesign, rim: Rim, placed: PlacedStation, press: PointerEvent
) -> Gesture:
    """Let a station follow the pointer: up and down, or along the edge, as the drag began."""
    assert design.finish is not None
    stations, changed, event = design.finish.rim, design, press
    axes, wanted = _axes_at(rim, placed.arc_mm, press.look), None
    while event.phase is not Phase.RELEASE:
        event = yield
        way_px = np.array([event.pixel[0] - press.pixel[0], press.pixel[1] - event.pixel[1]])
        if wanted is None and not event.by_key and np.hypot(*way_px) < LOCK_PX:
            continue
        way_mm = way_px * press.look.mm_per_px
        if wanted is None:
            wanted = _wanted(axes, way_mm, event.by_key)
        up_mm, along_mm = wanted * (way_mm @ axes.up, way_mm @ axes.along)
        moved = moved_station(
            rim, stations, placed.number, placed.arc_mm + along_mm, placed.height_mm + up_mm
        )
        changed = with_stations(design, moved)
        case.preview(changed)
    case.apply(changed, _raised() if wanted is None or wanted[0] else _moved())


def _carry_toe_line(
    case: Case, design: InsoleDesign, heads: HeadsParabola, press: PointerEvent
) -> Gesture:
    """Let the toe line follow the pointer ahead of the heads."""
    finish, start, event = design.finish, press.place_mm(0.0), press
    assert finish is not None
    allowed, changed = ranges_of(Finish)["toe_line_mm"], design
    while event.phase is not Phase.RELEASE:
        event = yield
        now = event.place_mm(0.0)
        if start is None or now is None:
            continue
        moved_mm = float(heads.ahead_mm(*now[:2]) - heads.ahead_mm(*start[:2]))
        ahead_mm = allowed.nearest(rounded(finish.toe_line_mm + moved_mm, TOE_LINE_STEP_MM))
        changed = replace(design, finish=replace(finish, toe_line_mm=ahead_mm))
        case.preview(changed)
    case.apply(changed, tr("Move the toe line"))


def _wanted(axes: _Axes, way_mm: FloatArray, by_key: bool) -> FloatArray:
    """Return which of height and place a drag changes, as factors (2,)."""
    if by_key:
        return np.ones(2)
    is_up = abs(way_mm @ axes.up) >= abs(way_mm @ axes.along)
    return np.array([1.0, 0.0] if is_up else [0.0, 1.0])


def _axes_at(rim: Rim, arc_mm: float, look: ViewTransform) -> _Axes:
    """Return the screen's directions at a place of the edge.

    Seen from above or below, the height has none of its own: a drag outwards raises the rim.
    """
    ahead, behind = (np.array(rim.edge.point_at(arc_mm + way)) for way in (2.0, -2.0))
    tangent = (ahead - behind) / max(float(np.hypot(*(ahead - behind))), 1e-9)
    outward = _outward(rim, arc_mm, tangent)
    up = _on_screen(look, np.array([0.0, 0.0, 1.0]))
    if not up.any():
        up = _on_screen(look, np.array([*outward, 0.0]))
    return _Axes(up, _on_screen(look, np.array([*tangent, 0.0])))


def _outward(rim: Rim, arc_mm: float, tangent: FloatArray) -> FloatArray:
    normal = np.array([tangent[1], -tangent[0]])
    from_middle = np.array(rim.edge.point_at(arc_mm)) - rim.edge.points_mm.mean(axis=0)
    return normal if normal @ from_middle > 0 else -normal


def _on_screen(look: ViewTransform, direction: FloatArray) -> FloatArray:
    """Return a direction as seen, a unit vector (2,); zero where it is seen end-on."""
    seen = np.array([direction @ look.right, direction @ look.up])
    length = float(np.hypot(*seen))
    return seen / length if length > LEAST_SEEN else np.zeros(2)


def _number(event: PointerEvent) -> int | None:
    """Return the number of the station under the pointer."""
    handle = event.handle
    if handle is None or not handle.startswith(PREFIX):
        return None
    return int(handle.removeprefix(PREFIX))


def _raised() -> str:
    return tr("Raise a station of the rim")


def _moved() -> str:
    return tr("Move a station of the rim")
