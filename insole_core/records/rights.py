"""What an account may do, by its role (decision 0045)."""

from __future__ import annotations

import json
from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType
from typing import Final

from sqlalchemy import Connection, select

from insole_core.errors import NotAllowed
from insole_core.messages import joined
from insole_core.records.author import Author, Proof, Role
from insole_core.records.checked_values import word_of
from insole_core.records.schema import accounts, clinic

ACCOUNTS_ON: Final = "accounts_on"
"""Key of the clinic's settings; absent while everybody at the computer may do everything."""


class Right(StrEnum):
    """What somebody may be allowed to do; the value completes "may not …"."""

    SEE = "see patients"
    WRITE = "change patients, visits and prescriptions"
    CAPTURE = "add captures"
    ORDER = "place and follow orders"
    EXPORT = "export patients"
    SIGN = "sign prescriptions"
    MERGE = "merge patients"
    ERASE = "erase patients"
    READ_AUDIT = "read the audit log"
    BACK_UP = "make backups"
    SET_UP = "change the settings of the clinic"
    MANAGE_ACCOUNTS = "manage accounts"


_CLINICAL: Final = frozenset(
    {Right.SEE, Right.WRITE, Right.CAPTURE, Right.ORDER, Right.EXPORT, Right.BACK_UP}
)
RIGHTS: Final[Mapping[Role, frozenset[Right]]] = MappingProxyType(
    {
        Role.ORTHOPEDIST: _CLINICAL | {Right.SIGN, Right.MERGE},
        Role.TECHNICIAN: _CLINICAL - {Right.EXPORT},
        Role.ADMINISTRATOR: frozenset(
            {
                Right.ERASE,
                Right.READ_AUDIT,
                Right.BACK_UP,
                Right.SET_UP,
                Right.MANAGE_ACCOUNTS,
            }
        ),
        Role.BACKUP_SERVICE: frozenset({Right.BACK_UP}),
    }
)
"""Who prescribes does not manage accounts, and who manages accounts does not see patients. Erasing
is the administrator's: it needs no look at the patient, and comes from a written request."""


def accounts_are_on(connection: Connection) -> bool:
    """Return whether somebody has to sign in."""
    value = connection.execute(select(clinic.c.value).where(clinic.c.key == ACCOUNTS_ON)).scalar()
    return value is not None and json.loads(value) is True


def require(connection: Connection, author: Author, right: Right) -> None:
    """Check that somebody may do something: the one check that all doors of the record share.

    While accounts are off, everybody may do everything. Once they are on, a name alone is nobody:
    it takes a proof. The role is that of the account in the database, so that whoever is demoted or
    disabled meanwhile stops at their next step.

    Raises
    ------
    NotAllowed
    """
    role = require_signed_in(connection, author)
    if role is not None and right not in RIGHTS[role]:
        allowed = [other for other in Role if right in RIGHTS[other]]
        raise NotAllowed(
            "The account {account} ({role}) may not {action}; ask somebody who may: {who}.",
            account=author.name,
            role=str(role),
            action=str(right),
            who=joined(allowed, " / "),
        )


def require_signed_in(connection: Connection, author: Author) -> Role | None:
    """Check that somebody has an account, whatever it may do, and return its role.

    Returns
    -------
    Role or None
        None while accounts are off.

    Raises
    ------
    NotAllowed
    """
    if not accounts_are_on(connection):
        return None
    query = select(accounts.c.role).where(accounts.c.name == author.name, ~accounts.c.is_disabled)
    role = None if author.proof is Proof.NONE else connection.execute(query).scalar()
    if role is None:
        raise NotAllowed("You are not signed in; sign in with your account of the record first.")
    return word_of(Role, role)
