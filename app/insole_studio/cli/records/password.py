"""``insole-studio records password``: choose another password of one's own."""

from __future__ import annotations

import argparse

from insole_core.errors import UsageError
from insole_core.progress import Progress
from insole_studio.cli.records.place import add_place, opened_by_nobody
from insole_studio.cli.records.secrets import new_password, password_of

NAME = "password"
HELP = "choose another password for the account that --account names"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_place(parser)


def run(arguments: argparse.Namespace, _progress: Progress) -> None:
    """Ask for the present password and for the new one, twice."""
    if arguments.account is None:
        raise UsageError("Whose password is to be changed? Name the account with --account NAME.")
    with opened_by_nobody(arguments) as records:
        present = password_of(arguments)
        records.accounts.change_password(arguments.account, present, new_password())
