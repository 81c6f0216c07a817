"""Sharp steps are found, slopes and outlines are not."""

from __future__ import annotations

import numpy as np

from insole_core.reconstruct.fusion.neighbourhood import smoothness


def sloping(per_px: float) -> np.ndarray:
    rows, columns = np.mgrid[:60, :80].astype(float)
    return 700 + per_px * rows + 0.5 * columns


def test_a_slope_is_smooth() -> None:
    assert smoothness(sloping(2.0)).min() == 1.0


def test_beside_a_step_nothing_is_smooth_and_farther_off_all_is() -> None:
    for turned in (False, True):
        raw = sloping(0.3)
        raw[30:] += 12
        found = smoothness(raw.T).T if turned else smoothness(raw)
        assert found[27:33].max() == 0.0
        assert found[:20].min() == found[40:].min() == 1.0


def test_a_low_step_and_the_outline_before_what_lies_behind_count_as_smooth() -> None:
    low, outline, edge = sloping(0.3), sloping(0.3), sloping(0.3)
    low[30:] += 4
    outline[30:] += 90
    edge[30:] = np.nan
    for raw in (low, outline, edge):
        assert smoothness(raw).min() == 1.0
