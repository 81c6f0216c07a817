"""Keep what a design corrects as the proposal for a finding."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.foot.landmarks import Landmarks
from insole_core.insole.elements import (
    BrushStroke,
    Correction,
    Pelott,
)
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.item_name import checked_name, key_of
from insole_core.insole.prescription.rim_sliders import (
    designed_cup_mm,
    medial_flange_mm,
)
from insole_core.insole.prescription.shell import Post
from insole_core.workflows.findings import Catalogue, Finding, ProposedPad, placed_proposal
from insole_core.workflows.pad_library import LibraryPad

_SHOWN_MM = 0.05  # half of the step in which heights are shown
_MOVED_MM = 5.0  # from its usual place, beyond which a pad is called moved


@dataclass(frozen=True)
class KeptFinding:
    """A finding made of a design.

    Parameters
    ----------
    left_out
        Corrections that no finding can propose: strokes, and pads that are not in the library.
    moved
        Pads that will be proposed at their usual places, and lie elsewhere now.
    """

    finding: Finding
    left_out: tuple[Correction, ...] = ()
    moved: tuple[Pelott, ...] = ()


def finding_of(
    design: InsoleDesign, name: str, landmarks: Landmarks, catalogue: Catalogue
) -> KeptFinding:
    """Return a finding that proposes what a design has beyond its device.

    Those are cup, medial flange, fill and width where they differ from the device's, posts, and
    corrections without what is of this foot alone; and the device if it is not the clinic's usual.

    Parameters
    ----------
    landmarks
        Of the design's foot, insole frame.

    Raises
    ------
    DesignError
        If the name is empty or too long.
    """
    device = catalogue.devices.get(key_of(design.device))
    usual = None if device is None else device.values
    is_default = key_of(design.device) == key_of(catalogue.default_device)
    pads = design.of(Pelott)
    known = {pad.id: _in_library(pad, catalogue) for pad in pads}
    heights = _heights(design, usual)
    finding = Finding(
        checked_name(name),
        cup_mm=heights.get("cup_mm"),
        medial_flange_mm=heights.get("medial_flange_mm"),
        arch_fill_mm=heights.get("arch_fill_mm"),
        device="" if device is None or is_default else device.name,
        posts=_posts(design, usual),
        corrections=tuple(c.for_any_foot() for c in design.active if _is_proposed(c, design)),
        pads=tuple(_proposed(pad, found) for pad in pads if (found := known[pad.id])),
        width_mm=None
        if usual is not None and usual.outline.width_mm == design.outline.width_mm
        else design.outline.width_mm,
    )
    unknown = tuple(pad for pad in pads if known[pad.id] is None)
    strokes = design.of(BrushStroke)
    moved = tuple(
        pad
        for pad in pads
        if (found := known[pad.id])
        and _distance_mm(pad, placed_proposal(found, design.side, landmarks, catalogue)) > _MOVED_MM
    )
    return KeptFinding(finding, (*unknown, *strokes), moved)


def _heights(design: InsoleDesign, usual: InsoleDesign | None) -> dict[str, float]:
    """Return cup, medial flange and fill where they differ from the device's."""
    own, of_device = _rim(design), {} if usual is None else _rim(usual)
    return {
        key: round(value, 1)
        for key, value in own.items()
        if value is not None and abs(value - (of_device.get(key) or 0.0)) > _SHOWN_MM
    }


def _rim(design: InsoleDesign) -> dict[str, float | None]:
    if design.finish is None:
        return {}
    return {
        "cup_mm": designed_cup_mm(design),
        "medial_flange_mm": medial_flange_mm(design.finish),
        "arch_fill_mm": design.finish.arch_fill_mm,
    }


def _posts(design: InsoleDesign, usual: InsoleDesign | None) -> tuple[Post, ...]:
    if design.shell is None:
        return ()
    of_device = () if usual is None or usual.shell is None else usual.shell.posts
    return tuple(post for post in design.shell.posts if post not in of_device)


def _is_proposed(correction: Correction, design: InsoleDesign) -> bool:
    if correction.rim_depth_mm is not None:
        return design.finish is None  # else `cup_mm` says its depth
    return not correction.is_of_one_foot


def _in_library(pad: Pelott, catalogue: Catalogue) -> LibraryPad | None:
    """Return the pad of the library that one was made of: the one nearest to it in size."""
    alike = [
        listed
        for listed in catalogue.pads
        if (listed.template.kind, listed.template.shape) == (pad.kind, pad.shape)
    ]
    return min(alike, key=lambda listed: _size_difference_mm(pad, listed.template), default=None)


def _size_difference_mm(pad: Pelott, other: Pelott) -> float:
    return abs(pad.length_mm - other.length_mm) + abs(pad.width_mm - other.width_mm)


def _proposed(pad: Pelott, listed: LibraryPad) -> ProposedPad:
    is_usual = abs(pad.height_mm - listed.template.height_mm) < _SHOWN_MM
    return ProposedPad(listed.kind, listed.size, None if is_usual else pad.height_mm)


def _distance_mm(pad: Pelott, other: Pelott) -> float:
    (x, y), (u, v) = pad.centre_mm, other.centre_mm
    return float(((x - u) ** 2 + (y - v) ** 2) ** 0.5)
