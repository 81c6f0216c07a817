"""``insole-studio inspect``: what a scan shows, without making anything of it."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from insole_core.errors import UsageError
from insole_core.progress import Progress
from insole_studio.cli import foot_argument
from insole_studio.cli.path_arguments import OutputPath

if TYPE_CHECKING:
    from insole_core.foot.foot_candidate import FootCandidate, FoundFoot
    from insole_core.workflows.import_scan import ScanExamination

NAME = "inspect"
HELP = "say what a scan shows: unit, form, which foot, how it lies, and what is in doubt"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("scan", type=Path, metavar="SCAN", help="a scan that is no session")
    foot_argument.add_scan_arguments(parser)
    parser.add_argument("--report", action=OutputPath, metavar="scan.json")


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Examine the scan, print what it shows, and write the report."""
    if arguments.report is not None and arguments.report.suffix.lower() != ".json":
        raise UsageError(f"--report is {arguments.report}, but the report is written as .json.")
    from insole_core.files.atomic import write_text
    from insole_core.files.transaction import Transaction
    from insole_core.workflows.import_scan import examine_scan

    choice = foot_argument.said_of_scan(arguments)
    examination = examine_scan(arguments.scan, choice, progress)
    content = report(examination)
    for line in _lines(content):
        print(line)
    if arguments.report is not None:
        with Transaction() as outputs:
            text = json.dumps(content, indent=1, ensure_ascii=False)
            write_text(text + "\n", outputs.file(arguments.report))
    progress.step(1.0, "Done")


def report(examination: ScanExamination) -> dict[str, Any]:
    """Return what a scan shows; lengths in mm."""
    return {
        "unit": examination.read.unit,
        "unit_is_sure": not any(foot.unit_readings for foot in examination.feet),
        "form": examination.form.value,
        "feet": [_foot(foot) for foot in examination.feet],
        "notes": list(map(str, examination.notes)),
        "left_out": list(map(str, examination.left_out)),
    }


def _foot(foot: FoundFoot) -> dict[str, Any]:
    return {
        "side": None if foot.told_side is None else foot.told_side.value,
        "doubts": list(map(str, foot.doubts)),
        "candidates": [_candidate(candidate) for candidate in foot.candidates],
        "warnings": list(map(str, foot.warnings)),
        "notes": list(map(str, foot.notes)),
    }


def _candidate(candidate: FootCandidate) -> dict[str, Any]:
    leg = candidate.leg
    return {
        "side": candidate.side.value,
        "length_mm": round(candidate.length_mm, 2) if candidate.is_length_known else None,
        "scanned_mm": round(candidate.surface_mm, 2),
        "dissimilarity": round(candidate.dissimilarity, 4),
        "covered": candidate.covered,
        "leg": None
        if leg is None
        else {"height_mm": round(leg.height_mm, 1), "ankle_deg": round(leg.ankle_deg, 1)},
        "source2insole": candidate.source2insole.round(6).tolist(),
    }


def _length(candidate: dict[str, Any]) -> str:
    if candidate["length_mm"] is None:
        return f"{candidate['scanned_mm']:.1f} mm of it scanned, without toes"
    return f"{candidate['length_mm']:.1f} mm long"


def _lines(content: dict[str, Any]) -> list[str]:
    unit = content["unit"] if content["unit_is_sure"] else f"{content['unit']}, a guess"
    lines = [f"Unit: {unit}; form: {content['form']}"]
    for foot in content["feet"]:
        side = foot["side"] or "left or right, which the shape does not tell"
        lines.append(f"Foot: {side}")
        lines += [
            f"  as a {one['side']} foot: {_length(one)}, dissimilarity {one['dissimilarity']:.3f}"
            for one in foot["candidates"]
        ]
        lines += [f"  In doubt: {doubt}" for doubt in foot["doubts"]]
        lines += [f"  {said}" for said in (*foot["warnings"], *foot["notes"])]
    return [*lines, *content["notes"], *content["left_out"]]
