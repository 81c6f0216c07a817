"""What is usually prescribed for a finding: proposals of the clinic, never applied by themselves.

The product's are in resources/findings/findings.json; a clinic's file beside the settings replaces
and adds some. Values that belong to device and rim are set, corrections and pads are added where
the design has none of their kind yet.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

from insole_core.errors import DesignError, InputError
from insole_core.foot.landmarks import Landmarks
from insole_core.insole.pads.pad_places import placed_pad
from insole_core.insole.prescription import design_json
from insole_core.insole.prescription.corrections import CorrectionBase
from insole_core.insole.prescription.design import (
    Correction,
    Finish,
    HeelCup,
    InsoleDesign,
    Pelott,
    Post,
    Shell,
)
from insole_core.insole.prescription.design_limits import (
    CORRECTION_RANGES,
    FINISH_RANGES,
    OUTLINE_RANGES,
    RIM_RANGES,
    Range,
)
from insole_core.insole.prescription.device import Device, apply_device
from insole_core.insole.prescription.item_name import key_of
from insole_core.insole.prescription.rim_sliders import with_cup_depth, with_medial_flange
from insole_core.json_object import JsonObject
from insole_core.resources import resource_path
from insole_core.workflows.clinic_devices import find_device
from insole_core.workflows.pad_library import LibraryPad

FORMAT, VERSION = "insole-findings", 1
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
        if not any(_is_at(pad, other) for other in design.corrections):
            design = design.with_added(stamp(replace(pad, id=CorrectionBase().id)))
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
    for cup in design.active:
        if isinstance(cup, HeelCup) and cup.depth_mm != depth_mm:
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
            changed = replace(own, **_set_values(proposed))
            return design if changed == own else design.with_changed(stamp(changed))
    return design.with_added(stamp(replace(proposed, id=CorrectionBase().id)))


def _set_values(correction: Correction) -> dict[str, Any]:
    """Return the values of a correction that are not the usual ones."""
    values = {field: getattr(correction, field.name) for field in fields(correction)}
    return {
        field.name: value
        for field, value in values.items()
        if field.name != "id" and value != field.default
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
    return placed_pad(template, pad.place, design.side, landmarks, catalogue.behind_heads_mm)


def _is_at(pad: Pelott, other: Correction) -> bool:
    if not isinstance(other, Pelott) or (other.shape, other.kind) != (pad.shape, pad.kind):
        return False
    (x, y), (u, v) = pad.centre_mm, other.centre_mm
    return math.hypot(x - u, y - v) < _SAME_PLACE_MM


class ClinicFindings:
    """The findings of the product, and those of the clinic in their places and beside them.

    Parameters
    ----------
    path
        Of the clinic's findings; while there is no such file, those of the product apply.
    """

    def __init__(self, path: Path) -> None:
        self._path = path

    def load(self) -> tuple[Finding, ...]:
        """Return all findings, in the order of their names.

        Raises
        ------
        InputError
            When a file cannot be read.
        """
        listed = _read(resource_path("findings/findings.json"))
        own = _read(self._path) if os.path.lexists(self._path) else ()
        by_key = {key_of(finding.name): finding for finding in (*listed, *own)}
        return tuple(finding for _, finding in sorted(by_key.items()))


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


def _read(path: Path) -> tuple[Finding, ...]:
    root = JsonObject.read(path)
    root.check_format(FORMAT, VERSION)
    return tuple(_finding(item) for item in root.objects("findings"))


def _finding(item: JsonObject) -> Finding:
    known = {field.name for field in fields(Finding)}
    for key in sorted(item.values.keys() - known):
        raise item.fail(key, "is no key of a finding; check its spelling or leave it out")
    design = _prescribed(item)
    height, fill = RIM_RANGES["height_mm"], FINISH_RANGES["arch_fill_mm"]
    return Finding(
        name=item.text("name"),
        keywords=tuple(item.texts("keywords")) if item.has("keywords") else (),
        advice=_text(item, "advice"),
        source=_text(item, "source"),
        device=_text(item, "device"),
        cup_mm=_number(item, "cup_mm", height),
        medial_flange_mm=_number(item, "medial_flange_mm", height),
        arch_fill_mm=_number(item, "arch_fill_mm", fill),
        width_mm=_number(item, "width_mm", OUTLINE_RANGES["width_mm"]),
        posts=() if design.shell is None else design.shell.posts,
        corrections=design.corrections,
        pads=tuple(_pad(pad) for pad in item.objects("pads")) if item.has("pads") else (),
    )


def _prescribed(item: JsonObject) -> InsoleDesign:
    """Return corrections and posts of a finding as a design, read as strictly as one."""
    content = {
        "format": design_json.FORMAT,
        "version": design_json.VERSION,
        "side": "left",
        "corrections": item.items("corrections") if item.has("corrections") else [],
        "shell": {"posts": item.items("posts") if item.has("posts") else []},
    }
    try:
        return design_json.design_from_json(content)
    except DesignError as error:
        raise InputError(
            "{file}: {place} {reason}",
            file=item.file,
            place=item.place.removesuffix("."),
            reason=error.message,
        ) from error


def _pad(item: JsonObject) -> ProposedPad:
    allowed = CORRECTION_RANGES[Pelott]["height_mm"]
    return ProposedPad(item.text("kind"), _text(item, "size"), _number(item, "height_mm", allowed))


def _text(item: JsonObject, key: str) -> str:
    return item.text(key, empty=True) if item.has(key) else ""


def _number(item: JsonObject, key: str, allowed: Range) -> float | None:
    return item.number(key, allowed.least, allowed.greatest) if item.has(key) else None
