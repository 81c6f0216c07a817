"""``insole-studio reconstruct``: a recorded session becomes a coloured foot."""

from __future__ import annotations

import argparse
import json
import sys
import time
from contextlib import ExitStack
from pathlib import Path

from insole_core.errors import UsageError
from insole_core.progress import Progress

NAME = "reconstruct"
HELP = "rebuild the coloured foot from a recorded session"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("session", type=Path, metavar="SESSION", help="folder or .zip")
    parser.add_argument("--out", type=Path, required=True, metavar="foot.ply")
    parser.add_argument(
        "--method", choices=["fused", "thesis"], default="fused",
        help="the best there is (default), or the chain of the 2013 thesis",
    )  # fmt: skip
    parser.add_argument("--report", type=Path, metavar="report.json")


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read, reconstruct, write."""
    if arguments.out.suffix.lower() != ".ply":
        raise UsageError(f"--out is {arguments.out}, but the foot is written as .ply.")
    start = time.perf_counter()
    # Imported here, so that a wrong call answers at once.
    from insole_core.export.atomic import replacing_file
    from insole_core.export.ply import write_ply
    from insole_core.reconstruct import reconstruct, report_json
    from insole_core.recording.reader import read_session

    with ExitStack() as outputs:
        foot_file = outputs.enter_context(replacing_file(arguments.out))
        report = arguments.report and outputs.enter_context(replacing_file(arguments.report))
        progress.step(0.0, "Reading the session")
        session = read_session(arguments.session)
        result = reconstruct(session, arguments.method, progress.part(0.1, 0.9))
        progress.step(0.9, "Writing the foot")
        write_ply(result.mesh, foot_file)
        for warning in result.warnings:
            print(f"Warning: {warning}", file=sys.stderr)
        if report:
            values = report_json(result, time.perf_counter() - start)
            report.write_text(json.dumps(values, indent=1) + "\n", encoding="utf-8")
    progress.step(1.0, f"Done: {arguments.out}")
