"""``insole-studio records backup``, ``schedule`` and ``restore``: snapshots of the record."""

from __future__ import annotations

import argparse
import logging
from pathlib import Path
from typing import TYPE_CHECKING, get_args

from insole_core.errors import InsoleError, NotAllowed, RecordsError, UsageError
from insole_core.messages import counted, joined
from insole_core.progress import Progress
from insole_core.visible_text import visible_line
from insole_studio.cli.argument_parser import Step, whole
from insole_studio.cli.path_arguments import OutputPath
from insole_studio.cli.records.arguments import (
    add_place,
    check_may_set_aside,
    opened,
    place_of,
    place_of_window,
)
from insole_studio.cli.records.secrets import add_secret_arguments, ask, ask_twice, secret_of
from insole_studio.user_paths import UserPaths

if TYPE_CHECKING:
    from insole_core.records.backup.backup_key import BackupKey
    from insole_core.records.place import RecordsPlace
    from insole_core.records.records import Records
    from insole_studio.document.record_location import RecordLocation
    from insole_studio.settings import Settings

_DAYS = ("monday", "tuesday", "wednesday", "thursday", "friday", "saturday", "sunday")
_KEPT = {day: str(number) for number, day in enumerate(_DAYS)} | {
    "daily": "daily",
    "never": "never",
}
"""What the settings call each."""

log = logging.getLogger(__name__)


def _add_backup_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "folder",
        action=OutputPath,
        metavar="FOLDER",
        help="folder of backups; it grows by what is new",
    )
    secret = parser.add_mutually_exclusive_group()
    secret.add_argument(
        "--passphrase-file", type=Path, metavar="FILE",
        help="the first time: file with the passphrase; without it you are asked",
    )  # fmt: skip
    secret.add_argument(
        "--recipient", action="append", metavar="AGE1…",
        help="the first time: public key of age, instead of a passphrase",
    )  # fmt: skip
    add_place(parser)


def _run_backup(arguments: argparse.Namespace, progress: Progress) -> None:
    """Back the record up."""
    from insole_core.records.backup.back_up import back_up, key_of_backups, set_up_backups
    from insole_core.records.rights import Right

    with opened(arguments, Right.BACK_UP) as records:
        _check_apart(arguments.folder, records.place)
        _refuse_wrong_record(records)
        key = key_of_backups(records.context)
        if key is None:
            _check_may_begin(records)
            set_up_backups(records.context, _new_key(arguments))
        else:
            _check_is_key(key, arguments)
        saved = UserPaths.of_user().backed_up_folders
        report = back_up(records.context, arguments.folder, saved, progress)
    print(
        f"snapshot {report.snapshot.number} of {report.place}: "
        f"{counted(report.patients, '1 patient', '{count} patients')}, "
        f"{counted(report.visits, '1 visit', '{count} visits')}, "
        f"{counted(report.orders, '1 order', '{count} orders')}; "
        f"{counted(report.rows, '1 row', '{count} rows')}, "
        f"{counted(report.contents, '1 file', '{count} files')} "
        f"({report.contents_bytes / 1e6:.1f} MB); {report.written_bytes / 1e6:.1f} MB were new"
    )
    for sha256 in report.damaged:
        print(f"not in the backup, because the record has lost it: {sha256}")


def _check_apart(backups: Path, place: RecordsPlace) -> None:
    """Refuse backups in the folder of their record: whatever takes one takes the other.

    Raises
    ------
    UsageError
    """
    record = place.contents.parent if place.is_local else place.contents
    if backups.resolve().is_relative_to(record.resolve()):
        raise UsageError(
            f"{backups} lies in {record}, the folder of the record; name another folder, at best "
            "on another disk."
        )


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


def _check_is_key(key: BackupKey, arguments: argparse.Namespace) -> None:
    """Check that what is given opens the backups of the record, which have their key already.

    Whoever gave another passphrase would keep it, and not get into the backups.

    Raises
    ------
    UsageError
    """
    from insole_core.records.backup.backup_key import BackupKey

    option = "--passphrase-file"
    if arguments.recipient:
        option = "--recipient"
        BackupKey.for_recipients(arguments.recipient)  # which refuses what is none
        is_right = key.is_for(arguments.recipient)
    else:
        file = arguments.passphrase_file
        is_right = file is None or key.is_opened_by(ask("", file))
    if not is_right:
        raise UsageError(
            f"The backups of this record, in every folder, are opened by the {key.opened_by} that "
            f"was chosen with the first one, and {option} does not give that; leave it out, and "
            "keep what was chosen: it cannot be changed."
        )


BACKUP = Step(
    "backup",
    "add an encrypted snapshot of the record, with all of its files, to a folder",
    _add_backup_arguments,
    _run_backup,
)


def _add_schedule_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--folder", type=Path, metavar="FOLDER", help="of the backups")
    parser.add_argument(
        "--day", choices=tuple(_KEPT), help="of the week, every day, or by hand only"
    )
    parser.add_argument("--hour", type=whole, metavar="H", help="0 to 23")
    parser.add_argument(
        "--keep", metavar="WHICH",
        help="all; or all of 30 days, then one of each month, of all (months) or one year (year)",
    )  # fmt: skip
    add_place(parser)


def _run_schedule(arguments: argparse.Namespace, _progress: Progress) -> None:
    """Change what is given, and print the plan."""
    from insole_core.records.backup.back_up import last_backup_at
    from insole_core.records.rights import Right
    from insole_studio.settings import LAST_HOUR, BackupKeep, load_settings, save_settings

    if arguments.hour is not None and not 0 <= arguments.hour <= LAST_HOUR:
        raise UsageError(f"--hour is {arguments.hour}, and must be 0 to {LAST_HOUR}.")
    kinds = get_args(BackupKeep)
    if arguments.keep not in (None, *kinds):
        raise UsageError(f"--keep is {arguments.keep}, and must be {joined(kinds, ' or ')}.")
    if arguments.folder is not None and not arguments.folder.is_dir():
        raise UsageError(
            f"--folder is {arguments.folder}, where no folder is; connect its disk or make it."
        )
    path = UserPaths.of_user().settings_file
    with opened(arguments, Right.BACK_UP) as records:
        settings = load_settings(path)
        if _change(settings, arguments):
            save_settings(settings, path)
        last = last_backup_at(records.context.database)
    day = next(name for name, kept in _KEPT.items() if kept == settings.backup_day)
    print(f"folder\t{settings.backup_folder or 'none'}")
    print(f"day\t{day}\nhour\t{settings.backup_hour}\nkeep\t{settings.backup_keep}")
    print(f"last backup\t{'never' if last is None else last.isoformat()}")


def _change(settings: Settings, arguments: argparse.Namespace) -> bool:
    """Change the settings; return whether anything was given."""
    given = {
        "backup_folder": None if arguments.folder is None else str(arguments.folder.absolute()),
        "backup_day": None if arguments.day is None else _KEPT[arguments.day],
        "backup_hour": arguments.hour,
        "backup_keep": arguments.keep,
    }
    for name, value in given.items():
        if value is not None:
            setattr(settings, name, value)
    return any(value is not None for value in given.values())


SCHEDULE = Step(
    "schedule",
    "say where and when the window of this station makes backups, or change that",
    _add_schedule_arguments,
    _run_schedule,
)


def _add_restore_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="folder of backups")
    parser.add_argument(
        "--snapshot", type=whole, metavar="NUMBER", help="which one; by default the newest"
    )
    parser.add_argument(
        "--set-aside", action="store_true",
        help="rename the record that is there, which is kept, and restore in its place",
    )  # fmt: skip
    add_secret_arguments(parser)
    add_place(parser)


def _run_restore(arguments: argparse.Namespace, progress: Progress) -> None:
    """Restore the record."""
    from insole_core.records.author import Author
    from insole_core.records.backup.restore import restore
    from insole_studio.document.record_location import settings_for

    paths, place = UserPaths.of_user(), place_of(arguments)
    _check_apart(arguments.folder, place)
    if arguments.set_aside:
        check_may_set_aside(arguments)
    location = _location_of(place, paths)
    report = restore(
        arguments.folder,
        secret_of(arguments),
        place,
        Author.of_user(),
        number=arguments.snapshot,
        replace_existing=arguments.set_aside,
        settings=None if location is None else paths.backed_up_folders,
        revise=None if location is None else settings_for(location, paths),
        progress=progress,
    )
    print(
        f"snapshot {report.snapshot.number} of {report.snapshot.made_at:%Y-%m-%d %H:%M} UTC: "
        f"{counted(report.rows, '1 row', '{count} rows')}, "
        f"{counted(report.contents, '1 file', '{count} files')} "
        f"({report.contents_bytes / 1e6:.1f} MB), "
        f"{counted(report.files, '1 setting', '{count} settings')}; "
        f"{counted(report.kept_files, '1 setting was', '{count} settings were')} there and "
        f"{'stays' if report.kept_files == 1 else 'stay'}"
    )
    if report.set_aside is not None:
        print(visible_line(f"the record before is kept as {report.set_aside}"))
    if report.erased_again:
        print(
            f"erased since the backup, and again now: "
            f"{counted(report.erased_again, '1 person', '{count} persons')}"
        )
    if report.is_erasure_unknown:
        print("the record before cannot be read: who was erased since the backup may be back")
    for sha256 in report.left_out:
        print(f"was lost before the backup was made: {sha256}")
    if report.audit.problem is not None:
        print(report.audit.problem)
    print(_put_in_front(place, location, paths))


def _location_of(place: RecordsPlace, paths: UserPaths) -> RecordLocation | None:
    """Return how the settings name a place; None for a folder that the window does not open."""
    from insole_studio.document.record_location import RecordLocation

    if not place.is_local:
        url = place.url.set(password=None).render_as_string()
        return RecordLocation(paths.records_folder, url, str(place.contents.absolute()))
    location = RecordLocation(paths.records_folder)
    return (
        location
        if location.place().database_file.resolve() == place.database_file.resolve()
        else None
    )


def _put_in_front(place: RecordsPlace, location: RecordLocation | None, paths: UserPaths) -> str:
    """Let the window open what was restored, unless its record has patients; tell which it is."""
    if location is None:
        folder = place.contents.parent
        return f"the window opens its own record as before; this one is --record {folder}"
    from insole_studio.document.record_location import let_window_open

    still = _other_with_patients(location, paths)
    if still:
        return (
            f"the window still opens {still}, which holds patients; Clinic › Where the record is… "
            f"leads it to {place.name}"
        )
    let_window_open(location, paths)
    return f"the window opens {place.name}"


def _other_with_patients(location: RecordLocation, paths: UserPaths) -> str:
    """Return the name of the window's record if that is another one, answers, and has patients."""
    from insole_core.records.place_check import look_at_place
    from insole_studio.document.record_location import location_of_window

    try:
        place = location_of_window(paths).place()
        if place != location.place() and look_at_place(place).patients:
            return place.name
    except InsoleError as error:
        log.info("the record of the window is not there any more: %s", error)
    return ""


RESTORE = Step(
    "restore",
    "restore the record with all of its files, into an empty place",
    _add_restore_arguments,
    _run_restore,
)
