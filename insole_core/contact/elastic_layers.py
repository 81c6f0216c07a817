"""Layers of elastic materials, glued on each other and on a rigid ground, under pressure.

A pressure that varies as cos(q x) makes the upper face sink by the compliance times that pressure,
in the same phase. The exact compliance of any stack follows from the stiffness of each layer's two
faces; that of a single layer is the closed form in K. L. Johnson, Contact Mechanics, 1985.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from insole_core.geometry.arrays import FloatArray

RIGID_MPA = 1e5
"""Stiffer than all that insoles are made of."""
_LEAST_QH = 1e-3
"""Below it the stiffness of a layer is that of uniform pressure, to the last digits that count."""


@dataclass(frozen=True)
class Layer:
    """A layer of one material.

    Parameters
    ----------
    thickness_mm
    modulus_mpa
        Young's modulus.
    poisson
        Poisson's ratio, below 0.5.
    """

    thickness_mm: float
    modulus_mpa: float
    poisson: float

    @property
    def confined_mpa(self) -> float:
        """Modulus under a uniform pressure, when the layer cannot give way sideways."""
        v = self.poisson
        return self.modulus_mpa * (1 - v) / ((1 + v) * (1 - 2 * v))


def uniform_compliance(layers: Sequence[Layer]) -> float:
    """Return how far a stack sinks under a uniform pressure, mm/MPa."""
    return sum(layer.thickness_mm / layer.confined_mpa for layer in layers)


def compliance(layers: Sequence[Layer], wave_number: FloatArray) -> FloatArray:
    """Compute how far the face of a stack sinks under pressure that varies along it.

    Parameters
    ----------
    layers
        From the loaded face down; the last one is glued to a rigid ground. The face is free of
        friction.
    wave_number : (n,) float64, 1/mm
        Of the pressure, not negative.

    Returns
    -------
    (n,) float64, mm/MPa
    """
    made = [layer for layer in layers if layer.thickness_mm > 0]
    if not made:
        return np.zeros_like(wave_number)
    # Of the ground below: so stiff that it does not move.
    stiffest = max(layer.modulus_mpa / layer.thickness_mm for layer in made)
    below = np.broadcast_to(1e9 * stiffest * np.eye(2), (*wave_number.shape, 2, 2))
    for layer in reversed(made):
        q = np.maximum(wave_number, _LEAST_QH / layer.thickness_mm)
        faces = _stiffness(layer, q)
        upper, across = faces[..., :2, :2], faces[..., :2, 2:]
        lower, back = faces[..., 2:, 2:], faces[..., 2:, :2]
        below = upper - across @ np.linalg.solve(lower + below, back)
    return np.asarray(np.linalg.inv(below)[..., 1, 1])


def _stiffness(layer: Layer, q: FloatArray) -> FloatArray:
    """(n, 4, 4) forces on both faces for displacements of them: along and down, upper first.

    The displacements are combinations of four solutions of Navier's equations, of which two fade
    with the depth z and two with the height over the lower face.
    """
    h = layer.thickness_mm
    shear = layer.modulus_mpa / (2 * (1 + layer.poisson))
    displaced = np.empty((*q.shape, 4, 4))
    forces = np.empty((*q.shape, 4, 4))
    solution = 0
    for sign, origin in ((-1.0, 0.0), (1.0, h)):
        for second in (False, True):
            for face, z in enumerate((0.0, h)):
                along, down, along_z, down_z = _solution(layer.poisson, q, sign, z - origin, second)
                rows = slice(2 * face, 2 * face + 2)
                displaced[:, rows, solution] = np.stack([along, down], axis=-1)
                lame = 2 * shear * layer.poisson / (1 - 2 * layer.poisson)
                normal = lame * (q * along + down_z) + 2 * shear * down_z
                tangent = shear * (along_z - q * down)
                outward = 1.0 if face else -1.0
                forces[:, rows, solution] = outward * np.stack([tangent, normal], axis=-1)
            solution += 1
    # forces = stiffness @ displaced
    turned = np.linalg.solve(np.swapaxes(displaced, -1, -2), np.swapaxes(forces, -1, -2))
    return np.asarray(np.swapaxes(turned, -1, -2))


def _solution(
    poisson: float, q: FloatArray, sign: float, z: float, second: bool
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return a solution at the depth z: displacements along and down, and their change with z."""
    fading: npt.NDArray[np.float64] = np.exp(sign * q * z)
    if not second:
        return -fading, sign * fading, -sign * q * fading, q * fading
    k = 3 - 4 * poisson
    along, down = q * z * fading, (k - sign * q * z) * fading
    return along, down, q * (1 + sign * q * z) * fading, (sign * q * (k - 1) - q * q * z) * fading
