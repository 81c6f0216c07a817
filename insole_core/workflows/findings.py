"""What is usually prescribed for a finding: proposals of the clinic, never applied by themselves.

The product's are in resources/findings/findings.json; a clinic's file beside the settings replaces
and adds some. Values that belong to device and rim are set, corrections and pads are added where
the design has none of their kind yet.
"""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.insole.prescription.design import Correction

FORMAT, VERSION = "insole-findings", 1


@dataclass(frozen=True)
class ProposedPad:
    """A pad of the library by its kind and size; by default as high as there."""

    kind: str
    size: str
    height_mm: float | None = None


@dataclass(frozen=True)
class Finding:
    """A finding and what is proposed for it.

    Parameters
    ----------
    name
        For display; English for those of the product.
    keywords
        Further words by which it is found in a list.
    advice
        What the values below do not say.
    source
        Where the proposal comes from.
    device
        Name of the device to start from; by default that of the design.
    cup_mm, medial_flange_mm, arch_fill_mm
        Of the finish; None leaves them.
    corrections
        Without positions.
    """

    name: str
    keywords: tuple[str, ...] = ()
    advice: str = ""
    source: str = ""
    device: str = ""
    cup_mm: float | None = None
    medial_flange_mm: float | None = None
    arch_fill_mm: float | None = None
    corrections: tuple[Correction, ...] = ()
    pads: tuple[ProposedPad, ...] = ()
