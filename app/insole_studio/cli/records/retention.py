"""``insole-studio records retention``: how long the record is kept, and whose time is over."""

from __future__ import annotations

import argparse
from datetime import date

from insole_core.progress import Progress
from insole_studio.cli.argument_parser import whole
from insole_studio.cli.records.place import add_place, opened

NAME = "retention"
HELP = "list by pseudonym those whose record need not be kept any longer, or say for how long it is"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "--years", type=whole, metavar="N", help="keep the record for so many years, at least ten"
    )
    parser.add_argument(
        "--limit", type=whole, default=100, metavar="N", help="most persons (default: 100)"
    )
    add_place(parser)


def run(arguments: argparse.Namespace, _progress: Progress) -> None:
    """Set the years if they are given, and print a line for each person."""
    from insole_core.errors import UsageError
    from insole_core.records.retention import (
        LEAST_YEARS,
        YEARS_VALUE,
        over_retention_named,
    )
    from insole_core.records.rights import Right

    with opened(arguments, Right.ERASE) as records:
        if arguments.years is not None:
            if arguments.years < LEAST_YEARS:
                raise UsageError(
                    f"--years is {arguments.years}, and the law keeps the documentation of a "
                    f"device for at least {LEAST_YEARS} years; give as many, or more."
                )
            records.clinic.set(YEARS_VALUE, arguments.years)
        years = records.clinic.get(YEARS_VALUE, LEAST_YEARS)
        print(f"kept for {years} years after the last entry")
        for found in over_retention_named(records.context, date.today(), arguments.limit):
            print(
                f"{found.pseudonym}\tkept until {found.kept_until}\t{found.visits} visits\t"
                f"{found.orders} orders"
            )
