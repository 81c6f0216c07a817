"""What is seen of an insole is what is exported, whatever was done to it (benchmark: 300)."""

from __future__ import annotations

import pytest
from PySide6.QtWidgets import QApplication

from benchmarks._random_designs import random_foot
from benchmarks._random_edits import random_sequence
from benchmarks.seen_and_exported import LIMITS
from insole_core.foot.foot import Foot


@pytest.fixture(scope="module")
def same_results() -> None:
    """Build everything anew: what is stale would be shared as well."""


@pytest.fixture(scope="module")
def foot() -> Foot:
    return random_foot(3)


@pytest.mark.parametrize("seed", [5, 8, 11, 14])
def test_every_vertex_and_normal_is_that_of_the_export(
    qapp: QApplication, foot: Foot, seed: int
) -> None:
    seen = random_sequence(foot, seed)
    assert seen is not None
    assert seen.apart_mm < LIMITS[0]
    assert seen.turned_deg < LIMITS[1]
