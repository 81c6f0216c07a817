"""The pad tool: click to place, drag to move, handles to stretch, turn and raise."""

from __future__ import annotations

from dataclasses import replace

from insole_core.insole.elements import Pelott, new_id
from insole_core.insole.fields import Place
from insole_core.insole.grips import place_at
from insole_studio.document.case import Case
from insole_studio.features.design.correction_names import name_of
from insole_studio.features.design.tools.hand import Hand, seen_from_above
from insole_studio.features.design.tools.metatarsal_line import clearance_text, usual_place
from insole_studio.features.design.tools.tool import ContextMenuItem, SurfaceContext, Tool
from insole_studio.scene.pointer import Gesture, Handle, Phase, PointerEvent
from insole_studio.texts import tr


class PelottTool(Tool):
    """Places pads of the template shape and reshapes the selected one."""

    key = "pelott"

    def __init__(self, pelott: Pelott, behind_heads_mm: float) -> None:
        self._pelott = pelott
        self._hand = Hand(behind_heads_mm, ("pad",))
        self.reset()

    def reset(self) -> None:
        """Forget what was set for the case before."""
        self.template = self._pelott

    def hint(self, case: Case) -> str:
        """Return one short sentence on what the user can do now."""
        held = self._hand.held(case)
        if held is None or not held.has_grips:
            return tr("Click on the sole to place: {name}").format(name=name_of(self.template))
        return clearance_text(case) or tr(
            "Drag to move, handles to stretch, turn and raise, wheel to raise by 0.5 mm"
        )

    def handles(self, case: Case, surface: SurfaceContext) -> tuple[Handle, ...]:
        """Return the handles of the selected pad."""
        return self._hand.handles(case, surface)

    def start(self, case: Case) -> Place | None:
        """Return the usual position of such a pad."""
        return usual_place(case.record, self.template, self._hand.behind_heads_mm)

    def offers(
        self, case: Case, event: PointerEvent, _surface: SurfaceContext
    ) -> tuple[ContextMenuItem, ...]:
        """Return the item that removes the pad at the pointer."""
        return self._hand.offers(case, event)

    def press(self, case: Case, event: PointerEvent, surface: SurfaceContext) -> Gesture | None:
        """Grab a handle or a pad, or place a new pad."""
        return self._hand.grab(case, event) or self._place(case, event, surface)

    def wheel(self, case: Case, event: PointerEvent, steps: float) -> bool:
        """Raise the pad under the pointer."""
        return self._hand.wheel(case, event, steps)

    def nudge(self, case: Case, event: PointerEvent, right: int, up: int) -> bool:
        """Move the selected pad by one step."""
        return self._hand.nudge(case, event, right, up)

    def _place(self, case: Case, event: PointerEvent, surface: SurfaceContext) -> Gesture | None:
        place = event.surface_mm
        if case.record.design is None or place is None or seen_from_above(event):
            return None
        if not surface.covers(place[0], place[1]):
            return None
        fresh = case.stamped(replace(self.template, id=new_id()))
        return self._follow(case, event, replace(fresh, centre_mm=place_at(place)))

    def _follow(self, case: Case, event: PointerEvent, pad: Pelott) -> Gesture:
        """Place a new pad that follows the pointer until release."""
        design, foot = case.record.design, case.foot
        assert design is not None, "a pad is placed in a design"
        assert foot is not None, "a pad is placed on a foot"
        case.select(pad.id)
        case.preview(design.with_added(pad))
        (grip,) = (grip for grip in pad.grips(foot) if grip.has_keys)
        while event.phase is not Phase.RELEASE:
            event = yield
            if event.touched_mm:
                pad = replace(pad, centre_mm=place_at(event.touched_mm[-1]))
                pad = self._hand.settled(case, pad, grip, event)
                case.preview(design.with_added(pad))
        case.apply(design.with_added(pad), tr("Place: {name}").format(name=name_of(pad)))
