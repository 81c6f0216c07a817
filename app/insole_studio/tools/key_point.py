"""The key point tool: name places on the skin."""

from __future__ import annotations

import numpy as np

from insole_core.cases.record import Annotations, KeyPoint
from insole_core.geometry.arrays import FloatArray
from insole_studio.scene.camera import Subject
from insole_studio.scene.pointer import Handle, Phase, PointerEvent
from insole_studio.texts import tr
from insole_studio.tools.tool import Gesture, Ground, Tool, rounded
from insole_studio.workbench.case import Case

NAMES = ("Heel", "1st head", "2nd head", "5th head", "2nd toe", "Arch")
PREFIX = "point:"


class KeyPointTool(Tool):
    """Places the next missing key point; points that are there can be dragged."""

    key = "key_point"

    def hint(self, case: Case) -> str:
        """Say in one short sentence what one can do now."""
        name = next_name(case.record.annotations)
        return tr("Click on the skin to mark: {name}. Drag a mark to move it").format(name=name)

    def handles(self, case: Case, ground: Ground) -> tuple[Handle, ...]:
        """Give the spots that can be grabbed."""
        if ground.subject is not Subject.FOOT:
            return ()
        return tuple(
            Handle(PREFIX + point.name, point.position_mm, tr("Drag to move the mark"))
            for point in case.shown.annotations.key_points
        )

    def press(self, case: Case, event: PointerEvent, _ground: Ground) -> Gesture | None:
        """Grab a mark or set the next."""
        if event.surface_mm is None or event.subject is not Subject.FOOT:
            return None
        if event.handle is not None:
            return _carry(case, event, event.handle.removeprefix(PREFIX), tr("Move a key point"))
        return _carry(case, event, next_name(case.record.annotations), tr("Mark a key point"))


def next_name(annotations: Annotations) -> str:
    """Give the first name that is not marked yet."""
    free = (name for name in NAMES if annotations.key_point(name) is None)
    numbered = f"Point {len(annotations.key_points) + 1}"
    return next(free, numbered)


def distances(annotations: Annotations) -> list[tuple[str, str, float]]:
    """Give the straight distance of each two key points, mm."""
    points = annotations.key_points
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
    x, y, z = (rounded(float(value), 0.01) for value in place)
    return annotations.with_key_point(KeyPoint(name, (x, y, z)))
