"""The pose of one view from the markers that its sensor saw.

It is found by Horn's method from their positions in space, as in the thesis (6.2.2, 6.2.3), or from
their positions in the colour image, which are an order of magnitude finer; Horn's pose is then the
start. The user's corrections take precedence over both.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.errors import ReconstructionError
from insole_core.geometry.absolute_orientation import absolute_orientation
from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.transforms import inverse, transform
from insole_core.messages import Message, joined
from insole_core.reconstruct.markers.blobs import Blobs
from insole_core.reconstruct.markers.detections import Detections
from insole_core.reconstruct.markers.edited_matching import (
    ENOUGH_NAMES,
    EditedMatch,
    follow_names,
    named,
    positions_of,
    searched,
)
from insole_core.reconstruct.markers.image_matching import match_in_image
from insole_core.reconstruct.markers.marker_faces import apparent_centers
from insole_core.reconstruct.markers.marker_matching import MarkerMatch, match_markers
from insole_core.reconstruct.markers.marker_observation import MarkerObservation, Registration
from insole_core.reconstruct.poses.camera_pose import CameraPose, SeenMarkers, fit_camera_pose
from insole_core.reconstruct.poses.pose_quality import (
    DEFAULT_LIMITS,
    RegistrationLimits,
    check_pose,
)
from insole_core.reconstruct.volume import enclosed_volume
from insole_core.recording.hand_edits import NO_VIEW_EDITS, ViewEdits
from insole_core.recording.session import Marker, ReferenceSystem
from insole_core.sensing.sensor import Sensor

_LEAST_PRECISE = 6
_LARGEST_LOSS = 0.05
_USUAL_LOSSES = 3.0
"""A marker is partly hidden or merges with another when its fill is less than the median by more
than `_LARGEST_LOSS` of it and by more than `_USUAL_LOSSES` standard deviations of the fills."""
_LEAST_WEIGHT = 0.1
"""Below this weight a marker is off by more than three times its noise and hardly counts."""


@dataclass(frozen=True)
class PoseSearch:
    """The search for the pose of one view; every method raises when it finds none.

    Parameters
    ----------
    system
    sensor
        Its faces are the marker groups that are searched for.
    limits
    edits
        The user's corrections; the positions pointed at are among the sightings.

    Raises
    ------
    ReconstructionError
        With the reason, as the end of a sentence.
    """

    system: ReferenceSystem
    sensor: Sensor
    limits: RegistrationLimits = DEFAULT_LIMITS
    edits: ViewEdits = NO_VIEW_EDITS

    def by_places(self, sightings: Detections) -> Registration:
        """Find the pose by Horn's method on the markers' positions in space, thesis (2) - (6)."""
        match = self._named(sightings)
        a2b = _by_horn(match)
        registration = Registration(a2b, _fixes(a2b, match))
        check_pose(registration, self.limits)
        return registration

    def by_pixels(self, sightings: Detections) -> Registration:
        """Find the pose of least reprojection error, starting from Horn's.

        The centres of the sightings must be known to a fraction of a pixel. When the user named
        enough markers, the start is the pose that follows from these.
        """
        if len(self.edits.named) >= ENOUGH_NAMES:
            markers, camera = self._facing(), self.sensor.color_camera
            pairs, start = follow_names(markers, sightings, camera, self.edits)
            return self._fitted(named(pairs, markers, sightings, camera, self.edits), start)
        match = self._named(sightings)
        return self._fitted(match, self.sensor.depth2color @ inverse(_by_horn(match)))

    def in_image(self, blobs: Blobs) -> Registration:
        """Find the pose from sharpened blobs alone, when depth cannot identify the markers."""
        markers, camera = self._facing(), self.sensor.color_camera
        rows = np.flatnonzero(searched(blobs.centroids, self.edits))
        found = match_in_image(
            blobs.centroids[rows], blobs.areas[rows], positions_of(markers), camera
        )
        # Depth is not used here, so no detection has a position in space.
        nowhere = np.full((len(blobs), 3), np.nan)
        sightings = Detections(blobs.centroids, nowhere, blobs.spreads, blobs.fills)
        exact = np.array([spot.pixel for spot in self.edits.named if spot.exact]).reshape(-1, 2)
        sightings = sightings.with_places(exact, np.full((len(exact), 3), np.nan))
        match = named(_of_rows(found.pairs, rows), markers, sightings, camera, self.edits)
        return self._fitted(match, found.reference2color)

    def _facing(self) -> tuple[Marker, ...]:
        faces = self.sensor.faces
        markers = self.system.facing(faces)
        if not markers:
            raise ReconstructionError(
                'its sensor.json lists the faces {faces}, but the reference system "{system}" has '
                "the faces {system_faces}",
                faces=_quoted(faces),
                system=self.system.name,
                system_faces=_quoted(_groups(self.system)),
            )
        return markers

    def _named(self, sightings: Detections) -> EditedMatch:
        """Match the markers by their positions in space, then apply the user's corrections."""
        markers = self._facing()
        may = searched(sightings.pixels, self.edits)
        may[len(sightings) - sightings.placed :] = False
        rows = np.flatnonzero(may)
        points = sightings.points[rows]
        try:
            found = match_markers(points, positions_of(markers), self.limits.assignment)
        except ReconstructionError as error:
            if len(self.edits.named) < ENOUGH_NAMES:
                raise ReconstructionError(self._why_unassigned(error, points)) from error
            nothing = np.zeros(0, dtype=np.int64)
            found = MarkerMatch(nothing, nothing, np.zeros(0, dtype=bool))
        camera = self.sensor.color_camera
        return named(_of_rows(found, rows), markers, sightings, camera, self.edits)

    def _fitted(self, match: EditedMatch, start: FloatArray) -> Registration:
        """Fit the pose to matched markers and check it."""
        counted, camera = ~match.excluded, self.sensor.color_camera
        pixels, positions = match.pixels, match.positions
        precise = _precise(match)[counted]
        seen = SeenMarkers(
            positions[counted],
            positions[counted],
            np.where(precise[:, None], pixels[counted], np.nan),
            transform(self.sensor.depth2color, match.points[counted])[:, 2],
        )
        pose = fit_camera_pose(seen, camera, start)
        spreads = _spreads(match)
        centers = positions
        if spreads is not None:
            centers = apparent_centers(positions, spreads, camera, pose.reference2color)
            seen = replace(seen, centers=centers[counted])
            pose = fit_camera_pose(seen, camera, pose.reference2color)
        used = np.zeros(len(pixels), dtype=bool)
        used[counted] = pose.weights > _LEAST_WEIGHT
        projected = camera.project(transform(pose.reference2color, centers))
        sensor2reference = inverse(pose.reference2color) @ self.sensor.depth2color
        fixes = _fixes(sensor2reference, _placed_on_rays(match, self.sensor, pose))
        registration = Registration(
            sensor2reference,
            tuple(_seen_in_image(fix, projected[i], bool(used[i])) for i, fix in enumerate(fixes)),
            pose,
            pose.displacement_mm(_middle(self.system)),
        )
        check_pose(registration, self.limits)
        return registration

    def _why_unassigned(self, error: ReconstructionError, points: FloatArray) -> str:
        """Explain why no pose was found; the likeliest cause is that two views were exchanged."""
        if len(points) == 0:
            return (
                "no blue marker with a depth reading is seen; check the light and that the "
                "reference system is in the picture"
            )
        for group in _groups(self.system):
            if group in self.sensor.faces:
                continue
            try:
                match_markers(
                    points, positions_of(self.system.facing((group,))), self.limits.assignment
                )
            except ReconstructionError:
                continue
            return Message(
                "its sensor.json says that it sees the markers {faces}, but it sees "
                '"{face}"; exchange the views, or correct "faces" there',
                faces=_quoted(self.sensor.faces),
                face=group,
            )
        return Message(
            'the markers of the reference system "{system}" are not recognised: {reason}',
            system=self.system.name,
            reason=error.message,
        )


def _of_rows(pairs: MarkerMatch, rows: IntArray) -> MarkerMatch:
    """Convert indices among the chosen rows to indices among all detections."""
    return replace(pairs, points=rows[pairs.points])


def _by_horn(match: EditedMatch) -> FloatArray:
    """Compute sensor2reference (4, 4) from the markers' positions in space."""
    weights = (match.pairs.used & np.isfinite(match.points[:, 2])).astype(float)
    if weights.sum() < ENOUGH_NAMES - 1:
        raise ReconstructionError(
            "only {count:.0f} of its markers have a depth reading; see that more markers are in "
            "view",
            count=weights.sum(),
        )
    points = np.nan_to_num(match.points)
    return absolute_orientation(points, match.positions, weights).a2b


def _seen_in_image(fix: MarkerObservation, projected: FloatArray, used: bool) -> MarkerObservation:
    u, v = projected.tolist()
    missed = float(np.linalg.norm(projected - fix.pixel))
    return replace(fix, used=used, reprojection_px=missed, projected=(u, v))


def _middle(system: ReferenceSystem) -> FloatArray:
    """Return the centre (3,) of the space for the foot, mm, reference frame."""
    box = enclosed_volume(system)
    return np.add(box.min_mm, box.max_mm) / 2


def _spreads(match: EditedMatch) -> FloatArray | None:
    """Return the spreads (k, 2, 2) of the markers; those without one get the mean."""
    if match.sightings.spreads is None:
        return None
    spreads = match.sightings.spreads[match.pairs.points]
    known = np.isfinite(spreads[:, 0, 0])
    if not known.any():
        return None
    return np.asarray(np.where(known[:, None, None], spreads, spreads[known].mean(0)))


def _placed_on_rays(match: EditedMatch, sensor: Sensor, pose: CameraPose) -> EditedMatch:
    """Place markers without a depth reading on their rays, at the distance the pose predicts."""
    unknown = np.flatnonzero(np.isnan(match.points[:, 2]))
    if len(unknown) == 0:
        return match
    rows, camera = match.pairs.points[unknown], sensor.color_camera
    away = transform(pose.reference2color, match.positions[unknown])[:, 2:]
    rays = np.column_stack([camera.normalised(match.pixels[unknown]), np.ones(len(rows))])
    points = match.sightings.points.copy()
    points[rows] = transform(inverse(sensor.depth2color), rays * away)
    return replace(match, sightings=replace(match.sightings, points=points))


def _precise(match: EditedMatch) -> BoolArray:
    """Return which markers (k,) are seen whole; all of them when too few are."""
    whole = np.ones(len(match.pairs.points), dtype=bool)
    if match.sightings.fills is None:
        return whole
    fills = match.sightings.fills[match.pairs.points]
    if not np.isfinite(fills).any():
        return whole
    # A position that the user pointed at has no shape and is trusted.
    loss = 1 - fills / np.nanmedian(fills)
    std = 1.4826 * float(np.nanmedian(np.abs(loss)))
    unspoilt = np.isnan(fills) | (loss < max(_LARGEST_LOSS, _USUAL_LOSSES * std))
    return np.asarray(unspoilt) if unspoilt.sum() >= _LEAST_PRECISE else whole


def _fixes(a2b: FloatArray, match: EditedMatch) -> tuple[MarkerObservation, ...]:
    measured = transform(a2b, match.points)
    residuals = np.linalg.norm(measured - match.positions, axis=1)
    fixes = []
    for i, marker in enumerate(match.pairs.markers):
        u, v = match.pixels[i].tolist()
        x, y, z = measured[i].tolist()
        fixes.append(
            MarkerObservation(
                match.markers[marker].id,
                (u, v),
                (x, y, z),
                float(residuals[i]),
                bool(match.pairs.used[i]),
                by_hand=bool(match.by_hand[i]),
                excluded=bool(match.excluded[i]),
            )
        )
    return tuple(fixes)


def _groups(system: ReferenceSystem) -> tuple[str, ...]:
    return tuple(dict.fromkeys(marker.face for marker in system.markers))


def _quoted(words: tuple[str, ...]) -> str:
    return joined(f'"{word}"' for word in words) or "none"
