"""The outline tool: the edge of the insole as a closed curve through draggable points."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.cases.case_record import CaseRecord
from insole_core.errors import DesignError
from insole_core.foot.measures import usual_size_eu
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.fields import Place
from insole_core.insole.grips import PLACE_STEP_MM, place_at
from insole_core.insole.outline.insole_outline import insole_outline, outline_points
from insole_core.insole.outline.outline_drag import drag_weights
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_limits import LEAST_DRAWN_POINTS
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.primitives.outline_curve import closed_curve, crosses_itself
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_studio.document.case import Case
from insole_studio.features.design.tools.tool import (
    ContextMenuItem,
    SurfaceContext,
    Tool,
    nudge_mm,
)
from insole_studio.scene.pointer import Gesture, Handle, Phase, PointerEvent
from insole_studio.texts import tr

PREFIX = "outline:"
NEAR_MM = 12.0
"""Largest distance from the outline at which a double click adds a point."""
_STRIDE = 4


@dataclass(frozen=True)
class _Nudge:
    """What arrow keys have done in a row: the point, where all began, the way, where all are."""

    number: int
    start: tuple[Place, ...]
    shift: FloatArray
    moved: tuple[Place, ...]


class OutlineTool(Tool):
    """Tool that drags, adds and removes points of the outline."""

    key = "outline"

    def __init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        """Forget what was set for the case before."""
        self._refusal = ""
        self._last: int | None = None
        """The point dragged last, which the arrow keys move."""
        self._nudge: _Nudge | None = None
        self._following: tuple[int, ...] = ()
        """The points that follow the drag that is running."""
        self._sketch: tuple[Place, ...] = ()

    def hint(self, _case: Case) -> str:
        """Return what the user can do now, or why the last edit was rejected."""
        return self._refusal or tr(
            "Drag a point of the outline, and its neighbours follow; double click adds one on the "
            "line, or takes one away"
        )

    @property
    def sketch(self) -> tuple[Place, ...]:
        """The part of the outline that follows the drag."""
        return self._sketch

    def handles(self, case: Case, surface: SurfaceContext) -> tuple[Handle, ...]:
        """Return the points of the outline as handles; those that follow a drag are larger."""
        points = points_of(case.shown)
        hint = tr("Drag to change the outline of the insole; double click takes the point away")
        return tuple(
            Handle(f"{PREFIX}{i}", surface.place(*point), hint, self._kind(i))
            for i, point in enumerate(points)
        )

    def press(self, case: Case, event: PointerEvent, _surface: SurfaceContext) -> Gesture | None:
        """Grab a point."""
        number = _number(event)
        if number is None or case.record.design is None:
            return None
        return self._carry(case, case.record.design, number, event)

    def double_click(self, case: Case, event: PointerEvent, _surface: SurfaceContext) -> bool:
        """Remove the point under the pointer, or add one on the outline."""
        number = _number(event)
        if number is not None:
            self._remove(case, number)
            return True
        place = event.place_mm(0.0)
        if place is None or not is_near(points_of(case.record), place[:2]):
            return False
        self._add(case, place_at(place))
        return True

    def offers(
        self, case: Case, event: PointerEvent, _surface: SurfaceContext
    ) -> tuple[ContextMenuItem, ...]:
        """Return the item for a double click's action, and one that resets the outline."""
        number, place = _number(event), event.place_mm(0.0)
        found = []
        if number is not None:
            text = tr("Remove this point")
            found.append(ContextMenuItem(text, lambda: self._remove(case, number), removes=True))
        elif place is not None and is_near(points_of(case.record), place[:2]):
            here = place_at(place)
            found.append(ContextMenuItem(tr("Add a point here"), lambda: self._add(case, here)))
        design = case.record.design
        if design is not None and design.outline.source == "drawn":
            found.append(
                ContextMenuItem(tr("Back to the outline of the foot"), lambda: _to_foot(case))
            )
        return tuple(found)

    def nudge(self, case: Case, event: PointerEvent, right: int, up: int) -> bool:
        """Move the point dragged last by one step; steps in a row add up to one soft drag."""
        points, design = points_of(case.record), case.record.design
        if design is None or self._last is None or self._last >= len(points):
            return False
        before = self._nudge
        goes_on = before is not None and before.number == self._last and before.moved == points
        start, way = (before.start, before.shift) if before and goes_on else (points, np.zeros(2))
        shift = way + nudge_mm(event, right, up)
        wanted = _softly_moved(start, self._last, shift, 0.01)
        if self._refuse_crossing(wanted):
            return True
        self._nudge = _Nudge(self._last, start, shift, wanted)
        sentence, key = tr("Move a point of the outline"), f"{PREFIX}{self._last}:nudge"
        return self._apply(case, wanted, sentence, key)

    def _carry(self, case: Case, design: InsoleDesign, number: int, event: PointerEvent) -> Gesture:
        """Let a point follow the pointer, except where the outline would intersect itself."""
        points = kept = points_of(case.record)
        start = event.place_mm(0.0)
        self._refusal, self._last = "", number
        try:
            while event.phase is not Phase.RELEASE:
                event = yield
                now = event.place_mm(0.0)
                if start is None or now is None:
                    continue
                shift = (now - start)[:2]
                wanted = _softly_moved(points, number, shift) if shift.any() else points
                if not self._refuse_crossing(wanted):
                    kept = wanted
                    self._show_reach(points, kept)
                case.preview(with_drawn(design, kept))
        finally:
            self._following = self._sketch = ()
        if kept == points:
            case.end_preview()
        else:
            case.apply(with_drawn(design, kept), tr("Move a point of the outline"))

    def _kind(self, number: int) -> str:
        return "move" if number in self._following else "size"

    def _show_reach(self, before: tuple[Place, ...], after: tuple[Place, ...]) -> None:
        """Draw the part of the edge that has moved, and let its points stand out."""
        count = len(after)
        moved = [i for i in range(count) if before[i] != after[i]]
        self._following = tuple(moved)
        if len(moved) in (0, count):
            self._sketch = ()
            return
        first = next(i for i in moved if (i - 1) % count not in moved)
        curve = closed_curve(after)
        per_span = len(curve) // count
        around = (np.arange((len(moved) + 1) * per_span + 1) + (first - 1) * per_span) % len(curve)
        self._sketch = tuple((float(x), float(y)) for x, y in curve[around])

    def _add(self, case: Case, place: Place) -> None:
        wanted = with_added(points_of(case.record), place)
        if not self._refuse_crossing(wanted):
            self._apply(case, wanted, tr("Add a point to the outline"))

    def _remove(self, case: Case, number: int) -> None:
        points = points_of(case.record)
        wanted = points[:number] + points[number + 1 :]
        self._last = None
        if len(wanted) < LEAST_DRAWN_POINTS:
            self._refusal = tr("An outline needs at least {count} points; this one stays").format(
                count=LEAST_DRAWN_POINTS
            )
            case.end_preview()
        elif not self._refuse_crossing(wanted):
            self._apply(case, wanted, tr("Remove a point of the outline"))

    def _refuse_crossing(self, points: tuple[Place, ...]) -> bool:
        crosses = crosses_itself(closed_curve(points)[::_STRIDE])
        self._refusal = ""
        if crosses:
            self._refusal = tr("There the outline would cross itself; the last good place is kept")
        return crosses

    def _apply(
        self, case: Case, points: tuple[Place, ...], sentence: str, merge_key: str = ""
    ) -> bool:
        design = case.record.design
        assert design is not None
        case.apply(with_drawn(design, points), sentence, merge_key)
        return True


def points_of(record: CaseRecord) -> tuple[Place, ...]:
    """Return the draggable points of the insole's outline; none without a foot or an outline."""
    if record.foot is None or record.design is None:
        return ()
    try:
        return outline_points(record.foot, record.design, landmarks_of(record))
    except DesignError:  # the preview says it
        return ()


def curve_of(record: CaseRecord) -> FloatArray:
    """Return the insole's outline, (n, 2), mm; empty without a foot or an outline."""
    if record.foot is None or record.design is None:
        return np.zeros((0, 2))
    try:
        return insole_outline(record.foot, record.design, landmarks_of(record))
    except DesignError:  # the preview says it
        return np.zeros((0, 2))


def with_drawn(design: InsoleDesign, points: tuple[Place, ...]) -> InsoleDesign:
    """Return the design with an outline through these points."""
    return replace(design, outline=replace(design.outline, source="drawn", points_mm=points))


def proposed_size_eu(record: CaseRecord) -> float | None:
    """Return the shoe size of the design, else that of the foot; None where its length is a guess.

    Parameters
    ----------
    record
        The open case, with foot and design.
    """
    assert record.design is not None
    assert record.foot is not None
    return record.design.outline.shoe_size_eu or usual_size_eu(record.foot, landmarks_of(record))


def with_source(record: CaseRecord, source: str) -> Outline:
    """Return the outline with another source; a drawn one starts from the current outline.

    Parameters
    ----------
    record
        The open case, with foot and design.
    source
        Key of the outline's source.
    """
    assert record.design is not None
    outline = record.design.outline
    if source == "drawn":
        return replace(outline, source=source, points_mm=points_of(record))
    return replace(outline, source=source, points_mm=None)


def with_size(record: CaseRecord, size_eu: float) -> Outline:
    """Return the outline by the size of a shoe."""
    return replace(with_source(record, "shoe_size"), shoe_size_eu=size_eu)


def with_added(points: tuple[Place, ...], place: Place) -> tuple[Place, ...]:
    """Return the points with a new one inserted where it lies along the curve.

    Parameters
    ----------
    points
        Points of the closed outline, in order.
    place
        The new point (x, y), mm.
    """
    number = _span(points, np.array(place)) + 1
    return (*points[:number], place, *points[number:])


def is_near(points: tuple[Place, ...], place: FloatArray) -> bool:
    """Return whether a position (2,) is within `NEAR_MM` of the outline."""
    return bool(points) and bool(np.hypot(*(closed_curve(points) - place).T).min() < NEAR_MM)


def _span(points: tuple[Place, ...], place: FloatArray) -> int:
    """Return the index of the last point on the curve before a position (2,)."""
    curve = closed_curve(points)
    nearest = int(np.hypot(*(curve - place).T).argmin())
    return nearest * len(points) // len(curve)


def _to_foot(case: Case) -> None:
    design = case.record.design
    assert design is not None
    changed = replace(design, outline=with_source(case.record, "foot"))
    case.apply(changed, tr("Back to the outline of the foot"))


def _softly_moved(
    points: tuple[Place, ...], number: int, shift: FloatArray, step_mm: float = PLACE_STEP_MM
) -> tuple[Place, ...]:
    """Return the points with one of them moved and its neighbours following; others untouched."""
    weights = drag_weights(np.array(points), number, shift)
    return tuple(
        place_at(np.array(point) + weight * shift, step_mm) if weight > 0 else point
        for point, weight in zip(points, weights, strict=True)
    )


def _number(event: PointerEvent) -> int | None:
    """Return the index of the point under the pointer."""
    handle = event.handle
    if handle is None or not handle.startswith(PREFIX):
        return None
    return int(handle.removeprefix(PREFIX))
