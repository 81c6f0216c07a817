"""The outline of a shoe as lines of the insole's view, with its heights as text."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.outline.shoe_outline import ShoeOutline
from insole_studio.scene.guide_lines import GuideLines
from insole_studio.texts import fill, tr

_TEXT_AHEAD_MM, _TEXT_BESIDE_MM, _TEXT_ABOVE_MM = 70.0, 6.0, 60.0
"""So that the text lies beside the shoe from below, and above the insole from the sides."""


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
        shoe.name or fill(tr("Outline of a shoe EU {size:g}"), size=shoe.size_eu),
        fill(tr("Heel of the shoe {mm:.1f} mm"), mm=shoe.pitch_mm),
    ]
    if shoe.most_over_mm > 0:
        parts.append(fill(tr("Insole up to {mm:.1f} mm wider"), mm=shoe.most_over_mm))
    if shoe.lift_mm > 0:
        parts.append(fill(tr("Heel lift {mm:.1f} mm"), mm=shoe.lift_mm))
    return "\n  ".join(parts)


def _closed(curve: FloatArray) -> FloatArray:
    return np.concatenate([curve, curve[:1]])
