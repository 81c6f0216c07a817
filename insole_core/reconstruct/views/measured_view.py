"""The measurement of one view before its sensor's pose is known, and the faults of its picture."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property

import cv2
import numpy as np

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import BoolArray, ByteArray, FloatArray, RawArray
from insole_core.memo import Memo
from insole_core.messages import Message, joined
from insole_core.reconstruct.markers.blobs import Blobs, blueness, find_blobs, sharpened
from insole_core.reconstruct.markers.detections import Detections, locate_blobs
from insole_core.reconstruct.markers.edited_matching import with_places
from insole_core.reconstruct.markers.marker_observation import Registration
from insole_core.reconstruct.poses.depth_scale import depth_scale, scale_note
from insole_core.reconstruct.poses.pose_quality import (
    DEFAULT_LIMITS,
    PoseRefusedError,
    RegistrationLimits,
)
from insole_core.reconstruct.poses.registration import PoseSearch
from insole_core.reconstruct.result import ViewResult, placed_result
from insole_core.reconstruct.views.coloring import steady_color
from insole_core.reconstruct.warnings import (
    check_still,
    check_unit,
    correction_note,
    lateness_note,
    motion_note,
)
from insole_core.recording.hand_edits import NO_VIEW_EDITS, ViewEdits
from insole_core.recording.session import ReferenceSystem, View
from insole_core.sensing.disparity import ScaledDisparity
from insole_core.sensing.frames import RawAverage, average_raw, median_raw
from insole_core.sensing.readings import Readings

_DARK = 40
"""Brightness (of 255) exceeded by one pixel in a hundred; 140 and more in a usual picture."""
_MARGIN_PX = 6
_GLARING = 250
_GLARING_SHARE = 0.25
_STEEPEST = 0.15
"""Change per pixel at a marker's rim, as a share of its blueness: 0.33 in a sharp picture, 0.13
when it is blurred by 3 px."""


def _picture_fault(color: ByteArray, blobs: Blobs) -> str:
    """Check whether a picture is dark, overexposed or out of focus.

    Parameters
    ----------
    color : (height, width, 3) uint8, RGB
    blobs
        Marker candidates found in `color`; focus is judged at their rims.

    Returns
    -------
    str
        The fault, as the start of a sentence; empty when there is none.
    """
    small = cv2.resize(color, None, fx=0.25, fy=0.25, interpolation=cv2.INTER_AREA)
    red, green, blue = cv2.split(small)
    if np.percentile(cv2.max(cv2.max(red, green), blue), 99) < _DARK:
        return "its colour picture is almost dark; give more light or a longer exposure"
    if (cv2.min(cv2.min(red, green), blue) >= _GLARING).mean() > _GLARING_SHARE:
        return "its colour picture is overexposed; take away light or shorten the exposure"
    if len(blobs) and _sharpness(color, blobs) < _STEEPEST:
        return "its colour picture is out of focus; clean the lens and see that the camera is still"
    return ""


def _sharpness(color: ByteArray, blobs: Blobs) -> float:
    """Compute the steepest relative change of the blueness per pixel of the sharpest blobs."""
    rows, columns = (_extent(np.any(blobs.labels >= 0, axis=axis)) for axis in (1, 0))
    labels = blobs.labels[rows, columns]
    blue = cv2.GaussianBlur(blueness(color[rows, columns]).astype(np.float32), (0, 0), 0.7)
    along_u, along_v = (
        cv2.Sobel(blue, cv2.CV_32F, du, dv, ksize=1, scale=0.5) for du, dv in ((1, 0), (0, 1))
    )
    label = cv2.dilate((labels + 1).astype(np.float32), np.ones((5, 5), np.uint8))
    at = label > 0
    index = label[at].astype(np.int64) - 1
    order = np.argsort(index, kind="stable")
    starts = np.searchsorted(index[order], np.arange(len(blobs)))
    steepest = np.maximum.reduceat(np.hypot(along_u, along_v)[at][order], starts)
    bluest = np.maximum.reduceat(blue[at][order], starts)
    return float(np.percentile(steepest / np.maximum(bluest, 1), 75))


def _extent(occupied: BoolArray) -> slice:
    """Return the occupied span, with the margin that a blur needs."""
    index = np.flatnonzero(occupied)
    return slice(max(int(index[0]) - _MARGIN_PX, 0), int(index[-1]) + _MARGIN_PX + 1)


@dataclass(frozen=True, eq=False)
class MeasuredView:
    """The averaged frames of one view, independent of its pose and of corrected markers.

    Parameters
    ----------
    view
        With the lattice of its readings in the place of its sensor's pixels.
    raw : (height, width) float64, raw units, corrected; NaN = no reading
    depth_mm : (height, width) float64, along z; NaN = no reading
    color : (height, width, 3) uint8, RGB
        Of all colour frames together.
    left_out
        Number of depth frames left out because something moved in them.
    motion_note
        How far it moved, as the end of a sentence; empty when nothing moved.
    precise
        Whether marker centres are measured to a fraction of a pixel.
    """

    view: View
    raw: FloatArray
    depth_mm: FloatArray
    color: ByteArray
    left_out: int
    motion_note: str
    precise: bool
    derived: Memo = field(default_factory=lambda: Memo(2), init=False, repr=False)

    @property
    def points(self) -> FloatArray:
        """(height, width, 3) points, mm, depth camera frame; large, so computed anew each time."""
        return self.view.sensor.points(self.depth_mm)

    @cached_property
    def blobs(self) -> Blobs:
        """Candidates for markers in the colour image."""
        found = find_blobs(self.color)
        return sharpened(self.color, found) if self.precise else found

    @cached_property
    def picture_fault(self) -> str:
        """The fault of the colour picture, as the start of a sentence; empty when it has none."""
        return _picture_fault(self.color, self.blobs)

    @cached_property
    def sightings(self) -> Detections:
        """The blobs whose position in space was measured."""
        return locate_blobs(self.blobs, self.points, self.view.sensor)

    def register(
        self,
        system: ReferenceSystem,
        limits: RegistrationLimits = DEFAULT_LIMITS,
        edits: ViewEdits = NO_VIEW_EDITS,
    ) -> Registration:
        """Find the sensor's pose; fast enough to be repeated while markers are corrected.

        The last ones are kept, for whoever makes a foot of the views that were placed before.

        Parameters
        ----------
        system
            The markers of the reference system, mm, reference frame.
        limits
            How well the markers must fit for the pose to be accepted.
        edits
            The user's corrections of this view's markers.

        Returns
        -------
        Registration
            Pose, and what was decided about every marker; with a depth scale other than 1, for
            `at_scale`.

        Raises
        ------
        ReconstructionError
            With the reason, as the end of a sentence; `PoseRefusedError` also holds the pose that
            was found but not accepted.
        """
        key = (system, limits, edits)
        try:
            return self.derived.get("registration", key, lambda: self._scaled(*key))
        except ReconstructionError as error:
            if not self.picture_fault:
                raise
            reason = Message("{fault} ({reason})", fault=self.picture_fault, reason=error.message)
            if isinstance(error, PoseRefusedError):
                raise PoseRefusedError(reason, error.registration) from error
            raise ReconstructionError(reason) from error

    def _scaled(
        self, system: ReferenceSystem, limits: RegistrationLimits, edits: ViewEdits
    ) -> Registration:
        registration = self._registered(system, limits, edits)
        scale = depth_scale(registration, self.sightings, system, self.view.sensor)
        if scale == 1.0:
            return registration
        again = self.at_scale(scale)._registered(system, limits, edits)
        return replace(again, depth_scale=scale)

    def at_scale(self, scale: float) -> MeasuredView:
        """Return the view with its depth divided by a scale."""
        if scale == 1.0:
            return self
        sensor = self.view.sensor
        corrected = replace(sensor, disparity=ScaledDisparity(sensor.disparity, 1 / scale))
        view = replace(self.view, sensor=corrected)
        return replace(self, view=view, depth_mm=self.depth_mm / scale)

    def _registered(
        self, system: ReferenceSystem, limits: RegistrationLimits, edits: ViewEdits
    ) -> Registration:
        sensor = self.view.sensor
        sightings = with_places(self.sightings, self.depth_mm, sensor, edits)
        search = PoseSearch(system, sensor, limits, edits)
        if not self.precise:
            return search.by_places(sightings)
        try:
            return search.by_pixels(sightings)
        except ReconstructionError as error:
            try:
                return search.in_image(self.blobs)
            except ReconstructionError:
                raise error from None


def measure_view(view: View) -> MeasuredView:
    """Average a view's frames in disparity and leave out those in which something moved.

    Raises
    ------
    ReconstructionError
        When most frames show motion or none holds a reading; the message is the end of a sentence.
    """
    check_unit(view)
    readings = Readings.of(view.sensor)
    average = average_raw(_numbers(view, readings), readings.per_raw)
    check_still(average)
    view = replace(view, sensor=readings.sensor)
    raw, depth_mm = _depth(view, average)
    note = motion_note(view, average)
    return MeasuredView(
        view, raw, depth_mm, steady_color(view), len(average.moved), note, precise=True
    )


def used_result(measured: MeasuredView, registration: Registration, note: str = "") -> ViewResult:
    """Return the result of a view that is part of the foot.

    Parameters
    ----------
    measured
    registration
    note
        A further remark for the user, appended to the view's own.

    Returns
    -------
    ViewResult
        Marked as used, its remarks joined in `reason`.
    """
    foreign = correction_note(measured.view.sensor)
    scale = scale_note(registration.depth_scale)
    late = lateness_note(measured.view)
    notes = (measured.motion_note, measured.picture_fault, foreign, scale, late, note)
    return replace(
        placed_result(measured.view.name, registration),
        used=True,
        reason=joined(filter(None, notes), "; "),
        frames=measured.view.depth_count,
        left_out=measured.left_out,
        family=measured.view.sensor.family,
    )


def measure_as_thesis(view: View) -> MeasuredView:
    """Take the median of a view's frames, depth in whole mm, thesis (12), (16), 6.1.

    Raises
    ------
    ReconstructionError
        When no frame holds a reading; the message is the end of a sentence.
    """
    check_unit(view)
    readings = Readings.of(view.sensor)
    median = median_raw(_numbers(view, readings), readings.per_raw)
    view = replace(view, sensor=readings.sensor)
    average = RawAverage(median, np.zeros_like(median), view.depth_count, (), 0.0)
    raw, depth_mm = _depth(view, average)
    whole_mm = np.asarray(np.rint(depth_mm))
    return MeasuredView(view, raw, whole_mm, steady_color(view), 0, "", precise=False)


def _depth(view: View, average: RawAverage) -> tuple[FloatArray, FloatArray]:
    """Return the corrected raw image and its depth in mm."""
    raw = view.sensor.corrected(average.raw)
    depth_mm = view.sensor.disparity.depth_mm(raw)
    if not np.isfinite(depth_mm).any():
        raise ReconstructionError(
            "its depth frames hold no reading; check the sensor's distance and that no "
            "sunlight falls on the foot"
        )
    return raw, depth_mm


def _numbers(view: View, readings: Readings) -> Iterable[RawArray]:
    return (readings.numbers(view.read_depth(index)) for index in range(view.depth_count))
