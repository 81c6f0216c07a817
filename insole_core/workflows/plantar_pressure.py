"""What lies under a foot of a case, and the reliefs that are proposed by it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from insole_core.cases.case_record import FootRecord
from insole_core.foot.landmarks import Landmarks
from insole_core.insole.elements import Correction, Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.pressure.laid_map import FootprintPicture, PressureMap
from insole_core.workflows.findings import Catalogue, Finding, ProposedPad, apply_finding


def with_pressure(record: FootRecord, pressure: PressureMap | None) -> FootRecord:
    """Return a foot with another map under it; None removes it."""
    return replace(record, plantar=replace(record.plantar, pressure=pressure))


def with_picture(record: FootRecord, picture: FootprintPicture | None) -> FootRecord:
    """Return a foot with another picture under it; None removes it."""
    return replace(record, plantar=replace(record.plantar, picture=picture))


def heads_to_relieve(design: InsoleDesign, overloaded: Sequence[int]) -> tuple[int, ...]:
    """Return the overloaded heads, 1 to 5, under which the design has no relief yet."""
    kinds = {pad.kind for pad in design.of(Pelott)}
    return tuple(head for head in overloaded if f"relief_head_{head}" not in kinds)


def with_reliefs(
    design: InsoleDesign,
    heads: Sequence[int],
    landmarks: Landmarks,
    catalogue: Catalogue,
    stamp: Callable[[Correction], Correction] = lambda correction: correction,
) -> InsoleDesign:
    """Return a design with the library's relief under each of some heads, 1 to 5.

    Raises
    ------
    InputError
        When the clinic's library has none.
    """
    pads = tuple(ProposedPad(f"relief_head_{head}") for head in heads)
    return apply_finding(
        Finding(name="peak pressure", pads=pads), design, landmarks, catalogue, stamp
    )
