"""The free-hand tool: draw the closed outline of a pad with mouse, pen or finger."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.surface_path import path_length_mm, resampled
from insole_core.insole.elements import Pelott
from insole_core.insole.fields import Place
from insole_core.insole.grips import place_at
from insole_core.insole.primitives.outline_curve import crosses_itself, inside_curve
from insole_studio.document.case import Case
from insole_studio.features.design.tools.hand import Hand, seen_from_above
from insole_studio.features.design.tools.tool import SurfaceContext, Tool
from insole_studio.scene.pointer import Gesture, Handle, Phase, PointerEvent
from insole_studio.texts import tr

CORNERS = 14
LEAST_LENGTH_MM = 30.0
HEIGHT_MM = 4.0


class FreeHandTool(Tool):
    """Tool whose drag draws the outline of a new pad."""

    key = "free_hand"
    draws = True

    def __init__(self, behind_heads_mm: float) -> None:
        self._hand = Hand(behind_heads_mm, ("pad",))
        self.reset()

    def reset(self) -> None:
        """Forget what was set for the case before."""
        self._sketch: tuple[Place, ...] = ()
        self._refusal = ""

    def hint(self, _case: Case) -> str:
        """Return what the user can do now, or why the last drawing made no pad."""
        return self._refusal or tr("Draw the outline of a pad round its place, in one go")

    def handles(self, case: Case, surface: SurfaceContext) -> tuple[Handle, ...]:
        """Return the handles of the drawn pad."""
        return self._hand.handles(case, surface)

    @property
    def sketch(self) -> tuple[Place, ...]:
        """The outline drawn so far."""
        return self._sketch

    def press(self, case: Case, event: PointerEvent, _surface: SurfaceContext) -> Gesture | None:
        """Grab a handle of the drawn pad, or start drawing."""
        if event.handle is not None:
            return self._hand.grab(case, event)
        if event.surface_mm is None or case.record.design is None or seen_from_above(event):
            return None
        return self._draw(case, event)

    def _draw(self, case: Case, event: PointerEvent) -> Gesture:
        design = case.record.design
        assert design is not None
        self._refusal = ""
        case.select(None)
        try:
            while event.phase is not Phase.RELEASE:
                self._sketch = (*self._sketch, *map(place_at, event.touched_mm))
                case.preview(design)
                event = yield
            drawn = np.array(self._sketch)
        finally:
            self._sketch = ()
        self._refusal = why_no_pad(drawn)
        if self._refusal:
            case.end_preview()
            return
        pad = case.stamped(drawn_pad(drawn))
        case.select(pad.id)
        case.apply(design.with_added(pad), tr("Draw a pad"))


def why_no_pad(drawn: FloatArray) -> str:
    """Return what is wrong with a drawing (n, 2); empty if nothing is."""
    if len(drawn) < 3 or path_length_mm(drawn) < LEAST_LENGTH_MM:
        return tr("That outline is too small for a pad; draw round its place")
    corners = _corners(drawn)
    if crosses_itself(corners):
        return tr("That outline crosses itself; draw it again in one round")
    return ""


def drawn_pad(drawn: FloatArray) -> Pelott:
    """Return the pad of a drawn outline (n, 2), its apex in the middle."""
    corners = _corners(drawn)
    centre = _middle(corners)
    around = tuple(place_at(corner - centre) for corner in corners)
    return Pelott(
        shape="outline", centre_mm=place_at(centre), height_mm=HEIGHT_MM, outline_mm=around
    )


def _corners(drawn: FloatArray) -> FloatArray:
    """Return a few points at equal distances along the closed drawing."""
    return resampled(np.concatenate([drawn, drawn[:1]]), CORNERS + 1)[:-1]


def _middle(corners: FloatArray) -> FloatArray:
    """Return the centroid; if it lies outside, the inner point farthest from the edge."""
    x, y = corners.T
    cross = x * np.roll(y, -1) - y * np.roll(x, -1)
    if abs(cross.sum()) > 1e-6:
        centre = ((corners + np.roll(corners, -1, axis=0)) * cross[:, None]).sum(axis=0)
        centre /= 3 * cross.sum()
        if inside_curve(corners, centre):
            return np.asarray(centre)
    low, high = corners.min(axis=0), corners.max(axis=0)
    steps = [np.linspace(a, b, 24) for a, b in zip(low, high, strict=True)]
    places = np.stack(np.meshgrid(*steps), axis=-1).reshape(-1, 2)
    inner = places[inside_curve(corners, places)]
    away = np.hypot(*np.moveaxis(inner[:, None] - corners, -1, 0)).min(axis=1)
    return np.asarray(inner[away.argmax()])
