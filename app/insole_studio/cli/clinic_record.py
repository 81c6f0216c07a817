"""``insole-studio records``: back up, restore and verify the clinic's record."""

from __future__ import annotations

import argparse

from insole_core.progress import Progress
from insole_studio.cli.records import backup, restore, verify
from insole_studio.cli.subcommands import Command, add_steps

NAME = "records"
HELP = "back up, restore or verify the clinic's record"
STEPS: tuple[Command, ...] = (backup, restore, verify)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the steps."""
    add_steps(parser, STEPS, "STEP")


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Run the chosen step."""
    arguments.step.run(arguments, progress)
