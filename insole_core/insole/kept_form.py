"""Keep the form of an insole, to be the base of others."""

from __future__ import annotations

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.insole.build import Insole
from insole_core.insole.forms.form_surface import FormFrame, form_frame, form_heights
from insole_core.insole.prescription.base_form import HEADS_ALONG, Form
from insole_core.insole.prescription.item_name import checked_name
from insole_core.insole.primitives.height_field import HeightField

_ALONG, _ACROSS = (-0.06, 1.08), (-0.2, 1.2)
"""Shares that the stations span: the insole and its usual allowances."""
_SUPPORT_ALONG, _SUPPORT_ACROSS = (0.05, HEADS_ALONG), (0.12, 0.88)
"""Shares within which the foot is supported: the sole behind the heads, without the rim."""
_PITCHES_MM = (10.0, 6.0, 4.0, 3.0, 2.0, 1.4)
_DECIMALS = 2
_WANTED_MM = 0.15
"""Greatest deviation from the insole; if need be the finest pitch is taken beyond it."""


def form_of(insole: Insole, name: str, source: str = "") -> Form:
    """Return the form of a finished insole, with everything that shapes its surface.

    Pads and corrections are part of the form: a design on this base does not need them again.

    Parameters
    ----------
    name
        Of the form.
    source
        Where it comes from, without the patient's name.

    Returns
    -------
    Form
        With as few stations as keep its surface within 0.15 mm where it supports the foot.

    Raises
    ------
    DesignError
        If the name cannot be used, or the foot has no width.
    """
    name, field = checked_name(name), insole.contact
    frame = form_frame(insole.foot)
    x, y = np.meshgrid(field.x_mm, field.y_mm)
    nodes = np.stack([x, y], axis=-1)
    along, across = frame.shares(nodes)
    supports = _within(along, _SUPPORT_ALONG) & _within(across, _SUPPORT_ACROSS)
    nodes, heights = nodes[supports], field.heights_mm[supports]
    for pitch_mm in _PITCHES_MM:
        form = _sampled(field, frame, pitch_mm, name, source)
        off = form_heights(form, frame, nodes) - heights
        if np.ptp(off) < 2 * _WANTED_MM:
            break
    return form


def _sampled(field: HeightField, frame: FormFrame, pitch_mm: float, name: str, source: str) -> Form:
    """Return the form with stations about `pitch_mm` apart."""
    along = _stations(_ALONG, frame.length_mm, pitch_mm)
    across = _stations(_ACROSS, frame.ball_width_mm, pitch_mm)
    heights = _heights_at(field, frame.points(along, across))
    heights = np.round(heights - heights.min(), _DECIMALS)
    return Form(
        name=name,
        source=source,
        length_mm=frame.length_mm,
        ball_width_mm=frame.ball_width_mm,
        along_shares=tuple(along.tolist()),
        across_shares=tuple(across.tolist()),
        heights_mm=tuple(tuple(row) for row in heights.tolist()),
    )


def _stations(shares: tuple[float, float], whole_mm: float, pitch_mm: float) -> FloatArray:
    count = 1 + int(np.ceil((shares[1] - shares[0]) * whole_mm / pitch_mm))
    return np.round(np.linspace(*shares, count), 5)


def _heights_at(field: HeightField, xy: FloatArray) -> FloatArray:
    """Interpolate a field by cubics at points (..., 2); beyond it goes on as high as its edge."""
    column = (xy[..., 0] - field.x0_mm) / field.step_mm
    row = (xy[..., 1] - field.y0_mm) / field.step_mm
    return np.asarray(
        scipy.ndimage.map_coordinates(field.heights_mm, [row, column], mode="nearest")
    )


def _within(shares: FloatArray, limits: tuple[float, float]) -> BoolArray:
    return np.asarray((shares > limits[0]) & (shares < limits[1]))
