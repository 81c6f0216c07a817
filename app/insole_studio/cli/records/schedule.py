"""``insole-studio records schedule``: where and when this station makes backups."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, get_args

from insole_core.errors import UsageError
from insole_core.messages import joined
from insole_core.progress import Progress
from insole_studio.cli.argument_parser import whole
from insole_studio.cli.records.place import add_place, opened
from insole_studio.user_paths import UserPaths

if TYPE_CHECKING:
    from insole_studio.settings import Settings

NAME = "schedule"
HELP = "say where and when the window of this station makes backups, or change that"
_DAYS = ("monday", "tuesday", "wednesday", "thursday", "friday", "saturday", "sunday")
_KEPT = {day: str(number) for number, day in enumerate(_DAYS)} | {
    "daily": "daily",
    "never": "never",
}
"""What the settings call each."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("--folder", type=Path, metavar="FOLDER", help="of the backups")
    parser.add_argument(
        "--day", choices=tuple(_KEPT), help="of the week, every day, or by hand only"
    )
    parser.add_argument("--hour", type=whole, metavar="H", help="0 to 23")
    parser.add_argument(
        "--keep", metavar="WHICH",
        help="all; or all of 30 days, then one of each month, of all (months) or one year (year)",
    )  # fmt: skip
    add_place(parser)


def run(arguments: argparse.Namespace, _progress: Progress) -> None:
    """Change what is given, and print the plan."""
    from insole_core.records.backup.back_up import last_backup_at
    from insole_core.records.rights import Right
    from insole_studio.settings import LAST_HOUR, BackupKeep, load_settings, save_settings

    if arguments.hour is not None and not 0 <= arguments.hour <= LAST_HOUR:
        raise UsageError(f"--hour is {arguments.hour}, and must be 0 to {LAST_HOUR}.")
    kinds = get_args(BackupKeep)
    if arguments.keep not in (None, *kinds):
        raise UsageError(f"--keep is {arguments.keep}, and must be {joined(kinds, ' or ')}.")
    path = UserPaths.of_user().settings_file
    with opened(arguments, Right.BACK_UP) as records:
        settings = load_settings(path)
        if _change(settings, arguments):
            save_settings(settings, path)
        last = last_backup_at(records.context.database)
    day = next(name for name, kept in _KEPT.items() if kept == settings.backup_day)
    print(f"folder\t{settings.backup_folder or 'none'}")
    print(f"day\t{day}\nhour\t{settings.backup_hour}\nkeep\t{settings.backup_keep}")
    print(f"last backup\t{'never' if last is None else last.isoformat()}")


def _change(settings: Settings, arguments: argparse.Namespace) -> bool:
    """Change the settings; return whether anything was given."""
    given = {
        "backup_folder": None if arguments.folder is None else str(arguments.folder.absolute()),
        "backup_day": None if arguments.day is None else _KEPT[arguments.day],
        "backup_hour": arguments.hour,
        "backup_keep": arguments.keep,
    }
    for name, value in given.items():
        if value is not None:
            setattr(settings, name, value)
    return any(value is not None for value in given.values())
