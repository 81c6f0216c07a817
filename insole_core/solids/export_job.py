"""Export of an order to the workshop: solid, checks and documents, all or nothing."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from insole_core.errors import DesignError, UsageError
from insole_core.export.atomic import replacing_file
from insole_core.export.solid_file import check_suffix, write_solids
from insole_core.export.three_mf import ThreeMfPart
from insole_core.insole.prescription.prescription_lines import correction_lines, make_facts
from insole_core.progress import SILENT, Progress
from insole_core.solids.checks import Override, require_export, survey_heights
from insole_core.solids.order import Part, nest_parts
from insole_core.solids.shop import Block, Shop

# `paper` is imported by the functions that write one: it brings reportlab and matplotlib.
if TYPE_CHECKING:
    from insole_core.export.paper import JobSheet

MOST_LETTERS = 200
"""Of a pseudonym or a material: what a page of the papers holds."""
_SECTIONS = ((0.5, False), (0.12, True), (0.5, True), (0.72, True))
"""Share of the length or width, and whether the cut goes across."""


@dataclass(frozen=True)
class ExportPaths:
    """Files to write; None for those not wanted.

    Parameters
    ----------
    checks
        Outcome of the checks, JSON.
    job_sheet, prescription
        PDF.
    """

    solid: Path
    checks: Path | None = None
    job_sheet: Path | None = None
    prescription: Path | None = None


@dataclass(frozen=True, eq=False)
class ExportJob:
    """The parts to export and the facts for their documents.

    Parameters
    ----------
    pieces
        One, or a left and a right one.
    identification
        What the workshop may know: a pseudonym; never the patient's name.
    patient
        For the prescription, which stays with the patient and in the record.
    block
        In which a pair is nested; None for parts that lie as they were designed.
    override
        Of blocking rules.
    ascii_stl
        Whether STL is written as text.
    """

    pieces: tuple[Part, ...]
    shop: Shop
    identification: Mapping[str, str] = field(default_factory=dict)
    patient: Mapping[str, str] = field(default_factory=dict)
    material: str = ""
    block: Block | None = None
    override: Override | None = None
    ascii_stl: bool = False

    def parts(self) -> tuple[ThreeMfPart, ...]:
        """Return the objects of the file.

        Raises
        ------
        DesignError
            If a pair does not fit the block.
        """
        if self.block is not None and len(self.pieces) == 2:
            return nest_parts(*self.pieces, self.block.size_mm, self.shop)
        return tuple(part for piece in self.pieces for part in piece.parts(self.shop))


@contextmanager
def outputs(places: ExportPaths) -> Iterator[ExportPaths]:
    """Open temporary files for every path before the work begins; none remains if it fails.

    Parameters
    ----------
    places
        The final paths, which the files take when the context ends without error.

    Yields
    ------
    ExportPaths
        The temporary files to write.

    Raises
    ------
    UsageError
        If a name has a suffix that is not supported.
    OutputError
        If a path cannot be written.
    """
    check_suffix(places.solid)
    for paper in (places.job_sheet, places.prescription):
        if paper is not None and paper.suffix.lower() != ".pdf":
            raise UsageError(
                "{paper} is a paper, which is written as .pdf; change its suffix.", paper=paper
            )
    with ExitStack() as stack:
        opened = (
            path and stack.enter_context(replacing_file(path)) for path in vars(places).values()
        )
        yield ExportPaths(*opened)


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
    """
    _check_texts((*job.identification.values(), job.material))
    records = [require_export(piece.findings, job.override) for piece in job.pieces]
    progress.step(0.1, "Writing the file")
    write_solids(job.parts(), beside.solid, ascii_stl=job.ascii_stl)
    if beside.checks is not None:
        text = json.dumps(_joined(job, records), indent=1, ensure_ascii=False)
        beside.checks.write_text(text + "\n", encoding="utf-8")
    if beside.job_sheet is not None:
        from insole_core.export.paper import write_job_sheet

        progress.step(0.4, "Writing the job sheet")
        sheets = [_job_sheet(job, piece, places, beside) for piece in job.pieces]
        write_job_sheet(sheets, beside.job_sheet)
    if beside.prescription is not None:
        progress.step(0.8, "Writing the prescription")
        _write_prescription(job, beside.prescription)


def _joined(job: ExportJob, records: list[dict[str, Any]]) -> dict[str, Any]:
    """Return the record of a single part as it is, those of a pair by side."""
    for piece, record in zip(job.pieces, records, strict=True):
        record["deviation_mm"] = round(piece.deviation_mm, 4)
        record["triangles"] = len(piece.solid.triangles)
    if len(records) == 1:
        return records[0]
    return {str(piece.side): r for piece, r in zip(job.pieces, records, strict=True)}


def _job_sheet(job: ExportJob, piece: Part, places: ExportPaths, beside: ExportPaths) -> JobSheet:
    from insole_core.export.paper import JobSheet, section_along

    top, bottom = survey_heights(piece.solid)
    return JobSheet(
        identification={
            **job.identification,
            "side": str(piece.side),
            "kind": piece.order.kind,
            "mark": ", ".join(piece.order.mark) or "–",
            "date": datetime.now(UTC).date().isoformat(),
        },
        measures=_measures(piece),
        make=_make(job, piece),
        sections=tuple(
            section_along(top, bottom, 1.0, share=share, across=across)
            for share, across in _SECTIONS
        ),
        checks=tuple(f"{'✓' if f.passed else '✗'} {f.sentence}" for f in piece.findings)
        + piece.notes
        + _released(job, piece),
        file=beside.solid,
        file_name=places.solid.name,
        height_map_mm=top,
    )


def _measures(piece: Part) -> dict[str, str]:
    solid = piece.solid
    length, width, height = (solid.bounds_mm[1] - solid.bounds_mm[0])[[1, 0, 2]]
    facts = {
        "length × width × height": f"{length:.1f} × {width:.1f} × {height:.1f} mm",
        "volume": f"{solid.volume_mm3 / 1000:.1f} cm³",
        "triangles": str(len(solid.triangles)),
    }
    if piece.deviation_mm > 0:
        facts["deviation of the triangles"] = f"{piece.deviation_mm:.3f} mm at most"
    return facts


def _make(job: ExportJob, piece: Part) -> dict[str, str]:
    facts = {
        "material": job.material or "–",
        "tolerance": f"± {job.shop.tolerance_mm:g} mm",
        **make_facts(piece.insole.design),
        "draft of the walls": f"{piece.order.options.draft_deg:g}°",
    }
    if job.block is not None:
        size = " × ".join(f"{length:g}" for length in job.block.size_mm)
        facts["block"] = f"{job.block.name}, {size} mm"
    return facts


def _released(job: ExportJob, piece: Part) -> tuple[str, ...]:
    by = job.override
    if by is None or not any(finding.blocks for finding in piece.findings):
        return ()
    return (f"Released against a blocking rule by {by.author}, {by.at}: {by.reason}",)


def _write_prescription(job: ExportJob, path: Path) -> None:
    from insole_core.export.paper import write_prescription

    lines, make = [], {}
    for piece in job.pieces:
        lines += [
            f"{str(piece.side).capitalize()}. {line}"
            for line in correction_lines(piece.insole.design)
        ]
        for key, value in make_facts(piece.insole.design).items():
            make[f"{piece.side}, {key}"] = value
    sides = " and ".join(str(piece.side) for piece in job.pieces)
    today = datetime.now(UTC).date().isoformat()
    identification = {**job.patient, **job.identification, "side": sides, "date": today}
    write_prescription(identification, lines, {"material": job.material or "–", **make}, path)
