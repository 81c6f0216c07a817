"""``insole-studio records statement``: the statement of Annex XIII about an order's devices."""

from __future__ import annotations

import argparse
import json
from datetime import date
from typing import TYPE_CHECKING

from insole_core.errors import InputError
from insole_core.progress import Progress
from insole_studio.cli.path_arguments import OutputPath
from insole_studio.cli.records.language import add_language, wording_of
from insole_studio.cli.records.place import add_place, opened

if TYPE_CHECKING:
    from insole_core.solids.prescription_paper import Responsible

NAME = "statement"
HELP = "write what the record knows about an order's devices, as Annex XIII of the MDR asks for"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("order", metavar="ORDER", help="number of the order")
    parser.add_argument("--out", action=OutputPath, metavar="FILE.pdf", help="the paper to sign")
    parser.add_argument(
        "--json", action="store_true", help="print it as JSON, with how each device came about"
    )
    parser.add_argument(
        "--clinic", metavar="NAME", help="of the prescriber (default: that of the window)"
    )
    parser.add_argument(
        "--maker", metavar="NAME", help="who made the devices (default: that of the window)"
    )
    parser.add_argument("--maker-address", metavar="TEXT", help="default: that of the window")
    add_language(parser)
    add_place(parser)


def run(arguments: argparse.Namespace, _progress: Progress) -> None:
    """Write the statement."""
    from insole_core.records.rights import Right
    from insole_core.records.statement import order_of_number, statement_of, write_statement_paper

    if arguments.out is None and not arguments.json:
        raise InputError("Nothing would be written; give --out FILE.pdf, --json, or both.")
    with opened(arguments, Right.SEE) as records:
        order_id = order_of_number(records.context, arguments.order)
        statement = statement_of(records.context, order_id, _responsible(arguments))
    if arguments.out is not None:
        translate = wording_of(arguments).translate
        write_statement_paper(statement, arguments.out, date.today(), translate)
    if arguments.json:
        print(json.dumps(statement.as_json(), indent=1, ensure_ascii=False))


def _responsible(arguments: argparse.Namespace) -> Responsible:
    from insole_core.solids.prescription_paper import Responsible
    from insole_studio.settings import load_settings
    from insole_studio.user_paths import UserPaths

    settings = load_settings(UserPaths.of_user().settings_file)
    return Responsible(
        clinic=arguments.clinic or settings.clinic,
        maker=arguments.maker or settings.maker,
        maker_address=arguments.maker_address or settings.maker_address,
    )
