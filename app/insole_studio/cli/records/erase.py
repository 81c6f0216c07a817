"""``insole-studio records erase``: erase a person, on request or after the time of keeping."""

from __future__ import annotations

import argparse
from datetime import date

from insole_core.errors import UsageError
from insole_core.progress import Progress
from insole_studio.cli.records.place import add_place, opened

NAME = "erase"
HELP = "erase a person; the law keeps the documentation of devices for some years, without a name"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
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


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Say what erasing means, and erase."""
    from insole_core.records.retention import ErasureReason, find_erasable
    from insole_core.records.rights import Right
    from insole_studio.document.erased_leftovers import ErasedLeftovers
    from insole_studio.user_paths import UserPaths

    today, leftovers = date.today(), ErasedLeftovers(UserPaths.of_user())
    with opened(arguments, Right.ERASE) as records:
        found = find_erasable(records.context, arguments.pseudonym)
        print(f"{found.pseudonym}: {found.visits} visits, {found.orders} orders")
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
