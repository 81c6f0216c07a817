"""``insole-studio reconstruct``: turn a recorded session into a coloured foot."""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from insole_core.errors import UsageError
from insole_core.geometry.side import Side
from insole_core.progress import Progress
from insole_studio.cli.argument_parser import number
from insole_studio.cli.path_arguments import OutputPath, side_path
from insole_studio.cli.sensor_arguments import add_store_argument

if TYPE_CHECKING:
    from insole_core.workflows.make_feet import ReconstructedFoot

NAME = "reconstruct"
HELP = "rebuild the coloured foot, or both feet, from a recorded session"
LIMITS = (
    ("residual-mm", "MM", "mean distance of the markers from the reference system"),
    ("reprojection-px", "PX", "root mean square of the distances in the colour image"),
    ("displacement-mm", "MM", "standard deviation of where the pose puts the foot"),
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("session", type=Path, metavar="SESSION", help="folder or .zip")
    parser.add_argument(
        "--out", action=OutputPath, required=True, metavar="foot.ply",
        help="of both feet, foot_left.ply and foot_right.ply",
    )  # fmt: skip
    parser.add_argument(
        "--side", choices=[side.value for side in Side], help="only this foot of both"
    )
    parser.add_argument(
        "--method", choices=["fused", "thesis"], default="fused",
        help="the best there is (default), or the chain of the 2013 thesis",
    )  # fmt: skip
    parser.add_argument(
        "--correction", choices=["learnt", "none"],
        help="whether the learnt error of the sensor is subtracted, by --method fused; by default "
        "as evaluate chain has decided for these sensors, else it is",
    )  # fmt: skip
    parser.add_argument(
        "--depth", choices=["auto", "infrared", "chip"], default="auto",
        help="whose depth: of the infrared pictures, by --method fused, where there are (default), "
        "or of the sensor's chip",
    )  # fmt: skip
    add_store_argument(parser)
    parser.add_argument("--report", action=OutputPath, metavar="report.json")
    limits = parser.add_argument_group("when the pose of a view is refused")
    for name, unit, what in LIMITS:
        limits.add_argument(f"--largest-{name}", type=number, metavar=unit, help=what)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the session, reconstruct the foot or both feet and write them."""
    if arguments.out.suffix.lower() != ".ply":
        raise UsageError(f"--out is {arguments.out}, but the foot is written as .ply.")
    if arguments.depth == "infrared" and arguments.method != "fused":
        raise UsageError("--depth infrared is for --method fused; leave one of them out.")
    if arguments.sensors is not None and not arguments.sensors.is_dir():
        raise UsageError(f"--sensors is {arguments.sensors}, and no such folder is there; name it.")
    start = time.perf_counter()
    # Imported here, so that usage errors are reported at once.
    from insole_core.files.atomic import write_text
    from insole_core.files.transaction import Transaction
    from insole_core.formats.ply import write_ply
    from insole_core.reconstruct import RegistrationLimits
    from insole_core.workflows.make_feet import reconstruct_feet
    from insole_core.workflows.make_foot import open_session

    limits = RegistrationLimits(**_given_limits(arguments))
    opened = open_session(arguments.session, progress, sensors=arguments.sensors)
    corrected = None if arguments.correction is None else arguments.correction == "learnt"
    if arguments.side is not None:
        opened = opened.of_foot(Side(arguments.side))
    sides = opened.session.manifest.sides
    with Transaction() as outputs:
        paths = [side_path(arguments.out, side, sides) for side in sides]
        files = [outputs.file(path) for path in paths]
        report = arguments.report and outputs.file(arguments.report)
        feet = reconstruct_feet(
            opened, limits, progress.part(0.1, 0.9),
            method=arguments.method, corrected=corrected, depth=arguments.depth,
        )  # fmt: skip
        progress.step(0.9, "Writing the foot")
        is_by_hand = opened.edits.side is not None
        feet = tuple(_with_side_doubt(foot, is_by_hand) for foot in feet)
        for foot, file in zip(feet, files, strict=True):
            write_ply(foot.result.mesh, file)
        _print_warnings(feet)
        if report:
            values = _report(feet, time.perf_counter() - start)
            if arguments.method == "fused":
                values["correction"] = opened.correction.called(corrected).json()
            write_text(json.dumps(values, indent=1) + "\n", report)
    progress.step(1.0, f"Done: {' '.join(map(str, paths))}")


def _with_side_doubt(foot: ReconstructedFoot, is_by_hand: bool) -> ReconstructedFoot:
    from insole_core.foot.side_check import side_doubt

    doubt = side_doubt(foot.result.mesh, foot.side, is_by_hand=is_by_hand)
    warnings = (*foot.result.warnings, *filter(None, [doubt]))
    return replace(foot, result=replace(foot.result, warnings=warnings))


def _print_warnings(feet: Sequence[ReconstructedFoot]) -> None:
    for foot in feet:
        which = f"{foot.side} foot: " if len(feet) > 1 else ""
        for warning in foot.result.warnings:
            print(f"Warning: {which}{warning}", file=sys.stderr)


def _report(feet: Sequence[ReconstructedFoot], total_seconds: float) -> dict[str, Any]:
    """Return the report of a foot, or those of both by their side."""
    from insole_core.reconstruct import report_json

    if len(feet) == 1:
        return report_json(feet[0].result, total_seconds)
    reports = {foot.side.value: report_json(foot.result, total_seconds) for foot in feet}
    return {"feet": reports, "seconds": {"total": total_seconds}}


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
