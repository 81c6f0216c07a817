"""The line at which the toe zone begins to take over, to be drawn and dragged."""

from __future__ import annotations

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.finishing.heads_parabola import HeadsParabola
from insole_core.insole.primitives.outline_curve import inside_curve

_PITCH_MM = 2.0


def toe_line(foot: Foot, outline: FloatArray, ahead_mm: float) -> FloatArray:
    """Return the places a given distance ahead of the parabola through the heads.

    Parameters
    ----------
    outline : (n, 2) float64, mm, insole frame
        Of the insole, which the line does not leave.
    ahead_mm
        As `Finish.toe_line_mm`.

    Returns
    -------
    (m, 2) float64, mm, insole frame
        In ascending x; none where the line lies ahead of the whole insole.
    """
    low, high = outline[:, 0].min(), outline[:, 0].max()
    x = np.linspace(low, high, max(2, round((high - low) / _PITCH_MM)))
    line = np.column_stack([x, HeadsParabola.of(foot).line_y_mm(x, ahead_mm)])
    return np.asarray(line[inside_curve(outline, line)])
