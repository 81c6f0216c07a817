"""``insole-studio records``: the clinic's record, without a window."""

from __future__ import annotations

import argparse

from insole_core.progress import Progress
from insole_studio.cli.records import (
    accounts,
    audit,
    backup,
    erase,
    export,
    import_,
    list_,
    migrate,
    password,
    restore,
    retention,
    schedule,
    show,
    statement,
    undo_upgrade,
    verify,
)
from insole_studio.cli.subcommands import Command, add_steps
from insole_studio.user_paths import UserPaths

NAME = "records"
HELP = "the clinic's record: its patients, orders and backups"
STEPS: tuple[Command, ...] = (
    list_,
    show,
    import_,
    export,
    statement,
    backup,
    schedule,
    restore,
    verify,
    migrate,
    undo_upgrade,
    accounts,
    password,
    audit,
    erase,
    retention,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the steps."""
    add_steps(parser, STEPS, "STEP")


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Run the chosen step; trouble with the database is in the log, too."""
    from insole_studio.log_file import log_to

    with log_to(UserPaths.of_user().log_file):
        arguments.step.run(arguments, progress)
