"""The findings of the product and those of the clinic, and their files: docs/formats/device.md."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

from insole_core.errors import DesignError, InputError
from insole_core.files.atomic import make_output_folder, replacing_file
from insole_core.forgiving_json import keep_unreadable, set_aside
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_core.insole.fields import Range, ranges_of
from insole_core.insole.prescription import design_json
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.item_name import checked_name, key_of
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Shell
from insole_core.json_object import JsonObject
from insole_core.resources import resource_path
from insole_core.workflows.findings import Finding, ProposedPad, set_values
from insole_core.workflows.named_files import Listed

FORMAT, VERSION = "insole-findings", 1
_SIMPLE = (
    "name", "advice", "source", "device", "cup_mm", "medial_flange_mm", "arch_fill_mm", "width_mm",
)  # fmt: skip


def read_findings(path: Path) -> tuple[Finding, ...]:
    """Read a file of findings.

    Raises
    ------
    InputError
        Naming the file, and the key that is missing, unknown or out of range.
    """
    root = JsonObject.read(path)
    root.check_format(FORMAT, VERSION)
    for key in sorted(root.values.keys() - {"format", "version", "findings"}):
        raise root.fail(key, "is no key of findings; check its spelling or leave it out")
    return tuple(_finding(item) for item in root.objects("findings"))


def write_findings(findings: Sequence[Finding], path: Path) -> None:
    """Write findings in the format of `read_findings`, as a rule to `replacing_file`'s path."""
    listed = [_to_json(finding) for finding in findings]
    content = {"format": FORMAT, "version": VERSION, "findings": listed}
    path.write_text(
        json.dumps(content, indent=1, ensure_ascii=False) + "\n", encoding="utf-8", newline="\n"
    )


def _to_json(finding: Finding) -> dict[str, Any]:
    """Return a finding as plain values, without those that are not set."""
    design = InsoleDesign(
        Side.LEFT, corrections=finding.corrections, shell=Shell(posts=finding.posts)
    )
    stated = design_json.design_to_json(design)
    content = {
        **{key: getattr(finding, key) for key in _SIMPLE},
        "keywords": list(finding.keywords),
        "posts": stated["shell"]["posts"],
        "corrections": [
            {key: value for key, value in plain.items() if key in ("type", *set_values(correction))}
            for correction, plain in zip(finding.corrections, stated["corrections"], strict=True)
        ],
        "pads": [_stated(vars(pad)) for pad in finding.pads],
    }
    return _stated(content)


def _stated(values: Mapping[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in values.items() if value not in (None, "", [])}


def _finding(item: JsonObject) -> Finding:
    known = {field.name for field in fields(Finding)}
    for key in sorted(item.values.keys() - known):
        raise item.fail(key, "is no key of a finding; check its spelling or leave it out")
    design = _prescribed(item)
    height, fill = ranges_of(RimStation)["height_mm"], ranges_of(Finish)["arch_fill_mm"]
    return Finding(
        name=_name(item),
        keywords=tuple(item.texts("keywords")) if item.has("keywords") else (),
        advice=_text(item, "advice"),
        source=_text(item, "source"),
        device=_text(item, "device"),
        cup_mm=_number(item, "cup_mm", height),
        medial_flange_mm=_number(item, "medial_flange_mm", height),
        arch_fill_mm=_number(item, "arch_fill_mm", fill),
        width_mm=_number(item, "width_mm", ranges_of(Outline)["width_mm"]),
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


def _name(item: JsonObject) -> str:
    try:
        return checked_name(item.text("name"))
    except DesignError as error:
        raise InputError("{file}: {reason}", file=item.file, reason=error.message) from error


def _pad(item: JsonObject) -> ProposedPad:
    allowed = ranges_of(Pelott)["height_mm"]
    return ProposedPad(item.text("kind"), _text(item, "size"), _number(item, "height_mm", allowed))


def _text(item: JsonObject, key: str) -> str:
    return item.text(key, empty=True) if item.has(key) else ""


def _number(item: JsonObject, key: str, allowed: Range) -> float | None:
    return item.number(key, allowed.least, allowed.greatest) if item.has(key) else None


class ClinicFindings:
    """Storage of findings; all of the clinic's are in one file.

    A finding of the clinic takes the place of one of the product with the same name, until it is
    removed.

    Parameters
    ----------
    folder
        Of the clinic's settings; while there is no file of findings in it, the product's apply.
    """

    def __init__(self, folder: Path) -> None:
        self._path = folder / "findings.json"

    def load(self) -> Listed[Finding]:
        """Return all findings.

        Raises
        ------
        InputError
            When those of the product cannot be read.
        """
        items = _by_key(read_findings(resource_path("findings/findings.json")))
        try:
            own = _by_key(self._own())
        except InputError as error:
            return Listed(items, frozenset(), (error.message,))
        return Listed(dict(sorted((items | own).items())), frozenset(own), ())

    def save(self, findings: Sequence[Finding], instead_of: str = "") -> None:
        """Store findings of the clinic; those of the same names are replaced.

        A file that cannot be read is kept under another name.

        Parameters
        ----------
        instead_of
            Name of one that goes: under which a finding was stored before.

        Raises
        ------
        OutputError
            When the place cannot be written.
        """
        make_output_folder(self._path.parent)
        if self._path.exists():
            keep_unreadable(self._path, self._own)
        own = _by_key(self._own())
        own.pop(key_of(instead_of), None)
        export_findings(tuple((own | _by_key(findings)).values()), self._path)

    def remove(self, name: str) -> None:
        """Remove a finding of the clinic; one of the product of that name comes back.

        Raises
        ------
        OutputError
            When the place cannot be written.
        """
        self.save((), instead_of=name)

    def reset(self) -> Path | None:
        """Return to the findings of the product.

        Returns
        -------
        Path or None
            Where the clinic's are kept, to be imported again; None if it has none.
        """
        return set_aside(self._path, "kept") if self._path.exists() else None

    def _own(self) -> tuple[Finding, ...]:
        return read_findings(self._path) if os.path.lexists(self._path) else ()


def export_findings(findings: Sequence[Finding], path: Path) -> None:
    """Write findings to a file for another clinic to import.

    Raises
    ------
    OutputError
        When the place cannot be written.
    """
    with replacing_file(path) as beside:
        write_findings(findings, beside)


def _by_key(findings: Iterable[Finding]) -> dict[str, Finding]:
    return {key_of(finding.name): finding for finding in findings}
