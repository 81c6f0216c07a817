"""``insole-studio records list`` and ``show``: find persons, orders and visits, and read them."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from datetime import date
from typing import TYPE_CHECKING

from insole_core.errors import UsageError
from insole_core.progress import Progress
from insole_studio.cli.argument_parser import Step, day, from_one
from insole_studio.cli.records.arguments import (
    Row,
    add_person,
    add_place,
    opened,
    person_id_of,
    print_rows,
)

if TYPE_CHECKING:
    from insole_core.records.records import Records


def _add_list_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "words", nargs="*", metavar="WORD",
        help="of name, birth date, personal number, pseudonym or order (default: the recent ones)",
    )  # fmt: skip
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--orders", action="store_true", help="open orders, the first due first")
    what.add_argument(
        "--visits", type=day, metavar="DAY", help="visits of a day: 2026-11-20, or today"
    )
    parser.add_argument(
        "--limit", type=from_one, default=50, metavar="N", help="most persons (default: 50)"
    )
    parser.add_argument("--json", action="store_true", help="as JSON, for other programs")
    add_place(parser)


def _run_list(arguments: argparse.Namespace, _progress: Progress) -> None:
    """Print a line for each."""
    from insole_core.records.rights import Right

    if arguments.words and (arguments.orders or arguments.visits is not None):
        raise UsageError("--orders and --visits list all, and take no WORD; leave one out.")
    with opened(arguments, Right.SEE) as records:
        rows = _rows(records, arguments)
    print_rows(rows, as_json=arguments.json)


def _rows(records: Records, arguments: argparse.Namespace) -> Sequence[Row]:
    if arguments.orders:
        return [
            {
                "order": order.number,
                "state": str(order.state),
                "due": _written(order.due_on),
                "shop": order.shop,
                "name": order.person_name,
            }
            for order in records.orders.open()
        ]
    if arguments.visits is not None:
        return [
            {
                "day": _written(visit.visited_on),
                "name": visit.person_name,
                "born": _written(visit.birth_date),
                "reason": " ".join(visit.reason.split()),
                "capture": str(visit.capture_state),
            }
            for visit in records.visits.on(arguments.visits)
        ]
    found = records.persons.search(" ".join(arguments.words), arguments.limit)
    return [
        {
            "pseudonym": person.pseudonym,
            "name": person.name,
            "born": _written(person.birth_date),
            "personal number": person.personal_number,
            "last visit": _written(person.last_visit),
        }
        for person in found
    ]


def _written(day: date | None) -> str:
    return "" if day is None else day.isoformat()


LIST = Step(
    "list",
    "list persons, found by words as in the window; or open orders, or the visits of a day",
    _add_list_arguments,
    _run_list,
)


def _add_show_arguments(parser: argparse.ArgumentParser) -> None:
    add_person(parser)
    parser.add_argument("--json", action="store_true", help="as JSON, for other programs")
    add_place(parser)


def _run_show(arguments: argparse.Namespace, _progress: Progress) -> None:
    """Print the person as text or JSON, without the large files."""
    from insole_core.evaluation.report import section_lines
    from insole_core.records.rights import Right
    from insole_core.workflows.records.person_dossier import person_json, read_dossier
    from insole_core.workflows.records.person_summary import person_report

    with opened(arguments, Right.SEE) as records:
        person = records.persons.open(person_id_of(records, arguments.person))
        dossier = read_dossier(records, person.id)
    if arguments.json:
        json.dump(person_json(dossier, {}, (), ()), sys.stdout, indent=1, ensure_ascii=False)
        print()
        return
    report = person_report(dossier, {}, (), ())
    print("\n\n".join("\n".join(section_lines(section)) for section in report.sections))


SHOW = Step(
    "show",
    "print what the record holds of a person; the audit log tells it",
    _add_show_arguments,
    _run_show,
)
