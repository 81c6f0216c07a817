"""``insole-studio order``: all that a shop needs for an order, in one place."""

from __future__ import annotations

import argparse

from insole_core.progress import Progress
from insole_studio.cli.order import create, verify
from insole_studio.cli.subcommands import Command, add_steps

NAME = "order"
HELP = "write an order to a shop as one folder or zip archive, or verify one that arrived"
STEPS: tuple[Command, ...] = (create, verify)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the steps."""
    add_steps(parser, STEPS, "STEP")


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Run the chosen step."""
    arguments.step.run(arguments, progress)
