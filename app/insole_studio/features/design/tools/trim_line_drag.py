"""The front edge of a short shell, dragged by its points; a part of the rim tool."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from insole_core.cases.case_record import CaseRecord
from insole_core.errors import DesignError
from insole_core.insole.fields import Place
from insole_core.insole.grips import place_at
from insole_core.insole.outline.insole_outline import insole_outline
from insole_core.insole.outline.trim_line import trim_points
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_limits import check_design
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_studio.document.case import Case
from insole_studio.scene.pointer import Gesture, Phase, PointerEvent
from insole_studio.texts import tr


def shown_trim_points(record: CaseRecord) -> tuple[Place, ...]:
    """Return the points of the trim line; none where the insole has no such line."""
    design = record.design
    if design is None or design.shell is None or record.foot is None:
        return ()
    if design.outline.source == "drawn" or design.outline.extent != "three_quarter":
        return ()
    return trim_points(design.shell, design.side, landmarks_of(record))


def carry_trim_point(case: Case, number: int, press: PointerEvent) -> Gesture:
    """Let a point of the trim line follow the pointer, as far as that leaves a shell."""
    design, points = case.record.design, shown_trim_points(case.record)
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
