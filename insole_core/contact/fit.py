"""Fit the tissue of a foot to a map of the pressures that were measured under it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy

from insole_core.contact.change import Assumptions, Loading, inside
from insole_core.contact.stance import shoe_floor
from insole_core.errors import InputError
from insole_core.geometry.arrays import FloatArray
from insole_core.pressure.laid_map import LOADED_KPA, PressureMap
from insole_core.progress import SILENT, Progress

FITTED = ("heel", "head_1", "head_3", "head_5")
HELD_OUT = ("midfoot", "head_2", "head_4", "toes")
"""Regions whose pressures the moduli are not fitted to; size and centre of the load come from the
whole map, theirs included. How well it tells them says how far it can be trusted."""
_LEAST_LOAD, _MOST_LOAD = 0.6, 1.5
"""Of the load that the posture puts on the foot."""
_BOUNDS = (-1.2, 1.2)
"""Of the logarithms of the moduli, as multiples of the usual ones: a third to three times."""
_STEPS = 22


@dataclass(frozen=True)
class Fitted:
    """What a measured map tells of a foot.

    Parameters
    ----------
    assumed
        Its tissue, and centre and size of its load.
    held_out
        Measured and computed peak pressure, kPa, of each region in `HELD_OUT` that was loaded.
    """

    assumed: Assumptions
    held_out: dict[str, tuple[float, float]]

    @property
    def error_percent(self) -> float | None:
        """Root mean square of the errors of the held-out peaks; None if none was loaded."""
        if not self.held_out:
            return None
        off = [100 * (found / measured - 1) for measured, found in self.held_out.values()]
        return float(np.sqrt(np.mean(np.square(off))))


def fit_tissue(loading: Loading, laid: PressureMap, progress: Progress = SILENT) -> Fitted:
    """Fit the moduli of heel and forefoot to a map of the bare foot on a hard plate.

    Parameters
    ----------
    laid
        In its place under the foot.

    Raises
    ------
    InputError
        When the map carries another load than the posture, as one of a step does, looks like one
        of the other foot, or lies beside the foot.
    Cancelled
    """
    sole, floor = loading.sole, shoe_floor(loading.sole)
    measured_n = float(np.nansum(laid.kpa)) * laid.pitch_mm[0] * laid.pitch_mm[1] / 1000
    if not _LEAST_LOAD <= measured_n / loading.load_n <= _MOST_LOAD:
        raise InputError(
            "The map carries {measured:.0f} N, and in this posture the foot carries {load:.0f} N; "
            "it is of walking, of another posture or of another person, so choose one that fits.",
            measured=measured_n,
            load=loading.load_n,
        )
    points = sole.field.nodes[:, :2]
    kpa = np.nan_to_num(laid.at(points)).reshape(sole.known.shape)
    begun = _as_loaded(loading, kpa, measured_n)
    _check_side(loading, laid, kpa, begun)
    seen = np.logical_or.reduce([inside(sole, name) for name in FITTED])
    scale = float((kpa[seen] ** 2).sum())
    if scale == 0:
        raise InputError(
            "The map does not press under heel and ball of this foot; see that it lies there."
        )

    def computed(logarithms: FloatArray) -> FloatArray:
        heel, forefoot = np.exp(np.clip(logarithms, *_BOUNDS))
        tissue = begun.tissue.scaled(heel=float(heel), forefoot=float(forefoot))
        return loading.pressed(floor, replace(begun, tissue=tissue)).sensed_kpa

    def off(logarithms: FloatArray) -> float:
        progress.step(0.5, "Loading the foot")
        return float(((computed(logarithms) - kpa)[seen] ** 2).sum()) / scale

    found = scipy.optimize.minimize(
        off, np.zeros(2), method="Nelder-Mead",
        options={"maxfev": _STEPS, "initial_simplex": [[0, 0], [0.4, 0], [0, 0.4]]},
    ).x  # fmt: skip
    heel, forefoot = (float(m) for m in np.exp(np.clip(found, *_BOUNDS)))
    model = computed(found)
    peaks = {
        name: (float(kpa[inside(sole, name)].max()), float(model[inside(sole, name)].max()))
        for name in HELD_OUT
    }
    loaded = {name: pair for name, pair in peaks.items() if pair[0] >= LOADED_KPA}
    return Fitted(replace(begun, tissue=begun.tissue.scaled(heel=heel, forefoot=forefoot)), loaded)


def _check_side(loading: Loading, laid: PressureMap, kpa: FloatArray, begun: Assumptions) -> None:
    """Refuse a map whose mirror image, about the load's centre, is more like this foot's."""
    sole = loading.sole
    usual = loading.pressed(shoe_floor(sole), begun).sensed_kpa
    centre_mm = begun.moved_mm[0] * sole.foot.side.medial_sign
    points = sole.field.nodes[:, :2] * [-1.0, 1.0] + [2 * centre_mm, 0.0]
    mirrored = np.nan_to_num(laid.at(points)).reshape(kpa.shape)
    own, other = (float(((usual - one)[sole.known] ** 2).sum()) for one in (kpa, mirrored))
    if other < own:
        raise InputError(
            "The map looks like one of the other foot; lay the map of the {side} foot.",
            side=sole.foot.side,
        )


def _as_loaded(loading: Loading, kpa: FloatArray, measured_n: float) -> Assumptions:
    """Return the usual tissue under the load that was measured, about its centre."""
    field, foot = loading.sole.field, loading.sole.foot
    share = kpa / kpa.sum() if kpa.sum() > 0 else kpa
    x_mm = float((share * field.x_mm).sum())
    y_mm = float((share * field.y_mm[:, None]).sum())
    ahead_mm = y_mm - loading.case.centre_share * foot.length_mm
    moved = (x_mm * foot.side.medial_sign, ahead_mm)
    return Assumptions(moved_mm=moved, heavier=measured_n / loading.load_n)
