"""The soft tissue between bone and sole: heel, forefoot, and what hangs in the hollow of the arch.

The values are effective: of one even material that stands for skin, fat and its chambers, and gives
way sideways more easily than fat itself. With e = sinking / thickness its pressure goes as
e / (1 - e).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.contact.elastic_layers import Layer
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.primitives.blending import smooth_step

_POISSON = 0.3
_FOREFOOT = (0.3, 0.55)
"""Shares of the foot's length between which the heel's tissue passes into the forefoot's."""
_ARCH_FROM, _TO_HEADS = (0.25, 0.33), (-0.08, -0.03)
"""Shares of the length where the hollow begins, from the heel, and ends, from the heads' line."""
_HOLLOW_MM = (0.5, 4.0)
"""Height of the unloaded sole over which no bone presses it on the ground."""


@dataclass(frozen=True)
class Tissue:
    """Thickness and modulus of the tissue.

    Under the pressures of standing the heel's pad is so compressed by a third to two fifths, as in
    Gefen, Megido-Ravid and Itzchak (In vivo biomechanical behavior of the human heel pad during
    the stance phase of gait, J. Biomech. 34, 2001). The forefoot's modulus stands for tissue and
    for the rays, which give way each by itself: heel and forefoot, and their peaks, are so loaded
    about as in Cavanagh, Rodgers and Iiboshi (Foot & Ankle 7, 1987). Muscle and skin in the hollow
    of the arch are our own judgement: a total contact insole then carries a tenth to a fifth of
    the load there.
    """

    heel_mm: float = 16.0
    forefoot_mm: float = 9.0
    arch_mm: float = 25.0
    heel_mpa: float = 0.20
    forefoot_mpa: float = 0.12
    arch_mpa: float = 0.05

    def scaled(
        self,
        *,
        heel: float = 1.0,
        forefoot: float = 1.0,
        arch: float = 1.0,
        thickness: float = 1.0,
    ) -> Tissue:
        """Return the tissue with other moduli and thicknesses, as multiples of these."""
        return replace(
            self,
            heel_mm=self.heel_mm * thickness,
            forefoot_mm=self.forefoot_mm * thickness,
            arch_mm=self.arch_mm * thickness,
            heel_mpa=self.heel_mpa * heel,
            forefoot_mpa=self.forefoot_mpa * forefoot,
            arch_mpa=self.arch_mpa * arch,
        )

    @property
    def layers(self) -> tuple[Layer, Layer, Layer]:
        """The tissue of heel, forefoot and arch."""
        return (
            Layer(self.heel_mm, self.heel_mpa, _POISSON),
            Layer(self.forefoot_mm, self.forefoot_mpa, _POISSON),
            Layer(self.arch_mm, self.arch_mpa, _POISSON),
        )


def tissue_shares(share: FloatArray, from_heads: FloatArray, height_mm: FloatArray) -> FloatArray:
    """Return how much of a sole has the tissue of heel, forefoot and arch.

    Parameters
    ----------
    share : (ny, 1) float64
        Place along the foot, as a share of its length.
    from_heads : (ny, nx) float64
        Place ahead of the line of the metatarsal heads, as a share of the length.
    height_mm : (ny, nx) float64
        Of the unloaded sole over its lowest point.

    Returns
    -------
    (3, ny, nx) float64
        Their sum is 1 everywhere.
    """
    along = smooth_step(share, *_ARCH_FROM) * (1 - smooth_step(from_heads, *_TO_HEADS))
    arch = along * smooth_step(height_mm, *_HOLLOW_MM)
    forefoot = smooth_step(share, *_FOREFOOT) * (1 - arch)
    return np.stack([1 - arch - forefoot, forefoot, arch])
