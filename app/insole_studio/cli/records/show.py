"""``insole-studio records show``: print what the record holds of a person."""

from __future__ import annotations

import argparse
import json
import sys

from insole_core.progress import Progress
from insole_studio.cli.records.person_argument import add_person, person_id_of
from insole_studio.cli.records.place import add_place, opened

NAME = "show"
HELP = "print what the record holds of a person; the audit log tells it"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_person(parser)
    parser.add_argument("--json", action="store_true", help="as JSON, for other programs")
    add_place(parser)


def run(arguments: argparse.Namespace, _progress: Progress) -> None:
    """Print the person as text or JSON, without the large files."""
    from insole_core.evaluation.report import section_lines
    from insole_core.records.rights import Right
    from insole_core.workflows.records.person_dossier import read_dossier
    from insole_core.workflows.records.person_json import person_json
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
