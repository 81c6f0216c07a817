"""The pelott tool: click to place, drag to move, handles to stretch, turn and raise."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.design import InsoleDesign, Pelott
from insole_core.insole.egg import egg_outline
from insole_core.insole.limits import CORRECTION_RANGES
from insole_studio.scene.camera import Subject
from insole_studio.scene.pointer import Handle, Phase, PointerEvent
from insole_studio.texts import tr
from insole_studio.tools.tool import Gesture, Ground, rise_mm, rounded
from insole_studio.workbench.case import Case

PLACE_STEP_MM = 0.1
HEIGHT_STEP_MM = 0.5
NUDGE_MM = 0.5
TURN_STEP_DEG = 0.5
TURN_HANDLE_GAP_MM = 12.0

Reshape = Callable[[Pelott, PointerEvent, PointerEvent], Pelott]


class PelottTool:
    """Places pads of the template shape and reshapes the selected one."""

    key = "pelott"

    def __init__(self) -> None:
        self.template = Pelott(centre_mm=(0.0, 0.0))

    def hint(self, case: Case) -> str:
        """Say in one short sentence what one can do now."""
        if selected_pelott(case) is None:
            return tr("Click on the sole to place a pelott")
        return tr("Drag to move, handles to stretch, turn and raise, wheel to raise by 0.5 mm")

    def handles(self, case: Case, ground: Ground) -> tuple[Handle, ...]:
        """Give the spots that can be grabbed."""
        return pelott_handles(case, ground)

    def press(self, case: Case, event: PointerEvent, ground: Ground) -> Gesture | None:
        """Grab a handle or a pad, or place a new one."""
        return grab_pelott(case, event) or self._place(case, event, ground)

    def wheel(self, case: Case, event: PointerEvent, steps: float) -> bool:
        """Raise the pad under the pointer."""
        return raise_pelott(case, event, steps)

    def nudge(self, case: Case, event: PointerEvent, right: int, up: int) -> bool:
        """Move the selected pad by a little."""
        return nudge_pelott(case, event, right, up)

    def _place(self, case: Case, event: PointerEvent, ground: Ground) -> Gesture | None:
        place = event.surface_mm
        if case.record.design is None or place is None or _seen_from_above(event):
            return None
        if not ground.covers(place[0], place[1]):
            return None
        new = Pelott(
            centre_mm=_xy(place),
            length_mm=self.template.length_mm,
            width_mm=self.template.width_mm,
            height_mm=self.template.height_mm,
            egg_ratio=self.template.egg_ratio,
        )
        return _follow(case, event, new, case.record.design.with_added, tr("Place a pelott"))


def selected_pelott(case: Case) -> Pelott | None:
    """Give the selected correction if it is a pelott of the shown design."""
    design = case.shown.design
    if design is None or case.selection is None:
        return None
    correction = design.correction(case.selection)
    return correction if isinstance(correction, Pelott) else None


def pelott_handles(case: Case, ground: Ground) -> tuple[Handle, ...]:
    """Give the handles of the selected pelott."""
    pad = selected_pelott(case)
    if pad is None:
        return ()
    front, back = _reach(pad)
    along, across = _axes(pad)
    centre = np.array(pad.centre_mm)
    spots = {
        "move": centre,
        "length": centre + front * along,
        "width": centre + pad.width_mm / 2 * across,
        "turn": centre + (front + TURN_HANDLE_GAP_MM) * along,
        "height": centre - back * along,
    }
    return tuple(
        Handle(name, ground.place(*spot), _HINTS[name](), "move" if name == "move" else "size")
        for name, spot in spots.items()
    )


def grab_pelott(case: Case, event: PointerEvent) -> Gesture | None:
    """Begin to drag the handle or the pad under the pointer; None where there is neither."""
    design = case.record.design
    if design is None:
        return None
    pad = selected_pelott(case)
    if pad is not None and event.handle in _RESHAPES:
        reshape, sentence = _RESHAPES[event.handle]
        return _reshape(case, event, pad, reshape, sentence())
    pad = pelott_at(design, event)
    if pad is None:
        return None
    case.select(pad.id)
    return _reshape(case, event, pad, _moved, tr("Move the pelott"))


def pelott_at(design: InsoleDesign, event: PointerEvent) -> Pelott | None:
    """Give the last switched-on pelott whose outline holds the touched place."""
    if event.surface_mm is None or _seen_from_above(event):
        return None
    place = event.surface_mm[:2]
    pads = [c for c in design.corrections if isinstance(c, Pelott) and c.enabled]
    return next((pad for pad in reversed(pads) if _holds(pad, place)), None)


def raise_pelott(case: Case, event: PointerEvent, steps: float) -> bool:
    """Raise the selected pad that is under the pointer by half a millimetre a step."""
    design = case.record.design
    pad = selected_pelott(case)
    if design is None or pad is None or pelott_at(design, event) != pad:
        return False
    step = 0.1 if event.fine else HEIGHT_STEP_MM
    raised = replace(
        pad, height_mm=_within("height_mm", rounded(pad.height_mm + steps * step, 0.1))
    )
    case.apply(design.with_changed(raised), tr("Raise the pelott"), f"{pad.id}:wheel")
    return True


def nudge_pelott(case: Case, event: PointerEvent, right: int, up: int) -> bool:
    """Move the selected pad along the picture by half a millimetre."""
    design = case.record.design
    pad = selected_pelott(case)
    if design is None or pad is None:
        return False
    distance = NUDGE_MM * (10.0 if event.coarse else 1.0) * (0.1 if event.fine else 1.0)
    step = (right * event.look.right + up * event.look.up)[:2]
    step = step / max(float(np.linalg.norm(step)), 1e-9) * distance
    moved = _at(pad, np.array(pad.centre_mm) + step, 0.01)
    case.apply(design.with_changed(moved), tr("Move the pelott"), f"{pad.id}:nudge")
    return True


def _follow(
    case: Case,
    event: PointerEvent,
    pad: Pelott,
    into: Callable[[Pelott], InsoleDesign],
    sentence: str,
) -> Gesture:
    """Place a new pad where the pointer is until it is let go."""
    case.select(pad.id)
    case.preview(into(pad))
    while event.phase is not Phase.RELEASE:
        event = yield
        if event.surface_mm is not None:
            pad = _at(pad, event.surface_mm[:2])
            case.preview(into(pad))
    case.apply(into(pad), sentence)


def _reshape(
    case: Case, press: PointerEvent, pad: Pelott, reshape: Reshape, sentence: str
) -> Gesture:
    """Drag: the pad of the press, changed by what the pointer did since."""
    design = case.record.design
    assert design is not None
    changed, event = pad, press
    while event.phase is not Phase.RELEASE:
        event = yield
        changed = reshape(pad, press, event)
        case.preview(design.with_changed(changed))
    case.apply(design.with_changed(changed), sentence)


def _moved(pad: Pelott, press: PointerEvent, event: PointerEvent) -> Pelott:
    start, now = press.place_mm(0.0), event.place_mm(0.0)
    if start is None or now is None:
        return pad
    return _at(pad, np.array(pad.centre_mm) + (now - start)[:2])


def _lengthened(pad: Pelott, _press: PointerEvent, event: PointerEvent) -> Pelott:
    offset = _offset(pad, event)
    if offset is None:
        return pad
    share = float(offset @ _axes(pad)[0]) / _reach(pad)[0]
    length = rounded(pad.length_mm * share, HEIGHT_STEP_MM)
    return replace(pad, length_mm=_within("length_mm", length))


def _widened(pad: Pelott, _press: PointerEvent, event: PointerEvent) -> Pelott:
    offset = _offset(pad, event)
    if offset is None:
        return pad
    width = rounded(2 * float(offset @ _axes(pad)[1]), HEIGHT_STEP_MM)
    return replace(pad, width_mm=_within("width_mm", width))


def _turned(pad: Pelott, _press: PointerEvent, event: PointerEvent) -> Pelott:
    offset = _offset(pad, event)
    if offset is None:
        return pad
    turn = float(np.degrees(np.arctan2(-offset[0], offset[1])))
    return replace(pad, turn_deg=rounded(turn, TURN_STEP_DEG))


def _raised(pad: Pelott, press: PointerEvent, event: PointerEvent) -> Pelott:
    height = rounded(pad.height_mm + rise_mm(press, event) * 0.25, 0.1)
    return replace(pad, height_mm=_within("height_mm", height))


def _offset(pad: Pelott, event: PointerEvent) -> FloatArray | None:
    place = event.place_mm(0.0)
    return None if place is None else np.asarray(place[:2] - np.array(pad.centre_mm))


def _at(pad: Pelott, xy: FloatArray, step_mm: float = PLACE_STEP_MM) -> Pelott:
    return replace(pad, centre_mm=(rounded(float(xy[0]), step_mm), rounded(float(xy[1]), step_mm)))


def _axes(pad: Pelott) -> tuple[FloatArray, FloatArray]:
    """Unit vectors along the pad (to its blunt end) and across."""
    angle = np.radians(pad.turn_deg)
    cos, sin = np.cos(angle), np.sin(angle)
    return np.array([-sin, cos]), np.array([cos, sin])


def _reach(pad: Pelott) -> tuple[float, float]:
    """How far the outline lies before and behind the apex."""
    upright = egg_outline(replace(pad, centre_mm=(0.0, 0.0), turn_deg=0.0), 180)
    return float(upright[:, 1].max()), float(-upright[:, 1].min())


def _holds(pad: Pelott, place: FloatArray) -> bool:
    """Whether the place lies in the outline (ray crossing)."""
    start = egg_outline(pad, 120) - place
    end = np.roll(start, -1, axis=0)
    spans = (start[:, 1] > 0) != (end[:, 1] > 0)
    start, end = start[spans], end[spans]
    crossing = start[:, 0] - start[:, 1] * (end - start)[:, 0] / (end - start)[:, 1]
    return bool((crossing > 0).sum() % 2)


def _within(name: str, value: float) -> float:
    allowed = CORRECTION_RANGES[Pelott][name]
    return float(np.clip(value, allowed.least, allowed.greatest))


def _xy(place: FloatArray) -> tuple[float, float]:
    return rounded(float(place[0]), PLACE_STEP_MM), rounded(float(place[1]), PLACE_STEP_MM)


def _seen_from_above(event: PointerEvent) -> bool:
    """Whether the back of the foot is in front, where no pad can lie."""
    return event.subject is Subject.FOOT and bool(event.look.back[2] > 0.3)


_HINTS: dict[str, Callable[[], str]] = {
    "move": lambda: tr("Drag to move the pelott"),
    "length": lambda: tr("Drag to make it longer or shorter"),
    "width": lambda: tr("Drag to make it wider or narrower"),
    "turn": lambda: tr("Drag to turn the pelott"),
    "height": lambda: tr("Drag up to raise the pelott, down to lower it"),
}
_RESHAPES: dict[str | None, tuple[Reshape, Callable[[], str]]] = {
    "move": (_moved, lambda: tr("Move the pelott")),
    "length": (_lengthened, lambda: tr("Stretch the pelott")),
    "width": (_widened, lambda: tr("Widen the pelott")),
    "turn": (_turned, lambda: tr("Turn the pelott")),
    "height": (_raised, lambda: tr("Raise the pelott")),
}
