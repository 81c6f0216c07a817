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
    """Run the chosen step."""
    arguments.step.run(arguments, progress)
