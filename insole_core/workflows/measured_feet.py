"""The measures of feet with their ±, by what is known of the scan and of the place."""

from __future__ import annotations

from collections.abc import Iterable

from insole_core.cases.case_record import FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import Landmarks, find_landmarks
from insole_core.foot.spread import MeasuredFoot, measure_foot
from insole_core.geometry.side import Side
from insole_core.workflows.calibration.repeat_tests import repeated_limits
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_core.workflows.scanned_feet import ScannedFoot


def measured_scan(scanned: ScannedFoot) -> MeasuredFoot:
    """Measure a foot by the landmarks that its shape shows."""
    return _measured(scanned.foot, find_landmarks(scanned.foot), scanned.source)


def measured_record(foot: FootRecord) -> MeasuredFoot:
    """Measure a foot of a case by its landmarks, those set by hand included."""
    return _measured(foot.foot, landmarks_of(foot), foot.source)


def measured_feet(feet: Iterable[FootRecord]) -> dict[Side, MeasuredFoot]:
    """Measure the feet that have measures of their own: a mirror image has none."""
    return {foot.side: measured_record(foot) for foot in feet if not foot.foot.mirrored}


def _measured(foot: Foot, landmarks: Landmarks, source: ScanSource) -> MeasuredFoot:
    is_recorded = source.kind == "session" or foot.mesh.touches is not None
    repeated = repeated_limits(source.place)
    return measure_foot(foot, landmarks, is_recorded=is_recorded, repeated=repeated)
