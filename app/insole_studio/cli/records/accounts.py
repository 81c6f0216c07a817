"""``insole-studio records accounts`` and ``password``: who may sign in, and with what."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, TypeAlias

from insole_core.errors import UsageError
from insole_core.progress import Progress
from insole_core.records.author import Role
from insole_studio.cli.argument_parser import Step
from insole_studio.cli.records.arguments import add_place, opened, opened_by_nobody, print_rows
from insole_studio.cli.records.secrets import new_password, password_of

if TYPE_CHECKING:
    from insole_core.records.accounts import Account
    from insole_core.records.records import Records

NAME = "accounts"
HELP = "list accounts, add, change or unlock one, or switch accounts on or off"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of each thing to do."""
    todo = parser.add_subparsers(required=True, metavar="TODO")
    listing = _add(todo, "list", "print a line for each account", _list)
    listing.add_argument("--json", action="store_true", help="as JSON, for other programs")
    on = _add(todo, "on", "switch accounts on by making the first administrator", _switch_on)
    _add_names(on)
    _add(todo, "off", "let everybody at the computer do everything again", _switch_off)
    add = _add(todo, "add", "add an account, with a first password for its owner", _add_one)
    _add_names(add)
    add.add_argument("--role", choices=[*map(str, Role)], required=True)
    change = _add(todo, "change", "give an account another name, role or system user", _change)
    change.add_argument("name", metavar="NAME")
    change.add_argument("--full-name", metavar="TEXT", help="as papers print it")
    change.add_argument("--role", choices=[*map(str, Role)])
    user = change.add_mutually_exclusive_group()
    user.add_argument(
        "--system-user", metavar="USER",
        help="of the operating system, which answers for them in place of a password",
    )  # fmt: skip
    user.add_argument("--no-system-user", action="store_true", help="ask everybody for a password")
    state = change.add_mutually_exclusive_group()
    state.add_argument("--disable", action="store_true", help="let nobody sign in with it")
    state.add_argument("--enable", action="store_true", help="let its owner sign in again")
    for name, text, work in (
        ("unlock", "let somebody try again who has mistyped too often", _unlock),
        ("reset", "give somebody another first password, and unlock the account", _reset),
    ):
        _add(todo, name, text, work).add_argument("name", metavar="NAME")


def run(arguments: argparse.Namespace, _progress: Progress) -> None:
    """Do it, as an administrator."""
    from insole_core.records.rights import Right

    with opened(arguments, Right.MANAGE_ACCOUNTS) as records:
        arguments.work(records, arguments)


Work = Callable[["Records", argparse.Namespace], None]
Todo: TypeAlias = "argparse._SubParsersAction[argparse.ArgumentParser]"


def _add(todo: Todo, name: str, text: str, work: Work) -> argparse.ArgumentParser:
    parser = todo.add_parser(name, help=text, description=text)
    parser.set_defaults(work=work)
    add_place(parser)
    return parser


def _add_names(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("name", metavar="NAME", help="to sign in with")
    parser.add_argument("--full-name", metavar="TEXT", required=True, help="as papers print it")


def _list(records: Records, arguments: argparse.Namespace) -> None:
    rows = [
        {
            "account": account.name,
            "full name": account.full_name,
            "role": str(account.role),
            "state": _state(account),
            "system user": account.system_user,
        }
        for account in records.accounts.all()
    ]
    print_rows(rows, as_json=arguments.json)


def _state(account: Account) -> str:
    if account.is_disabled:
        return "disabled"
    if account.failures:
        return f"wrong passwords: {account.failures}"
    return "first password" if account.has_first_password else ""


def _switch_on(records: Records, arguments: argparse.Namespace) -> None:
    password = new_password(f"Password of {arguments.name}")
    records.accounts.switch_on(arguments.name, arguments.full_name, password)


def _switch_off(records: Records, _arguments: argparse.Namespace) -> None:
    accounts = records.accounts
    if not accounts.are_on and not accounts.were_switched_off_unseen():
        raise UsageError("The record has no accounts, so there are none to switch off.")
    records.accounts.switch_off()


def _add_one(records: Records, arguments: argparse.Namespace) -> None:
    password = new_password(f"First password of {arguments.name}")
    records.accounts.add(arguments.name, arguments.full_name, Role(arguments.role), password)


def _change(records: Records, arguments: argparse.Namespace) -> None:
    account = records.accounts.named(arguments.name)
    user = "" if arguments.no_system_user else arguments.system_user
    records.accounts.change(
        replace(
            account,
            full_name=arguments.full_name or account.full_name,
            role=Role(arguments.role or account.role),
            is_disabled=arguments.disable or (account.is_disabled and not arguments.enable),
            system_user=account.system_user if user is None else user,
        )
    )


def _unlock(records: Records, arguments: argparse.Namespace) -> None:
    records.accounts.unlock(records.accounts.named(arguments.name).id)


def _reset(records: Records, arguments: argparse.Namespace) -> None:
    account = records.accounts.named(arguments.name)
    records.accounts.reset_password(account.id, new_password(f"First password of {account.name}"))


def _add_password_arguments(parser: argparse.ArgumentParser) -> None:
    add_place(parser)


def _run_password(arguments: argparse.Namespace, _progress: Progress) -> None:
    """Ask for the present password and for the new one, twice."""
    if arguments.account is None:
        raise UsageError("Whose password is to be changed? Name the account with --account NAME.")
    with opened_by_nobody(arguments) as records:
        present = password_of(arguments)
        records.accounts.change_password(arguments.account, present, new_password())


PASSWORD = Step(
    "password",
    "choose another password for the account that --account names",
    _add_password_arguments,
    _run_password,
)
