"""The line from which a rocker lets the underside rise, dragged along the foot."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from insole_core.geometry.rounding import rounded
from insole_core.insole.elements import Rocker
from insole_core.insole.fields import ranges_of
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.surface.rocker import heads_ahead, rocker_line
from insole_studio.document.case import Case
from insole_studio.features.design.tools.tool import SurfaceContext, nudge_mm
from insole_studio.scene.gesture import Gesture
from insole_studio.scene.pointer import Handle, Phase, PointerEvent
from insole_studio.texts import tr

ROCKER_LINE = "rocker_line"
STEP_MM, FINE_STEP_MM = 0.5, 0.05
_ALLOWED = ranges_of(Rocker)["behind_heads_mm"]


def selected_rocker(case: Case) -> Rocker | None:
    """Return the selected rocker of the shown design, if one is selected and switched on."""
    design = case.shown.design
    selected = None if design is None else design.found(case.selection, Rocker)
    return selected if selected is not None and selected.enabled else None


def rocker_handles(case: Case, surface: SurfaceContext) -> tuple[Handle, ...]:
    """Return the handle in the middle of the selected rocker's line."""
    rocker, foot = selected_rocker(case), case.foot
    if rocker is None or foot is None:
        return ()
    middle = rocker_line(foot, rocker).mean(axis=0)
    hint = tr("Drag to move the line from which the underside rises")
    return (Handle(ROCKER_LINE, surface.place(*middle.tolist()), hint, "size"),)


def carry_rocker_line(case: Case, press: PointerEvent) -> Gesture | None:
    """Let the selected rocker's line follow the pointer, along the foot."""
    rocker, design = selected_rocker(case), case.record.design
    if rocker is None or design is None:
        return None
    return _carry(case, design, rocker, press)


def nudge_rocker(case: Case, event: PointerEvent, right: int, up: int) -> bool:
    """Move the line of the selected rocker by an arrow key; steps in a row are one undo step."""
    rocker, design, foot = selected_rocker(case), case.record.design, case.foot
    if rocker is None or design is None or foot is None:
        return False
    ahead_mm = float(nudge_mm(event, right, up) @ heads_ahead(foot))
    step_mm = FINE_STEP_MM if event.fine else STEP_MM
    changed = _moved(design, rocker, ahead_mm, step_mm)
    case.apply(changed, tr("Move the rocker line"), f"{rocker.id}:line")
    return True


def _carry(case: Case, design: InsoleDesign, rocker: Rocker, press: PointerEvent) -> Gesture:
    foot, start, changed, event = case.foot, press.place_mm(0.0), design, press
    assert foot is not None, "a selected rocker belongs to a foot"
    ahead = heads_ahead(foot)
    while event.phase is not Phase.RELEASE:
        event = yield
        now = event.place_mm(0.0)
        if start is None or now is None:
            continue
        changed = _moved(design, rocker, float((np.array(now) - start)[:2] @ ahead), STEP_MM)
        case.preview(changed)
    case.apply(changed, tr("Move the rocker line"))


def _moved(design: InsoleDesign, rocker: Rocker, ahead_mm: float, step_mm: float) -> InsoleDesign:
    """Return the design with the rocker's line farther ahead, within its range."""
    behind_mm = _ALLOWED.nearest(rounded(rocker.behind_heads_mm - ahead_mm, step_mm))
    return design.with_changed(replace(rocker, behind_heads_mm=behind_mm))
