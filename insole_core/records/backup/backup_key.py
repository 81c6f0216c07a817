"""The key of a clinic's backups: whoever makes them cannot read them.

A backup is encrypted to a public key (age, X25519), which the record keeps, so that backups on a
schedule ask for nothing. The private key is encrypted with the clinic's passphrase, or to the age
recipients of somebody who keeps backups for it, and lies beside the backup.
"""

from __future__ import annotations

import base64
import hashlib
import hmac
import json
import secrets
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any, Final, Self

import pyrage

from insole_core.errors import InputError, RecordsError

SHORTEST_PASSPHRASE: Final = 12
_IDENTITY_PREFIX: Final = "AGE-SECRET-KEY-"


class WrongSecret(RecordsError):  # noqa: N818 - as the other errors of the record
    """Passphrase or private key do not open a backup."""


class DamagedBackup(RecordsError):  # noqa: N818
    """A part of a backup is missing, or is not what was written."""

    @property
    def part(self) -> str:
        """Name of its file."""
        return str(self.message.values["name"])


@dataclass(frozen=True)
class BackupKey:
    """What is needed to make a backup.

    Parameters
    ----------
    recipient
        Public key, ``age1…``.
    mac_key
        Authenticates what the record has written, in hexadecimal: the public key alone lets
        anybody write a backup that can be read.
    locked
        The private key and `mac_key`, encrypted, in base64.
    opened_by
        "passphrase" or "private key".
    recipients
        Those of `for_recipients`, which `locked` does not tell; a key of an older program has none.
    """

    recipient: str
    mac_key: str
    locked: str
    opened_by: str
    recipients: tuple[str, ...] = ()

    @classmethod
    def with_passphrase(cls, passphrase: str) -> Self:
        """Make a key that a passphrase opens.

        Raises
        ------
        InputError
            When the passphrase is too short.
        """
        if len(passphrase.strip()) < SHORTEST_PASSPHRASE:
            raise InputError(
                "The passphrase of a backup needs at least {least} characters; take four words or "
                "more, and keep it where the backup is not.",
                least=SHORTEST_PASSPHRASE,
            )
        return cls._make("passphrase", lambda key: pyrage.passphrase.encrypt(key, passphrase))

    @classmethod
    def for_recipients(cls, recipients: Sequence[str]) -> Self:
        """Make a key that the private key of any age recipient opens.

        Raises
        ------
        InputError
            When one of them is no recipient of age.
        """
        try:
            known = list(map(pyrage.x25519.Recipient.from_str, _stripped(recipients)))
        except pyrage.RecipientError:
            known = []
        if not known:
            raise InputError(
                "A recipient of backups is named by its public key of age; give it as age1… ."
            )
        made = cls._make("private key", lambda key: pyrage.encrypt(key, known))
        return replace(made, recipients=_stripped(recipients))

    def is_for(self, recipients: Sequence[str]) -> bool:
        """Return whether it was made for these recipients, as far as it knows."""
        return set(self.recipients) == set(_stripped(recipients))

    def is_opened_by(self, passphrase: str) -> bool:
        """Return whether a passphrase opens it, which takes a second."""
        try:
            open_key(self.locked, passphrase)
        except WrongSecret:
            return False
        return True

    @classmethod
    def _make(cls, opened_by: str, lock: Any) -> Self:
        identity = pyrage.x25519.Identity.generate()
        mac_key = secrets.token_hex(32)
        content = json.dumps({"identity": str(identity), "mac_key": mac_key}).encode("ascii")
        locked = base64.b64encode(lock(content)).decode("ascii")
        return cls(str(identity.to_public()), mac_key, locked, opened_by)

    @classmethod
    def from_json(cls, values: dict[str, Any]) -> Self:
        """Read a key as `as_json` writes it."""
        return cls(
            values["recipient"],
            values["mac_key"],
            values["locked"],
            values["opened_by"],
            tuple(values.get("recipients", ())),
        )

    def as_json(self) -> dict[str, Any]:
        """Return the values that the record keeps."""
        return asdict(self)


def _stripped(recipients: Sequence[str]) -> tuple[str, ...]:
    return tuple(text.strip() for text in recipients)


@dataclass(frozen=True)
class OpenedKey:
    """What is needed to read a backup.

    Parameters
    ----------
    identity
        Private key.
    """

    identity: str
    mac_key: str

    def decrypt(self, content: bytes, name: str) -> bytes:
        """Return what was encrypted to the key.

        Raises
        ------
        DamagedBackup
            When it is not what was written.
        """
        try:
            decrypted: bytes = pyrage.decrypt(content, [self._identity()])
        except pyrage.DecryptError as error:
            raise damaged(name) from error
        return decrypted

    def identities(self) -> list[Any]:
        """Return the private keys as age takes them."""
        return [self._identity()]

    def _identity(self) -> Any:
        return pyrage.x25519.Identity.from_str(self.identity)


def open_key(locked: str, secret: str) -> OpenedKey:
    """Open the key of a backup.

    Parameters
    ----------
    locked
        As a `BackupKey` has it.
    secret
        The passphrase, or a private key of age (``AGE-SECRET-KEY-1…``).

    Raises
    ------
    WrongSecret
        When it does not open the backup, or was damaged: age cannot tell these apart.
    """
    try:
        sealed = base64.b64decode(locked, validate=True)
        if secret.strip().startswith(_IDENTITY_PREFIX):
            identity = pyrage.x25519.Identity.from_str(secret.strip())
            content = pyrage.decrypt(sealed, [identity])
        else:
            content = pyrage.passphrase.decrypt(sealed, secret)
        values = json.loads(content)
        opened = OpenedKey(values["identity"], values["mac_key"])
        opened.identities()
        bytes.fromhex(opened.mac_key)
        return opened
    except (pyrage.DecryptError, pyrage.IdentityError, ValueError, KeyError, TypeError) as error:
        raise WrongSecret(
            "The passphrase or private key does not open this backup; check how it is written, and "
            "that it is that of this backup."
        ) from error


def authenticate(mac_key: str, content: bytes) -> str:
    """Return the HMAC-SHA256 of a content, in hexadecimal."""
    return hmac.new(bytes.fromhex(mac_key), content, hashlib.sha256).hexdigest()


def damaged(name: str) -> DamagedBackup:
    """Return the error about a part that is not what was written."""
    return DamagedBackup(
        "The backup is damaged: {name} is not what was written; use an earlier backup or another "
        "copy.",
        name=name,
    )


def missing(name: str) -> DamagedBackup:
    """Return the error about a part that is not there."""
    return DamagedBackup(
        "The backup is incomplete: {name} is missing; use an earlier backup or another copy.",
        name=name,
    )
