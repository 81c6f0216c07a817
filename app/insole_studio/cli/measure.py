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


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the foot, measure it and write the report."""
    if arguments.report.suffix.lower() != ".json":
        raise UsageError(f"--report is {arguments.report}, but the report is written as .json.")
    if arguments.csv is not None and arguments.csv.suffix.lower() != ".csv":
        raise UsageError(f"--csv is {arguments.csv}, but the table is written as .csv.")
    from insole_core.files.atomic import write_text
    from insole_core.files.transaction import Transaction

    with Transaction() as outputs:
        report_file = outputs.file(arguments.report)
        csv_file = arguments.csv and outputs.file(arguments.csv)
        feet = _read_feet(arguments, progress.part(0.0, 0.8))
        progress.step(0.8, "Measuring")
        rows = _table(feet)
        text = json.dumps(_content(feet, rows), indent=1, ensure_ascii=False)
        write_text(text + "\n", report_file)
        if csv_file:
            write_text(_csv(rows), csv_file)
    progress.step(1.0, f"Done: {arguments.report}")


def _read_feet(arguments: argparse.Namespace, progress: Progress) -> list[Foot]:
    """Read the foot and, if requested, the other one."""
    side = None if arguments.side is None else Side(arguments.side)
    if arguments.other is None:
        return [foot_argument.read_foot(arguments.foot, side, arguments, progress)]
    foot = foot_argument.read_foot(arguments.foot, side, arguments, progress.part(0.0, 0.5))
    progress = progress.part(0.5, 1.0)
    return [foot, foot_argument.read_foot(arguments.other, foot.side.other, arguments, progress)]


def _table(feet: Sequence[Foot]) -> list[MeasureRow]:
    from insole_core.foot.landmarks import find_landmarks
    from insole_core.foot.measure_table import measure_table
    from insole_core.foot.measures import measure

    return measure_table({foot.side: measure(foot, find_landmarks(foot)) for foot in feet})


def _csv(rows: Sequence[MeasureRow]) -> str:
    from insole_core.foot.measure_table import table_csv

    return table_csv(rows)


def _content(feet: Sequence[Foot], rows: Sequence[MeasureRow]) -> dict[str, Any]:
    from insole_core.foot.measure_table import unlike_sizes

    content = report(feet[0])
    if len(feet) == 2:
        content["other"] = report(feet[1])
        content["asymmetry"] = {
            row.key: {"difference": round(row.difference, 3), "percent": _rounded(row.percent)}
            for row in rows
            if row.difference is not None
        }
        left, right = sorted(feet, key=lambda foot: foot.side)
        if warning := unlike_sizes(left, right):
            content["notes"].append(warning)
            print(f"Warning: {warning}", file=sys.stderr)
    return content


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(value, 2)


def report(foot: Foot) -> dict[str, Any]:
    """Return measurements in mm and degrees, and landmarks in the frame of the input scan."""
    from insole_core.foot.landmarks import find_landmarks
    from insole_core.foot.measures import DEFINITIONS, MISSING, deviations_mm, doubts, measure
    from insole_core.geometry.transforms import inverse, transform

    landmarks = find_landmarks(foot)
    measures = measure(foot, landmarks)
    insole2source = inverse(foot.source2insole)
    return {
        "side": str(foot.side),
        "unit": "mm",
        "measures": {n: round(v, 3) for n, v in measures.items() if v is not None},
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
