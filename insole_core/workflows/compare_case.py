"""Compare surfaces of the open case or from files, and write the comparison."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path

from insole_core.cases.case_record import CaseRecord
from insole_core.compare.comparison import (
    Alignment,
    ComparisonSource,
    compare_surfaces,
    read_source,
)
from insole_core.compare.comparison_report import (
    colored_surface,
    difference_surface,
    draw_picture,
    report_json,
    span_mm,
    write_report,
)
from insole_core.compare.difference import Difference
from insole_core.errors import InputError, UsageError
from insole_core.files.atomic import replacing_file
from insole_core.formats.ply import write_ply
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.messages import Message, Translate, joined
from insole_core.progress import SILENT, Progress
from insole_core.workflows.calibration.correction_choice import is_corrected
from insole_core.workflows.calibration.repeat_tests import repeated_limits_of
from insole_core.workflows.insole_builder import InsoleBuilder
from insole_core.workflows.measured_feet import measured_record

_NAMES = {
    (Side.LEFT, "foot"): Message("left foot"),
    (Side.RIGHT, "foot"): Message("right foot"),
    (Side.LEFT, "insole"): Message("left insole"),
    (Side.RIGHT, "insole"): Message("right insole"),
}
REPORT_SUFFIXES = (".pdf", ".json", ".png", ".ply")


@dataclass(frozen=True)
class Wanted:
    """A surface to compare: one of the case by side and kind, or a file."""

    kind: str
    """"foot", "insole", or "file"."""
    side: Side | None = None
    path: Path | None = None


@dataclass(frozen=True, eq=False)
class Compared:
    """A comparison and its presentation.

    Parameters
    ----------
    surface
        The first surface.
    signed_mm : (n,) float64
        Signed difference at its vertices; NaN where the second surface is missing.
    span_mm
        Limit of the colour scale.
    """

    difference: Difference
    surface: TriangleMesh
    signed_mm: FloatArray
    span_mm: float


def surface_of(record: CaseRecord, wanted: Wanted, progress: Progress = SILENT) -> ComparisonSource:
    """Return a surface to compare.

    Parameters
    ----------
    record
        The open case.

    Returns
    -------
    ComparisonSource
        mm; a foot or insole of the case in the insole frame, a file in its own.

    Raises
    ------
    InputError
        When the case has no such foot, or the file cannot be read.
    DesignError
        When the insole cannot be built.
    Cancelled
    """
    if wanted.path is not None:
        return read_source(wanted.path, progress, is_corrected, repeated_limits_of)
    foot = None if wanted.side is None else record.of_side(wanted.side)
    if foot is None:
        raise InputError("The case has no such foot; open or capture one first.")
    name = _NAMES[foot.side, wanted.kind]
    if wanted.kind == "foot":
        measures = measured_record(foot)
        return ComparisonSource(name, foot.foot.mesh, measures=measures, side=foot.side)
    _, solid = InsoleBuilder().solid(foot.foot, foot.design, progress)
    return ComparisonSource(name, solid, side=foot.side)


def compare_sources(
    a: ComparisonSource,
    b: ComparisonSource,
    alignment: Alignment,
    median_pixels: int,
    progress: Progress = SILENT,
) -> Compared:
    """Align surface b with surface a and measure their difference.

    Parameters
    ----------
    b
        Mirrored, if it is of the other foot: see `ComparisonSource.like`.
    alignment
        How b is brought into the frame of a.
    median_pixels
        Kernel size of the spatial median filter, px; 1 for none.

    Raises
    ------
    InputError
        When the two cannot be aligned.
    Cancelled
    """
    difference = compare_surfaces(
        a.mesh, b.mesh, alignment, median_pixels=median_pixels, progress=progress.part(0.0, 0.9)
    )
    difference = replace(difference, feet=(a.measures, b.measures), b_is_mirrored=b.is_mirrored)
    surface, signed = difference_surface(difference)
    return Compared(difference, surface, signed, span_mm(difference))


def write_comparison(
    compared: Compared, names: tuple[str, str], path: Path, translate: Translate = str
) -> None:
    """Write a comparison in the form that the suffix selects: report, figures, picture, or mesh.

    Parameters
    ----------
    names
        Of the two surfaces.
    path
        With one of `REPORT_SUFFIXES`.
    translate
        Into the language of paper and picture.

    Raises
    ------
    UsageError
        When the suffix is not known.
    OutputError
        When the place cannot be written.
    """
    suffix = path.suffix.lower()
    if suffix not in REPORT_SUFFIXES:
        raise UsageError(
            "{path} names no form of a report; let it end in {suffixes}.",
            path=path,
            suffixes=joined(REPORT_SUFFIXES),
        )
    if suffix == ".ply":
        write_ply(colored_surface(compared.difference), path)
        return
    with replacing_file(path) as beside:
        if suffix == ".pdf":
            write_report(compared.difference, names, beside, translate)
        elif suffix == ".png":
            draw_picture(compared.difference, beside, names, translate)
        else:
            text = json.dumps(report_json(compared.difference), indent=1, allow_nan=False)
            beside.write_text(text + "\n", encoding="utf-8", newline="\n")
