"""Pads and the line of the metatarsal heads: clearance and snapping."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from insole_core.cases.case_record import CaseRecord
from insole_core.insole.elements import Pelott
from insole_core.insole.fields import Place
from insole_core.insole.pads.clearance import Clearance
from insole_core.insole.pads.clearance import clearance as pad_clearance
from insole_core.insole.pads.pad_places import placed_pad
from insole_core.workflows.foot_landmarks import landmarks_of, metatarsal_line
from insole_studio.features.design.tools.tool import place_at

SNAP_MM = 1.5
NEAR_MM = 30.0


def clearance(record: CaseRecord, pad: Pelott) -> Clearance | None:
    """Return the clearance of a pad from the line of the metatarsal heads.

    Parameters
    ----------
    record
        The open case.
    pad
        The pad.

    Returns
    -------
    Clearance or None
        None if the line does not matter for the pad.
    """
    line = metatarsal_line(record) if pad.ends_behind_heads else None
    return None if line is None else pad_clearance(pad, line[:, :2])


def usual_place(record: CaseRecord, pad: Pelott, behind_heads_mm: float) -> Place | None:
    """Return the default position of a pad, behind the middle heads; None without a foot."""
    landmarks, side = landmarks_of(record), record.side
    if not landmarks or side is None:
        return None
    return placed_pad(pad, "metatarsal_line", side, landmarks, behind_heads_mm).centre_mm


def snapped(record: CaseRecord, pad: Pelott, behind_heads_mm: float) -> Pelott:
    """Return the pad, moved to the usual distance behind the heads if it is almost there.

    Parameters
    ----------
    record
        The open case.
    pad
        The pad being dragged.
    behind_heads_mm
        The usual distance of the front edge, by the clinic's rules.
    """
    found = clearance(record, pad)
    if found is None or abs(found.distance_mm - behind_heads_mm) > SNAP_MM:
        return pad
    ahead = (found.nearest - found.front) / (found.distance_mm or 1.0)
    moved = np.array(pad.centre_mm) + (found.distance_mm - behind_heads_mm) * ahead
    return replace(pad, centre_mm=place_at(moved, 0.01))
