"""``insole-studio records restore``: restore the record from a folder of backups."""

from __future__ import annotations

import argparse
import logging
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import InsoleError
from insole_core.progress import Progress
from insole_core.visible_text import visible_line
from insole_studio.cli.argument_parser import whole
from insole_studio.cli.records.place import add_place, check_may_set_aside, place_of
from insole_studio.cli.records.secrets import add_secret_arguments, secret_of
from insole_studio.user_paths import UserPaths

if TYPE_CHECKING:
    from insole_core.records.place import RecordsPlace
    from insole_studio.document.record_location import RecordLocation

log = logging.getLogger(__name__)

NAME = "restore"
HELP = "restore the record with all of its files, into an empty place"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
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


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Restore the record."""
    from insole_core.records.author import Author
    from insole_core.records.backup.restore import restore
    from insole_studio.document.record_location import settings_for

    if arguments.set_aside:
        check_may_set_aside(arguments)
    paths, place = UserPaths.of_user(), place_of(arguments)
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
        f"{report.rows} rows, {report.contents} files ({report.contents_bytes / 1e6:.1f} MB), "
        f"{report.files} settings; {report.kept_files} settings were there and stay"
    )
    if report.set_aside is not None:
        print(visible_line(f"the record before is kept as {report.set_aside}"))
    if report.erased_again:
        print(f"erased since the backup, and again now: {report.erased_again} persons")
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
