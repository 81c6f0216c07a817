"""The landmark tool: put right what was found, and mark further places on the skin."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from insole_core.cases.record import Annotations, KeyPoint
from insole_core.foot.landmarks import NAMES
from insole_core.geometry.arrays import FloatArray
from insole_studio.scene.camera import Subject
from insole_studio.scene.pointer import Handle, Phase, PointerEvent
from insole_studio.texts import tr
from insole_studio.tools.tool import Gesture, Ground, Tool, rounded
from insole_studio.workbench.case import Case
from insole_studio.workbench.landmarks import SHOWN, landmarks_of

PREFIX = "point:"
_NAMES: dict[str, Callable[[], str]] = {
    "pternion": lambda: tr("Rearmost point"),
    "heel_centre": lambda: tr("Heel centre"),
    "metatarsal_head_1": lambda: tr("1st head"),
    "metatarsal_head_2": lambda: tr("2nd head"),
    "metatarsal_head_5": lambda: tr("5th head"),
    "toe_tip_1": lambda: tr("1st toe"),
    "toe_tip_2": lambda: tr("2nd toe"),
    "arch_apex": lambda: tr("Arch apex"),
    "achilles_lower": lambda: tr("Achilles, lower"),
    "achilles_upper": lambda: tr("Achilles, upper"),
    "calcaneus_lower": lambda: tr("Calcaneus, lower"),
    "calcaneus_upper": lambda: tr("Calcaneus, upper"),
}


class KeyPointTool(Tool):
    """Landmarks can be dragged; a click elsewhere marks a further point."""

    key = "key_point"

    def hint(self, _case: Case) -> str:
        """Say in one short sentence what one can do now."""
        return tr("Drag a landmark to where it belongs; click on the skin to mark a further point")

    def handles(self, case: Case, ground: Ground) -> tuple[Handle, ...]:
        """Give the landmarks and points that can be grabbed."""
        if ground.subject is not Subject.FOOT:
            return ()
        return tuple(
            Handle(PREFIX + name, place, landmark_hint(case, name))
            for name, place in shown_points(case).items()
        )

    def press(self, case: Case, event: PointerEvent, _ground: Ground) -> Gesture | None:
        """Grab a landmark or mark a point."""
        if event.surface_mm is None or event.subject is not Subject.FOOT:
            return None
        if event.handle is not None:
            name = event.handle.removeprefix(PREFIX)
            sentence = tr("Move: {name}").format(name=point_text(name))
            return _carry(case, event, name, sentence)
        return _carry(case, event, next_name(case.record.annotations), tr("Mark a point"))


def shown_points(case: Case) -> dict[str, tuple[float, float, float]]:
    """Give the places of the landmarks and of the further points, by name."""
    record = case.shown
    points = {
        name: _place(landmark.point)
        for name, landmark in landmarks_of(record).items()
        if name in SHOWN
    }
    points.update({p.name: p.position_mm for p in record.annotations.key_points})
    return points


def point_text(name: str) -> str:
    """Give the name of a landmark or point to be read."""
    return _NAMES[name]() if name in _NAMES else name


def confidence(case: Case, name: str) -> float:
    """Give how sure a landmark is, 0 to 1; a point set by hand is sure."""
    landmark = landmarks_of(case.shown).get(name)
    return 1.0 if landmark is None else landmark.confidence


def landmark_hint(case: Case, name: str) -> str:
    """Say how sure a landmark is."""
    sure = round(100 * confidence(case, name))
    return tr("{name}: {sure} % sure. Drag to move it").format(name=point_text(name), sure=sure)


def next_name(annotations: Annotations) -> str:
    """Name the next further point."""
    count = sum(point.name not in NAMES for point in annotations.key_points)
    return tr("Point {number}").format(number=count + 1)


def distances(annotations: Annotations) -> list[tuple[str, str, float]]:
    """Give the straight distance of each two further points, mm."""
    points = [point for point in annotations.key_points if point.name not in NAMES]
    return [
        (a.name, b.name, float(np.linalg.norm(np.subtract(a.position_mm, b.position_mm))))
        for i, a in enumerate(points)
        for b in points[i + 1 :]
    ]


def _carry(case: Case, event: PointerEvent, name: str, sentence: str) -> Gesture:
    annotations = case.record.annotations
    marked = _marked(annotations, name, event.surface_mm)
    case.preview(marked)
    while event.phase is not Phase.RELEASE:
        event = yield
        if event.surface_mm is not None:
            marked = _marked(annotations, name, event.surface_mm)
            case.preview(marked)
    case.apply(marked, sentence)


def _marked(annotations: Annotations, name: str, place: FloatArray | None) -> Annotations:
    assert place is not None
    return annotations.with_key_point(KeyPoint(name, _place(place)))


def _place(point: FloatArray) -> tuple[float, float, float]:
    x, y, z = (rounded(float(value), 0.01) for value in point)
    return x, y, z
