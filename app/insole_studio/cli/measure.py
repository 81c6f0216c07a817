"""``insole-studio measure``: measurements and landmarks of a foot, without a window."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from insole_core.errors import UsageError
from insole_core.geometry.side import Side
from insole_core.progress import Progress
from insole_studio.cli import foot_argument
from insole_studio.cli.path_arguments import OutputPath

if TYPE_CHECKING:
    from insole_core.foot.foot import Foot
    from insole_core.foot.measure_table import MeasureRow
    from insole_core.foot.spread import MeasuredFoot
    from insole_core.workflows.scanned_feet import ScannedFoot

NAME = "measure"
HELP = "measure a session or a scanned foot, and find its landmarks"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "foot", type=Path, metavar="FOOT", help=f"a session, or {foot_argument.A_MESH}"
    )
    parser.add_argument("--report", action=OutputPath, required=True, metavar="measures.json")
    foot_argument.add_arguments(parser)
    parser.add_argument(
        "--other", type=Path, metavar="FOOT2", help="the other foot, for left and right compared"
    )
    parser.add_argument(
        "--csv", action=OutputPath, metavar="measures.csv", help="the table, for reading"
    )
    parser.add_argument(
        "--sheet", action=OutputPath, metavar="foot.pdf",
        help="the foot sheet, to print: measures with their ±, and a drawing of the angles",
    )  # fmt: skip


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the foot, measure it and write the report."""
    if arguments.report.suffix.lower() != ".json":
        raise UsageError(f"--report is {arguments.report}, but the report is written as .json.")
    if arguments.csv is not None and arguments.csv.suffix.lower() != ".csv":
        raise UsageError(f"--csv is {arguments.csv}, but the table is written as .csv.")
    if arguments.sheet is not None and arguments.sheet.suffix.lower() != ".pdf":
        raise UsageError(f"--sheet is {arguments.sheet}, but the sheet is written as .pdf.")
    from insole_core.files.atomic import write_text
    from insole_core.files.transaction import Transaction
    from insole_core.workflows.measured_feet import measured_scan

    with Transaction() as outputs:
        report_file = outputs.file(arguments.report)
        csv_file = arguments.csv and outputs.file(arguments.csv)
        sheet_file = arguments.sheet and outputs.file(arguments.sheet)
        feet = _read_feet(arguments, progress.part(0.0, 0.8))
        progress.step(0.8, "Measuring")
        measured = [measured_scan(one) for one in feet]
        rows = _table(feet, measured)
        text = json.dumps(_content(feet, measured, rows), indent=1, ensure_ascii=False)
        write_text(text + "\n", report_file)
        if csv_file:
            write_text(_csv(rows), csv_file)
        if sheet_file:
            _write_sheet(feet, measured, sheet_file)
    progress.step(1.0, f"Done: {arguments.report}")


def _read_feet(arguments: argparse.Namespace, progress: Progress) -> list[ScannedFoot]:
    """Read the foot and, if requested, the other one."""
    side = None if arguments.side is None else Side(arguments.side)
    if arguments.other is None:
        return [foot_argument.read_scan(arguments.foot, side, arguments, progress)]
    first = foot_argument.read_scan(arguments.foot, side, arguments, progress.part(0.0, 0.5))
    progress, other = progress.part(0.5, 1.0), first.foot.side.other
    try:
        return [first, foot_argument.read_scan(arguments.other, other, arguments, progress)]
    except UsageError as error:
        raise UsageError(f"--other: {error}") from error


def _table(feet: Sequence[ScannedFoot], measured: Sequence[MeasuredFoot]) -> list[MeasureRow]:
    from insole_core.foot.measure_table import measure_table

    return measure_table({s.foot.side: one for s, one in zip(feet, measured, strict=True)})


def _write_sheet(feet: Sequence[ScannedFoot], measured: Sequence[MeasuredFoot], path: Path) -> None:
    from insole_core.workflows.foot_sheet import write_foot_sheet

    told = {one.foot.side: of_it for one, of_it in zip(feet, measured, strict=True)}
    write_foot_sheet(told, {one.foot.side: one.source for one in feet}, path)


def _csv(rows: Sequence[MeasureRow]) -> str:
    from insole_core.foot.measure_table import table_csv

    return table_csv(rows)


def _content(
    feet: Sequence[ScannedFoot], measured: Sequence[MeasuredFoot], rows: Sequence[MeasureRow]
) -> dict[str, Any]:
    from insole_core.foot.measure_table import unlike_sizes

    content = _report(feet[0].foot, measured[0])
    if len(feet) == 2:
        content["other"] = _report(feet[1].foot, measured[1])
        content["asymmetry"] = {
            row.key: {
                "difference": round(row.difference, 3),
                "percent": _rounded(row.percent),
                "limits_95": _rounded(row.difference_limits, 3),
                "within_error": row.is_within_error,
            }
            for row in rows
            if row.difference is not None
        }
        left, right = sorted((one.foot for one in feet), key=lambda foot: foot.side)
        if warning := unlike_sizes(left, right):
            content["notes"].append(warning)
            print(f"Warning: {warning}", file=sys.stderr)
    return content


def _rounded(value: float | None, decimals: int = 2) -> float | None:
    return None if value is None else round(value, decimals)


def _report(foot: Foot, measured: MeasuredFoot) -> dict[str, Any]:
    """Return measurements in mm and degrees, and landmarks in the frame of the input scan."""
    from insole_core.foot.landmarks import find_landmarks
    from insole_core.foot.measures import DEFINITIONS, MISSING, deviations_mm, doubts
    from insole_core.geometry.transforms import inverse, transform

    landmarks, measures = find_landmarks(foot), measured.values
    insole2source = inverse(foot.source2insole)
    return {
        "side": str(foot.side),
        "unit": "mm",
        "measures": {n: round(v, 3) for n, v in measures.items() if v is not None},
        **measured.limits_json(measures),
        "landmarks_mm": {
            name: transform(insole2source, mark.point).round(3).tolist()
            for name, mark in landmarks.items()
        },
        "confidence": {name: round(mark.confidence, 2) for name, mark in landmarks.items()},
        "uncertain": {n: t for n, t in doubts(landmarks).items() if measures[n] is not None},
        "deviation_mm": {name: round(v, 2) for name, v in deviations_mm(landmarks).items()},
        "not_measured": {n: MISSING[n] for n, v in measures.items() if v is None},
        "definitions": {n: d.text for n, d in DEFINITIONS.items() if measures[n] is not None},
        "notes": list(foot.notes),
    }
