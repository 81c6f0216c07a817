"""``insole-studio records backup``: add a snapshot of the record to a folder of backups."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import NotAllowed, RecordsError
from insole_core.progress import Progress
from insole_studio.cli.path_arguments import OutputPath
from insole_studio.cli.records.place import add_place, opened, place_of_window
from insole_studio.cli.records.secrets import ask, ask_twice
from insole_studio.user_paths import UserPaths

if TYPE_CHECKING:
    from insole_core.records.backup.backup_key import BackupKey
    from insole_core.records.records import Records

NAME = "backup"
HELP = "add an encrypted snapshot of the record, with all of its files, to a folder"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "folder",
        action=OutputPath,
        metavar="FOLDER",
        help="folder of backups; it grows by what is new",
    )
    parser.add_argument(
        "--passphrase-file", type=Path, metavar="FILE",
        help="the first time: file with the passphrase; without it you are asked",
    )  # fmt: skip
    parser.add_argument(
        "--recipient", action="append", metavar="AGE1…",
        help="the first time: public key of age, instead of a passphrase",
    )  # fmt: skip
    add_place(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Back the record up."""
    from insole_core.records.backup.back_up import back_up, key_of_backups, set_up_backups
    from insole_core.records.rights import Right

    with opened(arguments, Right.BACK_UP) as records:
        _refuse_wrong_record(records)
        if key_of_backups(records.context) is None:
            _check_may_begin(records)
            set_up_backups(records.context, _new_key(arguments))
        saved = UserPaths.of_user().backed_up_folders
        report = back_up(records.context, arguments.folder, saved, progress)
    print(
        f"snapshot {report.snapshot.number} of {report.place}: {report.patients} patients, "
        f"{report.visits} visits, {report.orders} orders; {report.rows} rows, {report.contents} "
        f"files ({report.contents_bytes / 1e6:.1f} MB); {report.written_bytes / 1e6:.1f} MB were "
        "new"
    )
    for sha256 in report.damaged:
        print(f"not in the backup, because the record has lost it: {sha256}")


def _refuse_wrong_record(records: Records) -> None:
    """Refuse to save a record without patients while that of the window has some.

    Raises
    ------
    RecordsError
    """
    from insole_core.records.place_check import look_at_place

    place, window = records.place, place_of_window()
    if place == window or look_at_place(place).patients:
        return
    if look_at_place(window).patients:
        raise RecordsError(
            "No backup was made: {place} holds no patient, but {window}, the record of the window, "
            "holds some; leave --record and --database out to back that up.",
            place=place.name,
            window=window.name,
        )


def _check_may_begin(records: Records) -> None:
    """Check that whoever backs up for the first time may also say what opens the backups.

    Raises
    ------
    NotAllowed
    """
    from insole_core.records.rights import RIGHTS, Right

    if records.accounts.are_on and Right.SET_UP not in RIGHTS[records.who.role]:
        raise NotAllowed(
            "Backups have no passphrase yet, and {account} ({role}) may not choose it; let an "
            "administrator make the first backup, here or in the window.",
            account=records.who.name,
            role=str(records.who.role),
        )


def _new_key(arguments: argparse.Namespace) -> BackupKey:
    from insole_core.records.backup.backup_key import BackupKey

    if arguments.recipient:
        return BackupKey.for_recipients(arguments.recipient)
    prompt = "New passphrase for backups: "
    if arguments.passphrase_file is not None:
        return BackupKey.with_passphrase(ask(prompt, arguments.passphrase_file))
    return BackupKey.with_passphrase(ask_twice(prompt, "The two passphrases differ; begin again."))
