"""The landmark tool: correct landmarks, and mark custom points on the skin."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from insole_core.cases.case_record import Annotations, KeyPoint
from insole_core.foot.landmarks import NAMES
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.workflows.foot_landmarks import SHOWN, landmarks_of
from insole_studio.document.case import Case
from insole_studio.features.design.tools.tool import ContextMenuItem, SurfaceContext, Tool
from insole_studio.scene.pointer import Gesture, Handle, Phase, PointerEvent
from insole_studio.scene.view_camera import Subject
from insole_studio.texts import tr

PREFIX = "point:"
AskText: TypeAlias = Callable[[str], str | None]
"""Given the text of now, asks for another one; None if cancelled."""
TOUCHED_MM = 12.0
"""A landmark nearer than this to the skin under the pointer is dragged along the skin."""
_NAMES: dict[str, Callable[[], str]] = {
    "pternion": lambda: tr("Rearmost point"),
    "heel_centre": lambda: tr("Heel centre"),
    "metatarsal_head_1": lambda: tr("1st head"),
    "metatarsal_head_2": lambda: tr("2nd head"),
    "metatarsal_head_5": lambda: tr("5th head"),
    "toe_tip_1": lambda: tr("Tip of the 1st toe"),
    "toe_tip_2": lambda: tr("Tip of the 2nd toe"),
    "arch_apex": lambda: tr("Arch apex"),
    "achilles_lower": lambda: tr("Achilles, lower"),
    "achilles_upper": lambda: tr("Achilles, upper"),
    "calcaneus_lower": lambda: tr("Calcaneus, lower"),
    "calcaneus_upper": lambda: tr("Calcaneus, upper"),
}


class KeyPointTool(Tool):
    """Tool that drags landmarks; a click elsewhere marks a custom point."""

    key = "key_point"

    def __init__(self) -> None:
        self.ask_text: AskText | None = None
        """Asks for the text of a custom point; None while nobody can be asked."""

    def hint(self, _case: Case) -> str:
        """Return one short sentence on what the user can do now."""
        return tr(
            "Drag a landmark to its place; a click marks a point, a double click writes on it"
        )

    def handles(self, case: Case, surface: SurfaceContext) -> tuple[Handle, ...]:
        """Return the landmarks and custom points as handles."""
        if surface.subject is not Subject.FOOT:
            return ()
        return tuple(
            Handle(PREFIX + name, place, landmark_hint(case, name))
            for name, place in shown_points(case).items()
        )

    def press(self, case: Case, event: PointerEvent, _surface: SurfaceContext) -> Gesture | None:
        """Grab a landmark or mark a custom point."""
        if event.subject is not Subject.FOOT:
            return None
        if event.handle is not None:
            name = event.handle.removeprefix(PREFIX)
            sentence = tr("Move: {name}").format(name=point_text(name))
            return _carry(case, event, name, sentence)
        if event.surface_mm is None:
            return None
        return _carry(case, event, next_name(case.record.annotations), tr("Mark a point"))

    def offers(
        self, case: Case, event: PointerEvent, _surface: SurfaceContext
    ) -> tuple[ContextMenuItem, ...]:
        """Return the items that write on the point under the pointer, and remove it."""
        if event.handle is None or event.subject is not Subject.FOOT:
            return ()
        name = event.handle.removeprefix(PREFIX)
        items = _forget_offers(case, name)
        if self.ask_text is not None and _is_custom(case, name):
            items = (
                ContextMenuItem(tr("Write on it…"), lambda: self._write_on(case, name)),
                *items,
            )
        return items

    def double_click(self, case: Case, event: PointerEvent, _surface: SurfaceContext) -> bool:
        """Let the user write on a custom point."""
        name = "" if event.handle is None else event.handle.removeprefix(PREFIX)
        if event.subject is not Subject.FOOT or not _is_custom(case, name):
            return False
        self._write_on(case, name)
        return True

    def _write_on(self, case: Case, name: str) -> None:
        """Ask for the text of a custom point, which is its name from then on."""
        text = None if self.ask_text is None else self.ask_text(name)
        annotations = case.record.annotations
        if not text or text == name:
            return
        new = free_name(annotations, text)
        points = tuple(
            replace(point, name=new) if point.name == name else point
            for point in annotations.key_points
        )
        case.apply(replace(annotations, key_points=points), tr("Write on a point"))


def _is_custom(case: Case, name: str) -> bool:
    return name not in NAMES and case.record.annotations.key_point(name) is not None


def _forget_offers(case: Case, name: str) -> tuple[ContextMenuItem, ...]:
    """Return the item that removes a custom point, or has a landmark detected again."""
    annotations = case.record.annotations
    kept = tuple(point for point in annotations.key_points if point.name != name)
    if kept == annotations.key_points:
        return ()
    text = tr("Find this landmark anew") if name in NAMES else tr("Remove this point")

    def forget() -> None:
        case.apply(replace(annotations, key_points=kept), text)

    return (ContextMenuItem(text, forget, removes=True),)


def shown_points(case: Case) -> dict[str, tuple[float, float, float]]:
    """Return the positions of landmarks and custom points, by name."""
    record = case.shown
    points = {
        name: _place(landmark.point)
        for name, landmark in landmarks_of(record).items()
        if name in SHOWN
    }
    points.update({p.name: p.position_mm for p in record.annotations.key_points})
    return points


def point_text(name: str) -> str:
    """Return the translated name of a landmark or point."""
    return _NAMES[name]() if name in _NAMES else name


def confidence(case: Case, name: str) -> float:
    """Return the confidence of a landmark, 0 to 1; placed and confirmed points have 1."""
    if case.shown.annotations.key_point(name) is not None:
        return 1.0
    return landmarks_of(case.shown)[name].confidence


def landmark_hint(case: Case, name: str) -> str:
    """Return the confidence of a landmark as text."""
    sure = round(100 * confidence(case, name))
    return tr("{name}: {sure} % sure. Drag to move it").format(name=point_text(name), sure=sure)


def next_name(annotations: Annotations) -> str:
    """Return a free name for the next custom point."""
    count = sum(point.name not in NAMES for point in annotations.key_points)
    numbers = range(count + 1, 2 * count + 2)
    names = (tr("Point {number}").format(number=number) for number in numbers)
    return next(name for name in names if annotations.key_point(name) is None)


def free_name(annotations: Annotations, wanted: str) -> str:
    """Return a name that no point has: the one that is wanted, or that with a number."""
    taken = {*NAMES, *(point.name for point in annotations.key_points)}
    numbered = (f"{wanted} {number}" for number in range(2, len(taken) + 3))
    return next(name for name in (wanted, *numbered) if name not in taken)


def distances(annotations: Annotations) -> list[tuple[str, str, float]]:
    """Return the straight distance between each two custom points: both names, and mm."""
    points = [point for point in annotations.key_points if point.name not in NAMES]
    return [
        (a.name, b.name, float(np.linalg.norm(np.subtract(a.position_mm, b.position_mm))))
        for i, a in enumerate(points)
        for b in points[i + 1 :]
    ]


def _carry(case: Case, press: PointerEvent, name: str, sentence: str) -> Gesture:
    """Let a point follow the pointer; one that leaves the foot at once stays where it is."""
    annotations, event = case.record.annotations, press
    start = shown_points(case).get(name)
    on_skin = _is_touched(press, start)
    is_placed = False
    while True:
        touched = event.touched_mm if on_skin else (_shifted(start, press, event),)
        if touched:
            marked = annotations.with_key_point(KeyPoint(name, _place(touched[-1])))
            case.preview(marked)
            is_placed = start is None or event is not press
        if event.phase is Phase.RELEASE:
            break
        event = yield
    if is_placed:
        case.apply(marked, sentence)
    else:
        case.end_preview()


def _is_touched(press: PointerEvent, start: tuple[float, float, float] | None) -> bool:
    """Return whether the pointer is on skin near the point, which may be hidden or at an edge."""
    if start is None:
        return True
    hit = press.surface_mm
    return hit is not None and bool(np.linalg.norm(hit - np.array(start)) < TOUCHED_MM)


def _shifted(
    start: tuple[float, float, float] | None, press: PointerEvent, event: PointerEvent
) -> FloatArray:
    """Return the point (3,) moved in the image plane by the pointer's movement."""
    look = press.look
    return np.array(start) + look.point_at(*event.pixel) - look.point_at(*press.pixel)


def _place(point: FloatArray) -> tuple[float, float, float]:
    x, y, z = (rounded(float(value), 0.01) for value in point)
    return x, y, z
