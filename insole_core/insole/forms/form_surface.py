"""A form realised on a foot, alone or mixed with the foot's own sole."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.forms.form_frame import FormFrame, form_frame
from insole_core.insole.prescription.base_form import BaseForm, Form
from insole_core.insole.prescription.finish import Finish
from insole_core.insole.primitives.height_field import HeightField

MOST_GRADING = 0.5
"""A form is graded to feet that are shorter or longer by less than this share."""


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
    if abs(foot.length_mm / form.length_mm - 1) >= MOST_GRADING:
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
