"""``insole-studio records import``: add persons of a table, or the case files of a folder."""

from __future__ import annotations

import argparse
import codecs
import sys
from collections.abc import Sequence
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import UsageError
from insole_core.progress import Progress
from insole_studio.cli.path_arguments import OutputPath
from insole_studio.cli.records.arguments import add_place, opened

if TYPE_CHECKING:
    from insole_core.cases.written_dates import DateOrder
    from insole_core.records.person_import import Outcomes
    from insole_core.records.person_table import ColumnMapping, PersonRows
    from insole_core.records.records import Records
    from insole_core.records.text_table import TextTable

NAME = "import"
HELP = "add the persons of a table (CSV), or the case files (.insole) of a folder"
_LEFT_OUT = "-"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "source", type=Path, metavar="TABLE|FOLDER",
        help="a table with headings in its first row, or a folder with case files",
    )  # fmt: skip
    parser.add_argument(
        "--dry-run", action="store_true",
        help="only tell what each row or file would do; nothing is added",
    )  # fmt: skip
    parser.add_argument(
        "--doubtful", action="store_true",
        help="add doubtful persons, too, as new ones; the window can merge them later",
    )  # fmt: skip
    parser.add_argument(
        "--report", action=OutputPath, metavar="report.csv", help="what became of every row or file"
    )
    parser.add_argument(
        "--column", action="append", default=[], metavar="HEADING=FIELD",
        help="what a column holds: given name, family name, or a field of a person such as birth "
        "date or contact (an unknown one is answered with the list of all), or - for nothing; a "
        "number in place of the heading counts columns from 1 (default: what the headings say)",
    )  # fmt: skip
    order = parser.add_mutually_exclusive_group()
    order.add_argument(
        "--day-first", action="store_true", help="dates such as 02/03/1970 begin with the day"
    )
    order.add_argument("--month-first", action="store_true", help="… with the month")
    parser.add_argument(
        "--number-kind", metavar="KIND",
        help="kind of the personal numbers: se for Swedish, any (default: what they look like)",
    )  # fmt: skip
    parser.add_argument(
        "--encoding", metavar="CODEC",
        help="character set of the table, such as cp1254 for Turkish (default: found, where the "
        "bytes tell it)",
    )  # fmt: skip
    add_place(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Import, or tell what an import would do."""
    from insole_core.export.csv_text import csv_text
    from insole_core.files.atomic import write_text
    from insole_core.records.rights import Right

    with opened(arguments, Right.WRITE) as records:
        is_folder = arguments.source.is_dir()
        headings, rows, counts = (_cases if is_folder else _persons)(records, arguments, progress)
    if arguments.report is not None:
        write_text(csv_text([headings, *rows]), arguments.report)
    told = [row for row in rows if arguments.dry_run or row[1] != "new"]
    print(csv_text(told, delimiter="\t"), end="")
    head = "Dry run" if arguments.dry_run else "Done"
    progress.step(1.0, "{head}: {counts}", head=head, counts=counts)


Report = tuple[Sequence[str], Sequence[Sequence[str]], str]


def _cases(records: Records, arguments: argparse.Namespace, progress: Progress) -> Report:
    from insole_core.workflows.records.import_cases import import_cases, plan_cases

    _refuse_options_of_tables(arguments)
    if arguments.dry_run:
        plan = plan_cases(records, arguments.source, progress)
    else:
        plan = import_cases(
            records, arguments.source, with_doubtful=arguments.doubtful, progress=progress
        )
    rows = [
        (line.path, str(line.outcome), line.name, str(line.day or ""), line.reason)
        for line in plan.lines
    ]
    return ("file", "outcome", "name", "visit", "reason"), rows, _counts(plan.lines, arguments)


def _counts(lines: Sequence[Outcomes], arguments: argparse.Namespace) -> str:
    from insole_core.records.person_import import count_added, count_outcomes

    if arguments.dry_run:
        return count_outcomes(lines)
    return count_added(lines, with_doubtful=arguments.doubtful)


def _refuse_options_of_tables(arguments: argparse.Namespace) -> None:
    options = {
        "--column": arguments.column,
        "--day-first": arguments.day_first,
        "--month-first": arguments.month_first,
        "--number-kind": arguments.number_kind,
        "--encoding": arguments.encoding,
    }
    for name, value in options.items():
        if value:
            raise UsageError(f"{name} is for tables, and {arguments.source} is a folder of cases.")


def _persons(records: Records, arguments: argparse.Namespace, progress: Progress) -> Report:
    from insole_core.records.person_import import import_persons, plan_import

    rows = _read(arguments)
    if arguments.dry_run:
        plan = plan_import(records, rows)
    else:
        plan = import_persons(records, rows, with_doubtful=arguments.doubtful, progress=progress)
    lines = [
        (str(line.line), str(line.outcome), line.person.name if line.person else "", line.reason)
        for line in plan.lines
    ]
    return ("line", "outcome", "name", "reason"), lines, _counts(plan.lines, arguments)


def _read(arguments: argparse.Namespace) -> PersonRows:
    from insole_core.records.person_table import IMPORTED, asks_date_order, read_persons
    from insole_core.records.text_table import read_table

    table = read_table(arguments.source, _codec(arguments.encoding))
    print(f"Read as {table.encoding}", file=sys.stderr)
    mapping = _mapping(table, arguments)
    for heading, field in zip(table.headings, mapping.fields, strict=True):
        holds = IMPORTED[field].noun if field else "left out"
        print(f"{heading or '(no heading)'}: {holds}", file=sys.stderr)
    if mapping.date_order is None and asks_date_order(table, mapping):
        raise UsageError(
            f"Some dates in {arguments.source} can be read in two ways; add --day-first or "
            "--month-first."
        )
    return read_persons(table, mapping, date.today())


def _codec(name: str | None) -> str | None:
    if name is None:
        return None
    try:
        "a".encode(name)  # unlike a look-up, only codecs of text
        return codecs.lookup(name).name
    except (LookupError, ValueError):
        raise UsageError(
            f"--encoding {name} is no known character set; give one such as utf-8, cp1252 (Western "
            "European), cp1250 (Central European), cp1254 (Turkish) or cp1251 (Cyrillic)."
        ) from None


def _mapping(table: TextTable, arguments: argparse.Namespace) -> ColumnMapping:
    from insole_core.records.person_table import ColumnMapping, propose_mapping
    from insole_core.records.personal_numbers import KINDS

    proposed = propose_mapping(table)
    fields = list(proposed.fields)
    for text in arguments.column:
        number, field = _column(table, text)
        fields[number] = field
    kind = proposed.number_kind
    if arguments.number_kind is not None:
        kind = "" if arguments.number_kind == "any" else arguments.number_kind
    if kind not in KINDS:
        known = ", ".join(key or "any" for key in KINDS)
        raise UsageError(f"--number-kind is {kind}, and must be one of: {known}.")
    return ColumnMapping(tuple(fields), _order(arguments) or proposed.date_order, kind)


def _order(arguments: argparse.Namespace) -> DateOrder | None:
    from insole_core.cases.written_dates import DateOrder

    if arguments.day_first:
        return DateOrder.DAY_FIRST
    return DateOrder.MONTH_FIRST if arguments.month_first else None


def _column(table: TextTable, text: str) -> tuple[int, str | None]:
    from insole_core.records.person_table import IMPORTED

    named = {field.noun: name for name, field in IMPORTED.items()} | {_LEFT_OUT: None}
    heading, equals, noun = text.rpartition("=")
    if heading in table.headings:
        number = table.headings.index(heading)
    elif heading.isdecimal() and 1 <= int(heading) <= len(table.headings):
        number = int(heading) - 1
    else:
        raise UsageError(f"--column {text}: the table has no column “{heading}”; check its name.")
    if not equals or noun not in named:
        raise UsageError(f"--column {text}: name one of: {', '.join(named)}.")
    return number, named[noun]
