"""``insole-studio records erase`` and ``retention``: when a person's record ends."""

from __future__ import annotations

import argparse
from datetime import date
from typing import TYPE_CHECKING

from insole_core.errors import UsageError
from insole_core.messages import counted
from insole_core.progress import Progress
from insole_studio.cli.argument_parser import Step, from_one, whole
from insole_studio.cli.records.arguments import add_place, opened

if TYPE_CHECKING:
    from insole_core.records.retention import Erasable


def _add_erase_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "pseudonym", metavar="PSEUDONYM", help="of a written request, or of retention"
    )
    parser.add_argument(
        "--reason", choices=("request", "retention"), default="request",
        help="for the audit log (default: request)",
    )  # fmt: skip
    parser.add_argument(
        "--yes", action="store_true",
        help="erase; without it the command only says what would be erased and what is kept",
    )  # fmt: skip
    add_place(parser)


def _run_erase(arguments: argparse.Namespace, progress: Progress) -> None:
    """Say what erasing means, and erase."""
    from insole_core.records.retention import ErasureReason, find_erasable
    from insole_core.records.rights import Right
    from insole_studio.document.record_maintenance import ErasedLeftovers
    from insole_studio.user_paths import UserPaths

    today, leftovers = date.today(), ErasedLeftovers(UserPaths.of_user())
    with opened(arguments, Right.ERASE) as records:
        found = find_erasable(records.context, arguments.pseudonym)
        print(f"{found.pseudonym}: {_visits(found)}, {_orders(found)}")
        if found.kept_until > today:
            print(
                "erased: name, birth date, numbers, contact, notes; kept under the pseudonym until "
                f"{found.kept_until}: the documentation of devices"
            )
        else:
            print("erased: everything but the pseudonym")
        if not arguments.yes:
            raise UsageError("Nothing was erased; give --yes, and it cannot be taken back.")
        is_over = arguments.reason == "retention"
        reason = ErasureReason.RETENTION_OVER if is_over else ErasureReason.REQUEST
        leftovers.erase(records, found.person_id, reason, today)
        leftovers.forget(leftovers.erased(records))
    progress.step(1.0, "Done: {pseudonym} is erased", pseudonym=found.pseudonym)


ERASE = Step(
    "erase",
    "erase a person; the law keeps the documentation of devices for some years, without a name",
    _add_erase_arguments,
    _run_erase,
)


def _add_retention_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--years", type=whole, metavar="N", help="keep the record for so many years, 10 to 100"
    )
    parser.add_argument(
        "--limit", type=from_one, default=100, metavar="N", help="most persons (default: 100)"
    )
    add_place(parser)


def _run_retention(arguments: argparse.Namespace, _progress: Progress) -> None:
    """Set the years if they are given, and print a line for each person."""
    from insole_core.records.retention import keep_for, over_retention_named, years_of_keeping
    from insole_core.records.rights import Right

    with opened(arguments, Right.ERASE) as records:
        if arguments.years is not None:
            keep_for(records.context, arguments.years)
        years = years_of_keeping(records.context)
        print(f"kept for {years} years after the last entry")
        for found in over_retention_named(records.context, date.today(), arguments.limit):
            print(
                f"{found.pseudonym}\tkept until {found.kept_until}\t{_visits(found)}\t"
                f"{_orders(found)}"
            )


def _visits(found: Erasable) -> str:
    return counted(found.visits, "1 visit", "{count} visits")


def _orders(found: Erasable) -> str:
    return counted(found.orders, "1 order", "{count} orders")


RETENTION = Step(
    "retention",
    "list by pseudonym those whose record need not be kept any longer, or say for how long it is",
    _add_retention_arguments,
    _run_retention,
)
