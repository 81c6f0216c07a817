"""Punch and sphere on an elastic layer, as exactly as one likes: an integral equation.

Lebedev and Ufliand (J. Appl. Math. Mech. 22, 1958, 442-450) reduce a round body without friction
on a layer that is glued to a rigid ground to an equation for a function on its radius, which is
solved here by Gauss's quadrature. Lengths are in thicknesses of the layer.
"""

from __future__ import annotations

import numpy as np
import scipy

from insole_core.geometry.arrays import FloatArray

_NODES = 24
_WAVES, _LARGEST_WAVE = 300, 25.0
"""Beyond the largest one, the ground below is felt by no more than exp(-50)."""


def punch_stiffness_by_theory(poisson: float, radius: float) -> float:
    """Return the stiffness of a flat round punch on a layer against that on a half-space."""
    _, weights, solved = _solved(poisson, radius)
    return float(weights @ solved[:, 0] / radius)


def sphere_load_by_theory(poisson: float, radius: float, sinking: float) -> float:
    """Return the load on a sphere against Hertz's for the same sinking.

    Parameters
    ----------
    radius, sinking
        In thicknesses of the layer.
    """

    def sinking_for(contact: float) -> float:
        ends, _, _ = _at_end(poisson, contact)
        return float(ends[1] / ends[0] / radius)

    hertz_contact = np.sqrt(radius * sinking)
    contact = scipy.optimize.brentq(
        lambda a: sinking_for(a) - sinking, 0.5 * hertz_contact, 2 * hertz_contact
    )
    _, weights, solved = _at_end(poisson, contact)
    load = 4 * weights @ (sinking * solved[:, 0] - solved[:, 1] / radius)
    return float(load / (8 / 3 * np.sqrt(radius) * sinking**1.5))


def _at_end(poisson: float, contact: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return both solutions at the edge of the contact, where a sphere's pressure ends."""
    places, weights, solved = _solved(poisson, contact)
    fitted = np.polynomial.legendre.legfit(2 * places / contact - 1, solved, _NODES - 4)
    return np.asarray(np.polynomial.legendre.legval(1.0, fitted)), weights, solved


def _solved(poisson: float, contact: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return places and weights (n,), and the solutions (n, 2) for a flat and a curved body."""
    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    places, weights = contact * (nodes + 1) / 2, contact * weights / 2
    waves, steps = np.polynomial.legendre.leggauss(_WAVES)
    waves, steps = _LARGEST_WAVE * (waves + 1) / 2, _LARGEST_WAVE * steps / 2
    cosines = np.cos(np.outer(places, waves))
    kernel = (cosines * (steps * (_softness(poisson, waves) - 1))) @ cosines.T
    wanted = np.column_stack([np.ones(_NODES), places**2])
    equation = np.eye(_NODES) + 2 / np.pi * kernel * weights
    return places, weights, np.asarray(np.linalg.solve(equation, wanted), np.float64)


def _softness(poisson: float, s: FloatArray) -> FloatArray:
    """Return the compliance of a layer against that of a half-space (K. L. Johnson, 1985)."""
    k = 3 - 4 * poisson
    below = k * np.cosh(2 * s) + 2 * s * s + 5 - 12 * poisson + 8 * poisson**2
    return np.asarray((k * np.sinh(2 * s) - 2 * s) / below)
