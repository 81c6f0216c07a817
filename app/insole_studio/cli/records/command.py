"""``insole-studio records``: the clinic's record, without a window."""

from __future__ import annotations

import argparse

from insole_core.progress import Progress
from insole_studio.cli.records import export, import_, list_, migrate, show
from insole_studio.cli.subcommands import Command, add_steps

NAME = "records"
HELP = "list, show, import and export the patients of the clinic's record"
STEPS: tuple[Command, ...] = (list_, show, import_, export, migrate)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the steps."""
    add_steps(parser, STEPS, "STEP")


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Run the chosen step."""
    arguments.step.run(arguments, progress)
