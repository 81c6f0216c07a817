"""``insole-studio reconstruct``: turn a recorded session into a coloured foot."""

from __future__ import annotations

import argparse
import json
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

from insole_core.errors import UsageError
from insole_core.progress import Progress
from insole_studio.cli.path_arguments import OutputPath

NAME = "reconstruct"
HELP = "rebuild the coloured foot from a recorded session"
LIMITS = (
    ("residual-mm", "MM", "mean distance of the markers from the reference system"),
    ("reprojection-px", "PX", "root mean square of the distances in the colour image"),
    ("displacement-mm", "MM", "standard deviation of where the pose puts the foot"),
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("session", type=Path, metavar="SESSION", help="folder or .zip")
    parser.add_argument("--out", action=OutputPath, required=True, metavar="foot.ply")
    parser.add_argument(
        "--method", choices=["fused", "thesis"], default="fused",
        help="the best there is (default), or the chain of the 2013 thesis",
    )  # fmt: skip
    parser.add_argument("--report", action=OutputPath, metavar="report.json")
    limits = parser.add_argument_group("when the pose of a view is refused")
    for name, unit, what in LIMITS:
        limits.add_argument(f"--largest-{name}", type=float, metavar=unit, help=what)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the session, reconstruct the foot and write it."""
    if arguments.out.suffix.lower() != ".ply":
        raise UsageError(f"--out is {arguments.out}, but the foot is written as .ply.")
    start = time.perf_counter()
    # Imported here, so that usage errors are reported at once.
    from insole_core.export.atomic import write_text
    from insole_core.export.ply import write_ply
    from insole_core.export.transaction import Transaction
    from insole_core.foot.side_check import side_doubt
    from insole_core.reconstruct import RegistrationLimits, report_json
    from insole_core.workflows.make_foot import open_session, reconstruct_session

    with Transaction() as outputs:
        foot_file = outputs.file(arguments.out)
        report = arguments.report and outputs.file(arguments.report)
        opened = open_session(arguments.session, progress)
        limits = RegistrationLimits(**_given_limits(arguments))
        result = reconstruct_session(
            opened, limits, progress.part(0.1, 0.9), method=arguments.method
        )
        progress.step(0.9, "Writing the foot")
        write_ply(result.mesh, foot_file)
        doubt = side_doubt(result.mesh, opened.session.manifest.side)
        result = replace(result, warnings=(*result.warnings, *filter(None, [doubt])))
        for warning in result.warnings:
            print(f"Warning: {warning}", file=sys.stderr)
        if report:
            values = report_json(result, time.perf_counter() - start)
            write_text(json.dumps(values, indent=1) + "\n", report)
    progress.step(1.0, f"Done: {arguments.out}")


def _given_limits(arguments: argparse.Namespace) -> dict[str, Any]:
    """Return the limits that the arguments set, by their names in the core."""
    given = {}
    for name, _unit, _what in LIMITS:
        value = getattr(arguments, f"largest_{name.replace('-', '_')}")
        if value is not None and not value > 0:
            raise UsageError(f"--largest-{name} is {value:g}, but must be above 0.")
        if value is not None:
            given[name.replace("-", "_")] = value
    return given
