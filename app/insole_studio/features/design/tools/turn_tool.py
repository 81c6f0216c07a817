"""The tool that turns the foot in its frame by three rotation rings, as in CAD programs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from insole_core.errors import InputError
from insole_core.foot.alignment import PoseAngles, pose_angles, turned
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.geometry.transforms import inverse
from insole_core.workflows.foot_landmarks import landmarks_of, turned_record
from insole_studio.document.case import Case
from insole_studio.features.design.tools.tool import SurfaceContext, Tool
from insole_studio.scene.pointer import Gesture, Handle, Phase, PointerEvent
from insole_studio.scene.view_camera import Subject
from insole_studio.texts import localised, tr

PREFIX = "turn-"
RADIUS_MM = 50.0
HEIGHT_MM = 25.0
"""Height of the rings' centre above the ground."""
GRAB_PX = 10.0
SAME_PX = 3.0
"""Points of a ring that appear closer than this cannot be told apart."""
STEP_DEG, FINE_DEG = 0.5, 0.1
MOST_DEG = 45.0
FACE_ON = 0.5
"""Rings with a larger cosine between axis and line of sight are turned around their centre."""
_ROUND = np.linspace(0.0, 2 * np.pi, 73)


@dataclass(frozen=True)
class Ring:
    """A rotation ring.

    Parameters
    ----------
    angle
        The attribute of `PoseAngles` that it changes.
    axis
        Index of the rotation axis.
    mirrored
        Whether the sign of the angle depends on the side of the foot.
    text
        Function that returns the translated name of the angle.
    """

    angle: str
    axis: int
    mirrored: bool
    text: Callable[[], str]

    @property
    def arms(self) -> tuple[FloatArray, FloatArray]:
        """Orthonormal vectors (3,) in the plane of the ring; rotation is from first to second."""
        axes = np.eye(3)
        return axes[(self.axis + 1) % 3], axes[(self.axis + 2) % 3]

    def place(self, centre: FloatArray, angle: float) -> FloatArray:
        """Return a point of the ring, (3,) mm; `angle` in radians."""
        first, second = self.arms
        return np.asarray(centre + RADIUS_MM * (np.cos(angle) * first + np.sin(angle) * second))

    def line(self, centre: FloatArray) -> FloatArray:
        """Return the ring as a polyline (n, 3), mm."""
        first, second = self.arms
        way = np.cos(_ROUND)[:, None] * first + np.sin(_ROUND)[:, None] * second
        return np.asarray(centre + RADIUS_MM * way)

    def sign(self, foot: Foot) -> float:
        """Return the sign of the pose angle for a positive rotation about the axis."""
        return -foot.side.medial_sign if self.mirrored else 1.0


RINGS = {
    PREFIX + ring.angle: ring
    for ring in (
        Ring("pitch_deg", 0, False, lambda: tr("Toe end up")),
        Ring("roll_deg", 1, True, lambda: tr("Medial edge up")),
        Ring("yaw_deg", 2, True, lambda: tr("Toes medially")),
    )
}


class TurnTool(Tool):
    """Tool with one ring per axis; the insole is updated on release."""

    key = "turn"

    def __init__(self) -> None:
        self._angle_text = ""
        self._step: FloatArray | None = None

    @property
    def foot_step(self) -> FloatArray | None:
        """The transform (4, 4) by which the foot is being turned; None while it is not."""
        return self._step

    @property
    def text(self) -> str:
        """The current angle as text; empty when nothing is being turned."""
        return self._angle_text

    def hint(self, case: Case) -> str:
        """Return one short sentence on what the user can do now."""
        if case.foot is not None and _angles(case) is None:
            return tr("The landmarks stand where they do on no foot; put them right first")
        return self._angle_text or tr("Drag a ring to turn the foot; hold Ctrl for small steps")

    def handles(self, case: Case, surface: SurfaceContext) -> tuple[Handle, ...]:
        """Return two spots on each ring; the rings themselves can be dragged as well."""
        if case.foot is None or surface.subject is not Subject.FOOT or _angles(case) is None:
            return ()
        centre = ring_centre(case.foot)
        return tuple(
            Handle(name, _point(ring.place(centre, at * np.pi)), _hint(ring))
            for at in (1.25, 0.25)
            for name, ring in RINGS.items()
        )

    def rings(self, case: Case) -> tuple[FloatArray, ...]:
        """Return the rings as polylines (n, 3), mm."""
        if case.foot is None or _angles(case) is None:
            return ()
        centre = ring_centre(case.foot)
        return tuple(ring.line(centre) for ring in RINGS.values())

    def press(self, case: Case, event: PointerEvent, _surface: SurfaceContext) -> Gesture | None:
        """Grab the ring under the pointer."""
        angles, foot = _angles(case), case.foot
        if angles is None or foot is None or event.subject is not Subject.FOOT:
            return None
        name = event.handle if event.handle in RINGS else _ring_at(event, ring_centre(foot))
        return None if name is None else self._turn(case, event, RINGS[name], foot, angles)

    def _turn(
        self, case: Case, press: PointerEvent, ring: Ring, foot: Foot, start: PoseAngles
    ) -> Gesture:
        angles, event = start, press
        landmarks = landmarks_of(case.record)
        try:
            while event.phase is not Phase.RELEASE:
                event = yield
                angles = _dragged(ring, start, foot, press, event)
                anew = turned(foot, landmarks, angles)
                self._step = anew.source2insole @ inverse(foot.source2insole)
                self._angle_text = f"{ring.text()} {localised(getattr(angles, ring.angle))}°"
                case.preview(case.record)
        finally:
            self._step, self._angle_text = None, ""
        if angles == start:
            case.end_preview()
        else:
            case.apply(turned_record(case.record, angles), tr("Turn the foot"))


def ring_centre(foot: Foot) -> FloatArray:
    """Return the centre of the rings, (3,) mm."""
    low, high = foot.mesh.bounds_mm
    x, y, _ = (low + high) / 2
    return np.array([x, y, HEIGHT_MM])


def _angles(case: Case) -> PoseAngles | None:
    """Return the pose angles of the foot; None if its landmarks do not determine them."""
    foot = case.record.foot
    if foot is None:
        return None
    try:
        return pose_angles(foot, landmarks_of(case.record))
    except InputError:
        return None


def _dragged(
    ring: Ring, start: PoseAngles, foot: Foot, press: PointerEvent, event: PointerEvent
) -> PoseAngles:
    turn = ring.sign(foot) * turned_deg(ring, ring_centre(foot), press, event)
    step = FINE_DEG if event.fine else STEP_DEG
    angle = float(np.clip(getattr(start, ring.angle) + turn, -MOST_DEG, MOST_DEG))
    return replace(start, **{ring.angle: rounded(angle, step)})


def turned_deg(ring: Ring, centre: FloatArray, press: PointerEvent, event: PointerEvent) -> float:
    """Return the angle by which the pointer has turned a ring, degrees.

    Parameters
    ----------
    ring
        The grabbed ring.
    centre : (3,) float64
        Centre of the rings, mm.
    press, event
        The press on the ring, and the current event.
    """
    axis = np.eye(3)[ring.axis]
    if abs(float(axis @ press.look.back)) > FACE_ON:
        turn = _bearing(ring, centre, event) - _bearing(ring, centre, press)
        return (turn + 180.0) % 360.0 - 180.0
    tangent = np.cross(axis, _facing(ring, centre, press))
    seen = np.array([tangent @ press.look.right, tangent @ press.look.up])
    shift = np.subtract(event.pixel, press.pixel) * [1.0, -1.0] * press.look.mm_per_px
    return float(np.degrees(shift @ seen / np.linalg.norm(seen) / RADIUS_MM))


def _facing(ring: Ring, centre: FloatArray, press: PointerEvent) -> FloatArray:
    """Return the direction (3,) from the centre to the grabbed half of the ring, across its axis.

    Of a ring seen edge-on the near half is meant; of a tilted one the far half can be grabbed too.
    """
    line, back = ring.line(centre), press.look.back
    distance = np.hypot(*(press.look.pixels_of(line) - press.pixel).T)
    depth = np.where(distance <= distance.min() + SAME_PX, (line - centre) @ back, -np.inf)
    way = back - (back @ np.eye(3)[ring.axis]) * np.eye(3)[ring.axis]
    return np.asarray(way if depth.max() >= 0 else -way)


def _bearing(ring: Ring, centre: FloatArray, event: PointerEvent) -> float:
    """Return the direction of the pointer from the centre, in the plane of the ring, degrees."""
    axis = np.eye(3)[ring.axis]
    origin, direction = event.look.ray_at(*event.pixel)
    hit = origin + direction * ((axis @ (centre - origin)) / (axis @ direction)) - centre
    first, second = ring.arms
    return float(np.degrees(np.arctan2(hit @ second, hit @ first)))


def _ring_at(event: PointerEvent, centre: FloatArray) -> str | None:
    """Return the name of the ring under the pointer."""
    distance = {
        name: float(np.hypot(*(event.look.pixels_of(ring.line(centre)) - event.pixel).T).min())
        for name, ring in RINGS.items()
    }
    nearest = min(distance, key=lambda name: distance[name])
    return nearest if distance[nearest] <= GRAB_PX else None


def _hint(ring: Ring) -> str:
    return tr("{angle}: drag along the ring").format(angle=ring.text())


def _point(place: FloatArray) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in place)
    return x, y, z
