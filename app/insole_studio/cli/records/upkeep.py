"""``insole-studio records verify``, ``migrate`` and ``undo-upgrade``: keep the record sound."""

from __future__ import annotations

import argparse
import sys
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import RecordsError
from insole_core.messages import counted
from insole_core.progress import Progress
from insole_studio.cli.argument_parser import Step
from insole_studio.cli.records.arguments import add_place, opened, place_of
from insole_studio.cli.records.secrets import add_secret_arguments, secret_of

if TYPE_CHECKING:
    from insole_core.records.backup.snapshot import CheckReport


def _add_verify_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--backup", type=Path, metavar="FOLDER",
        help="decrypt the newest backup in a folder, too, and compare the audit log with it",
    )  # fmt: skip
    add_secret_arguments(parser)
    add_place(parser)


def _run_verify(arguments: argparse.Namespace, progress: Progress) -> None:
    """Verify the record."""
    from insole_core.records.rights import Right
    from insole_core.records.verify import verify_record

    known: dict[int, str] = {}
    problems: list[str] = []
    if arguments.backup is not None:
        known, problems = _check(arguments, progress.part(0, 0.5))
    with opened(arguments, Right.BACK_UP) as records:
        report = verify_record(records.context, known, progress.part(0.5, 1))
    problems += report.problems()
    print(report.compared())
    print(
        f"{report.contents.checked_bytes / 1e6:.1f} MB of files; "
        f"{counted(len(report.contents.unused), '1 file is', '{count} files are')} not in use"
    )
    for path in report.contents.foreign:
        print(f"not part of the record: {path}")
    for problem in problems[:-1]:
        print(problem)
    if problems:
        raise RecordsError(problems[-1])


def _check(arguments: argparse.Namespace, progress: Progress) -> tuple[dict[int, str], list[str]]:
    """Return the last line of the audit log that a backup knows, and what is wrong with it."""
    from insole_core.records.backup.snapshot import check_backup, open_snapshot

    secret = secret_of(arguments)
    manifest = open_snapshot(arguments.backup, secret).manifest
    report: CheckReport = check_backup(arguments.backup, secret, progress=progress)
    print(
        f"backup {report.snapshot.number} of {report.snapshot.made_at:%Y-%m-%d %H:%M} UTC: "
        f"{counted(report.rows, '1 row', '{count} rows')}, "
        f"{counted(report.contents, '1 file', '{count} files')} "
        f"({report.contents_bytes / 1e6:.1f} MB)"
    )
    wrong = [f"The backup is damaged: {name}; use another copy." for name in report.damaged]
    return {manifest.audit_seq: manifest.audit_hash}, wrong


VERIFY = Step(
    "verify",
    "verify audit log, signatures, files and references of the record; exit code 1 if not sound",
    _add_verify_arguments,
    _run_verify,
)


def _add_migrate_arguments(parser: argparse.ArgumentParser) -> None:
    add_place(parser)


def _run_migrate(arguments: argparse.Namespace, progress: Progress) -> None:
    """Make or migrate the record; one that is up to date stays as it is."""
    from insole_core.records.author import Author
    from insole_core.records.migrate import SCHEMA
    from insole_core.records.records import open_records

    place = place_of(arguments)
    with closing(open_records(place, Author.of_user())) as records:
        if records.upgrade is not None:
            print(records.upgrade, file=sys.stderr)
    progress.step(1.0, "Done: {place} has schema {schema}", place=place.name, schema=SCHEMA)


MIGRATE = Step(
    "migrate",
    "make a record, or bring an older one to the tables of this program",
    _add_migrate_arguments,
    _run_migrate,
)


def _add_undo_upgrade_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "copy", nargs="?", metavar="COPY",
        help="which one to put back; the record of now becomes a copy (default: list them)",
    )  # fmt: skip
    add_place(parser)


def _run_undo_upgrade(arguments: argparse.Namespace, progress: Progress) -> None:
    """List the copies, or put one back; the next start of this program upgrades it again."""
    from insole_core.records.migrate import copies_of, put_back
    from insole_core.records.rights import Right

    with opened(arguments, Right.SET_UP) as records:
        if arguments.copy is None:
            for name in copies_of(records.context.database):
                print(name)
            return
        kept = put_back(records.context, arguments.copy)
    progress.step(
        1.0,
        "Done: {copy} is the record again, and the one until now is kept as {kept}; open it with "
        "the program that made it",
        copy=arguments.copy,
        kept=kept,
    )


UNDO_UPGRADE = Step(
    "undo-upgrade",
    "list the copies that were kept before an upgrade of the record, or put one of them back",
    _add_undo_upgrade_arguments,
    _run_undo_upgrade,
)
