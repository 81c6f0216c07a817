"""The parser of the command line, the kinds of its values, commands and their steps."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import date
from typing import NoReturn, Protocol

from insole_core.cases.written_dates import read_date
from insole_core.errors import InputError, UsageError
from insole_core.progress import Progress
from insole_core.visible_text import visible_line

_MOST = 2**32
_LONGEST, _LONGEST_NUMBER = 300, 20


class Command(Protocol):
    """The interface of a command's module, and of each of its steps."""

    @property
    def NAME(self) -> str:
        """What is typed."""
        ...

    @property
    def HELP(self) -> str:
        """What it does, in one line."""
        ...

    def add_arguments(self, parser: argparse.ArgumentParser, /) -> None:
        """Add the arguments."""
        ...

    def run(self, arguments: argparse.Namespace, progress: Progress, /) -> None:
        """Do the work; raise errors."""
        ...


@dataclass(frozen=True)
class Step:
    """A step that shares its module with others: each is a pair of functions."""

    NAME: str
    HELP: str
    add_arguments: Callable[[argparse.ArgumentParser], None]
    run: Callable[[argparse.Namespace, Progress], None]


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


class Parser(argparse.ArgumentParser):
    """A parser whose errors name a remedy."""

    def error(self, message: str) -> NoReturn:
        """Print the usage, what is wrong, and where help is, and exit with 2."""
        self.print_usage(sys.stderr)
        said = visible_line(message[:_LONGEST]) + "…" * (len(message) > _LONGEST)
        self.exit(2, f"{self.prog}: {said}; {self.prog} --help says what can be given.\n")


class PrintVersion(argparse.Action):
    """Prints the version and ends; looking it up takes longer than parsing, so only then."""

    def __init__(self, option_strings: list[str], dest: str) -> None:
        super().__init__(
            option_strings, argparse.SUPPRESS, nargs=0, help="show the version and exit"
        )

    def __call__(self, parser: argparse.ArgumentParser, *_values: object) -> None:
        """Print the version."""
        from importlib.metadata import version

        print(version("insole-studio"))
        parser.exit()


def number(text: str) -> float:
    """Convert an argument to a finite number."""
    try:
        value = float(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(
            f"{_cut(text)} is no number; write one with a point and no comma, such as 100.3"
        ) from error
    if not (math.isfinite(value) and abs(value) <= _MOST):
        raise argparse.ArgumentTypeError(f"{_cut(text)} is no usual number")
    return value


def whole(text: str) -> int:
    """Convert an argument to a whole number."""
    return _whole(text, "no whole number")


def _whole(text: str, lack: str) -> int:
    try:
        value = int(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"{_cut(text)} is {lack}") from error
    if abs(value) > _MOST:
        raise argparse.ArgumentTypeError(f"{_cut(text)} is no usual number")
    return value


def positive(text: str) -> float:
    """Convert an argument to a number above nothing."""
    value = number(text)
    if value <= 0:
        raise argparse.ArgumentTypeError(f"{_cut(text)} is not above 0")
    return value


def from_one(text: str) -> int:
    """Convert an argument to a whole number from 1 on."""
    value = _whole(text, "no whole number of 1 or more")
    if value < 1:
        raise argparse.ArgumentTypeError(f"{_cut(text)} is less than 1")
    return value


def check_within(option: str, value: float, least: float, most: float, unit: str) -> None:
    """Check a value whose limits are told by what is made of it, before anything is read.

    Raises
    ------
    UsageError
        When it is out of range.
    """
    if not least <= value <= most:
        raise UsageError(f"{option} is {value:g}, and must be {least:g} to {most:g} {unit}.")


def _cut(text: str) -> str:
    return text if len(text) <= _LONGEST_NUMBER else f"{text[:_LONGEST_NUMBER]}…"


def day(text: str) -> date:
    """Convert an argument to a day."""
    try:
        return date.today() if text == "today" else read_date(text, None)
    except InputError as error:
        raise argparse.ArgumentTypeError(
            f"{text} is no day; write it as 2026-11-20, or today"
        ) from error
