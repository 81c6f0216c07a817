"""The reference plane tool: a plane for visual comparison with the foot."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from insole_core.cases.case_record import Annotations, ReferencePlane
from insole_core.geometry.rounding import rounded
from insole_studio.document.case import Case
from insole_studio.features.design.tools.tool import SurfaceContext, Tool, rise_mm
from insole_studio.scene.pointer import Gesture, Handle, Phase, PointerEvent
from insole_studio.texts import tr

ARM_MM = 70.0
DEG_PER_MM = 0.5
ANGLE_STEP_DEG = 0.5
Turn = Callable[[ReferencePlane, float], ReferencePlane]


class PlaneTool(Tool):
    """Tool that places the plane by a click; its handles raise and tilt it."""

    key = "plane"

    def hint(self, case: Case) -> str:
        """Return one short sentence on what the user can do now."""
        if case.shown.annotations.plane is None:
            return tr("Click on the foot to put the reference plane through that place")
        return tr("Drag the middle up or down to raise the plane, its ends to turn it")

    def handles(self, case: Case, _surface: SurfaceContext) -> tuple[Handle, ...]:
        """Return the handles of the plane."""
        plane = case.shown.annotations.plane
        if plane is None:
            return ()
        arms = {"plane-raise": (0, 0), "plane-pitch": (0, ARM_MM), "plane-roll": (-ARM_MM, 0)}
        return tuple(
            Handle(name, _on_plane(plane, *arm), _HINTS[name](), _kind(name))
            for name, arm in arms.items()
        )

    def press(self, case: Case, event: PointerEvent, _surface: SurfaceContext) -> Gesture | None:
        """Grab the plane, or place it at the point under the pointer."""
        annotations = case.record.annotations
        if event.handle in _TURNS and annotations.plane is not None:
            return _turn(case, event, annotations, annotations.plane, _TURNS[event.handle])
        if event.surface_mm is None:
            return None
        return _put(case, event, annotations)


def _put(case: Case, event: PointerEvent, annotations: Annotations) -> Gesture:
    plane = _through(annotations.plane or ReferencePlane((0.0, 0.0, 0.0)), event)
    case.preview(replace(annotations, plane=plane))
    while event.phase is not Phase.RELEASE:
        event = yield
        plane = _through(plane, event)
        case.preview(replace(annotations, plane=plane))
    case.apply(replace(annotations, plane=plane), tr("Place the reference plane"))


def _through(plane: ReferencePlane, event: PointerEvent) -> ReferencePlane:
    if not event.touched_mm:
        return plane
    x, y, z = (rounded(float(value), 0.1) for value in event.touched_mm[-1])
    return replace(plane, origin_mm=(x, y, z))


def _turn(
    case: Case, press: PointerEvent, annotations: Annotations, plane: ReferencePlane, turn: Turn
) -> Gesture:
    turned, event = plane, press
    while event.phase is not Phase.RELEASE:
        event = yield
        turned = turn(plane, rise_mm(press, event))
        case.preview(replace(annotations, plane=turned))
    case.apply(replace(annotations, plane=turned), tr("Turn the reference plane"))


def _raised(plane: ReferencePlane, rise: float) -> ReferencePlane:
    x, y, z = plane.origin_mm
    return replace(plane, origin_mm=(x, y, rounded(z + rise, 0.1)))


def _pitched(plane: ReferencePlane, rise: float) -> ReferencePlane:
    return replace(plane, pitch_deg=_angle(plane.pitch_deg + rise * DEG_PER_MM))


def _rolled(plane: ReferencePlane, rise: float) -> ReferencePlane:
    return replace(plane, roll_deg=_angle(plane.roll_deg + rise * DEG_PER_MM))


def _angle(angle_deg: float) -> float:
    return rounded(float(np.clip(angle_deg, -90, 90)), ANGLE_STEP_DEG)


def _on_plane(plane: ReferencePlane, x_mm: float, y_mm: float) -> tuple[float, float, float]:
    x, y, z = plane.origin_mm + plane.rotation @ np.array([x_mm, y_mm, 0.0])
    return float(x), float(y), float(z)


def _kind(name: str) -> str:
    return "move" if name == "plane-raise" else "size"


_HINTS: dict[str, Callable[[], str]] = {
    "plane-raise": lambda: tr("Drag up or down to raise or lower the plane"),
    "plane-pitch": lambda: tr("Drag up or down to tilt the toe end"),
    "plane-roll": lambda: tr("Drag up or down to tilt the plane sideways"),
}
_TURNS: dict[str | None, Turn] = {
    "plane-raise": _raised,
    "plane-pitch": _pitched,
    "plane-roll": _rolled,
}
