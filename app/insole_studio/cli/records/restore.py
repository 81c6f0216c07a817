"""``insole-studio records restore``: restore the record from a folder of backups."""

from __future__ import annotations

import argparse
from pathlib import Path

from insole_core.progress import Progress
from insole_studio.cli.argument_parser import whole
from insole_studio.cli.records.place import add_place, check_may_set_aside, place_of
from insole_studio.cli.records.secrets import add_secret_arguments, secret_of
from insole_studio.user_paths import UserPaths

NAME = "restore"
HELP = "restore the record with all of its files, into an empty place"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="folder of backups")
    parser.add_argument(
        "--snapshot", type=whole, metavar="NUMBER", help="which one; by default the newest"
    )
    parser.add_argument(
        "--set-aside", action="store_true",
        help="rename the record that is there, which is kept, and restore in its place",
    )  # fmt: skip
    add_secret_arguments(parser)
    add_place(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Restore the record."""
    from insole_core.records.author import Author
    from insole_core.records.backup.restore import restore

    if arguments.set_aside:
        check_may_set_aside(arguments)
    report = restore(
        arguments.folder,
        secret_of(arguments),
        place_of(arguments),
        Author.of_user(),
        number=arguments.snapshot,
        replace_existing=arguments.set_aside,
        settings=UserPaths.of_user().backed_up_folders,
        progress=progress,
    )
    print(
        f"snapshot {report.snapshot.number} of {report.snapshot.made_at:%Y-%m-%d %H:%M} UTC: "
        f"{report.rows} rows, {report.contents} files ({report.contents_bytes / 1e6:.1f} MB), "
        f"{report.files} settings; {report.kept_files} settings were there and stay"
    )
    if report.set_aside is not None:
        print(f"the record before is kept as {report.set_aside}")
    if report.erased_again:
        print(f"erased since the backup, and again now: {report.erased_again} persons")
    for sha256 in report.left_out:
        print(f"was lost before the backup was made: {sha256}")
    if report.audit.problem is not None:
        print(report.audit.problem)
