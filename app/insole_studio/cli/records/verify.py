"""``insole-studio records verify``: verify the record, and a backup of it."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import RecordsError
from insole_core.progress import Progress
from insole_studio.cli.records.place import add_place, opened
from insole_studio.cli.records.secrets import add_secret_arguments, secret_of

if TYPE_CHECKING:
    from insole_core.records.backup.check import CheckReport

NAME = "verify"
HELP = "verify audit log, signatures, files and references of the record; exit code 1 if not sound"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "--backup", type=Path, metavar="FOLDER",
        help="decrypt the newest backup in a folder, too, and compare the audit log with it",
    )  # fmt: skip
    add_secret_arguments(parser)
    add_place(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
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
        f"{len(report.contents.unused)} files are not in use"
    )
    for path in report.contents.foreign:
        print(f"not part of the record: {path}")
    for problem in problems[:-1]:
        print(problem)
    if problems:
        raise RecordsError(problems[-1])


def _check(arguments: argparse.Namespace, progress: Progress) -> tuple[dict[int, str], list[str]]:
    """Return the last line of the audit log that a backup knows, and what is wrong with it."""
    from insole_core.records.backup.check import check_backup
    from insole_core.records.backup.snapshot import open_snapshot

    secret = secret_of(arguments)
    manifest = open_snapshot(arguments.backup, secret).manifest
    report: CheckReport = check_backup(arguments.backup, secret, progress=progress)
    print(
        f"backup {report.snapshot.number} of {report.snapshot.made_at:%Y-%m-%d %H:%M} UTC: "
        f"{report.rows} rows, {report.contents} files ({report.contents_bytes / 1e6:.1f} MB)"
    )
    wrong = [f"The backup is damaged: {name}; use another copy." for name in report.damaged]
    return {manifest.audit_seq: manifest.audit_hash}, wrong
