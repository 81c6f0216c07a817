"""The command lines of README, manual and documentation are those of the program.

`python -m benchmarks printed_commands` runs those that make files of files.
"""

from __future__ import annotations

import argparse

import pytest

from benchmarks._printed_commands import Printed, printed_commands
from insole_studio.cli.main import command_parser

PRINTED = printed_commands()


def parser_of(words: list[str]) -> tuple[argparse.ArgumentParser, list[str]]:
    """Return the parser of the command that words begin with, and the words behind it."""
    parser, left = command_parser(words), list(words)
    while left:
        subs = [a for a in parser._actions if isinstance(a, argparse._SubParsersAction)]
        if not subs or left[0] not in subs[0].choices:
            break
        parser = subs[0].choices[left.pop(0)]
    return parser, left


def complete(one: Printed) -> bool:
    """Whether a line can be run as it stands; a command that is only named cannot."""
    return not one.is_synopsis and (one.in_block or bool(parser_of(one.words)[1]))


def is_understood(one: Printed) -> bool:
    try:
        command_parser(one.words).parse_args(one.words)
    except SystemExit as ended:
        return ended.code == 0
    return True


def test_every_command_is_understood(capsys: pytest.CaptureFixture[str]) -> None:
    assert [one for one in PRINTED if complete(one) and not is_understood(one)] == []


def test_the_options_of_a_synopsis_exist() -> None:
    unknown = []
    for one in PRINTED:
        if not one.is_synopsis:
            continue
        parser, _ = parser_of(one.text.split()[1:])
        below = [parser]
        for action in parser._actions:
            if isinstance(action, argparse._SubParsersAction):
                below += action.choices.values()
        known = {name for each in below for name in each._option_string_actions}
        unknown += [(one.page, one.text, option) for option in one.options - known]
    assert unknown == []


def test_they_are_found() -> None:
    pages = {one.page for one in PRINTED}
    assert {"README.md", "docs/manual/calibration.md", "docs/manual/sv/commands.md"} <= pages
    assert sum(one.in_block for one in PRINTED) > 60
