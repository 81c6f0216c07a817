"""The pad tool: click to place, drag to move, handles to stretch, turn and raise."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.insole.elements import Pelott, new_id
from insole_core.insole.fields import Place, ranges_of
from insole_core.insole.pads.pad_heights import pad_outline
from insole_core.insole.pads.pad_shapes import local_outline, pad2insole, pad_size, resized
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.primitives.outline_curve import inside_curve
from insole_studio.document.case import Case
from insole_studio.features.design.correction_names import name_of
from insole_studio.features.design.tools.editable_pads import (
    is_arch,
    selected_pelott,
    selected_zone,
    with_zone,
)
from insole_studio.features.design.tools.metatarsal_line import (
    NEAR_MM,
    clearance,
    snapped,
    usual_place,
)
from insole_studio.features.design.tools.tool import (
    ContextMenuItem,
    SurfaceContext,
    Tool,
    nudge_mm,
    place_at,
    rise_mm,
)
from insole_studio.scene.gesture import Gesture
from insole_studio.scene.pointer import Handle, Phase, PointerEvent
from insole_studio.scene.view_camera import Subject
from insole_studio.texts import localised, tr

HEIGHT_STEP_MM = 0.5
TURN_STEP_DEG = 0.5
TURN_HANDLE_GAP_MM = 12.0
CORNER_GAP_MM = 6.0
OUTLINE_POINTS = 120

Reshape = Callable[[Pelott, PointerEvent, PointerEvent], Pelott]


class PelottTool(Tool):
    """Places pads of the template shape and reshapes the selected one."""

    key = "pelott"

    def __init__(self, pelott: Pelott, behind_heads_mm: float) -> None:
        self._pelott = pelott
        self._behind_heads_mm = behind_heads_mm
        self.reset()

    def reset(self) -> None:
        """Forget what was set for the case before."""
        self.template = self._pelott

    def hint(self, case: Case) -> str:
        """Return one short sentence on what the user can do now."""
        if selected_zone(case) is None:
            return tr("Click on the sole to place: {name}").format(name=name_of(self.template))
        distance = clearance_text(case)
        if distance:
            return distance
        return tr("Drag to move, handles to stretch, turn and raise, wheel to raise by 0.5 mm")

    def handles(self, case: Case, surface: SurfaceContext) -> tuple[Handle, ...]:
        """Return the handles of the selected pad."""
        return pelott_handles(case, surface)

    def start(self, case: Case) -> Place | None:
        """Return the usual position of such a pad."""
        return usual_place(case.record, self.template, self._behind_heads_mm)

    def offers(
        self, case: Case, event: PointerEvent, _surface: SurfaceContext
    ) -> tuple[ContextMenuItem, ...]:
        """Return the item that removes the pad at the pointer."""
        return pelott_offers(case, event)

    def press(self, case: Case, event: PointerEvent, surface: SurfaceContext) -> Gesture | None:
        """Grab a handle or a pad, or place a new pad."""
        grabbed = grab_pelott(case, event, self._behind_heads_mm)
        return grabbed or self._place(case, event, surface)

    def wheel(self, case: Case, event: PointerEvent, steps: float) -> bool:
        """Raise the pad under the pointer."""
        return raise_pelott(case, event, steps)

    def nudge(self, case: Case, event: PointerEvent, right: int, up: int) -> bool:
        """Move the selected pad by one step."""
        return nudge_pelott(case, event, right, up)

    def _place(self, case: Case, event: PointerEvent, surface: SurfaceContext) -> Gesture | None:
        place = event.surface_mm
        if case.record.design is None or place is None or seen_from_above(event):
            return None
        if not surface.covers(place[0], place[1]):
            return None
        fresh = case.stamped(replace(self.template, id=new_id()))
        new = replace(fresh, centre_mm=place_at(place))
        return _follow(case, event, new, case.record.design, self._behind_heads_mm)


def pelott_handles(case: Case, surface: SurfaceContext) -> tuple[Handle, ...]:
    """Return the handles of the selected pad or arch, including the corners of a free outline."""
    return tuple(
        Handle(name, surface.place(*spot), _hint(name), _kind(name))
        for name, spot in _selected_spots(case).items()
    )


def grab_pelott(case: Case, event: PointerEvent, behind_heads_mm: float) -> Gesture | None:
    """Start dragging the handle or the pad under the pointer.

    Parameters
    ----------
    case
        The open case.
    event
        The press.
    behind_heads_mm
        Distance behind the heads to which a pelott snaps.

    Returns
    -------
    Gesture or None
        None if neither handle nor pad is under the pointer.
    """
    design = case.record.design
    if design is None:
        return None
    pad = selected_zone(case)
    if pad is not None and event.handle in _selected_spots(case):
        if event.handle == "move":
            return _move(case, event, pad, behind_heads_mm)
        reshape, sentence = _reshape_of(event.handle)
        return _reshape(case, event, pad, reshape, sentence)
    pad = pelott_at(design, event)
    if pad is None:
        return None
    case.select(pad.id)
    return _move(case, event, pad, behind_heads_mm)


def pelott_at(design: InsoleDesign, event: PointerEvent) -> Pelott | None:
    """Return the pad under the pointer.

    Parameters
    ----------
    design
        The shown design.
    event
        Position of the pointer.

    Returns
    -------
    Pelott or None
        The last enabled pad whose outline contains the point.
    """
    if event.surface_mm is None or seen_from_above(event):
        return None
    place = event.surface_mm[:2]
    outlines = ((pad, pad_outline(pad, OUTLINE_POINTS)) for pad in reversed(design.of(Pelott)))
    return next((pad for pad, outline in outlines if inside_curve(outline, place)), None)


def raise_pelott(case: Case, event: PointerEvent, steps: float) -> bool:
    """Raise the selected pad by 0.5 mm per step; by the wheel only if the pointer is on it.

    Returns
    -------
    bool
        False if the event is not used.
    """
    design = case.record.design
    pad = selected_zone(case)
    if design is None or pad is None:
        return False
    if not event.by_key and not _is_on(design, pad, event):
        return False
    step = 0.1 if event.fine else HEIGHT_STEP_MM
    raised = replace(
        pad, height_mm=_within("height_mm", rounded(pad.height_mm + steps * step, 0.1))
    )
    case.apply(with_zone(design, pad, raised), tr("Raise the pad"), f"{pad.id}:wheel")
    return True


def _is_on(design: InsoleDesign, pad: Pelott, event: PointerEvent) -> bool:
    """Return whether the pointer is on a pad, or in an arch raise and on no pad."""
    found = pelott_at(design, event)
    if found is not None or event.surface_mm is None or seen_from_above(event):
        return found == pad
    return bool(inside_curve(pad_outline(pad, OUTLINE_POINTS), event.surface_mm[:2]))


def nudge_pelott(case: Case, event: PointerEvent, right: int, up: int) -> bool:
    """Move the selected pad by 0.5 mm in the image's direction; return False without one."""
    design = case.record.design
    pad = selected_zone(case)
    if design is None or pad is None:
        return False
    moved = _at(pad, np.array(pad.centre_mm) + nudge_mm(event, right, up), 0.01)
    case.apply(with_zone(design, pad, moved), tr("Move the pad"), f"{pad.id}:nudge")
    return True


def pelott_offers(case: Case, event: PointerEvent) -> tuple[ContextMenuItem, ...]:
    """Return the item that removes the pad at the pointer, or the pad of the chosen handle."""
    design = case.record.design
    if design is None:
        return ()
    pad = pelott_at(design, event) if event.handle is None else selected_pelott(case)
    if pad is None:
        return ()
    return (ContextMenuItem(tr("Remove the pad"), partial(_remove, case, pad), removes=True),)


def clearance_text(case: Case) -> str:
    """Return how far the selected pad ends behind the metatarsal heads; empty if far away."""
    pad = selected_pelott(case)
    found = clearance(case.shown, pad) if pad is not None else None
    if found is None or abs(found.distance_mm) > NEAR_MM:
        return ""
    return tr("Front edge {distance} mm behind the metatarsal heads").format(
        distance=localised(found.distance_mm)
    )


def seen_from_above(event: PointerEvent) -> bool:
    """Return whether the dorsum of the foot is in front, where the insole cannot be touched."""
    return event.subject is Subject.FOOT and bool(event.look.back[2] > 0.3)


def _remove(case: Case, pad: Pelott) -> None:
    design = case.record.design
    if design is not None:
        case.apply(design.with_removed(pad.id), tr("Remove a correction"))


def _selected_spots(case: Case) -> dict[str, FloatArray]:
    """Return the positions of the handles of the selected pad or arch, which does not turn."""
    pad = selected_zone(case)
    if pad is None:
        return {}
    return {name: spot for name, spot in _spots(pad).items() if name != "turn" or not is_arch(case)}


def _kind(name: str) -> str:
    """Return of which kind a handle is, by which it is drawn."""
    kind = name.split(":", maxsplit=1)[0]
    return kind if kind in ("move", "corner") else "size"


def _spots(pad: Pelott) -> dict[str, FloatArray]:
    """Return the positions (3,) of the handles, by name."""
    front, back = _reach(pad)
    along, across = _axes(pad)
    centre = np.array(pad.centre_mm)
    beside = _beside_corners_mm(pad)
    spots = {
        "move": centre,
        "turn": centre + (front + beside + TURN_HANDLE_GAP_MM) * along,
        "height": centre - (back + beside) * along,
        "length": centre + (front + beside) * along,
        "width": centre + (_breadth(pad) + beside) * across,
    }
    if pad.outline_mm is not None:
        corners = np.array(pad.outline_mm) @ pad2insole(pad).T + centre
        spots.update({f"corner:{number}": corner for number, corner in enumerate(corners)})
    return spots


def _follow(
    case: Case, event: PointerEvent, pad: Pelott, design: InsoleDesign, behind_heads_mm: float
) -> Gesture:
    """Place a new pad that follows the pointer until release.

    Parameters
    ----------
    case
        The open case.
    event
        The press.
    pad
        The new pad.
    design
        The design without the pad.
    behind_heads_mm
        Distance behind the heads to which a pelott snaps.
    """
    case.select(pad.id)
    case.preview(design.with_added(pad))
    while event.phase is not Phase.RELEASE:
        event = yield
        if event.touched_mm:
            pad = _settled(case, _at(pad, event.touched_mm[-1][:2]), event, behind_heads_mm)
            case.preview(design.with_added(pad))
    case.apply(design.with_added(pad), tr("Place: {name}").format(name=name_of(pad)))


def _reshape(
    case: Case, press: PointerEvent, pad: Pelott, reshape: Reshape, sentence: str
) -> Gesture:
    """Reshape a pad by dragging.

    Parameters
    ----------
    case
        The open case.
    press
        The press that starts the drag.
    pad
        The pad at the press.
    reshape
        Function of the pad, the press and the current event.
    sentence
        Description of the undo step.
    """
    design = case.record.design
    assert design is not None
    changed, event = pad, press
    while event.phase is not Phase.RELEASE:
        event = yield
        changed = reshape(pad, press, event)
        case.preview(with_zone(design, pad, changed))
    case.apply(with_zone(design, pad, changed), sentence)


def _move(case: Case, press: PointerEvent, pad: Pelott, behind_heads_mm: float) -> Gesture:
    """Move a pad by dragging; a pelott snaps to its usual distance behind the heads."""

    def moved(pad: Pelott, press: PointerEvent, event: PointerEvent) -> Pelott:
        start, now = press.place_mm(0.0), event.place_mm(0.0)
        if start is None or now is None or np.array_equal(start, now):
            return pad
        there = _at(pad, np.array(pad.centre_mm) + (now - start)[:2])
        return _settled(case, there, event, behind_heads_mm)

    return _reshape(case, press, pad, moved, tr("Move the pad"))


def _settled(case: Case, pad: Pelott, event: PointerEvent, behind_heads_mm: float) -> Pelott:
    """Return the moved pad, snapped to the metatarsal line unless Ctrl is held."""
    if event.fine or is_arch(case):
        return pad
    return snapped(case.record, pad, behind_heads_mm)


def _lengthened(pad: Pelott, _press: PointerEvent, event: PointerEvent) -> Pelott:
    offset = _offset(pad, event)
    if offset is None:
        return pad
    length, width = pad_size(pad)
    share = (float(offset @ _axes(pad)[0]) - _beside_corners_mm(pad)) / _reach(pad)[0]
    return resized(pad, _within("length_mm", rounded(length * share, HEIGHT_STEP_MM)), width)


def _widened(pad: Pelott, _press: PointerEvent, event: PointerEvent) -> Pelott:
    offset = _offset(pad, event)
    if offset is None:
        return pad
    length, width = pad_size(pad)
    share = (float(offset @ _axes(pad)[1]) - _beside_corners_mm(pad)) / _breadth(pad)
    return resized(pad, length, _within("width_mm", rounded(width * share, HEIGHT_STEP_MM)))


def _turned(pad: Pelott, _press: PointerEvent, event: PointerEvent) -> Pelott:
    offset = _offset(pad, event)
    if offset is None:
        return pad
    turn = float(np.degrees(np.arctan2(-offset[0], offset[1])))
    return replace(pad, turn_deg=rounded(turn, TURN_STEP_DEG))


def _raised(pad: Pelott, press: PointerEvent, event: PointerEvent) -> Pelott:
    height = rounded(pad.height_mm + rise_mm(press, event) * 0.25, 0.1)
    return replace(pad, height_mm=_within("height_mm", height))


def _with_corner(pad: Pelott, press: PointerEvent, event: PointerEvent) -> Pelott:
    offset = _offset(pad, event)
    if offset is None or pad.outline_mm is None or press.handle is None:
        return pad
    number = int(press.handle.removeprefix("corner:"))
    corners = list(pad.outline_mm)
    corners[number] = place_at(offset @ pad2insole(pad))
    return replace(pad, outline_mm=tuple(corners))


def _offset(pad: Pelott, event: PointerEvent) -> FloatArray | None:
    place = event.place_mm(0.0)
    return None if place is None else np.asarray(place[:2] - np.array(pad.centre_mm))


def _at(pad: Pelott, xy: FloatArray, step_mm: float = 0.1) -> Pelott:
    return replace(pad, centre_mm=place_at(xy, step_mm))


def _axes(pad: Pelott) -> tuple[FloatArray, FloatArray]:
    """Return unit vectors along the pad (towards its blunt end) and across."""
    across, along = pad2insole(pad).T
    return along, across


def _reach(pad: Pelott) -> tuple[float, float]:
    """Return the extent of the outline in front of and behind the apex, mm."""
    y = local_outline(pad)[:, 1]
    return float(y.max()), float(-y.min())


def _breadth(pad: Pelott) -> float:
    """Return the extent of the outline to +x of the apex, mm."""
    return float(local_outline(pad)[:, 0].max())


def _beside_corners_mm(pad: Pelott) -> float:
    """Return how far outside the outline handles stand, so that they cover no corner."""
    return 0.0 if pad.outline_mm is None else CORNER_GAP_MM


def _within(name: str, value: float) -> float:
    return float(ranges_of(Pelott)[name].nearest(value))


def _hint(name: str) -> str:
    return _HINTS[name.partition(":")[0]]()


def _reshape_of(handle: str) -> tuple[Reshape, str]:
    reshape, sentence = _RESHAPES[handle.partition(":")[0]]
    return reshape, sentence()


_HINTS: dict[str, Callable[[], str]] = {
    "move": lambda: tr("Drag to move the pad"),
    "length": lambda: tr("Drag to make it longer or shorter"),
    "width": lambda: tr("Drag to make it wider or narrower"),
    "turn": lambda: tr("Drag to turn the pad"),
    "height": lambda: tr("Drag up to raise the pad, down to lower it"),
    "corner": lambda: tr("Drag to change the outline"),
}
_RESHAPES: dict[str, tuple[Reshape, Callable[[], str]]] = {
    "length": (_lengthened, lambda: tr("Stretch the pad")),
    "width": (_widened, lambda: tr("Widen the pad")),
    "turn": (_turned, lambda: tr("Turn the pad")),
    "height": (_raised, lambda: tr("Raise the pad")),
    "corner": (_with_corner, lambda: tr("Change the outline of the pad")),
}
