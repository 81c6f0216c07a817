"""Where a sensor stood: the pose of one view from the markers it saw (thesis 6.2.2, 6.2.3)."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.horn import absolute_orientation
from insole_core.geometry.transforms import transform
from insole_core.reconstruct.assignment import Assignment, AssignmentLimits, assign
from insole_core.reconstruct.sighting import Sightings
from insole_core.recording.session import Marker, ReferenceSystem


@dataclass(frozen=True)
class RegistrationLimits:
    """When a pose is good enough to be used.

    Parameters
    ----------
    residual_mm
        Largest mean distance of the measured markers from the reference system.
    assignment
        When the assignment of blobs to markers is trusted.
    """

    residual_mm: float = 4.0
    assignment: AssignmentLimits = field(default_factory=AssignmentLimits)


DEFAULT_LIMITS = RegistrationLimits()


@dataclass(frozen=True)
class MarkerFix:
    """One marker as one view saw it.

    Parameters
    ----------
    id
    pixel
        (u, v) of its centre in the colour image, px.
    position_mm
        Measured, reference frame.
    residual_mm
        Distance from where the reference system has it.
    used
        Whether it helped to determine the pose.
    """

    id: str
    pixel: tuple[float, float]
    position_mm: tuple[float, float, float]
    residual_mm: float
    used: bool


@dataclass(frozen=True, eq=False)
class Registration:
    """The pose of one view and the markers it rests on.

    Parameters
    ----------
    sensor2reference : (4, 4) float64, mm
    fixes
        In the order of the reference system.
    """

    sensor2reference: FloatArray
    fixes: tuple[MarkerFix, ...]

    @property
    def residuals_mm(self) -> FloatArray:
        """(k,) residuals of the markers that determined the pose."""
        return np.array([fix.residual_mm for fix in self.fixes if fix.used])


def register(
    sightings: Sightings,
    system: ReferenceSystem,
    faces: tuple[str, ...],
    limits: RegistrationLimits = DEFAULT_LIMITS,
) -> Registration:
    """Determine a view's pose by Horn's method on the markers it saw, thesis (2) - (6).

    Parameters
    ----------
    sightings
        What the view saw that may be markers.
    system
    faces
        The marker groups that the view is said to see; only they are looked for.

    Raises
    ------
    ReconstructionError
        With the reason, as the end of a sentence.
    """
    markers = system.facing(faces)
    if not markers:
        raise ReconstructionError(
            f'its sensor.json lists the faces {_quoted(faces)}, but the reference system "'
            f'{system.name}" has the faces {_quoted(_groups(system))}'
        )
    if len(sightings) == 0:
        raise ReconstructionError(
            "no blue marker with a depth reading is seen; check the light and that the reference "
            "system is in the picture"
        )
    try:
        found = assign(sightings.points, _positions(markers), limits.assignment)
    except ReconstructionError as error:
        raise ReconstructionError(
            _why_unassigned(error, sightings, system, faces, limits)
        ) from error
    registration = _registration(sightings, markers, found)
    _check_residuals(registration, limits)
    return registration


def _registration(
    sightings: Sightings, markers: tuple[Marker, ...], found: Assignment
) -> Registration:
    positions = _positions(markers)[found.markers]
    points = sightings.points[found.points]
    a2b = absolute_orientation(points, positions, found.used.astype(float)).a2b
    measured = transform(a2b, points)
    residuals = np.linalg.norm(measured - positions, axis=1)
    fixes = []
    for i, marker in enumerate(found.markers):
        u, v = sightings.pixels[found.points[i]].tolist()
        x, y, z = measured[i].tolist()
        residual_mm, used = float(residuals[i]), bool(found.used[i])
        fixes.append(MarkerFix(markers[marker].id, (u, v), (x, y, z), residual_mm, used))
    return Registration(a2b, tuple(fixes))


def _why_unassigned(
    error: ReconstructionError,
    sightings: Sightings,
    system: ReferenceSystem,
    faces: tuple[str, ...],
    limits: RegistrationLimits,
) -> str:
    """Say why no pose was found; the likeliest cause is a view in another view's place."""
    for group in _groups(system):
        if group in faces:
            continue
        try:
            assign(sightings.points, _positions(system.facing((group,))), limits.assignment)
        except ReconstructionError:
            continue
        return (
            f"its sensor.json says that it sees the markers {_quoted(faces)}, but it sees "
            f'"{group}"; exchange the views, or correct "faces" there'
        )
    return f'the markers of the reference system "{system.name}" are not recognised: {error}'


def _check_residuals(registration: Registration, limits: RegistrationLimits) -> None:
    mean_mm = float(registration.residuals_mm.mean())
    if mean_mm <= limits.residual_mm:
        return
    worst = sorted(registration.fixes, key=lambda fix: -fix.residual_mm)[:3]
    named = ", ".join(f"{fix.id} {fix.residual_mm:.1f} mm" for fix in worst)
    raise ReconstructionError(
        f"its markers lie {mean_mm:.1f} mm from the reference system on average, more than "
        f"{limits.residual_mm:g} mm (worst: {named}); check that the reference system was not "
        "changed or moved"
    )


def _positions(markers: tuple[Marker, ...]) -> FloatArray:
    return np.array([marker.position_mm for marker in markers], dtype=float).reshape(-1, 3)


def _groups(system: ReferenceSystem) -> tuple[str, ...]:
    return tuple(dict.fromkeys(marker.face for marker in system.markers))


def _quoted(words: tuple[str, ...]) -> str:
    return ", ".join(f'"{word}"' for word in words) or "none"
