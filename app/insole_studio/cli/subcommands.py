"""A command that is divided into steps, each in a module of its own."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import Protocol

from insole_core.progress import Progress


class Command(Protocol):
    """The interface of a command's module, and of each of its steps."""

    NAME: str
    HELP: str

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Add the arguments."""
        ...

    def run(self, arguments: argparse.Namespace, progress: Progress) -> None:
        """Do the work; raise errors."""
        ...


def add_steps(parser: argparse.ArgumentParser, steps: Sequence[Command], metavar: str) -> None:
    """Add the steps of a command; the chosen one becomes ``arguments.step``.

    Parameters
    ----------
    metavar
        Name of the step in the usage text.
    """
    chosen = parser.add_subparsers(required=True, metavar=metavar)
    for step in steps:
        sub = chosen.add_parser(step.NAME, help=step.HELP, description=step.HELP)
        step.add_arguments(sub)
        sub.set_defaults(step=step)
