"""Warnings about the input of a reconstruction: motion, missing sides, sensors in one place."""

from __future__ import annotations

from collections.abc import Collection
from itertools import combinations

import numpy as np

from insole_core.errors import ReconstructionError
from insole_core.geometry.transforms import rotation_angle_deg
from insole_core.messages import Message, joined
from insole_core.reconstruct.result import Surface, ViewResult
from insole_core.reconstruct.views.foot_coverage import coverage_warnings
from insole_core.recording.session import Session, View
from insole_core.sensing.frames import Motion, RawAverage
from insole_core.sensing.sensor import Sensor

_SAME_PLACE_MM = 60.0
_SAME_DIRECTION_DEG = 5.0
_UNCERTAIN_MM = 1.5
_MISFIT_MM = 2.0
"""Least gap between views that is reported; of a foot that kept still it is below 1.2 mm."""
_UNIT_STEP, _NEAR_PERCENT = 8, 5
_NEAREST_MM, _FARTHEST_MM = 150.0, 3000.0
"""Of the nearest readings of a picture that may show a foot."""
_MOST_APART_MS = 50.0
"""A frame and a half: what is taken together lies within a frame."""
_STRAYED_PX = 4.0
"""Reprojection error far beyond noise: 3 mm at 750 mm."""


def check_still(average: RawAverage) -> None:
    """Refuse a view in which something moved in most of the frames.

    Raises
    ------
    ReconstructionError
        With the reason, as the end of a sentence.
    """
    if 2 * len(average.moved) > average.frames:
        raise ReconstructionError(
            "something moved in {moved} of its {frames} depth frames; capture it again with the "
            "foot kept still",
            moved=len(average.moved),
            frames=average.frames,
        )


def check_unit(view: View) -> None:
    """Refuse a view whose depth lies where no foot can be, as in a wrong unit.

    Raises
    ------
    ReconstructionError
        With the reason, as the end of a sentence.
    """
    unit_mm = view.sensor.depth_unit_mm
    if unit_mm is None:
        return
    stored = view.read_depth(0)[::_UNIT_STEP, ::_UNIT_STEP]
    if not stored.any():
        return
    near_mm = float(np.percentile(stored[stored > 0], _NEAR_PERCENT)) * unit_mm
    if not _NEAREST_MM < near_mm < _FARTHEST_MM:
        raise ReconstructionError(
            'by "depth_unit_mm" in its sensor.json what it sees is {near_mm:.0f} mm away, where no '
            "foot can be; put in the unit of its depth frames",
            near_mm=near_mm,
        )


def lateness_note(view: View) -> str:
    """Describe a colour picture of another moment than the depth; the end of a sentence, or empty.

    Parameters
    ----------
    view
        With the times of its frames, if its sensor told them.
    """
    if view.times is None or view.times.color_apart_ms <= _MOST_APART_MS:
        return ""
    return Message(
        "a colour picture was taken {apart_ms:.0f} ms before or after the depth, so what moved "
        "meanwhile is in another place; capture it again if the foot was not quite still",
        apart_ms=view.times.color_apart_ms,
    )


def motion_note(view: View, average: RawAverage) -> str:
    """Describe how far the foot moved in the frames that were left out.

    Parameters
    ----------
    view
    average
        Of the view's depth frames.

    Returns
    -------
    str
        The end of a sentence; empty when no frame was left out.
    """
    if not average.moved:
        return ""
    counts = {"moved": len(average.moved), "frames": average.frames}
    if not average.motion:
        return Message(
            "something moved; {moved} of its {frames} depth frames are left out", **counts
        )
    return Message(
        "something moved by {distance_mm:.1f} mm; {moved} of its {frames} depth frames are left "
        "out",
        distance_mm=_motion_mm(view, average.motion),
        **counts,
    )


def correction_note(sensor: Sensor) -> str:
    """Describe a correction of another device, as the end of a sentence; empty for its own."""
    correction = sensor.correction
    if correction is None or correction.record.is_of(sensor.serial):
        return ""
    return Message(
        "the distortion of the depth is corrected by what was measured on sensor {owner}, not on "
        "{serial}, so the depth may be wrong by several millimetres; give the session the "
        "calibration of its own sensor",
        owner=correction.record.serial,
        serial=sensor.serial,
    )


def _motion_mm(view: View, motion: Motion) -> float:
    """Compute the length of a motion in space."""
    near_raw = motion.at_raw + np.array([0.0, motion.nearer_raw])
    at_mm, came_to_mm = view.sensor.disparity.depth_mm(near_raw)
    camera = view.sensor.depth_camera
    sideways_mm = np.array([motion.along_u_px / camera.fx, motion.along_v_px / camera.fy]) * at_mm
    return float(np.hypot(np.linalg.norm(sideways_mm), came_to_mm - at_mm))


def warnings_of(
    session: Session, results: list[ViewResult], coverage: dict[str, float]
) -> tuple[str, ...]:
    """Collect the warnings that a user should read before trusting the foot.

    Parameters
    ----------
    session
    results
        Of all views.
    coverage
        Share by region of the foot (see `coverage_of`).

    Returns
    -------
    tuple of str
        A sentence each.
    """
    unseen = _unseen_sides(session, results)
    return (
        *(
            Message("The view {view} is left out: {reason}.", view=r.name, reason=r.reason)
            for r in results
            if not r.used
        ),
        *(
            Message("In the view {view} {reason}.", view=r.name, reason=r.reason)
            for r in results
            if r.used and r.reason
        ),
        *_uncertain_poses(results),
        *_strayed_markers(results),
        *_hand_corrections(session, results),
        *unseen,
        *coverage_warnings(coverage, absence_is_reported=bool(unseen)),
        *_same_places(session, results),
        *_one_camera(session, results),
    )


def misfits(results: list[ViewResult], surface: Surface, aside: Collection[str] = ()) -> list[str]:
    """Warn of the two used views that fit each other worst, if their gap is too large.

    Parameters
    ----------
    results
        Of all views.
    surface
        With the gaps between the used views, in the order of `results`.
    aside
        Views that see too little of the foot for a gap to be certain.

    Returns
    -------
    list of str
        One sentence or none.
    """
    if surface.view_gaps_mm is None:
        return []
    used = [result for result in results if result.used]
    apart_mm = np.nan_to_num(np.linalg.norm(surface.view_gaps_mm, axis=2))
    unsure = [result.name in aside for result in used]
    apart_mm[unsure, :] = apart_mm[:, unsure] = 0.0
    first, second = np.unravel_index(int(apart_mm.argmax()), apart_mm.shape)
    if apart_mm[first, second] < _MISFIT_MM:
        return []
    return [
        Message(
            "The views {first} and {second} do not fit each other by {apart_mm:.0f} mm; see "
            "whether the foot or the reference system was moved between them.",
            first=used[first].name,
            second=used[second].name,
            apart_mm=apart_mm[first, second],
        )
    ]


def _uncertain_poses(results: list[ViewResult]) -> list[str]:
    return [
        Message(
            "The markers of the view {view} leave its place uncertain by {uncertainty_mm:.1f} "
            "mm at the foot; see that more of them are in view.",
            view=result.name,
            uncertainty_mm=uncertainty_mm,
        )
        for result in results
        if result.used and (uncertainty_mm := result.displacement_mm or 0.0) > _UNCERTAIN_MM
    ]


def _strayed_markers(results: list[ViewResult]) -> list[str]:
    """Name the markers that are not seen where the reference system has them."""
    strayed: dict[str, list[tuple[str, float]]] = {}
    for result in results:
        for fix in result.fixes if result.used else ():
            missed_px = fix.reprojection_px
            if not (fix.used or fix.excluded) and missed_px is not None and missed_px > _STRAYED_PX:
                strayed.setdefault(fix.id, []).append((result.name, fix.residual_mm))
    return [
        Message(
            "The marker {marker} is seen {distances} from its place by {views} and does not "
            "count; see whether it was moved.",
            marker=marker,
            distances=", ".join(f"{off:.0f} mm" for _, off in seen),
            views=joined(name for name, _ in seen),
        )
        for marker, seen in strayed.items()
    ]


def _hand_corrections(session: Session, results: list[ViewResult]) -> list[str]:
    """List what the user corrected."""
    edits = session.edits
    found: list[str] = [
        Message(
            "The markers of the view {view} were corrected by hand: {corrections}.",
            view=result.name,
            corrections=edits.of(result.name).summary(),
        )
        for result in results
        if result.used and edits.of(result.name).corrects_markers
    ]
    if edits.volume_of_interest is not None:
        found.append("The volume of interest was set by hand.")
    if edits.side is not None:
        found.append(Message("It was set by hand that it is a {side} foot.", side=edits.side))
    return found


def _unseen_sides(session: Session, results: list[ViewResult]) -> list[str]:
    """Name the sides of the reference system that no used view faces."""
    used = {result.name for result in results if result.used}
    seen = {face for view in session.views if view.name in used for face in view.sensor.faces}
    sides = dict.fromkeys(marker.face for marker in session.manifest.reference_system.markers)
    return [
        Message(
            'No view shows the side of the markers "{face}", so the foot is not measured there.',
            face=side,
        )
        for side in sides
        if side not in seen
    ]


def _one_camera(session: Session, results: list[ViewResult]) -> list[str]:
    """Name the views that one camera cannot have recorded, unless somebody moved it meanwhile.

    Only of sensors that deliver millimetres, whose ``sensor.json`` is put in by hand.
    """
    views = {view.name: view for view in session.views}
    found: list[str] = []
    for first, second in combinations([result for result in results if result.used], 2):
        a, b = views[first.name], views[second.name]
        if a.sensor.depth_unit_mm is None or a.sensor.serial != b.sensor.serial:
            continue
        was_moved = a.times is not None and b.times is not None and not a.times.overlap(b.times)
        if not was_moved and _same_place_mm(first, second) is None:
            found.append(
                Message(
                    "The views {first} and {second} name one camera, {serial}, in two places; "
                    "unless it was moved between them, give each view the sensor.json of its own "
                    "camera.",
                    first=first.name,
                    second=second.name,
                    serial=a.sensor.serial,
                )
            )
    return found


def _same_place_mm(first: ViewResult, second: ViewResult) -> float | None:
    """Return how far apart two sensors stood in the same place; None in different places."""
    a, b = first.sensor2reference, second.sensor2reference
    if a is None or b is None:
        return None
    apart_mm = float(np.linalg.norm(a[:3, 3] - b[:3, 3]))
    turned_deg = rotation_angle_deg(a[:3, :3].T @ b[:3, :3])
    is_same = apart_mm < _SAME_PLACE_MM and turned_deg < _SAME_DIRECTION_DEG
    return apart_mm if is_same else None


def _same_places(session: Session, results: list[ViewResult]) -> list[str]:
    """Name the pairs of different sensors that had the same pose."""
    serials = {view.name: view.sensor.serial for view in session.views}
    found: list[str] = []
    for first, second in combinations([result for result in results if result.used], 2):
        if serials[first.name] == serials[second.name]:
            continue
        apart_mm = _same_place_mm(first, second)
        if apart_mm is not None:
            found.append(
                Message(
                    "The sensors of the views {first} and {second} stood in the same place "
                    "({apart_mm:.0f} mm apart); see that no view was recorded under two names.",
                    first=first.name,
                    second=second.name,
                    apart_mm=apart_mm,
                )
            )
    return found
