"""The elements of a prescription: the corrections that an insole is made of."""

from insole_core.insole.elements.corrections import (
    CORRECTION_TYPES,
    ArchRaise,
    BrushStroke,
    Correction,
    CorrectionBase,
    ForefootTwist,
    HeelCup,
    HeelLift,
    HeelSkive,
    Pelott,
    Posting,
    Rocker,
)

__all__ = [
    "CORRECTION_TYPES",
    "ArchRaise",
    "BrushStroke",
    "Correction",
    "CorrectionBase",
    "ForefootTwist",
    "HeelCup",
    "HeelLift",
    "HeelSkive",
    "Pelott",
    "Posting",
    "Rocker",
]
