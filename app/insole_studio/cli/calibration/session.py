"""``insole-studio calibrate session``: give a recorded session the calibrations of its sensors."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from insole_core.progress import Progress
from insole_studio.cli.path_arguments import OutputPath
from insole_studio.cli.sensor_arguments import add_store_argument, store_of

NAME = "session"
HELP = "write a copy of a session whose sensors are calibrated as they are kept here"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("session", type=Path, metavar="SESSION", help="folder or .zip")
    parser.add_argument("--out", action=OutputPath, required=True, metavar="SESSION")
    parser.add_argument(
        "--correction", type=Path, metavar="correction.npz",
        help="use this distortion correction for all views instead",
    )  # fmt: skip
    parser.add_argument(
        "--insist", action="store_true", help="use a correction of another sensor all the same"
    )
    add_store_argument(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the session, calibrate it and write it."""
    from insole_core.recording.reader import read_session
    from insole_core.recording.session_layout import check_session_target
    from insole_core.recording.writer import write_session
    from insole_core.sensing.correction import load_correction
    from insole_core.workflows.calibration.calibrated_session import calibrated_session

    check_session_target(arguments.out)
    progress.step(0.0, "Reading the session")
    session = read_session(arguments.session)
    correction = arguments.correction and load_correction(arguments.correction)
    calibrated, warnings = calibrated_session(
        session, store_of(arguments), correction, arguments.insist
    )
    for warning in warnings:
        print(f"Warning: {warning}", file=sys.stderr)
    write_session(calibrated, arguments.out, progress=progress.part(0.1, 1.0))
    progress.step(1.0, f"Done: {arguments.out}")
