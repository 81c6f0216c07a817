"""Where a sensor stood: the pose of one view from the markers it saw.

By Horn's method on their places in space as in the thesis (6.2.2, 6.2.3), or by their places in the
colour image, which are an order of magnitude finer; then Horn's pose is the start.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.horn import absolute_orientation
from insole_core.geometry.transforms import inverse, transform
from insole_core.reconstruct.assignment import Assignment, AssignmentLimits, assign
from insole_core.reconstruct.blobs import Blobs
from insole_core.reconstruct.camera_pose import CameraPose, SeenMarkers, fit_camera_pose
from insole_core.reconstruct.image_assignment import assign_in_image
from insole_core.reconstruct.marker_faces import apparent_centers
from insole_core.reconstruct.sighting import Sightings
from insole_core.recording.session import Marker, ReferenceSystem
from insole_core.sensing.sensor import Sensor

_LEAST_PRECISE = 6
_LEAST_FILL = 0.95
"""Share of the usual fill below which a marker is partly hidden or runs into another."""
_LEAST_WEIGHT = 0.2
"""Below it a marker lies twice its noise off and hardly counts."""


@dataclass(frozen=True)
class RegistrationLimits:
    """When a pose is good enough to be used.

    Parameters
    ----------
    residual_mm
        Largest mean distance of the measured markers from the reference system.
    assignment
        When the assignment of blobs to markers is trusted.
    least_used
        So many markers must determine the pose, all when fewer were found; fused only.
    reprojection_px
        Largest root mean square of the distances in the colour image, fused only.
    shift_deviation_mm, turn_deviation_deg
        Largest standard deviations of a pose, fused only.
    """

    residual_mm: float = 4.0
    least_used: int = 6
    reprojection_px: float = 1.0
    shift_deviation_mm: float = 1.5
    turn_deviation_deg: float = 0.6
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
    reprojection_px
        Distance in the colour image from where the pose puts it; the thesis's chain has none.
    """

    id: str
    pixel: tuple[float, float]
    position_mm: tuple[float, float, float]
    residual_mm: float
    used: bool
    reprojection_px: float | None = None


@dataclass(frozen=True, eq=False)
class Registration:
    """The pose of one view and the markers it rests on.

    Parameters
    ----------
    sensor2reference : (4, 4) float64, mm
    fixes
        In the order of the reference system.
    camera_pose : optional
        With its certainty, where the pose was found in the colour image.
    """

    sensor2reference: FloatArray
    fixes: tuple[MarkerFix, ...]
    camera_pose: CameraPose | None = None

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
    markers, found = _assign(sightings, system, faces, limits)
    positions = _positions(markers)[found.markers]
    points = sightings.points[found.points]
    a2b = absolute_orientation(points, positions, found.used.astype(float)).a2b
    registration = Registration(a2b, _fixes(a2b, sightings, markers, found))
    _check_residuals(registration, limits)
    return registration


def register_precisely(
    sightings: Sightings,
    system: ReferenceSystem,
    sensor: Sensor,
    limits: RegistrationLimits = DEFAULT_LIMITS,
) -> Registration:
    """Determine a view's pose by the least reprojection error, started and checked by Horn's.

    Parameters
    ----------
    sightings
        What the view saw that may be markers, centres to a fraction of a pixel.
    system
    sensor
        Its faces are the marker groups that are looked for.

    Raises
    ------
    ReconstructionError
        With the reason, as the end of a sentence.
    """
    markers, found = _assign(sightings, system, sensor.faces, limits)
    positions = _positions(markers)[found.markers]
    points = sightings.points[found.points]
    start = absolute_orientation(points, positions, found.used.astype(float)).a2b
    reference2color = sensor.depth2color @ inverse(start)
    return _fitted(sightings, (markers, found), sensor, reference2color, limits)


def register_in_image(
    blobs: Blobs,
    system: ReferenceSystem,
    sensor: Sensor,
    limits: RegistrationLimits = DEFAULT_LIMITS,
) -> Registration:
    """Determine a view's pose from its colour image alone, where depth does not tell who is who.

    Parameters
    ----------
    blobs
        Sharpened.
    system
    sensor
        Its faces are the marker groups that are looked for.

    Raises
    ------
    ReconstructionError
        With the reason, as the end of a sentence.
    """
    markers = _facing(system, sensor.faces)
    camera = sensor.color_camera
    found = assign_in_image(blobs.centroids, blobs.areas, _positions(markers), camera)
    pairs = found.pairs
    rays = camera.normalised(blobs.centroids)
    in_color = np.full((len(blobs), 3), np.nan)
    at_marker = transform(found.reference2color, _positions(markers)[pairs.markers])
    in_color[pairs.points] = (
        np.column_stack([rays, np.ones(len(rays))])[pairs.points] * at_marker[:, 2:]
    )
    # Placed on their rays as far away as their markers are: the depth image had no say.
    points = transform(inverse(sensor.depth2color), in_color)
    sightings = Sightings(blobs.centroids, points, blobs.spreads, blobs.fills)
    return _fitted(sightings, (markers, pairs), sensor, found.reference2color, limits)


def _fitted(
    sightings: Sightings,
    assigned: tuple[tuple[Marker, ...], Assignment],
    sensor: Sensor,
    start: FloatArray,
    limits: RegistrationLimits,
) -> Registration:
    """Fit the pose to assigned markers and judge it."""
    markers, found = assigned
    positions = _positions(markers)[found.markers]
    pixels, camera = sightings.pixels[found.points], sensor.color_camera
    precise = _precise(sightings, found)
    seen = SeenMarkers(
        positions,
        positions,
        np.where(precise[:, None], pixels, np.nan),
        transform(sensor.depth2color, sightings.points[found.points])[:, 2],
    )
    pose = fit_camera_pose(seen, camera, start)
    if sightings.spreads is not None:
        spreads = sightings.spreads[found.points]
        centers = apparent_centers(positions, spreads, camera, pose.reference2color)
        seen = replace(seen, centers=centers)
        pose = fit_camera_pose(seen, camera, pose.reference2color)
    missed = np.linalg.norm(
        pixels - camera.project(transform(pose.reference2color, seen.centers)), axis=1
    )
    used = pose.weights > _LEAST_WEIGHT
    sensor2reference = inverse(pose.reference2color) @ sensor.depth2color
    fixes = tuple(
        replace(fix, used=bool(used[i]), reprojection_px=float(missed[i]))
        for i, fix in enumerate(_fixes(sensor2reference, sightings, markers, found))
    )
    registration = Registration(sensor2reference, fixes, pose)
    _check_used(registration, limits)
    _check_residuals(registration, limits)
    _check_certainty(pose, fixes, limits)
    return registration


def _facing(system: ReferenceSystem, faces: tuple[str, ...]) -> tuple[Marker, ...]:
    markers = system.facing(faces)
    if not markers:
        raise ReconstructionError(
            f'its sensor.json lists the faces {_quoted(faces)}, but the reference system "'
            f'{system.name}" has the faces {_quoted(_groups(system))}'
        )
    return markers


def _assign(
    sightings: Sightings,
    system: ReferenceSystem,
    faces: tuple[str, ...],
    limits: RegistrationLimits,
) -> tuple[tuple[Marker, ...], Assignment]:
    markers = _facing(system, faces)
    if len(sightings) == 0:
        raise ReconstructionError(
            "no blue marker with a depth reading is seen; check the light and that the reference "
            "system is in the picture"
        )
    try:
        return markers, assign(sightings.points, _positions(markers), limits.assignment)
    except ReconstructionError as error:
        raise ReconstructionError(
            _why_unassigned(error, sightings, system, faces, limits)
        ) from error


def _precise(sightings: Sightings, found: Assignment) -> BoolArray:
    """Tell which markers (k,) are seen whole; all when too few of them are."""
    whole = np.ones(len(found.points), dtype=bool)
    if sightings.fills is None:
        return whole
    fills = sightings.fills[found.points]
    unspoilt = fills > _LEAST_FILL * np.median(fills)
    return np.asarray(unspoilt) if unspoilt.sum() >= _LEAST_PRECISE else whole


def _fixes(
    a2b: FloatArray, sightings: Sightings, markers: tuple[Marker, ...], found: Assignment
) -> tuple[MarkerFix, ...]:
    measured = transform(a2b, sightings.points[found.points])
    residuals = np.linalg.norm(measured - _positions(markers)[found.markers], axis=1)
    fixes = []
    for i, marker in enumerate(found.markers):
        u, v = sightings.pixels[found.points[i]].tolist()
        x, y, z = measured[i].tolist()
        residual_mm, used = float(residuals[i]), bool(found.used[i])
        fixes.append(MarkerFix(markers[marker].id, (u, v), (x, y, z), residual_mm, used))
    return tuple(fixes)


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


def _check_used(registration: Registration, limits: RegistrationLimits) -> None:
    used, found = sum(fix.used for fix in registration.fixes), len(registration.fixes)
    if used < min(limits.least_used, found):
        raise ReconstructionError(
            f"only {used} of the {found} markers agree with each other in the colour image "
            f"({_worst_in_image(registration.fixes)}); check that the reference system was not "
            "changed or moved"
        )


def _check_certainty(
    pose: CameraPose, fixes: tuple[MarkerFix, ...], limits: RegistrationLimits
) -> None:
    for value, limit, what in (
        (pose.rms_px, limits.reprojection_px, "px apart in the colour image"),
        (pose.shift_deviation_mm, limits.shift_deviation_mm, "mm uncertain in place"),
        (pose.turn_deviation_deg, limits.turn_deviation_deg, "degrees uncertain in direction"),
    ):
        if value > limit:
            raise ReconstructionError(
                f"its markers leave the pose {value:.2f} {what}, more than {limit:g} "
                f"({_worst_in_image(fixes)}); see that more markers are in view and that the "
                "reference system was not moved"
            )


def _worst_in_image(fixes: tuple[MarkerFix, ...]) -> str:
    worst = sorted(fixes, key=lambda fix: -(fix.reprojection_px or 0.0))[:3]
    return "worst: " + ", ".join(f"{fix.id} {fix.reprojection_px:.1f} px" for fix in worst)


def _positions(markers: tuple[Marker, ...]) -> FloatArray:
    return np.array([marker.position_mm for marker in markers], dtype=float).reshape(-1, 3)


def _groups(system: ReferenceSystem) -> tuple[str, ...]:
    return tuple(dict.fromkeys(marker.face for marker in system.markers))


def _quoted(words: tuple[str, ...]) -> str:
    return ", ".join(f'"{word}"' for word in words) or "none"
