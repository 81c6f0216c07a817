"""``insole-studio records audit``: who saw, changed and exported what."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from insole_core.errors import RecordsError, UsageError
from insole_core.messages import counted
from insole_core.progress import Progress
from insole_studio.cli.argument_parser import day, from_one
from insole_studio.cli.records.arguments import add_place, opened, print_rows

if TYPE_CHECKING:
    from insole_core.records.audit_search import ShownLine
    from insole_core.records.records import Records

NAME = "audit"
HELP = "print the audit log, the newest line first, or verify that every line is what was written"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("--person", metavar="PSEUDONYM", default="", help="only about this person")
    parser.add_argument("--author", metavar="NAME", default="", help="only what this account did")
    parser.add_argument(
        "--from", type=day, dest="first", metavar="DAY", help="2026-11-20, or today"
    )
    parser.add_argument("--to", type=day, dest="last", metavar="DAY", help="the last day")
    parser.add_argument(
        "--limit", type=from_one, default=200, metavar="N", help="most lines (default: 200)"
    )
    parser.add_argument("--json", action="store_true", help="as JSON, for other programs")
    parser.add_argument(
        "--verify",
        action="store_true",
        help="verify the whole log; exit code 1 if it is not intact",
    )
    add_place(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Print lines, or verify all of them."""
    from insole_core.records.rights import Right

    first, last = arguments.first, arguments.last
    if arguments.verify and (arguments.person or arguments.author or first or last):
        raise UsageError(
            "--verify reads the whole log; leave out --person, --author, --from and --to."
        )
    if first is not None and last is not None and first > last:
        raise UsageError(f"--from is {first}, which is after --to {last}; exchange them.")
    with opened(arguments, Right.READ_AUDIT) as records:
        if arguments.verify:
            _verify(records, progress)
        else:
            _print(records, arguments)


def _verify(records: Records, progress: Progress) -> None:
    from insole_core.records.audit_search import verify_audit

    report = verify_audit(records.context, progress)
    if report.problem is not None:
        raise RecordsError("{problem}", problem=report.problem)
    lines = counted(report.lines, "1 line is", "{count} lines are")
    print(f"{lines} what was written, and none is missing")


def _print(records: Records, arguments: argparse.Namespace) -> None:
    from insole_core.records.audit_search import AuditFilter, search_audit

    wanted = AuditFilter(arguments.person, arguments.author, arguments.first, arguments.last)
    rows = [_row(shown) for shown in search_audit(records.context, wanted, limit=arguments.limit)]
    print_rows(rows, as_json=arguments.json)


def _row(shown: ShownLine) -> dict[str, str]:
    line = shown.line
    return {
        "line": str(line.seq),
        "at": line.at,
        "author": line.author,
        "station": line.station,
        "action": line.action,
        "what": f"{line.subject_kind} {shown.subject}",
        "details": ", ".join(f"{key}: {value}" for key, value in shown.details.items()),
    }
