"""``insole-studio records export`` and ``statement``: a person as a folder, and Annex XIII."""

from __future__ import annotations

import argparse
import json
import sys
from datetime import date
from typing import TYPE_CHECKING

from insole_core.errors import InputError
from insole_core.messages import counted
from insole_core.progress import Progress
from insole_studio.cli.argument_parser import Step
from insole_studio.cli.path_arguments import OutputPath
from insole_studio.cli.records.arguments import (
    add_language,
    add_person,
    add_place,
    opened,
    person_id_of,
    wording_of,
)

if TYPE_CHECKING:
    from insole_core.solids.prescription_paper import Responsible


def _add_export_arguments(parser: argparse.ArgumentParser) -> None:
    add_person(parser)
    parser.add_argument(
        "--out", action=OutputPath, required=True, metavar="FOLDER", help="new or empty"
    )
    parser.add_argument(
        "--pseudonymous", action="store_true",
        help="leave out all that names or describes the person, as for a shop",
    )  # fmt: skip
    add_language(parser)
    add_place(parser)


def _run_export(arguments: argparse.Namespace, progress: Progress) -> None:
    """Write the folder; tell on stderr what could not be exported."""
    from insole_core.records.rights import Right
    from insole_core.workflows.records.export_person import export_person

    with opened(arguments, Right.EXPORT) as records:
        export = export_person(
            records,
            person_id_of(records, arguments.person),
            arguments.out,
            is_pseudonymous=arguments.pseudonymous,
            responsible=_responsible(None, None, None),
            wording=wording_of(arguments),
            progress=progress,
        )
    for sentence in export.left_out:
        print(f"Not exported: {sentence}", file=sys.stderr)
    files = counted(len(export.files), "1 file", "{count} files")
    progress.step(1.0, "Done: {files} in {folder}", files=files, folder=export.folder)


EXPORT = Step(
    "export",
    "export a person as a folder that opens without this program",
    _add_export_arguments,
    _run_export,
)


def _add_statement_arguments(parser: argparse.ArgumentParser) -> None:
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


def _run_statement(arguments: argparse.Namespace, _progress: Progress) -> None:
    """Write the statement."""
    from insole_core.export.lettering import letters_note
    from insole_core.records.rights import Right
    from insole_core.records.statement import order_of_number, statement_of, write_statement_paper

    if arguments.out is None and not arguments.json:
        raise InputError("Nothing would be written; give --out FILE.pdf, --json, or both.")
    responsible = _responsible(arguments.clinic, arguments.maker, arguments.maker_address)
    with opened(arguments, Right.SEE) as records:
        order_id = order_of_number(records.context, arguments.order)
        statement = statement_of(records.context, order_id, responsible)
    if arguments.out is not None:
        translate = wording_of(arguments).translate
        letters = letters_note([json.dumps(statement.as_json(), ensure_ascii=False)])
        if letters is not None:
            print(f"Warning: {letters}", file=sys.stderr)
        write_statement_paper(statement, arguments.out, date.today(), translate)
    if arguments.json:
        print(json.dumps(statement.as_json(), indent=1, ensure_ascii=False))


def _responsible(clinic: str | None, maker: str | None, maker_address: str | None) -> Responsible:
    """Return clinic and maker as given, else as the settings of the window name them."""
    from insole_core.solids.prescription_paper import Responsible
    from insole_studio.settings import load_settings
    from insole_studio.user_paths import UserPaths

    settings = load_settings(UserPaths.of_user().settings_file)
    return Responsible(
        clinic=clinic or settings.clinic,
        maker=maker or settings.maker,
        maker_address=maker_address or settings.maker_address,
    )


STATEMENT = Step(
    "statement",
    "write what the record knows about an order's devices, as Annex XIII of the MDR asks for",
    _add_statement_arguments,
    _run_statement,
)
