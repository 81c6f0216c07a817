"""The measures that a visit keeps, to be followed over the years."""

from __future__ import annotations

from collections.abc import Iterable

from insole_core.cases.case_record import FootRecord
from insole_core.foot.measures import DEFINITIONS, measure
from insole_core.workflows.foot_landmarks import landmarks_of

_UNIT = {"mm": "_mm", "degrees": "", "": ""}
"""What a key of the record ends with; names of angles already end so."""


def visit_measures(feet: Iterable[FootRecord]) -> dict[str, float]:
    """Return the measures of feet by side, name and unit: ``left_foot_length_mm``.

    Measures that a scan does not show are left out, and feet that were not scanned on this visit.
    """
    return {
        f"{foot.side}_{key}{_UNIT[DEFINITIONS[key].unit]}": round(value, 3)
        for foot in feet
        if not foot.foot.mirrored and not foot.foot.scanned_on
        for key, value in measure(foot.foot, landmarks_of(foot)).items()
        if value is not None
    }
