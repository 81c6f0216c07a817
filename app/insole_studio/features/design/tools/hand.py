"""The hand that grabs elements of the prescription in a view, whatever their type."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TypeVar

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.insole.elements import Correction
from insole_core.insole.elements.correction import STAGES
from insole_core.insole.grips import Grip, Pull
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.primitives.outline_curve import inside_curve
from insole_core.workflows.foot_landmarks import metatarsal_line
from insole_studio.document.case import Case
from insole_studio.features.design.tools.tool import (
    ContextMenuItem,
    SurfaceContext,
    nudge_mm,
    rise_mm,
)
from insole_studio.scene.pointer import Gesture, Handle, Phase, PointerEvent
from insole_studio.scene.view_camera import Subject
from insole_studio.texts import tr, translate_core_message

FINE = 0.2
"""Share of its step that a notch of the wheel is worth while Ctrl is held."""
_Element = TypeVar("_Element", bound=Correction)
Settle = Callable[[Correction, Grip, PointerEvent], Correction]


@dataclass(frozen=True)
class Hand:
    """Grabs the elements of some stages.

    Parameters
    ----------
    behind_heads_mm
        Distance behind the heads to which a pad snaps, by the clinic's rules.
    """

    behind_heads_mm: float
    stages: tuple[str, ...] = STAGES

    def held(self, case: Case) -> Correction | None:
        """Return the selected element if this hand can grab it."""
        element = selected_element(case)
        return element if element is not None and element.stage in self.stages else None

    def handles(self, case: Case, surface: SurfaceContext) -> tuple[Handle, ...]:
        """Return the handles of the selected element."""
        element = self.held(case)
        return () if element is None else element_handles(case, element, surface)

    def at(self, case: Case, event: PointerEvent) -> Correction | None:
        """Return the last element under the pointer, of those that are always drawn."""
        design = case.record.design
        seen = () if design is None else reversed(design.of_stage(*self.stages))
        return next((one for one in seen if one.is_seen and _is_on(case, one, event)), None)

    def grab(self, case: Case, event: PointerEvent) -> Gesture | None:
        """Start dragging the handle or the element under the pointer; None if there is neither."""
        element = self.held(case)
        grip = None if element is None else _grip(case, element, event.handle)
        if element is None or grip is None:
            element = self.at(case, event)
            if element is None:
                return None
            case.select(element.id)
            grip = next(grip for grip in _grips(case, element) if grip.has_keys)
        return dragged(case, event, element, grip, partial(self.settled, case))

    def settled(self, case: Case, element: _Element, grip: Grip, event: PointerEvent) -> _Element:
        """Return an element at a usual place that is near it, unless Ctrl is held."""
        line = metatarsal_line(case.record)
        if event.fine or line is None or grip.kind != "move":
            return element
        return element.settled(line[:, :2], self.behind_heads_mm)

    def wheel(self, case: Case, event: PointerEvent, steps: float) -> bool:
        """Pull the selected element by notches; by the wheel only if the pointer is on it."""
        element, design = self.held(case), case.record.design
        if element is None or design is None or not (event.by_key or self._is_over(case, event)):
            return False
        turned = [grip for grip in _grips(case, element) if grip.notch_mm]
        if not turned:
            return False
        grip = next((grip for grip in turned if grip.name == event.handle), turned[0])
        turn_by_notches(case, element, grip, steps * (FINE if event.fine else 1.0))
        return True

    def nudge(self, case: Case, event: PointerEvent, right: int, up: int) -> bool:
        """Pull the selected element by an arrow key; steps in a row are one undo step."""
        element, design, foot = self.held(case), case.record.design, case.foot
        if element is None or design is None or foot is None:
            return False
        grip = next((grip for grip in element.grips(foot) if grip.has_keys), None)
        if grip is None:
            return False
        way = nudge_mm(event, right, up)
        pull = Pull(np.zeros(2), way, by_key=True, is_fine=event.fine)
        changed = design.with_changed(element.pulled(grip.name, pull, foot))
        case.apply(changed, translate_core_message(grip.sentence), f"{element.id}:nudge")
        return True

    def offers(self, case: Case, event: PointerEvent) -> tuple[ContextMenuItem, ...]:
        """Return the item that removes the pad at the pointer, or the pad of the chosen handle."""
        pad = self.at(case, event) if event.handle is None else self.held(case)
        if pad is None or not pad.is_seen:
            return ()
        return (ContextMenuItem(tr("Remove the pad"), partial(_remove, case, pad), removes=True),)

    def _is_over(self, case: Case, event: PointerEvent) -> bool:
        """Return whether the pointer is on the selected element, and on no other before it."""
        element, found = self.held(case), self.at(case, event)
        if element is None or found is not None:
            return found == element
        return _is_on(case, element, event)


def selected_element(case: Case) -> Correction | None:
    """Return the selected correction of the shown design, if it is switched on."""
    design, selection = case.shown.design, case.selection
    element = None if design is None or selection is None else design.correction(selection)
    return element if element is not None and element.enabled else None


def element_handles(case: Case, element: Correction, surface: SurfaceContext) -> tuple[Handle, ...]:
    """Return the handles of an element."""
    return tuple(
        Handle(
            grip.name,
            surface.place(*grip.place_mm),
            translate_core_message(grip.hint),
            grip.kind,
        )
        for grip in _grips(case, element)
    )


def dragged(
    case: Case, press: PointerEvent, element: Correction, grip: Grip, settle: Settle
) -> Gesture:
    """Let an element follow the pointer by one of its grips; a new one is added if it changes.

    Parameters
    ----------
    settle
        Returns the element as it stays where the pointer is.
    """
    foot, design = _worked_on(case)
    start, changed, event = press.place_mm(0.0), element, press
    while event.phase is not Phase.RELEASE:
        event = yield
        now = event.place_mm(0.0)
        pull = Pull(
            None if start is None else start[:2],
            None if now is None else now[:2],
            rise_mm(press, event),
        )
        pulled = element.pulled(grip.name, pull, foot)
        changed = pulled if pulled == element else settle(pulled, grip, event)
        case.preview(design.with_set(changed))
    if changed == element:
        case.end_preview()
    else:
        case.apply(design.with_set(changed), translate_core_message(grip.sentence))


def turn_by_notches(case: Case, element: Correction, grip: Grip, notches: float) -> None:
    """Pull a grip by notches of the wheel; turns in a row are one undo step."""
    foot, design = _worked_on(case)
    changed = element.pulled(grip.name, Pull(up_mm=notches * grip.notch_mm), foot)
    sentence = translate_core_message(grip.sentence)
    case.apply(design.with_set(changed), sentence, f"{element.id}:{grip.name}:wheel")


def seen_from_above(event: PointerEvent) -> bool:
    """Return whether the dorsum of the foot is in front, where the insole cannot be touched."""
    return event.subject is Subject.FOOT and bool(event.look.back[2] > 0.3)


def _worked_on(case: Case) -> tuple[Foot, InsoleDesign]:
    foot, design = case.foot, case.record.design
    assert foot is not None, "what is grabbed lies on a foot"
    assert design is not None, "what is grabbed belongs to a design"
    return foot, design


def _grips(case: Case, element: Correction) -> tuple[Grip, ...]:
    return () if case.foot is None else element.grips(case.foot)


def _grip(case: Case, element: Correction, name: str | None) -> Grip | None:
    return next((grip for grip in _grips(case, element) if grip.name == name), None)


def _is_on(case: Case, element: Correction, event: PointerEvent) -> bool:
    """Return whether the pointer is within the outline of an element."""
    if event.surface_mm is None or case.foot is None or seen_from_above(event):
        return False
    place = event.surface_mm[:2]
    return any(inside_curve(line, place) for line in element.lines(case.foot))


def _remove(case: Case, pad: Correction) -> None:
    _, design = _worked_on(case)
    case.apply(design.with_removed(pad.id), tr("Remove a correction"))
