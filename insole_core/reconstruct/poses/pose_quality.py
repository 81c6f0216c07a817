"""Whether a pose is good enough to be used."""

from __future__ import annotations

from dataclasses import dataclass, field

from insole_core.errors import ReconstructionError
from insole_core.messages import Message
from insole_core.reconstruct.markers.marker_matching import MarkerMatchLimits
from insole_core.reconstruct.markers.marker_observation import MarkerObservation, Registration


@dataclass(frozen=True)
class RegistrationLimits:
    """When a pose is good enough to be used.

    Parameters
    ----------
    residual_mm
        Largest mean distance of the measured markers from the reference system.
    least_used
        Least number of markers that determine the pose, which must also be half of those found;
        fused only.
    reprojection_px
        Largest root mean square of the distances in the colour image, fused only.
    displacement_mm
        Largest standard deviation of the position of the foot's middle, fused only.
    turn_deviation_deg
        Largest standard deviation of the rotation, fused only.
    assignment
        When the matching of points to markers is trusted.
    """

    residual_mm: float = 4.0
    least_used: int = 4
    reprojection_px: float = 1.0
    displacement_mm: float = 3.0
    turn_deviation_deg: float = 1.0
    assignment: MarkerMatchLimits = field(default_factory=MarkerMatchLimits)


DEFAULT_LIMITS = RegistrationLimits()


class PoseRefusedError(ReconstructionError):
    """A pose was found but is not good enough; `registration` holds it with its markers."""

    def __init__(self, reason: str, registration: Registration) -> None:
        super().__init__(reason)
        self.registration = registration


def check_pose(registration: Registration, limits: RegistrationLimits) -> None:
    """Refuse a pose that does not meet the limits.

    Parameters
    ----------
    registration
        The pose with its markers.
    limits

    Raises
    ------
    PoseRefusedError
        With the reason, as the end of a sentence: which markers, which residuals.
    """
    for reason in (
        _too_few(registration, limits),
        _too_far(registration, limits),
        _too_uncertain(registration, limits),
    ):
        if reason:
            raise PoseRefusedError(reason, registration)


def _too_few(registration: Registration, limits: RegistrationLimits) -> str:
    if registration.camera_pose is None:
        return ""
    fixes = [fix for fix in registration.fixes if not fix.excluded]
    used = sum(fix.used for fix in fixes)
    if used >= limits.least_used and 2 * used >= len(fixes):
        return ""
    return Message(
        "only {used} of the {count} markers agree with each other in the colour image "
        "({worst}); check that the reference system was not changed or moved",
        used=used,
        count=len(fixes),
        worst=_worst_in_image(fixes),
    )


def _too_far(registration: Registration, limits: RegistrationLimits) -> str:
    mean_mm = float(registration.residuals_mm.mean())  # too few would have been refused before
    if mean_mm <= limits.residual_mm:
        return ""
    fixes = [fix for fix in registration.fixes if not fix.excluded]
    worst = sorted(fixes, key=lambda fix: -fix.residual_mm)[:3]
    named = ", ".join(f"{fix.id} {fix.residual_mm:.1f} mm" for fix in worst)
    return Message(
        "its markers lie {mean_mm:.1f} mm from the reference system on average, more than "
        "{limit_mm:g} mm (worst: {worst}); check that the reference system was not changed "
        "or moved",
        mean_mm=mean_mm,
        limit_mm=limits.residual_mm,
        worst=named,
    )


def _too_uncertain(registration: Registration, limits: RegistrationLimits) -> str:
    pose, displacement_mm = registration.camera_pose, registration.displacement_mm
    if pose is None or displacement_mm is None:
        return ""
    fixes = [fix for fix in registration.fixes if not fix.excluded]
    for value, limit, what in (
        (pose.rms_px, limits.reprojection_px, "px apart in the colour image"),
        (displacement_mm, limits.displacement_mm, "mm uncertain at the foot"),
        (pose.turn_deviation_deg, limits.turn_deviation_deg, "degrees uncertain in direction"),
    ):
        if value > limit:
            return Message(
                "its markers leave the pose {value:.2f} {what}, more than {limit:g} "
                "({worst}); see that more markers are in view and that the reference "
                "system was not moved",
                value=value,
                what=what,
                limit=limit,
                worst=_worst_in_image(fixes),
            )
    return ""


def _worst_in_image(fixes: list[MarkerObservation]) -> str:
    worst = sorted(fixes, key=lambda fix: -(fix.reprojection_px or 0.0))[:3]
    named = ", ".join(f"{fix.id} {fix.reprojection_px:.1f} px" for fix in worst)
    return Message("worst: {markers}", markers=named)
