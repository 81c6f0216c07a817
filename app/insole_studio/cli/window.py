"""``insole-studio open``: open the window."""

from __future__ import annotations

import argparse
import gc
import sys
from pathlib import Path

from insole_core.progress import Progress
from insole_studio.cli.sensor_arguments import add_emulate_argument

NAME = "open"
HELP = "open the window, on a case, a session or a scan where one is named (the default)"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("path", nargs="?", type=Path, help="a case, a session, or a mesh")
    add_emulate_argument(parser)


def run(arguments: argparse.Namespace, _progress: Progress) -> None:
    """Open the window and return when it is closed."""
    from insole_studio.app.screen import check_screen

    check_screen()
    gc.disable()  # modules leave no garbage while they load; then the window collects by itself
    from insole_studio.app.bootstrap import run_application

    paths = [arguments.path] if arguments.path else []
    sys.exit(run_application(paths, emulate=arguments.emulate))
