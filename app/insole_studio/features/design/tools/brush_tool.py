"""The brush tool: raise, lower or smooth the surface; each stroke is logged."""

from __future__ import annotations

from dataclasses import replace

from insole_core.insole.elements import BrushStroke, new_id
from insole_core.insole.fields import Place
from insole_core.insole.grips import place_at
from insole_studio.document.case import Case
from insole_studio.features.design.tools.hand import seen_from_above
from insole_studio.features.design.tools.tool import SurfaceContext, Tool
from insole_studio.scene.pointer import Gesture, Phase, PointerEvent
from insole_studio.texts import tr

LEAST_STEP_SHARE = 0.15
"""Share of the radius: closer points add nothing to a stroke."""


class BrushTool(Tool):
    """Tool whose drag is a stroke of the template's kind."""

    key = "brush"
    draws = True

    def __init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        """Forget what was set for the case before."""
        self.template = BrushStroke(points_mm=((0.0, 0.0),))

    def hint(self, _case: Case) -> str:
        """Return one short sentence on what the user can do now."""
        return _HINTS[self.template.mode]()

    def press(self, case: Case, event: PointerEvent, surface: SurfaceContext) -> Gesture | None:
        """Start a stroke."""
        place = event.surface_mm
        if case.record.design is None or place is None or seen_from_above(event):
            return None
        return self._stroke(case, event) if surface.covers(place[0], place[1]) else None

    def _stroke(self, case: Case, event: PointerEvent) -> Gesture:
        design = case.record.design
        assert design is not None
        points: tuple[Place, ...] = ()
        fresh = case.stamped(replace(self.template, id=new_id()))
        while True:
            before = points
            for place in map(place_at, event.touched_mm):
                if self._goes_on(points, place):
                    points = (*points, place)
            if points is not before:
                case.preview(design.with_added(replace(fresh, points_mm=points)))
            if event.phase is Phase.RELEASE:
                break
            event = yield
        stroke = replace(fresh, points_mm=points)
        case.apply(design.with_added(stroke), _SENTENCES[stroke.mode]())

    def _goes_on(self, points: tuple[Place, ...], place: Place) -> bool:
        if not points:
            return True
        dx, dy = place[0] - points[-1][0], place[1] - points[-1][1]
        return bool(dx * dx + dy * dy >= (LEAST_STEP_SHARE * self.template.radius_mm) ** 2)


_HINTS = {
    "push": lambda: tr("Drag over the sole to raise the surface there"),
    "pull": lambda: tr("Drag over the sole to lower the surface there"),
    "smooth": lambda: tr("Drag over the sole to smooth the surface there"),
}
_SENTENCES = {
    "push": lambda: tr("Raise with the brush"),
    "pull": lambda: tr("Lower with the brush"),
    "smooth": lambda: tr("Smooth with the brush"),
}
