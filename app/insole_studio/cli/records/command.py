"""``insole-studio records``: the clinic's record, without a window."""

from __future__ import annotations

import argparse

from insole_core.progress import Progress
from insole_studio.cli.argument_parser import Command, add_steps
from insole_studio.cli.records import (
    accounts,
    audit,
    backup,
    erase,
    export,
    import_,
    look_up,
    upkeep,
)
from insole_studio.user_paths import UserPaths

NAME = "records"
HELP = "the clinic's record: its patients, orders and backups"
STEPS: tuple[Command, ...] = (
    look_up.LIST,
    look_up.SHOW,
    import_,
    export.EXPORT,
    export.STATEMENT,
    backup.BACKUP,
    backup.SCHEDULE,
    backup.RESTORE,
    upkeep.VERIFY,
    upkeep.MIGRATE,
    upkeep.UNDO_UPGRADE,
    accounts,
    accounts.PASSWORD,
    audit,
    erase.ERASE,
    erase.RETENTION,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the steps."""
    add_steps(parser, STEPS, "STEP")


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Run the chosen step; trouble with the database is in the log, too."""
    from insole_studio.log_file import log_to

    with log_to(UserPaths.of_user().log_file):
        arguments.step.run(arguments, progress)
