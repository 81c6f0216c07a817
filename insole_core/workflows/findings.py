"""What is usually prescribed for a finding: proposals of the clinic, never applied by themselves.

The product's are in resources/findings/findings.json, the clinic's beside its settings
(`clinic_findings`). Values that belong to device and rim are set, corrections and pads are added
where the design has none of their kind yet.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

from insole_core.errors import InputError
from insole_core.foot.landmarks import Landmarks
from insole_core.geometry.side import Side
from insole_core.insole.elements import Correction, HeelCup, Pelott, new_id
from insole_core.insole.elements.pad_places import placed_pad
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import Device, apply_device
from insole_core.insole.prescription.finish import Finish
from insole_core.insole.prescription.item_name import key_of
from insole_core.insole.prescription.rim_sliders import with_cup_depth, with_medial_flange
from insole_core.insole.prescription.shell import Post, Shell
from insole_core.workflows.clinic_devices import find_device
from insole_core.workflows.pad_library import LibraryPad

_OF_ITS_MAKING = ("id", "author", "created_at")
_SAME_PLACE_MM = 15.0
"""Pads of one shape whose centres are nearer than this are one and the same."""


@dataclass(frozen=True)
class ProposedPad:
    """A pad of the library by its kind and size; by default as high as there."""

    kind: str
    size: str = ""
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
        Name of the device to start from; empty: that of the design.
    cup_mm, medial_flange_mm, arch_fill_mm
        Of the finish; None leaves them.
    width_mm
        Of the outline; None leaves it.
    posts
        Of the shell, by region.
    corrections
        Without positions.
    pads
        At their usual places.
    """

    name: str
    keywords: tuple[str, ...] = ()
    advice: str = ""
    source: str = ""
    device: str = ""
    cup_mm: float | None = None
    medial_flange_mm: float | None = None
    arch_fill_mm: float | None = None
    width_mm: float | None = None
    posts: tuple[Post, ...] = ()
    corrections: tuple[Correction, ...] = ()
    pads: tuple[ProposedPad, ...] = ()


@dataclass(frozen=True)
class Catalogue:
    """What a finding refers to.

    Parameters
    ----------
    devices
        By `key_of` their names.
    default_device
        Name of the device for a design that is as scanned, where a finding sets rim or fill.
    pads
        Of the clinic's library.
    behind_heads_mm
        Usual distance of a pad's front edge from the line of the metatarsal heads.
    """

    devices: Mapping[str, Device]
    default_device: str
    pads: Sequence[LibraryPad]
    behind_heads_mm: float


def apply_finding(
    finding: Finding,
    design: InsoleDesign,
    landmarks: Landmarks,
    catalogue: Catalogue,
    stamp: Callable[[Correction], Correction] = lambda correction: correction,
) -> InsoleDesign:
    """Return a design with what is proposed for a finding.

    A correction of the same kind, and of the same border, gets those of the proposed values that
    are not the usual ones; a pad of the same shape that is at its place already stays. Everything
    else of the design is kept.

    Parameters
    ----------
    landmarks
        Of the design's foot, insole frame.
    stamp
        Returns a correction with author and time.

    Raises
    ------
    InputError
        If the finding names a device or a kind of pad that the clinic does not have.
    """
    design = _on_device(finding, design, catalogue)
    if finding.width_mm is not None:
        design = replace(design, outline=replace(design.outline, width_mm=finding.width_mm))
    design = _with_posts(_with_rim(finding, design, stamp), finding.posts)
    for correction in finding.corrections:
        design = _with_correction(design, correction, stamp)
    for proposed in finding.pads:
        pad = _placed(proposed, finding, design, landmarks, catalogue)
        if not any(_is_at(pad, other) for other in design.of(Pelott, active=False)):
            design = design.with_added(stamp(replace(pad, id=new_id())))
    return design


def _on_device(finding: Finding, design: InsoleDesign, catalogue: Catalogue) -> InsoleDesign:
    needs_finish = _sets_rim(finding) and design.finish is None
    name = finding.device or (catalogue.default_device if needs_finish else "")
    return apply_device(find_device(catalogue.devices, name), design) if name else design


def _sets_rim(finding: Finding) -> bool:
    of_finish = finding.cup_mm, finding.medial_flange_mm, finding.arch_fill_mm
    return any(value is not None for value in of_finish)


def _with_rim(
    finding: Finding, design: InsoleDesign, stamp: Callable[[Correction], Correction]
) -> InsoleDesign:
    if not _sets_rim(finding):
        return design
    finish = design.finish or Finish()  # the clinic's device may be one without
    if finding.cup_mm is not None:
        finish = with_cup_depth(finish, finding.cup_mm)
        design = _with_cups(design, finding.cup_mm, stamp)
    if finding.medial_flange_mm is not None:
        finish = with_medial_flange(finish, finding.medial_flange_mm)
    if finding.arch_fill_mm is not None:
        finish = replace(finish, arch_fill_mm=finding.arch_fill_mm)
    return replace(design, finish=finish)


def _with_cups(
    design: InsoleDesign, depth_mm: float, stamp: Callable[[Correction], Correction]
) -> InsoleDesign:
    """Set the depth of the heel cups among the corrections, which would overrule the rim."""
    for cup in design.of(HeelCup):
        if cup.depth_mm != depth_mm:
            design = design.with_changed(stamp(replace(cup, depth_mm=depth_mm)))
    return design


def _with_posts(design: InsoleDesign, posts: tuple[Post, ...]) -> InsoleDesign:
    if not posts:
        return design
    shell = design.shell or Shell()
    proposed = {post.region for post in posts}
    kept = tuple(post for post in shell.posts if post.region not in proposed)
    return replace(design, shell=replace(shell, posts=(*kept, *posts)))


def _with_correction(
    design: InsoleDesign, proposed: Correction, stamp: Callable[[Correction], Correction]
) -> InsoleDesign:
    for own in design.corrections:
        same_border = getattr(own, "border", "") == getattr(proposed, "border", "")
        if own.type == proposed.type and same_border:
            changed = replace(own, **set_values(proposed))
            return design if changed == own else design.with_changed(stamp(changed))
    return design.with_added(stamp(replace(proposed, id=new_id())))


def set_values(correction: Correction) -> dict[str, Any]:
    """Return the values of a correction that are not the usual ones."""
    values = {field: getattr(correction, field.name) for field in fields(correction)}
    return {
        field.name: value
        for field, value in values.items()
        if field.name not in _OF_ITS_MAKING and value != field.default
    }


def _placed(
    proposed: ProposedPad,
    finding: Finding,
    design: InsoleDesign,
    landmarks: Landmarks,
    catalogue: Catalogue,
) -> Pelott:
    wanted = (proposed.kind, proposed.size)
    pad = next((pad for pad in catalogue.pads if (pad.kind, pad.size) == wanted), None)
    if pad is None:
        raise InputError(
            'The finding "{finding}" proposes the pad {kind} {size}, and the pad library has none; '
            "choose another one in the clinic's findings.",
            finding=finding.name,
            kind=proposed.kind,
            size=proposed.size,
        )
    template = pad.template
    if proposed.height_mm is not None:
        template = replace(template, height_mm=proposed.height_mm)
    changed = replace(pad, template=template)
    return placed_proposal(changed, design.side, landmarks, catalogue)


def placed_proposal(
    pad: LibraryPad, side: Side, landmarks: Landmarks, catalogue: Catalogue
) -> Pelott:
    """Return a pad of the library where it is usually placed on a foot."""
    return placed_pad(pad.template, pad.place, side, landmarks, catalogue.behind_heads_mm)


def _is_at(pad: Pelott, other: Pelott) -> bool:
    if (other.shape, other.kind) != (pad.shape, pad.kind):
        return False
    (x, y), (u, v) = pad.centre_mm, other.centre_mm
    return math.hypot(x - u, y - v) < _SAME_PLACE_MM


def find_finding(findings: Sequence[Finding], name: str) -> Finding:
    """Return the finding of a name, in whatever case and punctuation.

    Raises
    ------
    InputError
        Naming the findings that there are.
    """
    found = next((f for f in findings if key_of(f.name) == key_of(name)), None)
    if found is None:
        raise InputError(
            'There is no finding "{name}"; choose one of {known}.',
            name=name,
            known=", ".join(key_of(finding.name) for finding in findings),
        )
    return found
