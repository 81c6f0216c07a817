"""What the steps of `records` share: the record, the account, a person, a language, and rows."""

from __future__ import annotations

import argparse
import json
import logging
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import FirstPassword, InputError, NotAllowed, RecordsError, UsageError
from insole_studio.cli.argument_parser import whole
from insole_studio.cli.records.secrets import new_password, password_of
from insole_studio.languages import LANGUAGES

if TYPE_CHECKING:
    from insole_core.records.author import Author
    from insole_core.records.place import RecordsPlace
    from insole_core.records.records import Records
    from insole_core.records.rights import Right
    from insole_core.workflows.records.person_summary import Wording

log = logging.getLogger(__name__)

_SHOWN = 5

Row = Mapping[str, str]


def add_place(parser: argparse.ArgumentParser) -> None:
    """Add the options that name a record and an account."""
    parser.add_argument(
        "--record", type=Path, metavar="FOLDER",
        help="folder of a record (default: the record of the window, also if it is on a server)",
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
    password = parser.add_mutually_exclusive_group()
    password.add_argument(
        "--password-file", type=Path, metavar="FILE",
        help="file with the password of --account, which only you may read",
    )  # fmt: skip
    password.add_argument(
        "--password-fd", type=whole, metavar="N",
        help="file descriptor that a script has opened to hand over the password",
    )  # fmt: skip


def place_of(arguments: argparse.Namespace) -> RecordsPlace:
    """Return the place of the record that the options name.

    Raises
    ------
    UsageError
        When they contradict each other.
    InputError
        When the settings of the window are asked, and do not tell it.
    """
    from insole_core.records.place import RecordsPlace

    if arguments.account is None and (arguments.password_file, arguments.password_fd) != (
        None,
        None,
    ):
        raise UsageError(
            "--password-file and --password-fd are of an account; name it with --account."
        )
    if arguments.database is None:
        if arguments.contents is not None:
            raise UsageError("--contents belongs to --database; name both, or neither.")
        if arguments.record is None:
            return place_of_window()
        return RecordsPlace.local(arguments.record)
    if arguments.record is not None or arguments.contents is None:
        raise UsageError("--database needs --contents, and takes no --record.")
    return RecordsPlace.of_url(arguments.database, arguments.contents)


def place_of_window() -> RecordsPlace:
    """Return the place of the record that the window opens.

    Raises
    ------
    InputError
        When its settings do not tell it.
    """
    from insole_studio.document.record_location import location_of_window
    from insole_studio.user_paths import UserPaths

    return location_of_window(UserPaths.of_user()).place()


def check_may_set_aside(arguments: argparse.Namespace) -> None:
    """Check that whoever restores may set the record aside that is there, as in the window.

    To a damaged record nobody may be able to sign in: there the passphrase of the backup is enough.

    Raises
    ------
    NotAllowed
    """
    from insole_core.records.author import Author
    from insole_core.records.records import open_records
    from insole_core.records.rights import Right

    place = place_of(arguments)
    if not place.is_local or not place.database_file.exists():
        return
    try:
        records = open_records(place, Author.of_user())
    except RecordsError as error:
        log.warning("a record that cannot be opened may be set aside: %s", error)
        return
    with closing(records):
        if not records.is_read_only:
            _check(records, sign_in(records, arguments), Right.SET_UP)


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
    with opened_by_nobody(arguments) as records:
        who = sign_in(records, arguments)
        _check(records, who, right)
        yield records.for_author(who)


@contextmanager
def opened_by_nobody(arguments: argparse.Namespace) -> Iterator[Records]:
    """Yield the record that the options name, for a command that proves who it is by itself.

    Raises
    ------
    UsageError
        When there is no such record; a command does not make one.
    """
    from insole_core.records.author import Author
    from insole_core.records.records import open_records

    place = place_of(arguments)
    if place.is_local and not place.database_file.exists():
        raise UsageError(f"{place.database_file} does not exist; name the folder of a record.")
    with closing(open_records(place, Author.of_user())) as records:
        if records.upgrade is not None:
            print(records.upgrade, file=sys.stderr)
        yield records


def _check(records: Records, who: Author, right: Right) -> None:
    from insole_core.records.rights import require

    with records.context.database.reading() as connection:
        require(connection, who, right)


def sign_in(records: Records, arguments: argparse.Namespace) -> Author:
    """Return whoever the options name, once that is proven; the system's user without accounts.

    Raises
    ------
    NotAllowed
        When the password is wrong, or nobody signs in to a record with accounts.
    """
    accounts, account = records.accounts, arguments.account
    if not accounts.are_on:
        if account is not None and accounts.were_switched_off_unseen():
            raise NotAllowed(
                "Accounts are off, although nobody has switched them off: anybody may do anything. "
                "Verify the record without --account, switch them on again, and compare the record "
                "with a backup."
            )
        if account is not None:
            raise NotAllowed("The record has no accounts; leave out --account.")
        return records.who
    if account is None:
        author = accounts.sign_in_system_user()
        if author is None:
            raise NotAllowed(
                "The record has accounts, and you are not signed in; name yours with --account "
                "NAME, and its password is asked for."
            )
        return author
    password = password_of(arguments)
    try:
        return accounts.sign_in(account, password)
    except FirstPassword as error:
        print(error, file=sys.stderr)
    return accounts.change_password(account, password, new_password())


def add_person(parser: argparse.ArgumentParser) -> None:
    """Add the argument."""
    parser.add_argument(
        "person", metavar="PERSON",
        help="pseudonym, personal number, or words that only one person is found by",
    )  # fmt: skip


def person_id_of(records: Records, text: str) -> str:
    """Return the id of the person that a text names.

    Raises
    ------
    InputError
        When it names nobody, or several.
    """
    found = records.persons.search(text) if text.strip() else []
    named = [person for person in found if text in (person.id, person.pseudonym)]
    if len(named or found) == 1:
        return (named or found)[0].id
    if not found:
        raise InputError("Nobody is found by “{text}”; check it with: records list.", text=text)
    some = ", ".join(person.pseudonym for person in found[:_SHOWN])
    raise InputError(
        "“{text}” names several persons ({some}…); give the pseudonym of one of them.",
        text=text,
        some=some,
    )


def add_language(parser: argparse.ArgumentParser) -> None:
    """Add the option that chooses a language."""
    parser.add_argument(
        "--language",
        choices=list(LANGUAGES),
        help="of what is written (default: that of the window)",
    )


def wording_of(arguments: argparse.Namespace) -> Wording:
    """Return the language that was chosen, else that of the window."""
    from insole_core.workflows.records.person_summary import Wording
    from insole_studio.settings import load_settings
    from insole_studio.texts import language_code, translation_into
    from insole_studio.user_paths import UserPaths

    language = arguments.language or load_settings(UserPaths.of_user().settings_file).language
    return Wording(language_code(language), translation_into(language))


def print_rows(rows: Sequence[Row], *, as_json: bool) -> None:
    """Print rows with their headings, cells apart by tabs, or as JSON."""
    from insole_core.export.csv_text import csv_text

    if as_json:
        json.dump(rows, sys.stdout, indent=1, ensure_ascii=False)
        print()
        return
    lines = [tuple(rows[0]), *(tuple(row.values()) for row in rows)] if rows else []
    print(csv_text(lines, delimiter="\t"), end="")
