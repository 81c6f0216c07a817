"""The elements of a prescription: the corrections that an insole is made of.

Each is declared by a class in a module of its own; a new one is named here, and nowhere else.
"""

from insole_core.insole.elements.arch_raise import ArchRaise
from insole_core.insole.elements.brush_stroke import BrushStroke
from insole_core.insole.elements.correction import CORRECTION_TYPES, Correction, in_order, new_id
from insole_core.insole.elements.forefoot_twist import ForefootTwist
from insole_core.insole.elements.full_lift import FullLift
from insole_core.insole.elements.heel_cup import HeelCup
from insole_core.insole.elements.heel_lift import HeelLift
from insole_core.insole.elements.heel_skive import HeelSkive
from insole_core.insole.elements.pelott import Pelott
from insole_core.insole.elements.posting import Posting
from insole_core.insole.elements.rocker import Rocker

__all__ = [
    "CORRECTION_TYPES",
    "ArchRaise",
    "BrushStroke",
    "Correction",
    "ForefootTwist",
    "FullLift",
    "HeelCup",
    "HeelLift",
    "HeelSkive",
    "Pelott",
    "Posting",
    "Rocker",
    "in_order",
    "new_id",
]
