"""What the pad handles edit: pads, and arch raises as the ellipses that they are."""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.rounding import rounded
from insole_core.insole.elements import ArchRaise, Correction, Pelott
from insole_core.insole.fields import Place, ranges_of
from insole_core.insole.prescription.design import InsoleDesign
from insole_studio.document.case import Case

_Kind = TypeVar("_Kind", bound=Correction)


def selected_pelott(case: Case) -> Pelott | None:
    """Return the selected correction if it is a pad of the shown design."""
    return _selected(case, Pelott)


def selected_zone(case: Case) -> Pelott | None:
    """Return the selected pad, or the ellipse of the selected arch raise."""
    arch = _selected(case, ArchRaise)
    return selected_pelott(case) if arch is None else _ellipse(case, arch)


def is_arch(case: Case) -> bool:
    """Return whether the selected correction is an arch raise."""
    return _selected(case, ArchRaise) is not None


def with_zone(design: InsoleDesign, before: Pelott, after: Pelott) -> InsoleDesign:
    """Return the design with an edited pad, or with the arch raise that an ellipse stands for.

    Parameters
    ----------
    before, after
        As `selected_zone` returned it, and as edited.
    """
    correction = design.found(after.id, ArchRaise)
    if correction is None:
        return design.with_changed(after)
    raised = replace(
        correction,
        apex_mm=correction.apex_mm if after.centre_mm == before.centre_mm else after.centre_mm,
        length_mm=_within("length_mm", after.length_mm),
        width_mm=_within("width_mm", after.width_mm),
    )
    if correction.target_mm is None:
        return design.with_changed(replace(raised, height_mm=after.height_mm))
    target = rounded(correction.target_mm + after.height_mm - before.height_mm, 0.1)
    return design.with_changed(replace(raised, target_mm=_within("target_mm", target)))


def arch_apex_mm(case: Case, arch: ArchRaise) -> Place | None:
    """Return the apex of an arch raise: its own, or that of the foot's arch; None without one."""
    foot = case.shown.foot
    if arch.apex_mm is not None or foot is None:
        return arch.apex_mm
    x, y = find_landmarks(foot)["arch_apex"].point[:2]
    return float(x), float(y)


def _selected(case: Case, kind: type[_Kind]) -> _Kind | None:
    design = case.shown.design
    return None if design is None else design.found(case.selection, kind)


def _ellipse(case: Case, arch: ArchRaise) -> Pelott | None:
    """Return the ellipse of an arch raise; one with a target counts from 0."""
    apex = arch_apex_mm(case, arch)
    if apex is None:
        return None
    return Pelott(
        id=arch.id,
        enabled=arch.enabled,
        centre_mm=apex,
        length_mm=arch.length_mm,
        width_mm=arch.width_mm,
        height_mm=arch.height_mm if arch.target_mm is None else 0.0,
        egg_ratio=0.0,
    )


def _within(name: str, value: float) -> float:
    return float(ranges_of(ArchRaise)[name].nearest(value))
