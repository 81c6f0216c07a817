"""Accounts of the clinic: signing in, lock-out, and their administration (decision 0045).

They are off until somebody makes the first administrator; until then the operating system's user
is the author of every change, and nobody is asked. No account has a password that it came with.
"""

from __future__ import annotations

import json
import re
import time
import unicodedata
import uuid
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any, Final

from sqlalchemy import Connection, Row, delete, func, insert, select, text, update

from insole_core.errors import FirstPassword, InputError, NotAllowed, RecordsError
from insole_core.records import schema
from insole_core.records.audit import AuditLog
from insole_core.records.author import Author, Proof, Role, system_user, utc_now
from insole_core.records.checked_values import word_of
from insole_core.records.database import Database
from insole_core.records.database_errors import DamagedDatabase
from insole_core.records.passwords import (
    check_password,
    hash_password,
    is_outdated,
    is_password,
)
from insole_core.records.rights import ACCOUNTS_ON, Right, accounts_are_on, require
from insole_core.records.row_report import SWITCHED_OFF, SWITCHED_ON

LOCK_MINUTES: Final = "lock_minutes"
"""Key of the clinic's settings: minutes without input after which a window is locked."""
USUAL_LOCK_MINUTES: Final = 10
FREE_FAILURES: Final = 5
"""Wrong passwords in a row that have no consequence."""
FIRST_LOCK_S, LONGEST_LOCK_S = 60.0, 3600.0
_NAME: Final = re.compile(r"[^\W_][\w.@-]{0,59}")
_LONGEST_FULL_NAME: Final = 200
_ACCOUNT: Final = "account"
_TELLS_SYSTEM_USER: Final = 160_000
"""Version of PostgreSQL that says how a connection was authenticated."""


@dataclass(frozen=True)
class Account:
    """Who may sign in.

    Parameters
    ----------
    name
        To sign in with; capitals make no difference.
    full_name
        As papers print it.
    failures
        Wrong passwords since the last right one.
    has_first_password
        Whether the password is still the one that an administrator has chosen.
    system_user
        Of the operating system, who needs no password; empty for nobody.
    """

    id: str
    name: str
    full_name: str
    role: Role
    failures: int = 0
    is_disabled: bool = False
    has_first_password: bool = False
    system_user: str = ""


class Accounts:
    """The accounts of a record.

    Parameters
    ----------
    who
        Whoever is signed in, whose rights count and whose name the audit log keeps.
    now
        Seconds since 1970, by the clock of the computer, which may be put forward or back.
    monotonic
        Seconds, by a clock that nobody can change.
    """

    def __init__(
        self,
        database: Database,
        who: Author,
        *,
        now: Callable[[], float] = time.time,
        monotonic: Callable[[], float] = time.monotonic,
    ) -> None:
        self._database = database
        self._who = who
        self._now = now
        self._monotonic = monotonic
        self._locked_here: dict[str, float] = {}
        """By id, until when by the monotonic clock: no jump of the other one shortens a lock."""
        self._failures_here: dict[str, int] = {}
        """By id, where nothing can be written."""

    @property
    def are_on(self) -> bool:
        """Whether somebody has to sign in."""
        with self._database.reading() as connection:
            return accounts_are_on(connection)

    def all(self) -> list[Account]:
        """Return all accounts by name.

        Raises
        ------
        NotAllowed
        """
        with self._database.reading() as connection:
            require(connection, self._who, Right.MANAGE_ACCOUNTS)
            rows = connection.execute(select(schema.accounts).order_by(schema.accounts.c.name))
            return [_account(row) for row in rows]

    def named(self, name: str) -> Account:
        """Return the account of a name, however it is typed.

        Raises
        ------
        InputError
            When there is none.
        NotAllowed
        """
        for account in self.all():
            if account.name == _folded(name):
                return account
        raise InputError("There is no account {name}; look at the list of accounts.", name=name)

    def were_switched_off_unseen(self) -> bool:
        """Return whether accounts are off although the audit log says that they are on."""
        actions = (SWITCHED_ON, SWITCHED_OFF)
        query = select(schema.audit.c.action).where(schema.audit.c.action.in_(actions))
        with self._database.reading() as connection:
            last = connection.execute(query.order_by(schema.audit.c.seq.desc()).limit(1)).scalar()
            return last == SWITCHED_ON and not accounts_are_on(connection)

    def switch_on(self, name: str, full_name: str, password: str) -> Account:
        """Switch accounts on by making the first administrator.

        Raises
        ------
        InputError
            When name or password will not do.
        RecordsError
            When accounts are on already.
        """
        values = _new_account(name, full_name, Role.ADMINISTRATOR, password)
        with self._database.writing() as connection:
            if accounts_are_on(connection):
                raise RecordsError("Accounts are switched on already; sign in.")
            earlier = _find(connection, values["name"])
            if earlier is None:
                connection.execute(insert(schema.accounts).values(values))
            else:  # from when accounts were on before
                values["id"] = earlier.id
                _change(connection, earlier.id, **values, locked_until=None)
            on = {"key": ACCOUNTS_ON, "value": json.dumps(True)}
            connection.execute(insert(schema.clinic).values(on))
            self._log(connection, SWITCHED_ON, values["id"])
        return _account_of(values)

    def switch_off(self) -> None:
        """Let everybody at the computer do everything again; the accounts stay, unused.

        Raises
        ------
        NotAllowed
        """
        with self._database.writing() as connection:
            require(connection, self._who, Right.MANAGE_ACCOUNTS)
            connection.execute(delete(schema.clinic).where(schema.clinic.c.key == ACCOUNTS_ON))
            self._log(connection, SWITCHED_OFF, "all")

    def add(self, name: str, full_name: str, role: Role, password: str) -> Account:
        """Add an account, whose owner has to change the password that they are told.

        That of a scheduled task stays: there is nobody who would change it.

        Raises
        ------
        InputError
            When name or password will not do, or the name is taken.
        NotAllowed
        """
        values = _new_account(name, full_name, role, password)
        values["must_change_password"] = role is not Role.BACKUP_SERVICE
        with self._database.writing() as connection:
            self._require_management(connection)
            if _find(connection, values["name"]) is not None:
                raise InputError(
                    "There is an account {account} already; choose another name.",
                    account=values["name"],
                )
            connection.execute(insert(schema.accounts).values(values))
            self._log(connection, "added", values["id"], role=str(role))
        return _account_of(values)

    def change(self, account: Account) -> None:
        """Give an account another full name, role or system user, or disable it.

        Accounts are disabled and never removed: the record keeps who did what.

        Raises
        ------
        RecordsError
            When no administrator would be left.
        NotAllowed
        """
        full_name = _checked_full_name(account.full_name)
        with self._database.writing() as connection:
            self._require_management(connection)
            _check_system_user(connection, account)
            _change(
                connection,
                account.id,
                full_name=full_name,
                role=str(account.role),
                is_disabled=account.is_disabled,
                system_user=account.system_user or None,
                changed_at=utc_now(),
            )
            if _count_administrators(connection) == 0:
                raise RecordsError(
                    "{account} is the only administrator; make another one first.",
                    account=account.name,
                )
            self._log(
                connection,
                "changed",
                account.id,
                role=str(account.role),
                is_disabled=account.is_disabled,
                has_system_user=bool(account.system_user),
            )

    def reset_password(self, account_id: str, password: str) -> None:
        """Give an account another password, which its owner has to change, and unlock it.

        Raises
        ------
        InputError, NotAllowed
        """
        with self._database.writing() as connection:
            self._require_management(connection)
            found = _get(connection, account_id)
            self._set_password(connection, found, password)
            must_change = word_of(Role, found.role) is not Role.BACKUP_SERVICE
            _change(connection, account_id, must_change_password=must_change)
            self._log(connection, "reset password", account_id)
        self._forgive_here(account_id)

    def unlock(self, account_id: str) -> None:
        """Let somebody try again who has mistyped too often.

        Raises
        ------
        NotAllowed
        """
        with self._database.writing() as connection:
            self._require_management(connection)
            _forgive(connection, account_id)
            self._log(connection, "unlocked", account_id)
        self._forgive_here(account_id)

    def sign_in(self, name: str, password: str) -> Author:
        """Return the author that name and password belong to.

        An attempt is counted before its password is checked, so that attempts at the same time,
        or a program that is killed, gain nothing. A record that may only be read, such as a
        damaged one, counts them as long as the program runs, and its log keeps no line.

        Raises
        ------
        FirstPassword
            When its owner has to choose a password first; not where nothing can be written.
        NotAllowed
            When they are wrong, or the account is locked or disabled.
        """
        with self._database.understanding():
            found, author = self._proven(name, password)
        if found.must_change_password and not self._database.is_read_only:
            with self._database.writing() as connection:
                _forgive(connection, found.id)
            raise FirstPassword(
                "The password of {account} was chosen by somebody else; choose your own.",
                account=found.name,
            )
        if not self._database.is_read_only:
            # From now on a damaged one may only be read, by whoever may.
            with self._database.understanding(), suppress(DamagedDatabase):
                self._note_success(author, found, password)
        return author

    def sign_in_system_user(self) -> Author | None:
        """Return the author whose account belongs to the operating system's user; None for nobody.

        A database's server says who that is (such as by peer authentication), where there is one.
        """
        with self._database.reading() as connection:
            user = system_user() if self._database.is_sqlite else _user_of_server(connection)
            query = select(schema.accounts).where(
                schema.accounts.c.system_user == user, ~schema.accounts.c.is_disabled
            )
            found = connection.execute(query).one_or_none() if user else None
        if found is None:
            return None
        with self._database.understanding():
            author = Author(found.name, self._who.station, Role(found.role), Proof.SYSTEM_USER)
        if not self._database.is_read_only:
            with self._database.writing() as connection:
                AuditLog.append(connection, author, "signed in", _ACCOUNT, found.id)
        return author

    def _proven(self, name: str, password: str) -> tuple[Row[Any], Author]:
        """Return the account that name and password belong to, and its owner.

        Raises
        ------
        NotAllowed
        """
        found = self._count_attempt(_folded(name))
        stored = found.password_hash if found is not None and not found.is_disabled else None
        if not is_password(password, stored) or found is None:
            raise NotAllowed(
                "The name or the password is wrong; try again, or ask the administrator for "
                "another password."
            )
        self._forgive_here(found.id)
        return found, Author(found.name, self._who.station, Role(found.role), Proof.PASSWORD)

    def _note_success(self, author: Author, found: Row[Any], password: str) -> None:
        with self._database.writing() as connection:
            _forgive(connection, found.id)
            if is_outdated(found.password_hash):
                _store_password(connection, found.id, password)
                AuditLog.append(connection, author, "changed password", _ACCOUNT, found.id)
            AuditLog.append(connection, author, "signed in", _ACCOUNT, found.id)

    def change_password(self, name: str, old: str, new: str) -> Author:
        """Let the owner of an account choose another password, and sign them in.

        Raises
        ------
        NotAllowed
            When the old password is wrong, as for `sign_in`.
        InputError
            When the new one will not do.
        """
        proven, author = self._proven(name, old)
        with self._database.writing() as connection:
            _forgive(connection, proven.id)
        with self._database.writing() as connection:
            found = _find(connection, author.name)
            if found is None or found.is_disabled:
                raise NotAllowed("This account was disabled meanwhile; ask the administrator.")
            self._set_password(connection, found, new)
            _change(connection, found.id, must_change_password=False)
            AuditLog.append(connection, author, "signed in", _ACCOUNT, found.id)
            AuditLog.append(connection, author, "changed password", _ACCOUNT, found.id)
        return author

    def _count_attempt(self, name: str) -> Row[Any] | None:
        """Count one more failure, which a right password takes back; return the account.

        Raises
        ------
        NotAllowed
            While the account is locked.
        """
        if self._database.is_read_only:
            found, wait_s = self._count_here(name)
        else:
            try:
                found, wait_s = self._count_in_record(name)
            except DamagedDatabase:  # from now on it may only be read
                found, wait_s = self._count_here(name)
        if wait_s > 0:
            raise NotAllowed(
                "Too many wrong passwords: wait {minutes} min, or ask the administrator to unlock "
                "the account.",
                minutes=int(-(-wait_s // 60)),
            )
        return found

    def _count_in_record(self, name: str) -> tuple[Row[Any] | None, float]:
        """Count one more failure; return the account, and for how many seconds it is locked."""
        with self._database.writing() as connection:
            found = _find(connection, name, for_update=True)
            wait_s = 0.0 if found is None else self._time_locked(connection, found)
            if found is None or wait_s > 0:
                # Not the name that was typed, which is often the password.
                self._log(connection, "refused", "?" if found is None else found.id)
            else:
                self._count_failure(connection, found)
        return found, wait_s

    def _count_here(self, name: str) -> tuple[Row[Any] | None, float]:
        """Do the same where nothing can be written; the lock of the record holds here, too."""
        with self._database.reading() as connection:
            found = _find(connection, name)
        if found is None:
            return None, 0.0
        if found.id not in self._failures_here:
            self._failures_here[found.id] = found.failures
            self._lock_here(found.id, min(self._time_written(found), _lock_s(found.failures)))
        wait_s = self._time_locked_here(found.id)
        if wait_s == 0:
            self._failures_here[found.id] += 1
            self._lock_here(found.id, _lock_s(self._failures_here[found.id]))
        return found, wait_s

    def _lock_here(self, account_id: str, lock_s: float) -> None:
        self._locked_here[account_id] = self._monotonic() + lock_s

    def _time_locked_here(self, account_id: str) -> float:
        return max(self._locked_here.get(account_id, 0.0) - self._monotonic(), 0.0)

    def _time_written(self, found: Row[Any]) -> float:
        """Return for how many seconds the record says that an account is locked."""
        return 0.0 if found.locked_until is None else _read(found.locked_until) - self._now()

    def _forgive_here(self, account_id: str) -> None:
        self._locked_here.pop(account_id, None)
        self._failures_here.pop(account_id, None)

    def _count_failure(self, connection: Connection, found: Row[Any]) -> None:
        lock_s = _lock_s(found.failures + 1)
        values: dict[str, Any] = {"failures": found.failures + 1}
        if lock_s > 0:
            values["locked_until"] = _written(self._now() + lock_s)
            self._lock_here(found.id, lock_s)
            self._log(connection, "locked", found.id, failures=found.failures + 1)
        _change(connection, found.id, **values)

    def _time_locked(self, connection: Connection, found: Row[Any]) -> float:
        """Return for how many seconds an account stays locked; 0 if it is not.

        A clock that was put back would lock it for as long: the lock is never longer than its
        number of failures asks for. One that was put forward does not end a lock of this process,
        and after a new start it allows a single attempt, since failures count until one succeeds.
        """
        there_s = self._time_written(found)
        longest_s = _lock_s(found.failures)
        if there_s > longest_s:
            there_s = longest_s
            _change(connection, found.id, locked_until=_written(self._now() + longest_s))
        return max(self._time_locked_here(found.id), there_s)

    def _set_password(self, connection: Connection, found: Row[Any], password: str) -> None:
        check_password(password, found.name, found.full_name)
        if is_password(password, found.password_hash):
            raise InputError("This is the password that it had before; choose another one.")
        _store_password(connection, found.id, password)
        _forgive(connection, found.id)

    def _require_management(self, connection: Connection) -> None:
        if not accounts_are_on(connection):
            raise RecordsError(
                "Accounts are switched off; switch them on with the first administrator."
            )
        require(connection, self._who, Right.MANAGE_ACCOUNTS)

    def _log(
        self, connection: Connection, action: str, subject_id: str, **details: str | float
    ) -> None:
        AuditLog.append(connection, self._who, action, _ACCOUNT, subject_id, **details)


def _new_account(name: str, full_name: str, role: Role, password: str) -> dict[str, Any]:
    folded = _folded(name)
    if _NAME.fullmatch(folded) is None:
        raise InputError(
            "An account is named by up to 60 letters, digits and the signs . _ - @, and begins "
            "with a letter or digit; choose such a name."
        )
    full_name = _checked_full_name(full_name)
    check_password(password, folded, full_name)
    return {
        "id": str(uuid.uuid4()),
        "name": folded,
        "full_name": full_name,
        "role": str(role),
        "password_hash": hash_password(password),
        "failures": 0,
        "is_disabled": False,
        "must_change_password": False,
        "changed_at": utc_now(),
    }


def _checked_full_name(full_name: str) -> str:
    tidy = " ".join(full_name.split())
    if not 0 < len(tidy) <= _LONGEST_FULL_NAME or not tidy.isprintable():
        raise InputError(
            "An account needs the full name of its owner, of at most {most} characters; type it "
            "as papers print it.",
            most=_LONGEST_FULL_NAME,
        )
    return tidy


def _folded(name: str) -> str:
    return unicodedata.normalize("NFKC", name).strip().casefold()


def _account(row: Row[Any]) -> Account:
    return Account(
        row.id,
        row.name,
        row.full_name,
        Role(row.role),
        row.failures,
        row.is_disabled,
        row.must_change_password,
        row.system_user or "",
    )


def _account_of(values: dict[str, Any]) -> Account:
    return Account(
        values["id"],
        values["name"],
        values["full_name"],
        Role(values["role"]),
        has_first_password=values["must_change_password"],
    )


def _check_system_user(connection: Connection, account: Account) -> None:
    """Refuse a user of the system who has another account: which one would be a guess."""
    query = select(schema.accounts.c.name).where(
        schema.accounts.c.system_user == account.system_user, schema.accounts.c.id != account.id
    )
    other = connection.execute(query).scalar() if account.system_user else None
    if other is not None:
        raise InputError(
            "The user {user} of the system has the account {account} already; choose one of both.",
            user=account.system_user,
            account=other,
        )


def _user_of_server(connection: Connection) -> str:
    """Return whom PostgreSQL knows by the system that both run on; empty for nobody.

    A password of the database is that of the clinic, and says nothing about a person.
    """
    version = int(
        connection.execute(select(func.current_setting("server_version_num"))).scalar_one()
    )
    if version < _TELLS_SYSTEM_USER:
        return ""
    method, _, user = str(connection.execute(text("SELECT system_user")).scalar() or "").partition(
        ":"
    )
    return user if method in ("peer", "gss", "sspi") else ""


def _find(connection: Connection, name: str, *, for_update: bool = False) -> Row[Any] | None:
    query = select(schema.accounts).where(schema.accounts.c.name == name)
    return connection.execute(query.with_for_update() if for_update else query).one_or_none()


def _get(connection: Connection, account_id: str) -> Row[Any]:
    query = select(schema.accounts).where(schema.accounts.c.id == account_id)
    found = connection.execute(query).one_or_none()
    if found is None:
        raise RecordsError("There is no such account any more; look at the list again.")
    return found


def _change(connection: Connection, account_id: str, **values: Any) -> None:
    connection.execute(
        update(schema.accounts).where(schema.accounts.c.id == account_id).values(values)
    )


def _forgive(connection: Connection, account_id: str) -> None:
    _change(connection, account_id, failures=0, locked_until=None)


def _store_password(connection: Connection, account_id: str, password: str) -> None:
    _change(connection, account_id, password_hash=hash_password(password), changed_at=utc_now())


def _count_administrators(connection: Connection) -> int:
    query = select(func.count()).where(
        schema.accounts.c.role == str(Role.ADMINISTRATOR), ~schema.accounts.c.is_disabled
    )
    return int(connection.execute(query).scalar_one())


def _lock_s(failures: int) -> float:
    """Return for how long an account is locked after so many failures."""
    if failures < FREE_FAILURES:
        return 0.0
    return float(min(FIRST_LOCK_S * 2.0 ** min(failures - FREE_FAILURES, 20), LONGEST_LOCK_S))


def _written(time_s: float) -> str:
    return datetime.fromtimestamp(time_s, UTC).strftime("%Y-%m-%dT%H:%M:%S.%fZ")


def _read(text: str) -> float:
    return datetime.fromisoformat(text).timestamp()
