"""The matching of detections to markers after the user's corrections."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.transforms import rigid
from insole_core.reconstruct.markers.detections import Detections, locate_places
from insole_core.reconstruct.markers.marker_matching import MarkerMatch
from insole_core.reconstruct.poses.pose_batch import PoseBatch, Sight, improved, matches
from insole_core.recording.hand_edits import NamedSpot, Region, ViewEdits
from insole_core.recording.session import Marker
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor

SNAP_SHARE = 12 / 1280
"""Largest distance from where the user pointed to the detection meant, per image width."""
ENOUGH_NAMES = 4
"""Number of markers named by the user that alone determine the sensor's pose."""
_FOLLOW_SHARES = np.geomspace(30, 3, 6) / 1280


@dataclass(frozen=True, eq=False)
class EditedMatch:
    """Detections matched to markers, with the user's corrections.

    Parameters
    ----------
    markers
        Those that the view can see.
    sightings
        The detections of the view.
    pairs
        Indices into both, in the order of the markers.
    by_hand, excluded : (k,) bool
        Whether the user pointed at the marker of each pair, and whether the user excluded it.
    """

    markers: tuple[Marker, ...]
    sightings: Detections
    pairs: MarkerMatch
    by_hand: BoolArray
    excluded: BoolArray

    @property
    def positions(self) -> FloatArray:
        """(k, 3) positions of the markers in the reference system, mm, reference frame."""
        return positions_of(self.markers)[self.pairs.markers]

    @property
    def points(self) -> FloatArray:
        """(k, 3) measured positions, mm, depth camera frame."""
        return self.sightings.points[self.pairs.points]

    @property
    def pixels(self) -> FloatArray:
        """(k, 2) positions in the colour image, px."""
        return self.sightings.pixels[self.pairs.points]


def positions_of(markers: tuple[Marker, ...]) -> FloatArray:
    """Return the positions (m, 3) of markers, mm, reference frame."""
    return np.array([marker.position_mm for marker in markers], dtype=float).reshape(-1, 3)


def searched(pixels: FloatArray, edits: ViewEdits) -> BoolArray:
    """Return which positions may show markers, by the regions that the user drew.

    Parameters
    ----------
    pixels : (n, 2) float64, px, colour image
    edits

    Returns
    -------
    (n,) bool
    """
    may = np.ones(len(pixels), dtype=bool)
    if edits.searched is not None:
        may &= _inside(pixels, edits.searched)
    for region in edits.ignored:
        may &= ~_inside(pixels, region)
    return may


def with_places(
    sightings: Detections, depth_mm: FloatArray, sensor: Sensor, edits: ViewEdits
) -> Detections:
    """Append the positions that the user pointed at and where nothing was detected.

    Parameters
    ----------
    sightings
    depth_mm : (height, width) float64, along z; NaN = no reading
    sensor
    edits

    Returns
    -------
    Detections
        `sightings` itself when nothing is to be added.
    """
    missing = [
        spot.pixel
        for spot in edits.named
        if spot.exact or _nearest(spot, sightings, sensor.color_camera) is None
    ]
    if not missing:
        return sightings
    pixels = np.array(missing, dtype=float)
    return sightings.with_places(pixels, locate_places(pixels, sensor.points(depth_mm), sensor))


def named(
    pairs: MarkerMatch,
    markers: tuple[Marker, ...],
    sightings: Detections,
    camera: PinholeCamera,
    edits: ViewEdits,
) -> EditedMatch:
    """Apply the user's corrections to a matching.

    Parameters
    ----------
    pairs
        The automatic matching; indices into `sightings` and `markers`.
    markers
        Those that the view can see.
    sightings
        With the positions that the user pointed at (see `with_places`).
    camera
        The colour camera.
    edits

    Returns
    -------
    EditedMatch
        In which a marker named by the user has the detection pointed at, and no other marker has.

    Raises
    ------
    ReconstructionError
        When the user pointed at a position without a detection, or too few markers are left.
    """
    index = {marker.id: number for number, marker in enumerate(markers)}
    spots = [spot for spot in edits.named if spot.id in index]
    rows_said = _rows(spots, sightings, camera)
    said = {index[spot.id]: row for spot, row in zip(spots, rows_said, strict=True)}
    rows = {
        marker: (point, used)
        for marker, point, used in zip(
            pairs.markers.tolist(), pairs.points.tolist(), pairs.used.tolist(), strict=True
        )
        if point not in said.values()
    }
    rows |= {marker: (point, True) for marker, point in said.items()}
    order = sorted(rows)
    excluded = np.array([markers[marker].id in edits.excluded for marker in order], dtype=bool)
    _check_enough(order, excluded, edits)
    return EditedMatch(
        markers,
        sightings,
        MarkerMatch(
            np.array([rows[marker][0] for marker in order], dtype=np.int64),
            np.array(order, dtype=np.int64),
            np.array([rows[marker][1] for marker in order], dtype=bool) & ~excluded,
        ),
        np.array([marker in said for marker in order], dtype=bool),
        excluded,
    )


def follow_names(
    markers: tuple[Marker, ...], sightings: Detections, camera: PinholeCamera, edits: ViewEdits
) -> tuple[MarkerMatch, FloatArray]:
    """Find the camera's pose from the markers named by the user, then match the others.

    Parameters
    ----------
    markers
        Those that the view can see.
    sightings
        With the positions that the user pointed at (see `with_places`).
    camera
        The colour camera.
    edits
        With names for four markers or more.

    Returns
    -------
    pairs : MarkerMatch
    reference2color : (4, 4) float64, mm

    Raises
    ------
    ReconstructionError
        When no pose of the camera explains the named markers.
    """
    index = {marker.id: number for number, marker in enumerate(markers)}
    spots = [spot for spot in edits.named if spot.id in index]
    positions = positions_of(markers)
    pointed = np.array(_rows(spots, sightings, camera))
    places = positions[[index[spot.id] for spot in spots]]
    # The regions limit the other markers only; a named one counts wherever it lies.
    may = searched(sightings.pixels, edits)
    may[pointed] = True
    rows = np.flatnonzero(may)
    sight = Sight(camera.normalised(sightings.pixels[rows]), positions)
    poses = _pose_of(places, camera.normalised(sightings.pixels[pointed]))
    for share in _FOLLOW_SHARES:
        poses = improved(poses, sight, float(share * camera.width / camera.fx))
    if len(poses.rotations) == 0:
        raise ReconstructionError(
            "the {count} markers that were pointed at cannot be seen at these places from "
            "anywhere; check which marker is which",
            count=len(spots),
        )
    near = float(_FOLLOW_SHARES[-1] * camera.width / camera.fx)
    nearest, explained, _ = matches(poses, sight, near)
    found = np.flatnonzero(explained[0])
    pairs = MarkerMatch(rows[nearest[0, found]], found, np.ones(len(found), dtype=bool))
    return pairs, rigid(poses.rotations[0], poses.translations[0])


def _pose_of(places: FloatArray, rays: FloatArray) -> PoseBatch:
    """Compute the pose from markers (k, 3) and their normalised image coordinates (k, 2), k > 3."""
    try:
        found, turn, shift = cv2.solvePnP(places, rays, np.eye(3), None, flags=cv2.SOLVEPNP_SQPNP)
    except cv2.error:  # the rays are almost one
        found = False
    if not found:
        return PoseBatch(np.zeros((0, 3, 3)), np.zeros((0, 3)))
    return PoseBatch(cv2.Rodrigues(turn)[0][None], shift.reshape(1, 3))


def _check_enough(order: list[int], excluded: BoolArray, edits: ViewEdits) -> None:
    left = len(order) - int(excluded.sum())
    if left < ENOUGH_NAMES:
        raise ReconstructionError(
            "only {left} of the {count} markers are left after the corrections by hand "
            "({corrections}), and {least} are needed; include or add markers",
            left=left,
            count=len(order),
            corrections=edits.summary(),
            least=ENOUGH_NAMES,
        )


def _rows(spots: list[NamedSpot], sightings: Detections, camera: PinholeCamera) -> list[int]:
    rows = [_row(spot, sightings, camera) for spot in spots]
    for number, row in enumerate(rows):
        if row in rows[:number]:
            raise ReconstructionError(
                "the markers {first} and {second} were pointed at in one place; point at each "
                "where it is",
                first=spots[rows.index(row)].id,
                second=spots[number].id,
            )
    return rows


def _row(spot: NamedSpot, sightings: Detections, camera: PinholeCamera) -> int:
    row = _nearest(spot, sightings, camera)
    if row is None:
        u, v = spot.pixel
        raise ReconstructionError(
            "the marker {marker} was pointed at where the colour image shows nothing ({u:.0f}, "
            "{v:.0f}); point at it again",
            marker=spot.id,
            u=u,
            v=v,
        )
    return row


def _nearest(spot: NamedSpot, sightings: Detections, camera: PinholeCamera) -> int | None:
    """Return the index of the detection meant; one added by the user counts before a blob."""
    if len(sightings) == 0:
        return None
    distance = np.linalg.norm(sightings.pixels - spot.pixel, axis=1)[::-1]
    row = int(distance.argmin())
    return len(distance) - 1 - row if distance[row] <= SNAP_SHARE * camera.width else None


def _inside(pixels: FloatArray, region: Region) -> BoolArray:
    outline = np.array(region, dtype=np.float32).reshape(-1, 1, 2)
    return np.array(
        [cv2.pointPolygonTest(outline, (float(u), float(v)), False) >= 0 for u, v in pixels],
        dtype=bool,
    )
