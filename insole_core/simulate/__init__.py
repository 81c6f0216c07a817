"""Simulated sessions with their ground truth."""

from insole_core.simulate.foot_model import FootModel, build_foot
from insole_core.simulate.foot_shape import FootShape
from insole_core.simulate.simulation import (
    SimulatedSession,
    SimulationOptions,
    simulate_session,
)

__all__ = [
    "FootModel",
    "FootShape",
    "SimulatedSession",
    "SimulationOptions",
    "build_foot",
    "simulate_session",
]
