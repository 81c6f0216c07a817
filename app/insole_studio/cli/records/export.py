"""``insole-studio records export``: export a person as a folder."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from insole_core.progress import Progress
from insole_studio.cli.path_arguments import OutputPath
from insole_studio.cli.records.language import add_language, wording_of
from insole_studio.cli.records.person_argument import add_person, person_id_of
from insole_studio.cli.records.place import add_place, opened

if TYPE_CHECKING:
    from insole_core.solids.prescription_paper import Responsible

NAME = "export"
HELP = "export a person as a folder that opens without this program"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_person(parser)
    parser.add_argument(
        "--out", action=OutputPath, required=True, metavar="FOLDER", help="new or empty"
    )
    parser.add_argument(
        "--pseudonymous", action="store_true",
        help="leave out all that names or describes the person, as for a shop",
    )  # fmt: skip
    add_language(parser)
    add_place(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Write the folder; tell on stderr what could not be exported."""
    from insole_core.records.rights import Right
    from insole_core.workflows.records.export_person import export_person

    with opened(arguments, Right.EXPORT) as records:
        export = export_person(
            records,
            person_id_of(records, arguments.person),
            arguments.out,
            is_pseudonymous=arguments.pseudonymous,
            responsible=_responsible(),
            wording=wording_of(arguments),
            progress=progress,
        )
    for sentence in export.left_out:
        print(f"Not exported: {sentence}", file=sys.stderr)
    progress.step(
        1.0, "Done: {count} files in {folder}", count=len(export.files), folder=export.folder
    )


def _responsible() -> Responsible:
    """Return maker and clinic, as the settings of the window name them."""
    from insole_core.solids.prescription_paper import Responsible
    from insole_studio.settings import load_settings
    from insole_studio.user_paths import UserPaths

    settings = load_settings(UserPaths.of_user().settings_file)
    return Responsible(
        clinic=settings.clinic, maker=settings.maker, maker_address=settings.maker_address
    )
