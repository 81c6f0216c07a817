"""Pads and the line of the metatarsal heads: distances that are shown."""

from __future__ import annotations

from insole_core.cases.case_record import CaseRecord
from insole_core.insole.elements import Pelott
from insole_core.insole.elements.pad_places import placed_pad
from insole_core.insole.fields import Place
from insole_core.insole.pads.clearance import Clearance
from insole_core.insole.pads.clearance import clearance as pad_clearance
from insole_core.workflows.foot_landmarks import landmarks_of, metatarsal_line
from insole_studio.document.case import Case
from insole_studio.texts import localised, tr

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


def selected_pelott(case: Case) -> Pelott | None:
    """Return the selected correction if it is a pad of the shown design."""
    design = case.shown.design
    return None if design is None else design.found(case.selection, Pelott)


def clearance_text(case: Case) -> str:
    """Return how far the selected pad ends from the metatarsal heads; empty if far away."""
    pad = selected_pelott(case)
    found = clearance(case.shown, pad) if pad is not None else None
    if found is None or abs(found.distance_mm) > NEAR_MM:
        return ""
    behind = tr("Front edge {distance} mm behind the metatarsal heads")
    ahead = tr("Front edge {distance} mm ahead of the metatarsal heads")
    sentence = ahead if found.distance_mm < 0 else behind
    return sentence.format(distance=localised(abs(found.distance_mm)))
