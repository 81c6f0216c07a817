"""The colour maps of the foot stage: view, skin colour, uncertainty, number of observations,
correction of the sensor's matching."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.workflows.make_foot import MadeFoot
from insole_studio.features.foot.rows import FootMap
from insole_studio.scene.coloring import Coloring
from insole_studio.texts import tr

_LEAST_SPAN_MM = 0.5


def color_foot(kind: FootMap, made: MadeFoot) -> Coloring | None:
    """Return the colours of a foot.

    Parameters
    ----------
    kind
        The colour map.
    made
        The foot, with the data its reconstruction kept.

    Returns
    -------
    Coloring or None
        None for skin colour, and for maps without data.
    """
    maker = _MAKERS.get(kind)
    return None if maker is None else maker(made)


def _confidence(made: MadeFoot) -> Coloring | None:
    deviation_mm = made.reconstruction.deviation_mm
    if deviation_mm is None:
        return None
    return Coloring(deviation_mm, (0.0, _span(deviation_mm)), tr("Standard deviation"))


def _coverage(made: MadeFoot) -> Coloring | None:
    if made.agreement is None:
        return None
    views = made.agreement.views.astype(float)
    most = max(float(views.max(initial=1)), 1.0)
    return Coloring(views, (0.0, most), tr("Views that see it"), unit=tr("views"))


def _agreement(made: MadeFoot) -> Coloring | None:
    if made.agreement is None:
        return None
    spread_mm = made.agreement.spread_mm
    return Coloring(spread_mm, (0.0, _span(spread_mm)), tr("Distance between the views"))


def _correction(made: MadeFoot) -> Coloring | None:
    correction_mm = made.reconstruction.correction_mm
    if correction_mm is None:
        return None
    span = _span(np.abs(correction_mm))
    return Coloring(correction_mm, (-span, span), tr("Moved by the correction"), signed=True)


def _span(values_mm: FloatArray) -> float:
    known = values_mm[np.isfinite(values_mm)]
    return max(float(np.percentile(known, 98)), _LEAST_SPAN_MM) if len(known) else _LEAST_SPAN_MM


_MAKERS: dict[FootMap, Callable[[MadeFoot], Coloring | None]] = {
    FootMap.CONFIDENCE: _confidence,
    FootMap.COVERAGE: _coverage,
    FootMap.AGREEMENT: _agreement,
    FootMap.CORRECTION: _correction,
}
