"""Export of an order to the workshop: solid, checks and documents, all or nothing."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from datetime import date
from functools import cached_property
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from insole_core.errors import DesignError, UsageError
from insole_core.export.sheet_terms import as_keyword, sheet_terms
from insole_core.export.shop_order import OrderTerms, Release, serial_number
from insole_core.files.atomic import write_text
from insole_core.files.transaction import Transaction
from insole_core.formats.dxf import write_dxf
from insole_core.formats.file_formats import OUTLINES, can_carry, check_solid_suffix
from insole_core.formats.slicer_3mf import Printer, write_slicer_3mf
from insole_core.formats.solid_content import SolidPart, write_solids
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.height_map import HeightMap
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid
from insole_core.insole.elements.words import number_message
from insole_core.insole.prescription.prescription_lines import make_facts
from insole_core.messages import Message, Translate, joined
from insole_core.progress import SILENT, Progress
from insole_core.solids.checks import (
    Finding,
    Override,
    Place,
    require_export,
    survey_heights,
)
from insole_core.solids.order import Part, nest_parts
from insole_core.solids.prescription_paper import NOBODY, Responsible, write_prescription_paper
from insole_core.solids.print_density import PrintedDensities
from insole_core.solids.shop import Block, Shop
from insole_core.solids.silhouette import block_outline, mark_text, outlines_of
from insole_core.solids.zone_bodies import ZonedPart, placed_print

# `paper` is imported by the functions that write one: it brings reportlab and matplotlib.
if TYPE_CHECKING:
    from insole_core.export.insole_drawing import DrawnInsole
    from insole_core.export.paper import JobSheet, Nesting

MOST_LETTERS = 200
"""Of a pseudonym or a material: what a page of the papers holds."""


@dataclass(frozen=True)
class ExportPaths:
    """Files to write; None for those not wanted.

    Parameters
    ----------
    checks
        Outcome of the checks, JSON.
    job_sheet, prescription
        PDF.
    programs, setup_sheet, pin_holes
        Of a router, from `workflows.mill`: what mills the pieces, in order, the PDF for its
        operator, and what bores the holes for dowels into the spoil board.
    outlines
        DXF.
    """

    solid: Path
    checks: Path | None = None
    job_sheet: Path | None = None
    prescription: Path | None = None
    programs: tuple[Path, ...] = ()
    setup_sheet: Path | None = None
    pin_holes: Path | None = None
    outlines: Path | None = None

    @property
    def files(self) -> tuple[Path, ...]:
        """All of them."""
        single = [value for value in vars(self).values() if isinstance(value, Path)]
        return (*single, *self.programs)


@dataclass(frozen=True, eq=False)
class Printing:
    """A print for a certain slicer, with the zones of each side and how dense they become."""

    printer: Printer
    zoned: Mapping[Side, ZonedPart]
    densities: Mapping[Side, PrintedDensities]

    @property
    def notes(self) -> tuple[str, ...]:
        """What is to be known of the zones, each sentence once."""
        of_zones = [note for each in self.zoned.values() for note in each.notes]
        of_densities = [note for each in self.densities.values() for note in each.notes]
        return tuple(dict.fromkeys((*of_zones, *of_densities)))


@dataclass(frozen=True, eq=False)
class ExportJob:
    """The parts to export and the facts for their documents.

    Parameters
    ----------
    parts
        One, or a left and a right one.
    identification
        What the workshop may know: a pseudonym or an order number; never the patient's name.
    patient
        For the prescription, which stays with the patient and in the record.
    responsible
        Who prescribes and who makes, for the prescription.
    materials
        What each side of the order is made of, for the papers.
    block
        From which the parts are made, and in which a pair is nested; None for none.
    override
        Of blocking rules.
    ascii_stl
        Whether STL is written as text.
    printing
        Settings and zones in a 3MF for a slicer; None for a file without.
    terms
        Quantity, colour and so on, for the job sheet.
    drawn
        Drawings of all parts of the order, also those of other files, which its first page shows
        together; empty for drawings of `parts` alone.
    release
        Number, revision and who released it, for the drawing.
    translate
        Into the language of the papers.
    """

    parts: tuple[Part, ...]
    shop: Shop
    identification: Mapping[str, str] = field(default_factory=dict)
    patient: Mapping[str, str] = field(default_factory=dict)
    responsible: Responsible = NOBODY
    materials: Mapping[Side, str] = field(default_factory=dict)
    block: Block | None = None
    override: Override | None = None
    ascii_stl: bool = False
    printing: Printing | None = None
    terms: OrderTerms = field(default_factory=OrderTerms)
    drawn: tuple[DrawnInsole, ...] = ()
    release: Release = field(default_factory=Release)
    translate: Translate = str

    @property
    def is_nested(self) -> bool:
        """Whether a left and a right part lie in one block."""
        return self.block is not None and len(self.parts) == 2

    def serial_of(self, side: Side) -> str:
        """Return the serial number of a side's piece."""
        return serial_number(self.release, self.identification.get("pseudonym", ""), side)

    def serials_of(self, side: Side) -> str:
        """Return the serial numbers of all pieces of a side."""
        count = self.terms.quantity
        return self.serial_of(side) + (f"/1 – /{count}" if count > 1 else "")

    def placed(self) -> tuple[PlacedPart, ...]:
        """Return the parts where they lie in the file: the lowest place of each at z = 0.

        Raises
        ------
        DesignError
            If a pair does not fit the block.
        """
        if self.block is None or len(self.parts) != 2:
            return tuple(PlacedPart(part, standing(part.solid)) for part in self.parts)
        nest = nest_parts(*self.parts, self.block.size_mm)
        return tuple(map(PlacedPart, self.parts, nest.insole2block))


@dataclass(frozen=True, eq=False)
class PlacedPart:
    """A part at its position in the exported file.

    Parameters
    ----------
    insole2file : (4, 4) float64, mm
        Along z alone for a part that lies as it was designed: a short or tapered shell has its
        lowest place over the bottom plane of the insole frame, raised letters have theirs below.
    """

    part: Part
    insole2file: FloatArray

    @property
    def findings(self) -> tuple[Finding, ...]:
        """The findings, with places in the frame of the file."""
        return tuple(finding.moved(self.insole2file) for finding in self.part.findings)

    @property
    def failed_mm(self) -> tuple[Place, ...]:
        """Where checks have failed, in the frame of the file."""
        return tuple(
            finding.place_mm
            for finding in self.findings
            if finding.place_mm is not None and not finding.passed
        )

    def objects(self, shop: Shop) -> tuple[SolidPart, ...]:
        """Return the objects of the file."""
        return tuple(
            replace(layer, mesh=layer.mesh.transformed(self.insole2file))
            for layer in self.part.layers(shop)
        )

    @cached_property
    def heights(self) -> HeightMap:
        """The heights of the solid, in the frame of the file."""
        return survey_heights(self.part.solid.transformed(self.insole2file))


def standing(solid: TriangleMesh) -> FloatArray:
    """Return the transform (4, 4), mm, that lets a solid stand on z = 0."""
    return rigid(np.eye(3), np.array([0.0, 0.0, -solid.bounds_mm[0, 2]]))


def opened(places: ExportPaths, transaction: Transaction) -> ExportPaths:
    """Open temporary files for every path before the work begins.

    Parameters
    ----------
    places
        The final paths, which the files take when the transaction ends without error.

    Returns
    -------
    ExportPaths
        The temporary files to write.

    Raises
    ------
    UsageError
        If a name has a suffix that is not supported, or two results have the same name.
    OutputError
        If a path cannot be written.
    """
    check_solid_suffix(places.solid)
    for paper in (places.job_sheet, places.prescription, places.setup_sheet):
        if paper is not None and paper.suffix.lower() != ".pdf":
            raise UsageError(
                "{paper} is a paper, which is written as .pdf; change its suffix.", paper=paper
            )
    if places.outlines is not None and places.outlines.suffix.lower() != OUTLINES.ending:
        raise UsageError(
            "{path} are outlines, which are written as .dxf; change its suffix.",
            path=places.outlines,
        )
    beside: dict[str, Any] = {
        name: tuple(map(transaction.file, value))
        if isinstance(value, tuple)
        else value and transaction.file(value)
        for name, value in vars(places).items()
    }
    return ExportPaths(**beside)


@contextmanager
def outputs(places: ExportPaths) -> Iterator[ExportPaths]:
    """Open temporary files for every path, as `opened`; none remains if the work fails."""
    with Transaction() as transaction:
        yield opened(places, transaction)


def _check_texts(texts: Iterable[str]) -> None:
    for text in texts:
        if len(text) > MOST_LETTERS:
            raise DesignError(
                '"{start}…" has {count} characters, and the papers take at most {most}; '
                "shorten it.",
                start=text[:20],
                count=len(text),
                most=MOST_LETTERS,
            )


def run_export_job(
    job: ExportJob, places: ExportPaths, beside: ExportPaths, progress: Progress = SILENT
) -> None:
    """Write the solid and the documents that are wanted.

    Parameters
    ----------
    places
        The final paths, named in the documents.
    beside
        The temporary files to write, from `outputs`.

    Raises
    ------
    DesignError
        If a blocking check failed and is not overridden, a pair does not fit its block, or a text
        is too long for the papers.
    InputError
        If a paper lacks what it states.
    """
    _check_texts((*job.identification.values(), *job.materials.values()))
    placed = job.placed()
    records = [require_export(each.findings, job.override) for each in placed]
    progress.step(0.1, "Writing the file")
    _write_solid(job, placed, beside.solid)
    if beside.checks is not None:
        text = json.dumps(_joined(job, records), indent=1, ensure_ascii=False)
        write_text(text + "\n", beside.checks)
    materials = {part.side: job.materials.get(part.side, "") for part in job.parts}
    if beside.job_sheet is not None:
        from insole_core.export.paper import write_job_sheet

        progress.step(0.4, "Writing the job sheet")
        drawn = job.drawn or drawn_parts(job.parts, job.translate)
        sheets = [_job_sheet(job, each, drawn, places, beside) for each in placed]
        nesting = _nesting(job.block, placed) if job.block and job.is_nested else None
        keyword = as_keyword(
            sheet_terms(
                job.release,
                job.identification.get("pseudonym", ""),
                materials,
                job.terms,
            )
        )
        write_job_sheet(sheets, beside.job_sheet, nesting, drawn, job.translate, keyword=keyword)
    if beside.outlines is not None:
        progress.step(0.7, "Writing the outlines")
        _write_outlines(job, placed, beside.outlines)
    if beside.prescription is not None:
        progress.step(0.8, "Writing the prescription")
        write_prescription_paper(
            [part.insole.design for part in job.parts],
            beside.prescription,
            responsible=job.responsible,
            identification={**job.patient, **job.identification, **_numbers(job)},
            material=joined(dict.fromkeys(filter(None, materials.values())), " / "),
            day=date.today(),
            provenance={
                part.side: {"change of pressure": joined(part.told, " ")}
                for part in job.parts
                if part.told
            },
            landmarks={part.side: part.landmarks for part in job.parts},
            warnings={part.side: part.warnings for part in job.parts},
            translate=job.translate,
        )


def _numbers(job: ExportJob) -> dict[str, str]:
    """Return by which numbers the pieces and their material are known, for the prescription."""
    serials = ", ".join(job.serials_of(part.side) for part in job.parts)
    lot = {"lot of the material": job.terms.lot} if job.terms.lot else {}
    return {"serial number": serials, **lot}


def _write_solid(job: ExportJob, placed: tuple[PlacedPart, ...], path: Path) -> None:
    mirrored = ", ".join(_mirrored(job))
    label = ", ".join(filter(None, (mirrored, job.identification.get("pseudonym", ""))))
    if job.printing is None:
        objects = [layer for each in placed for layer in each.objects(job.shop)]
        write_solids(objects, path, as_text=job.ascii_stl, label=label, note=mirrored)
        return
    prints = [
        placed_print(job.printing.zoned[each.part.side].printed, each.insole2file)
        for each in placed
    ]
    title = " ".join(filter(None, ("Insole", label)))
    write_slicer_3mf(prints, path, job.printing.printer, title)


def _write_outlines(job: ExportJob, placed: tuple[PlacedPart, ...], path: Path) -> None:
    """Write the outlines of all parts, in the frame of the file, with their marks."""
    drawn = [tuple(outlines_of(each.part, each.insole2file)) for each in placed]
    known = job.identification.get("pseudonym", "")
    marks = [
        mark_text(" ".join(filter(None, (known, str(each.part.side)))), lines)
        for each, lines in zip(placed, drawn, strict=True)
    ]
    outlines = [line for lines in drawn for line in lines]
    if job.block is not None:
        length, width, _ = job.block.sides_mm
        middle = (width / 2, length / 2) if job.is_nested else marks[0].place_mm
        outlines.append(block_outline(job.block, middle))
    write_dxf(outlines, marks, path)


def _mirrored(job: ExportJob) -> list[str]:
    """Say in the file itself which of its parts are for a foot that was not scanned."""
    sides = (part.side for part in job.parts if part.insole.foot.mirrored)
    return [f"{side} mirrored from {side.other}" for side in sides]


def require_3mf(path: Path) -> None:
    """Check that a file for a slicer can hold settings and zones.

    Raises
    ------
    UsageError
        If its suffix is not .3mf.
    """
    if not can_carry(path.suffix, "print settings"):
        raise UsageError(
            "Only a .3mf file holds zones and settings for a slicer, and {path} is none; change "
            "its suffix, or name no printer.",
            path=path,
        )


def _joined(job: ExportJob, records: list[dict[str, Any]]) -> dict[str, Any]:
    """Return the record of a single part as it is, those of a pair by side."""
    for part, record in zip(job.parts, records, strict=True):
        record["deviation_mm"] = round(part.deviation_mm, 4)
        record["triangles"] = len(part.solid.triangles)
        record["warnings"] = list(map(str, part.warnings))
    if len(records) == 1:
        return records[0]
    return {str(part.side): r for part, r in zip(job.parts, records, strict=True)}


def _job_sheet(
    job: ExportJob,
    placed: PlacedPart,
    drawn: Sequence[DrawnInsole],
    places: ExportPaths,
    beside: ExportPaths,
) -> JobSheet:
    from insole_core.export.paper import JobSheet

    part, say = placed.part, job.translate
    piece = next((each for each in drawn if each.side is part.side), None)
    is_upright = piece is not None and not job.is_nested
    return JobSheet(
        identification={
            **job.identification,
            "side": str(part.side),
            "serial number": job.serials_of(part.side),
            "kind": part.order.kind,
            "mark": ", ".join(part.order.mark) or "–",
            "date": date.today().isoformat(),
        },
        measures=_translated(_measures(part), say),
        make=_translated(_make(job, part), say),
        checks=tuple(f"{'✓' if f.passed else '✗'} {say(f.sentence)}" for f in placed.findings)
        + tuple(
            map(say, (*part.notes, *part.told, *_printed_notes(job, part), *_released(job, part)))
        ),
        warnings=tuple(map(say, part.warnings)),
        file=beside.solid,
        file_name=places.solid.name,
        height_map=piece.heights if piece is not None and is_upright else placed.heights,
        failed_mm=placed.failed_mm,
        is_nested=job.is_nested,
        drawn=piece,
        title=_title(job, part, [each.side for each in drawn]),
        own_title=_title(job, part, [part.side]),
        remarks=job.terms.remarks,
    )


def _title(job: ExportJob, part: Part, sides: Sequence[Side]) -> dict[str, str]:
    """Return the title block of a sheet that shows the sides, without what file and page tell."""
    release, terms = job.release, job.terms
    known = job.identification.get("pseudonym", "–")
    materials = [job.translate(job.materials.get(side) or "–") for side in sides]
    return {
        "order number": release.number or known,
        "revision": str(release.revision),
        "date": date.today().isoformat(),
        "sheet": "",
        "pseudonym": known,
        "side": " and ".join(map(str, sides)),
        "kind": part.order.kind,
        "quantity": str(terms.quantity),
        "material": ", ".join(dict.fromkeys(materials)),
        "lot of the material": terms.lot or "–",
        "serial number": ", ".join(map(job.serial_of, sides)),
        "colour": terms.colour or "–",
        "cover": terms.cover or "–",
        "delivery date": terms.facts.get("delivery date", "–"),
        "scale": "",
        "projection": "named at each view",
        "units": "mm",
        "tolerance": job.translate(_tolerance(job)),
        "file": "",
        "SHA-256": "",
        "drawn": f"Insole Studio {version('insole-studio')}",
        "released": release.by or "–",
    }


def drawn_parts(parts: Sequence[Part], translate: Translate = str) -> tuple[DrawnInsole, ...]:
    """Return parts for the drawing of their job sheet; without those that are not closed."""
    from insole_core.solids.drawn_part import drawn_part

    drawn = (drawn_part(part, translate) for part in parts)
    return tuple(piece for piece in drawn if piece is not None)


def _translated(facts: Mapping[str, str], translate: Translate) -> dict[str, str]:
    return {name: translate(text) for name, text in facts.items()}


def _nesting(block: Block, placed: tuple[PlacedPart, ...]) -> Nesting:
    from insole_core.export.paper import NestedPart, Nesting

    length, width, height = block.sides_mm
    return Nesting(
        stock=block.words,
        block_mm=(width, length, height),
        parts=tuple(
            NestedPart(
                name=str(each.part.side),
                heights=each.heights,
                bounds_mm=each.part.solid.transformed(each.insole2file).bounds_mm,
                turn_deg=180 if each.insole2file[1, 1] < 0 else 0,
                failed_mm=each.failed_mm,
            )
            for each in placed
        ),
    )


def _measures(part: Part) -> dict[str, str]:
    solid = part.solid
    length, width, height = (solid.bounds_mm[1] - solid.bounds_mm[0])[[1, 0, 2]]
    facts = {
        "length × width × height": Message(
            "{length:.1f} × {width:.1f} × {height:.1f} mm",
            length=length,
            width=width,
            height=height,
        ),
        "volume": Message("{volume:.1f} cm³", volume=solid.volume_mm3 / 1000),
        "triangles": str(len(solid.triangles)),
    }
    for finding in part.findings:
        if finding.name == "thickness":
            facts["least thickness, without the rim"] = Message(
                "{number} mm", number=number_message(finding.value, 2)
            )
    if part.deviation_mm > 0:
        facts["deviation of the triangles"] = Message(
            "{deviation:.3f} mm at most", deviation=part.deviation_mm
        )
    return facts


def _make(job: ExportJob, part: Part) -> dict[str, str]:
    facts = {
        "material": job.materials.get(part.side) or "–",
        "tolerance": _tolerance(job),
        **{name: text for name, text in job.terms.facts.items() if name != "remarks"},
        **make_facts(part.insole.design),
    }
    if part.insole.design.shell is None or part.order.kind == "positive":
        facts["draft of the walls"] = Message("{value:g}°", value=part.order.options.draft_deg)
    if job.printing is not None:
        facts |= job.printing.densities[part.side].facts
    if job.terms.remarks:
        facts["remarks"] = job.terms.remarks
    if job.block is not None:
        facts["stock"] = job.block.words
    return facts


def _tolerance(job: ExportJob) -> Message:
    return Message("± {number} mm", number=number_message(job.shop.tolerance_mm, 2))


def _printed_notes(job: ExportJob, part: Part) -> tuple[str, ...]:
    return () if job.printing is None else job.printing.densities[part.side].notes


def _released(job: ExportJob, part: Part) -> tuple[str, ...]:
    by = job.override
    if by is None or not any(finding.blocks for finding in part.findings):
        return ()
    return (
        Message(
            "Released against a blocking rule by {author}, {at}: {reason}",
            author=by.author,
            at=by.at,
            reason=by.reason,
        ),
    )
