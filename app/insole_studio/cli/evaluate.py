"""``insole-studio evaluate``: measure a sensor's accuracy and check it against limits."""

from __future__ import annotations

import argparse

from insole_core.progress import Progress
from insole_studio.cli.evaluation import (
    alignment,
    artefact,
    chain,
    known_object,
    noise,
    resolution,
    wall,
)
from insole_studio.cli.subcommands import Command, add_steps

NAME = "evaluate"
HELP = "evaluate a sensor from folders of images; a limit that is not kept is exit code 1"
KINDS: tuple[Command, ...] = (wall, resolution, alignment, known_object, artefact, noise, chain)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the kinds of evaluation."""
    add_steps(parser, KINDS, "KIND")


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Run the chosen evaluation."""
    arguments.step.run(arguments, progress)
