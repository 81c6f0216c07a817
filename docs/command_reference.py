"""The directive ``commands`` of the manual: what each command says with ``--help``."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import TYPE_CHECKING

from docutils import nodes
from docutils.parsers.rst import Directive

from insole_studio.cli.main import command_parser

if TYPE_CHECKING:
    from sphinx.application import Sphinx

WIDTH = 88
"""Columns of the help, whatever the terminal has in which the site is built."""


class CommandReference(Directive):
    """A section for every command, with its help as the program prints it."""

    def run(self) -> list[nodes.Node]:
        """Return the sections."""
        return [_section(parser) for parser in each_command(command_parser())]


def each_command(parser: argparse.ArgumentParser) -> Iterator[argparse.ArgumentParser]:
    """Yield the parser of every command, and below a divided one that of every step."""
    for action in parser._actions:  # argparse tells of its parsers in no other way
        if isinstance(action, argparse._SubParsersAction):
            for sub in dict.fromkeys(action.choices.values()):
                yield sub
                yield from each_command(sub)


def help_of(parser: argparse.ArgumentParser) -> str:
    """Return what a command prints with ``--help``, at a fixed width and without colours."""
    parser.formatter_class = lambda prog: argparse.HelpFormatter(prog, width=WIDTH)
    return parser.format_help().rstrip()


def _section(parser: argparse.ArgumentParser) -> nodes.section:
    name = parser.prog.removeprefix("insole-studio ")
    text = help_of(parser)
    return nodes.section(
        "",
        nodes.title(text=name),
        nodes.literal_block(text, text, language="text"),
        ids=[nodes.make_id(f"command-{name}")],
        names=[nodes.fully_normalize_name(f"command {name}")],
    )


def setup(app: Sphinx) -> dict[str, bool]:
    """Make the directive known."""
    app.add_directive("commands", CommandReference)
    return {"parallel_read_safe": True}
