"""Make the feet of a session, of which there may be two, in one go."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np

from insole_core.errors import InputError, InsoleError, ReconstructionError
from insole_core.foot.side_check import seen_side
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.messages import joined
from insole_core.progress import SILENT, Progress
from insole_core.reconstruct import DepthSource, Method, Reconstruction, RegistrationLimits
from insole_core.reconstruct.poses.pose_quality import DEFAULT_LIMITS
from insole_core.reconstruct.shared_views import SharedViews
from insole_core.reconstruct.volume import NothingInVolumeError, volume_of_interest
from insole_core.recording.box import Box
from insole_core.workflows.make_foot import (
    MadeFoot,
    MeasuredSession,
    make_foot,
    reconstruct_session,
)

_AT_BORDER_MM = 3.0
_LEAST_AT_BORDER_MM2 = 200.0
"""A foot that is cut shows a strip several times as large, stray readings far less."""


class MissingFootError(ReconstructionError):
    """One of two feet that were captured together is not in its place.

    Parameters
    ----------
    session
        Where it was read from.
    side
        Of the foot that is missing.
    """

    def __init__(self, session: str, side: Side) -> None:
        super().__init__(
            "{session} was recorded with both feet, but no {side} foot is in its place; capture "
            "both again, or choose the {other} foot alone.",
            session=session,
            side=side,
            other=side.other,
        )
        self.side = side


class DoubtfulFeetError(InsoleError):
    """The feet of one capture contradict their places; a user may insist on them."""


@dataclass(frozen=True, eq=False)
class ReconstructedFoot:
    """The surface of one foot of a session.

    Parameters
    ----------
    side
        As recorded.
    result
        Its mesh is in mm, in the foot's own reference frame.
    """

    side: Side
    result: Reconstruction


def reconstruct_feet(
    opened: MeasuredSession,
    limits: RegistrationLimits = DEFAULT_LIMITS,
    progress: Progress = SILENT,
    *,
    method: Method = "fused",
    corrected: bool | None = None,
    depth: DepthSource = "auto",
) -> tuple[ReconstructedFoot, ...]:
    """Reconstruct the surface of every foot of a session; all or none.

    Parameters
    ----------
    opened
        Views that were not measured yet are measured here.
    limits
        Beyond which the pose of a view is refused.
    corrected
        Whether the learnt error of the sensor's matching is subtracted, by the fused method only;
        by default as was chosen for the sensors.

    Returns
    -------
    tuple
        The only foot, or the left and the right one.

    Raises
    ------
    MissingFootError
        When one of two feet is not in its place.
    ReconstructionError
        When no view can be used.
    DoubtfulFeetError
        When a foot of two reaches out of its place, or is of the wrong side.
    Cancelled
    """
    feet = opened.feet
    shared = _shared(opened, limits)
    results = []
    for foot, part in zip(feet, _parts(progress, feet), strict=True):
        with _naming(foot, feet):
            result = reconstruct_session(
                foot, limits, part, method=method, corrected=corrected, depth=depth, shared=shared
            )
        results.append(ReconstructedFoot(foot.session.manifest.one_side, result))
    _check_places(feet, [one.result.mesh for one in results])
    return tuple(results)


def make_feet(
    opened: MeasuredSession,
    limits: RegistrationLimits = DEFAULT_LIMITS,
    progress: Progress = SILENT,
    *,
    compare_views: bool = False,
    force: bool = False,
) -> tuple[MadeFoot, ...]:
    """Make every foot of a session ready for design; all or none.

    Parameters
    ----------
    limits
        Beyond which the pose of a view is refused.
    compare_views
        Whether to measure how far the views deviate from each other on the feet.
    force
        Continue although the shape looks like the other foot, or a foot reaches out of its place.

    Returns
    -------
    tuple
        The only foot, or the left and the right one.

    Raises
    ------
    MissingFootError
        When one of two feet is not in its place.
    ReconstructionError
        When no view can be used.
    SideMismatchError
        When the shape of the only foot is that of the other one, unless `force`.
    DoubtfulFeetError
        When a foot of two reaches out of its place, or is of the wrong side, unless `force`.
    Cancelled
    """
    feet = opened.feet
    shared = _shared(opened, limits)
    made: list[MadeFoot] = []
    for foot, part in zip(feet, _parts(progress, feet), strict=True):
        with _naming(foot, feet):
            made.append(
                make_foot(
                    foot,
                    limits,
                    part,
                    compare_views=compare_views,
                    force=force or shared is not None,
                    shared=shared,
                )
            )
    if not force:
        _check_places(feet, [one.mesh for one in made])
    return tuple(made)


def _shared(opened: MeasuredSession, limits: RegistrationLimits) -> SharedViews | None:
    """Return what the two feet of a session have in common; None for one foot."""
    system = opened.session.manifest.reference_system
    return SharedViews(system, limits, opened.measure) if system.feet else None


def _parts(progress: Progress, feet: tuple[MeasuredSession, ...]) -> tuple[Progress, ...]:
    """Return the progress of each foot, which says of two feet which one it is."""
    parts = progress.parts(len(feet))
    if len(feet) == 1:
        return parts
    return tuple(
        part.about("The {side} foot: {step}", side=foot.session.manifest.one_side)
        for foot, part in zip(feet, parts, strict=True)
    )


@contextmanager
def _naming(foot: MeasuredSession, feet: tuple[MeasuredSession, ...]) -> Iterator[None]:
    """Say in an error which of two feet it is about."""
    side = foot.session.manifest.one_side
    try:
        yield
    except NothingInVolumeError as error:
        if len(feet) == 1:
            raise
        raise MissingFootError(foot.session.source, side) from error
    except (InputError, ReconstructionError) as error:
        if len(feet) == 1:
            raise
        raise ReconstructionError(
            "The {side} foot: {reason}", side=side, reason=error.message
        ) from error


def _check_places(feet: tuple[MeasuredSession, ...], meshes: list[TriangleMesh]) -> None:
    """Check that each foot of two is whole and in its own place; a single one may be cut."""
    for foot, mesh in zip(feet, meshes, strict=True):
        if foot.is_of_two and _reaches_out(mesh, volume_of_interest(foot.session)):
            raise DoubtfulFeetError(
                "The {side} foot reaches out of its volume, so part of it is missing or of the "
                "other foot; put each foot in the middle of its place, where they neither touch "
                "nor cross, and capture them again.",
                side=foot.session.manifest.one_side,
            )
    if len(feet) == 1:
        return
    seen = {
        foot.session.manifest.one_side: seen_side(mesh)
        for foot, mesh in zip(feet, meshes, strict=True)
    }
    wrong = [side for side, shown in seen.items() if shown is side.other]
    if len(wrong) == len(feet):
        raise DoubtfulFeetError(
            "The feet look exchanged: a right one is in the place of the left, and a left one in "
            "the place of the right; see that they are not crossed, and that the pictures are not "
            "flipped."
        )
    if wrong:
        raise DoubtfulFeetError(
            "In the place of the {side} foot the shape looks like a {other} one; see that the two "
            "feet are of one person, and stand in their own places.",
            side=joined(wrong),
            other=joined(side.other for side in wrong),
        )


def _reaches_out(mesh: TriangleMesh, box: Box) -> bool:
    """Return whether a surface is cut at a border of its volume; above, the leg always is."""
    near = mesh.vertices < np.array(box.min_mm) + _AT_BORDER_MM
    near[:, :2] |= mesh.vertices[:, :2] > np.array(box.max_mm[:2]) - _AT_BORDER_MM
    return bool(np.sum(mesh.vertex_areas[near.any(axis=1)]) > _LEAST_AT_BORDER_MM2)
