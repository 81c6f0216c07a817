"""The parser of the command line: its errors say what to do, its numbers are finite and usual."""

from __future__ import annotations

import argparse
import math
import sys
from typing import NoReturn

from insole_core.visible_text import visible_line

_MOST = 2**32
_LONGEST, _LONGEST_NUMBER = 300, 20


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
    value = float(text)
    if not (math.isfinite(value) and abs(value) <= _MOST):
        raise argparse.ArgumentTypeError(f"{_cut(text)} is no usual number")
    return value


def whole(text: str) -> int:
    """Convert an argument to a whole number."""
    value = int(text)
    if abs(value) > _MOST:
        raise argparse.ArgumentTypeError(f"{_cut(text)} is no usual number")
    return value


def _cut(text: str) -> str:
    return text if len(text) <= _LONGEST_NUMBER else f"{text[:_LONGEST_NUMBER]}…"
