from __future__ import annotations

import numpy as np
import pytest

from insole_core.geometry.side import Side
from insole_core.simulate import (
    FootModel,
    FootShape,
    SimulatedSession,
    SimulationOptions,
    build_foot,
    simulate_session,
)

COARSE_MM = 3.5


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(7)


@pytest.fixture(scope="module")
def left_foot() -> FootModel:
    return build_foot(FootShape(), np.random.default_rng(3), COARSE_MM)


@pytest.fixture(scope="module")
def right_session() -> SimulatedSession:
    """A right foot, two bursts, small colour images."""
    return simulate_session(
        SimulationOptions(
            seed=5,
            side=Side.RIGHT,
            bursts=2,
            frames=2,
            color_size=(640, 480),
            foot_cell_mm=COARSE_MM,
        )
    )
