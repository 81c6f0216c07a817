"""Arguments that say which record is meant, and who works on it."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import InputError, UsageError
from insole_studio.cli.records.secrets import ask
from insole_studio.user_paths import UserPaths

if TYPE_CHECKING:  # the database is loaded by the steps that need it
    from insole_core.records.place import RecordsPlace
    from insole_core.records.records import Records


def add_record_arguments(parser: argparse.ArgumentParser) -> None:
    """Add where the record is; by default it is that of this user."""
    parser.add_argument(
        "--record", type=Path, metavar="FOLDER", help="folder of the record; by default this user's"
    )
    parser.add_argument(
        "--database", metavar="URL",
        help="database of a server instead: postgresql+psycopg://user@server/database",
    )  # fmt: skip
    parser.add_argument(
        "--contents", type=Path, metavar="FOLDER",
        help="folder of the large files, with --database",
    )  # fmt: skip


def add_account_argument(parser: argparse.ArgumentParser) -> None:
    """Add who signs in where accounts are on."""
    parser.add_argument(
        "--account", metavar="NAME", help="account to sign in with, where accounts are on"
    )
    parser.add_argument(
        "--password-file", type=Path, metavar="FILE",
        help="file with its password; without it you are asked",
    )  # fmt: skip


def place_of(arguments: argparse.Namespace) -> RecordsPlace:
    """Return the place of the record that is meant.

    Raises
    ------
    UsageError
        When the arguments contradict each other.
    """
    from insole_core.records.place import RecordsPlace

    if arguments.database is None:
        if arguments.contents is not None:
            raise UsageError(
                "--contents belongs to --database; name the folder of a record with --record."
            )
        return RecordsPlace.local(arguments.record or UserPaths.of_user().records_folder)
    if arguments.contents is None or arguments.record is not None:
        raise UsageError("--database needs --contents, the folder of the large files, alone.")
    return RecordsPlace.of_url(arguments.database, arguments.contents)


@contextmanager
def opened_record(arguments: argparse.Namespace) -> Iterator[Records]:
    """Yield the record that is meant, for whoever signs in.

    Raises
    ------
    InputError
        When there is none: a command makes none.
    NotAllowed
    """
    from insole_core.records.author import Author
    from insole_core.records.open import open_records

    place = place_of(arguments)
    if place.is_local and not place.database_file.exists():
        raise InputError(
            "There is no record at {place}; name its folder with --record.", place=place.name
        )
    records = open_records(place, Author.of_user())
    try:
        if arguments.account is None:
            yield records
        else:
            password = ask(f"Password of {arguments.account}: ", arguments.password_file)
            yield records.for_author(records.accounts.sign_in(arguments.account, password))
    finally:
        records.close()


def saved_settings() -> dict[str, Path]:
    """Return the folders that belong to a backup, besides the record, by name."""
    paths = UserPaths.of_user()
    return {"settings": paths.settings_folder, "sensors": paths.sensors_folder}
