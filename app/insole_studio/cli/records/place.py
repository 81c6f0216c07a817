"""Which record a command works on, and with which account."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import NotAllowed, UsageError
from insole_studio.cli.records.secrets import ask

if TYPE_CHECKING:
    from insole_core.records.author import Author
    from insole_core.records.place import RecordsPlace
    from insole_core.records.records import Records
    from insole_core.records.rights import Right


def add_place(parser: argparse.ArgumentParser) -> None:
    """Add the options that name a record and an account."""
    parser.add_argument(
        "--record", type=Path, metavar="FOLDER",
        help="folder of a record (default: that of the window)",
    )  # fmt: skip
    parser.add_argument(
        "--database", metavar="URL",
        help="of a shared record: postgresql+psycopg://user@server/database; the password is taken "
        "from PostgreSQL's own password file",
    )  # fmt: skip
    parser.add_argument(
        "--contents", type=Path, metavar="FOLDER", help="folder of the large files of --database"
    )
    parser.add_argument(
        "--account", metavar="NAME",
        help="sign in with this account; its password is asked, or read from the standard input",
    )  # fmt: skip


def place_of(arguments: argparse.Namespace) -> RecordsPlace:
    """Return the place of the record that the options name.

    Raises
    ------
    UsageError
        When they contradict each other.
    """
    from insole_core.records.place import RecordsPlace
    from insole_studio.user_paths import UserPaths

    if arguments.database is None:
        if arguments.contents is not None:
            raise UsageError("--contents belongs to --database; name both, or neither.")
        return RecordsPlace.local(arguments.record or UserPaths.of_user().records_folder)
    if arguments.record is not None or arguments.contents is None:
        raise UsageError("--database needs --contents, and takes no --record.")
    return RecordsPlace.of_url(arguments.database, arguments.contents)


@contextmanager
def opened(arguments: argparse.Namespace, right: Right) -> Iterator[Records]:
    """Yield the record that the options name, signed in where the clinic has accounts.

    Parameters
    ----------
    right
        What the command does.

    Raises
    ------
    UsageError
        When there is no such record; a command does not make one.
    NotAllowed
        When the account may not do it.
    """
    from insole_core.records.author import Author
    from insole_core.records.open import open_records
    from insole_core.records.rights import require

    place = place_of(arguments)
    if place.is_local and not place.database_file.exists():
        raise UsageError(f"{place.database_file} does not exist; name the folder of a record.")
    records = open_records(place, Author.of_user())
    try:
        if arguments.account is not None:
            who = _signed_in(records, arguments.account)
            records.close()
            records = open_records(place, who)
        with records.context.database.reading() as connection:
            require(connection, records.who, right)
        yield records
    finally:
        records.close()


def _signed_in(records: Records, account: str) -> Author:
    from insole_core.records.accounts import Accounts

    accounts = Accounts(records.context.database, records.who)
    if not accounts.are_on:
        raise NotAllowed("The record has no accounts; leave out --account.")
    return accounts.sign_in(account, ask(f"Password of {account}: ", None))
