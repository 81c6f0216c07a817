"""Guide lines in the views: axes of the rearfoot, the sole's level, rings, a shoe."""

from __future__ import annotations

import numpy as np

from insole_core.cases.case_record import CaseRecord
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.outline.shoe_outline import ShoeOutline
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_studio.document.case import Case
from insole_studio.features.design.tools.tool import Tool
from insole_studio.features.design.tools.turn_tool import TurnTool, ring_centre
from insole_studio.scene.guide_lines import GuideLines
from insole_studio.texts import fill, localised, tr

LEVEL_HALF_MM = 42.0
"""Wider than a heel, and short of the words beside the ball."""
BELOW_MM = np.array([0.0, -9.0, -9.0])
"""Offset of the angle's text from its line, seen from below and from behind."""
BEYOND = 0.25
"""Share of its length by which an axis is extended at both ends."""
_TEXT_AHEAD_MM, _TEXT_BESIDE_MM, _TEXT_ABOVE_MM = 70.0, 6.0, 60.0
"""So that the text lies beside the shoe from below, and above the insole from the sides."""


def axes_of(case: Case, tool: Tool) -> GuideLines | None:
    """Return the guide lines of a tool: the rearfoot axes, or the rings of the turn tool."""
    if isinstance(tool, TurnTool):
        return _rings(case, tool)
    if tool.key not in ("posting", "key_point"):
        return None
    found = rear_lines(case.shown)
    return found if found is None or tool.key == "posting" else found.axes_alone()


def _rings(case: Case, tool: TurnTool) -> GuideLines | None:
    """Return the rotation rings, with the current angle in front of the toes."""
    rings, foot = tool.rings(case), case.foot
    if foot is None or not rings:
        return None
    x, _, z = ring_centre(foot)
    return GuideLines(rings, np.array([x, foot.mesh.bounds_mm[1, 1], z]), tool.text)


def rear_lines(record: CaseRecord) -> GuideLines | None:
    """Return the rearfoot axes and the sole's level; None if the leg was not scanned."""
    landmarks = landmarks_of(record)
    if record.foot is None or "achilles_lower" not in landmarks:
        return None
    lines = [
        _axis(landmarks[f"{name}_lower"].point, landmarks[f"{name}_upper"].point)
        for name in ("achilles", "calcaneus")
        if f"{name}_upper" in landmarks
    ]
    x, y, _ = landmarks["achilles_lower"].point
    level = np.array([[x - LEVEL_HALF_MM, y, 0.0], [x + LEVEL_HALF_MM, y, 0.0]])
    way = lines[0][1] - lines[0][0]
    lean = float(np.degrees(np.arctan2(record.foot.side.medial_sign * way[0], way[2])))
    kind = tr("valgus") if lean > 0 else tr("varus")
    text = tr("{angle}° {kind}").format(angle=localised(abs(lean)), kind=kind)
    # Below the lateral end, clear of lines and handles, which are at the medial edge.
    end = level[0] if record.foot.side.medial_sign > 0 else level[1]
    return GuideLines((*lines, level), end + BELOW_MM, text)


def _axis(lower: FloatArray, upper: FloatArray) -> FloatArray:
    more = BEYOND * (upper - lower)
    return np.stack([lower - more, upper + more])


def shoe_lines(shoe: ShoeOutline) -> GuideLines:
    """Return inside, sole and heel of a shoe, and what they mean in millimetres."""
    ahead_mm = np.abs(shoe.ground[:, 1] - shoe.heel[0, 1] - _TEXT_AHEAD_MM)
    level = shoe.ground[ahead_mm.argsort()[:12]]  # on both sides of the foot
    x_mm, y_mm, _ = level[level[:, 0].argmax()]
    place = np.array([x_mm + _TEXT_BESIDE_MM, y_mm, _TEXT_ABOVE_MM])
    lines = [_closed(shoe.inside), _closed(shoe.ground)]
    if shoe.pitch_mm > 0:
        lines.append(shoe.heel)
    return GuideLines(tuple(lines), place, _text(shoe), shoe.wider)


def _text(shoe: ShoeOutline) -> str:
    parts = [
        shoe.name or _usual_text(shoe),
        fill(tr("Heel of the shoe {mm:.1f} mm"), mm=shoe.pitch_mm),
    ]
    if shoe.most_over_mm > 0:
        parts.append(fill(tr("Insole up to {mm:.1f} mm wider"), mm=shoe.most_over_mm))
    if shoe.lift_mm > 0:
        parts.append(fill(tr("Heel lift {mm:.1f} mm"), mm=shoe.lift_mm))
    return "\n  ".join(parts)


def _usual_text(shoe: ShoeOutline) -> str:
    if shoe.is_guess:
        return tr("Outline of a shoe, its size a guess: the heel or the toes were not scanned")
    return fill(tr("Outline of a shoe EU {size:g}"), size=shoe.size_eu)


def _closed(curve: FloatArray) -> FloatArray:
    return np.concatenate([curve, curve[:1]])
