"""``insole-studio order verify``: whether an order arrived as the clinic has written it."""

from __future__ import annotations

import argparse
from pathlib import Path

from insole_core.errors import InputError
from insole_core.progress import Progress
from insole_core.visible_text import visible_line

NAME = "verify"
HELP = "say what is missing, changed, added, or of a wrong side in an order; exit code 1 if so"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("order", type=Path, metavar="FOLDER|ZIP", help="of the order")


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Open the order, print what it holds, and what is wrong with it."""
    from insole_core.export.order_verification import verify_order

    verification = verify_order(arguments.order, progress)
    order = verification.order
    count = sum(item.terms.quantity for item in order.items)
    told = (
        f"Order {order.release.number}, revision {order.release.revision}, of {order.created_at}, "
        f"by {order.program}: "
        f"{len(order.items)} patients, {count} pieces or pairs, {len(order.files)} files"
    )
    for line in (told, *verification.problems):
        print(visible_line(line))
    if verification.problems:
        raise InputError(
            "{order} is not as it was written: {count} problems, listed above; do not make it "
            "before the clinic has answered.",
            order=arguments.order,
            count=len(verification.problems),
        )
    print(visible_line(f"The order is complete. {verification.compared()}"))
