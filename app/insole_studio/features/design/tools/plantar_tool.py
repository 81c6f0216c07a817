"""The tool that lays a pressure map or a footprint by hand."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.insole.grips import place_at
from insole_core.pressure.laid_map import Placement
from insole_studio.document.case import Case
from insole_studio.document.plantar_view import PlantarView
from insole_studio.features.design.tools.tool import SurfaceContext, Tool, nudge_mm
from insole_studio.scene.pointer import Gesture, Handle, Phase, PointerEvent
from insole_studio.texts import tr

TURN = "plantar-turn"
STEP_DEG = 0.5
_ARM_MM = 90.0
_NEAR_MM = 20.0
"""Nearer to the middle a pointer cannot turn."""


class PlantarTool(Tool):
    """Drags the map over the foot, or turns it about its middle by a handle before the toes."""

    key = "plantar"

    def __init__(self, view: PlantarView) -> None:
        self._view = view

    def hint(self, case: Case) -> str:
        """Return one short sentence on what the user can do now."""
        if self._placement(case) is None:
            return tr("Lay a pressure map or a footprint under this foot first (Tools)")
        return tr("Drag the map to move it, the handle ahead of it to turn it; arrow keys move too")

    def handles(self, case: Case, surface: SurfaceContext) -> tuple[Handle, ...]:
        """Return the handle that turns the map."""
        shown = self._view.shown(case.shown.plantar)
        if shown is None:
            return ()
        foot = case.shown.foot
        ahead = _ARM_MM if foot is None else foot.length_mm / 2
        at = shown.placement.middle_mm + ahead * _toes_of(shown.placement)
        place = surface.place(float(at[0]), float(at[1]))
        return (Handle(TURN, place, tr("Drag around the middle to turn the map"), "size"),)

    def press(self, case: Case, event: PointerEvent, _surface: SurfaceContext) -> Gesture | None:
        """Grab the map, or its handle."""
        placement = self._placement(case)
        if placement is None or (event.surface_mm is None and event.handle != TURN):
            return None
        return self._drag(case, event, placement, is_turn=event.handle == TURN)

    def nudge(self, case: Case, event: PointerEvent, right: int, up: int) -> bool:
        """Move the map by an arrow key."""
        placement, foot = self._placement(case), case.record.current
        if placement is None or foot is None:
            return False
        x, y = nudge_mm(event, right, up)
        moved = self._view.placed(foot, placement.moved(float(x), float(y)))
        case.apply(moved, tr("Move the map"), "plantar:nudge")
        return True

    def _placement(self, case: Case) -> Placement | None:
        shown = self._view.shown(case.record.plantar)
        return None if shown is None else shown.placement

    def _drag(self, case: Case, press: PointerEvent, start: Placement, *, is_turn: bool) -> Gesture:
        foot, placement, event = case.record.current, start, press
        assert foot is not None, "a map lies under a foot"
        while event.phase is not Phase.RELEASE:
            event = yield
            placement = (_turned if is_turn else _moved)(start, press, event)
            case.preview(self._view.placed(foot, placement))
        if placement == start:
            case.end_preview()
        else:
            sentence = tr("Turn the map") if is_turn else tr("Move the map")
            case.apply(self._view.placed(foot, placement), sentence)


def _moved(start: Placement, press: PointerEvent, event: PointerEvent) -> Placement:
    """Follow the pointer across the plane of the insole."""
    way = _ground(event) - _ground(press)
    x, y = place_at(way)
    return start.moved(x, y)


def _turned(start: Placement, press: PointerEvent, event: PointerEvent) -> Placement:
    before, now = _ground(press) - start.middle_mm, _ground(event) - start.middle_mm
    if min(float(np.linalg.norm(before)), float(np.linalg.norm(now))) < _NEAR_MM:
        return start
    turn = np.degrees(np.arctan2(now[1], now[0]) - np.arctan2(before[1], before[0]))
    return start.turned(rounded(float(turn), STEP_DEG), start.middle_mm)


def _ground(event: PointerEvent) -> FloatArray:
    """Return where (2,) the line of sight meets the ground; seen edge-on, the point of the skin."""
    origin, direction = event.look.ray_at(*event.pixel)
    if abs(direction[2]) < 0.1:
        return np.asarray(origin[:2])
    return np.asarray((origin - direction * (origin[2] / direction[2]))[:2])


def _toes_of(placement: Placement) -> FloatArray:
    """Return the direction (2,) of the map's axis that is nearer to the toes."""
    way = placement.to_insole(np.array([[0.0, 1.0]]))[0] - placement.middle_mm
    return way if way[1] >= 0 else -way
