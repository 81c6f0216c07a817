"""``insole-studio evaluate reference-foot``: what to print for a proof of the whole chain."""

from __future__ import annotations

import argparse

from insole_core.progress import Progress
from insole_studio.cli.path_arguments import OutputPath

NAME = "reference-foot"
HELP = "write the reference foot to print, its scale bar, reference system and certificate"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("out", action=OutputPath, metavar="FOLDER", help="folder to write")


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Write the files."""
    from insole_core.workflows.calibration.reference_foot_files import write_reference_foot

    progress.step(0.1, "Making the reference foot")
    write_reference_foot(arguments.out)
    progress.step(1.0, f"Done: {arguments.out}")
