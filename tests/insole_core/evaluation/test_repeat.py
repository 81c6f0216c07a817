"""Captures of one foot are compared with each other, and those of two feet are told."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.errors import CalibrationError
from insole_core.evaluation.repeat import RepeatedCapture, evaluate_repeat, scatter
from insole_core.foot.foot import Foot
from insole_core.geometry.mesh import TriangleMesh


def test_the_feet_of_two_persons_are_told(left_foot: Foot) -> None:
    shape = left_foot.mesh.vertices * (1.1, 1.0, 1.8)
    other = replace(left_foot, mesh=TriangleMesh(shape, left_foot.mesh.triangles))
    captures = [RepeatedCapture("a", left_foot, {}), RepeatedCapture("b", other, {})]
    with pytest.raises(CalibrationError, match="a and b show two different feet"):
        evaluate_repeat(captures)
    longer = [
        RepeatedCapture(name, left_foot, {"foot_length": length_mm})
        for name, length_mm in (("a", 245.0), ("b", 252.0))
    ]
    with pytest.raises(CalibrationError, match=r"7\.0 mm longer"):
        evaluate_repeat(longer)


def test_the_map_is_as_deep_as_the_captures_scatter(left_foot: Foot) -> None:
    captures = [RepeatedCapture(str(n), left_foot, {"arch_height": 10.0 + n}) for n in range(3)]
    found = evaluate_repeat(captures)
    assert np.nanmax(found.deviation_mm) < 1e-3
    assert found.measures["arch_height"] == scatter(np.array([10.0, 11.0, 12.0]))
    assert found.measures["arch_height"].deviation == pytest.approx(1.0)
    assert found.measures["arch_height"].limits_95 == pytest.approx(4.303, abs=1e-3)
