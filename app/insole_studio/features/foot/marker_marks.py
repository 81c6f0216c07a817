"""Marks on the colour image of a view: its markers, and blue spots that are none."""

from __future__ import annotations

import numpy as np

from insole_core.reconstruct import MarkerObservation, ViewResult
from insole_core.reconstruct.views.measured_view import MeasuredView
from insole_core.recording.hand_edits import ViewEdits
from insole_studio.features.foot.rows import Mark, MarkState

_SAME_PX = 1.0


def marks_of(measured: MeasuredView, result: ViewResult, edits: ViewEdits) -> tuple[Mark, ...]:
    """Return the marks of a view, markers first.

    Without a pose only manually placed markers are known.

    Parameters
    ----------
    measured
        The detections in the view.
    result
        The estimated pose, if any, and its residuals.
    edits
        The manual corrections of the view.
    """
    marks = [
        Mark(
            fix.id,
            fix.pixel,
            fix.projected,
            _state(fix),
            fix.by_hand,
            fix.reprojection_px,
            fix.residual_mm,
        )
        for fix in result.fixes
    ]
    known = {mark.id for mark in marks}
    marks += [
        Mark(spot.id, spot.pixel, None, "unused", by_hand=True)
        for spot in edits.named
        if spot.id not in known
    ]
    taken = np.array([mark.pixel for mark in marks]).reshape(-1, 2)
    spots = [
        Mark("", (float(u), float(v)), None, "spot")
        for u, v in measured.blobs.centroids
        if not (np.abs(taken - [u, v]).max(axis=1) < _SAME_PX).any()
    ]
    return (*marks, *spots)


def _state(fix: MarkerObservation) -> MarkState:
    if fix.excluded:
        return "excluded"
    return "used" if fix.used else "unused"
