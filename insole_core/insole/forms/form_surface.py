"""A form realised on a foot: where its stations lie, alone or mixed with the sole."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.prescription.base_form import HEADS_ALONG, BaseForm, Form
from insole_core.insole.prescription.finish import Finish
from insole_core.insole.primitives.blending import smooth_step
from insole_core.insole.primitives.height_field import HeightField

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
_MOST_GRADING = 0.5
"""A form is graded to feet that are shorter or longer by less than this share."""


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


def base_surface(foot: Foot, sole: HeightField, base: BaseForm) -> HeightField:
    """Return the surface from which the insole of a foot is shaped.

    Parameters
    ----------
    sole
        The foot's own, heights above its lowest point.

    Returns
    -------
    HeightField
        On the grid of `sole`: the mean of sole and form, weighted by `contact_share`.

    Raises
    ------
    DesignError
        If the form is of a foot that is shorter or longer by half or more.
    """
    form = foot.derived.get("form", (base.form, sole.grid), lambda: _graded(foot, sole, base))
    share = base.contact_share
    return replace(sole, heights_mm=share * sole.heights_mm + (1 - share) * form)


def finish_on_base(finish: Finish, base: BaseForm | None) -> Finish:
    """Return the finish of a surface that starts from a base.

    Expansion, fill and smoothing of folds correct a scan, and a form is none: they count by the
    share of the foot's own sole, and without it not at all.
    """
    if base is None:
        return finish
    share = base.contact_share
    return replace(
        finish,
        expansion_mm=share * finish.expansion_mm,
        arch_fill_mm=share * finish.arch_fill_mm,
        skin_smoothing_mm=finish.skin_smoothing_mm if share > 0 else 0.0,
    )


def form_heights(form: Form, frame: FormFrame, xy: FloatArray) -> FloatArray:
    """Return the heights (...) in mm of a form at points (..., 2), mm, insole frame.

    Beyond its outermost stations a form goes on as high as there.
    """
    along, across = frame.shares(xy)
    surface = scipy.interpolate.RectBivariateSpline(
        form.along_shares, form.across_shares, form.heights_mm
    )
    heights = surface.ev(
        np.clip(along, form.along_shares[0], form.along_shares[-1]),
        np.clip(across, form.across_shares[0], form.across_shares[-1]),
    )
    return np.asarray(heights * (frame.ball_width_mm / form.ball_width_mm))


def check_length(form: Form, foot: Foot) -> None:
    """Raise a `DesignError` if a foot is too long or too short for a form to be graded to it."""
    if abs(foot.length_mm / form.length_mm - 1) >= _MOST_GRADING:
        raise DesignError(
            'The form "{form}" is that of a foot of {form_mm:.0f} mm, and this one is '
            "{foot_mm:.0f} mm long; choose a form of about its length.",
            form=form.name,
            form_mm=form.length_mm,
            foot_mm=foot.length_mm,
        )


def _graded(foot: Foot, sole: HeightField, base: BaseForm) -> FloatArray:
    form = base.form
    check_length(form, foot)
    x, y = np.meshgrid(sole.x_mm, sole.y_mm)
    return form_heights(form, form_frame(foot), np.stack([x, y], axis=-1))
