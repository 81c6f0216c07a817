"""``insole-studio measure``: the measures and landmarks of a foot, without a window."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from insole_core.errors import UsageError
from insole_core.geometry.side import Side
from insole_core.progress import Progress
from insole_studio.commands.foot_source import read_foot

if TYPE_CHECKING:
    from insole_core.foot.foot import Foot

NAME = "measure"
HELP = "measure a session or a scanned foot, and find its landmarks"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "foot", type=Path, metavar="FOOT", help="a session, or a mesh (.ply .stl .obj)"
    )
    parser.add_argument("--report", type=Path, required=True, metavar="measures.json")
    parser.add_argument("--side", choices=[side.value for side in Side], help="needed for a mesh")
    parser.add_argument(
        "--force", action="store_true", help="go on although the shape looks like the other foot"
    )


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the foot, measure it, write the report."""
    if arguments.report.suffix.lower() != ".json":
        raise UsageError(f"--report is {arguments.report}, but the report is written as .json.")
    from insole_core.export.atomic import replacing_file

    side = None if arguments.side is None else Side(arguments.side)
    with replacing_file(arguments.report) as beside:
        foot = read_foot(arguments.foot, side, arguments.force, progress.part(0.0, 0.8))
        for note in foot.notes:
            print(note, file=sys.stderr)
        progress.step(0.8, "Measuring")
        text = json.dumps(report(foot), indent=1, ensure_ascii=False)
        beside.write_text(text + "\n", encoding="utf-8")
    progress.step(1.0, f"Done: {arguments.report}")


def report(foot: Foot) -> dict[str, Any]:
    """Measures in mm and degrees; landmarks in the frame that the scan came in."""
    from insole_core.foot.landmarks import find_landmarks
    from insole_core.foot.measures import DEFINITIONS, MISSING, measure
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
        "not_measured": {n: MISSING[n] for n, v in measures.items() if v is None},
        "definitions": {n: d.text for n, d in DEFINITIONS.items() if measures[n] is not None},
        "notes": list(foot.notes),
    }
