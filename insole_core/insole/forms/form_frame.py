"""Where the stations of a form lie on a foot, by its landmarks alone.

Along the foot the stations run from the rearmost point of the heel over the line of the metatarsal
heads to the longest toe; across it between two borders: through the outermost points of heel and
ball, parallel to the foot axis behind and ahead of them, and smooth between. So neither the scan's
shape nor its ragged edge moves a form.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.prescription.base_form import HEADS_ALONG
from insole_core.insole.primitives.blending import smooth_step

_MOST_SHIFT = 0.1
"""Greatest share of the length by which the heads of a foot lie off `HEADS_ALONG`."""
_SHIFT_BEGIN, _SHIFT_END = (0.25, 0.6), (0.75, 1.0)
"""Shares of the length between which the stations begin to follow the heads, and cease to."""
_LANDMARKS = (
    ("heel_medial", "heel_lateral"),
    ("metatarsale_tibiale", "metatarsale_fibulare"),
    ("metatarsal_head_1", "metatarsal_head_5"),
)
_PITCH_MM = 0.25  # of the table by which shares along the foot are turned into places
_LEAST_WIDTH = 0.1
"""Least width of heel and ball, as a share of the length."""


@dataclass(frozen=True)
class FormFrame:
    """The landmarks that place a form; all in mm, insole frame, x counted medially.

    Parameters
    ----------
    length_mm
        Of the foot.
    heel_mm, ball_mm
        (medial, lateral) x of the outermost points of heel and ball.
    heel_y_mm, ball_y_mm
        (medial, lateral) y of these points.
    heads_y_mm
        Where the line through the 1st and the 5th metatarsal head meets (medial, lateral) border.
    medial_sign
        Sign of the insole frame's x at the medial border.
    """

    length_mm: float
    heel_mm: tuple[float, float]
    ball_mm: tuple[float, float]
    heel_y_mm: tuple[float, float]
    ball_y_mm: tuple[float, float]
    heads_y_mm: tuple[float, float]
    medial_sign: float

    @property
    def ball_width_mm(self) -> float:
        """Between the medial and the lateral border at the ball."""
        return self.ball_mm[0] - self.ball_mm[1]

    def shares(self, xy: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the shares along and across the foot, each (...), of points (..., 2)."""
        x, y = xy[..., 0] * self.medial_sign, xy[..., 1]
        medial, lateral = (self._border(y, side) for side in (0, 1))
        across = (medial - x) / (medial - lateral)
        return self._along(y, across), across

    def points(self, along: FloatArray, across: FloatArray) -> FloatArray:
        """Return the points (m, n, 2), mm, insole frame, at shares (m,) along and (n,) across."""
        ways = np.arange(
            along[0] * self.length_mm, along[-1] * self.length_mm + _PITCH_MM, _PITCH_MM
        )
        shares = self._along(ways, across[:, None])
        y = np.array([np.interp(along, share, ways) for share in shares]).T
        medial, lateral = (self._border(y, side) for side in (0, 1))
        return np.stack([(medial - across * (medial - lateral)) * self.medial_sign, y], axis=-1)

    def _along(self, y: FloatArray, across: FloatArray) -> FloatArray:
        """Return the shares along the foot at y and shares across, which are broadcast."""
        straight = y / self.length_mm
        heads = np.array(self.heads_y_mm) / self.length_mm
        at_heads = heads[0] + np.clip(across, 0, 1) * (heads[1] - heads[0])
        shift = np.clip(HEADS_ALONG - at_heads, -_MOST_SHIFT, _MOST_SHIFT)
        near = smooth_step(straight, *_SHIFT_BEGIN) * (1 - smooth_step(straight, *_SHIFT_END))
        return np.asarray(straight + shift * near)

    def _border(self, y: FloatArray, side: int) -> FloatArray:
        """Return x of a border (0 medial, 1 lateral) at each y."""
        way = smooth_step(y, self.heel_y_mm[side], self.ball_y_mm[side])
        return np.asarray(self.heel_mm[side] + way * (self.ball_mm[side] - self.heel_mm[side]))


def form_frame(foot: Foot) -> FormFrame:
    """Return where a form lies on a foot.

    Raises
    ------
    DesignError
        If heel or ball have no width, or the ball lies behind the heel.
    """
    landmarks, sign = find_landmarks(foot), float(foot.side.medial_sign)
    (hm, hl), (bm, bl), heads = (
        [landmarks[name].point[:2] * [sign, 1.0] for name in names] for names in _LANDMARKS
    )
    least_mm = _LEAST_WIDTH * foot.length_mm
    if min(hm[0] - hl[0], bm[0] - bl[0], bm[1] - hm[1], bl[1] - hl[1]) < least_mm:
        raise DesignError(
            "Heel and ball of this foot lie in an impossible order, so no form of the library can "
            "be laid on it; choose a base from the foot, or scan again."
        )
    frame = FormFrame(
        length_mm=foot.length_mm,
        heel_mm=(float(hm[0]), float(hl[0])),
        ball_mm=(float(bm[0]), float(bl[0])),
        heel_y_mm=(float(hm[1]), float(hl[1])),
        ball_y_mm=(float(bm[1]), float(bl[1])),
        heads_y_mm=(0.0, 0.0),
        medial_sign=sign,
    )
    _, across = frame.shares(np.array(heads) * [sign, 1.0])
    y = np.array([head[1] for head in heads])
    slope = (y[1] - y[0]) / (across[1] - across[0])
    medial = float(y[0] - slope * across[0])
    return replace(frame, heads_y_mm=(medial, medial + float(slope)))
