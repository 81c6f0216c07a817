"""``insole-studio doctor``: say what may keep the program from working on this computer."""

from __future__ import annotations

import argparse
import os
from typing import TYPE_CHECKING

from insole_core.progress import Progress
from insole_studio.cli.path_arguments import OutputPath

if TYPE_CHECKING:
    from insole_studio.app.graphics import Graphics

NAME = "doctor"
HELP = (
    "examine graphics, sensors, disk, settings, record and backups, and advise on what is wrong; "
    "ends with 1 if record or backups need attention"
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "--report", action=OutputPath, metavar="FILE",
        help="write the lines to a file as well; no patient's data are in it",
    )  # fmt: skip


def run(arguments: argparse.Namespace, _progress: Progress) -> None:
    """Print a line for each thing that was examined, and one of advice for each that is wrong.

    Raises
    ------
    RecordsError
        When the record or its backups need attention, so that monitoring sees it.
    """
    from insole_core.errors import RecordsError
    from insole_core.files.atomic import write_text
    from insole_studio.app.doctor import RECORD, Doctor, report_lines
    from insole_studio.user_paths import UserPaths

    found = Doctor(UserPaths.of_user(), _graphics()).examine()
    lines = report_lines(found)
    print("\n".join(lines))
    if arguments.report is not None:
        write_text("\n".join(lines) + "\n", arguments.report)
    if any(diagnosis.advice for diagnosis in found if diagnosis.topic == RECORD):
        raise RecordsError(
            "The record or its backups need attention: see the lines of the record above."
        )


def _graphics() -> Graphics | None:
    from insole_studio.app.screen import has_screen

    if not has_screen():
        os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from insole_studio.app.bootstrap import qt_application
    from insole_studio.app.graphics import examine_graphics

    return examine_graphics(qt_application().platformName())
