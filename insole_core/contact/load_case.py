"""What a foot carries, and where: standing, and two instants of a step."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

GRAVITY = 9.80665


class Posture(StrEnum):
    """An instant that is modelled."""

    STANDING = "standing"
    HEEL_STRIKE = "heel_strike"
    PUSH_OFF = "push_off"


@dataclass(frozen=True)
class LoadCase:
    """The load on one foot and its centre.

    Parameters
    ----------
    weight_share
        Of the body's weight.
    centre_share
        Of the foot's length, from the heel.
    """

    weight_share: float
    centre_share: float

    def load_n(self, weight_kg: float) -> float:
        """Return the load on the foot of a person, N."""
        return self.weight_share * weight_kg * GRAVITY


LOAD_CASES = {
    Posture.STANDING: LoadCase(0.5, 0.35),
    Posture.HEEL_STRIKE: LoadCase(1.1, 0.20),
    Posture.PUSH_OFF: LoadCase(1.1, 0.74),
}
"""Standing: Cavanagh, Rodgers and Iiboshi (Pressure distribution under symptom-free feet during
barefoot standing, Foot & Ankle 7, 1987) found 60.5 % of the load at the heel, 7.8 % at the midfoot,
28.1 % at the forefoot and 3.6 % at the toes, whose middles lie at 0.14, 0.45, 0.70 and 0.92 of the
length.

A step: Perry and Burnfield (Gait Analysis, 2010) have 110 % of the weight at the end of loading
response and in terminal stance, then with its centre under the metatarsal heads. The centre at heel
strike, still under the heel's front, is our own judgement.
"""
