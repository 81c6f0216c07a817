"""``insole-studio records migrate``: bring a record to the tables of this program."""

from __future__ import annotations

import argparse
import sys
from contextlib import closing

from insole_core.progress import Progress
from insole_studio.cli.records.place import add_place, place_of

NAME = "migrate"
HELP = "make a record, or bring an older one to the tables of this program"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_place(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Make or migrate the record; one that is up to date stays as it is."""
    from insole_core.records.author import Author
    from insole_core.records.migrate import SCHEMA
    from insole_core.records.open import open_records

    place = place_of(arguments)
    with closing(open_records(place, Author.of_user())) as records:
        if records.upgrade is not None:
            print(records.upgrade, file=sys.stderr)
    progress.step(1.0, "Done: {place} has schema {schema}", place=place.name, schema=SCHEMA)
