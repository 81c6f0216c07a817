"""``insole-studio records undo-upgrade``: put back the record from before an upgrade."""

from __future__ import annotations

import argparse

from insole_core.progress import Progress
from insole_studio.cli.records.place import add_place, opened

NAME = "undo-upgrade"
HELP = "list the copies that were kept before an upgrade of the record, or put one of them back"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "copy", nargs="?", metavar="COPY",
        help="which one to put back; the record of now becomes a copy (default: list them)",
    )  # fmt: skip
    add_place(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """List the copies, or put one back; the next start of this program upgrades it again."""
    from insole_core.records.rights import Right
    from insole_core.records.upgrade_copy import copies_of, put_back

    with opened(arguments, Right.SET_UP) as records:
        if arguments.copy is None:
            for name in copies_of(records.context.database):
                print(name)
            return
        kept = put_back(records.context, arguments.copy)
    progress.step(
        1.0,
        "Done: {copy} is the record again, and the one until now is kept as {kept}; open it with "
        "the program that made it",
        copy=arguments.copy,
        kept=kept,
    )
