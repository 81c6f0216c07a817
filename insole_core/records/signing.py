"""Signing a version of a prescription, which makes it immutable.

The signature is the SHA-256 of all that the version states, kept with the version and in the audit
log. Changing one of them is told by the other, and changing the log by its chain. Where its person
is erased, the version loses names and notes; the signature stays, and the log keeps the SHA-256 of
what the version states from then on, if it was sound before.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final

from sqlalchemy import Connection, Row, select, update

from insole_core.errors import RecordsError
from insole_core.progress import SILENT, Progress
from insole_core.records.audit import AuditLog
from insole_core.records.author import Author, utc_now
from insole_core.records.rights import Right, require
from insole_core.records.schema import audit, prescription_versions

SIGNED: Final = "signed"
ERASED: Final = "erased"
REDACTED: Final = "redacted"
PRESCRIPTION: Final = "prescription"
SIGNED_COLUMNS: Final = (
    "id",
    "visit_id",
    "side",
    "number",
    "document",
    "mesh_sha256",
    "capture_id",
    "author",
    "station",
    "reason",
    "program_version",
    "created_at",
    "signed_by",
    "signed_at",
)
"""What a signature covers: everything that a version states, and the scan by its digest."""
_BATCH: Final = 200


@dataclass(frozen=True)
class Signature:
    """Who has signed what.

    Parameters
    ----------
    digest
        SHA-256 of what was signed, in hexadecimal.
    """

    version_id: str
    signed_by: str
    signed_at: str
    digest: str


@dataclass(frozen=True)
class SignatureReport:
    """What a verification of all signatures found.

    Parameters
    ----------
    changed
        Ids of signed versions that are not what was signed.
    unlogged
        Ids of signed versions whose signature is not in the audit log.
    missing
        Ids of versions that were signed and are gone, although nobody has erased them.
    """

    checked: int
    changed: tuple[str, ...] = ()
    unlogged: tuple[str, ...] = ()
    missing: tuple[str, ...] = ()


def digest_of(version: Mapping[str, Any]) -> str:
    """Return the digest that a signature of a version is: SHA-256 of a JSON array in ASCII.

    Parameters
    ----------
    version
        Values of `SIGNED_COLUMNS`, in whose order they are written.
    """
    content = json.dumps([version[name] for name in SIGNED_COLUMNS], separators=(",", ":"))
    return hashlib.sha256(content.encode("ascii")).hexdigest()


def sign(connection: Connection, version_id: str, author: Author) -> Signature:
    """Sign a version and close it, in a transaction of the caller.

    Raises
    ------
    NotAllowed
        When the account may not sign.
    RecordsError
        When there is no such version, or it is signed already.
    """
    require(connection, author, Right.SIGN)
    columns = prescription_versions.c
    query = select(prescription_versions).where(columns.id == version_id).with_for_update()
    row = connection.execute(query).one_or_none()
    if row is None:
        raise RecordsError(
            "This version of the prescription is not in the record any more; look at its history."
        )
    if row.signed_at is not None:
        raise RecordsError(
            "{name} has signed this version already; make a new one to change it.",
            name=str(row.signed_by),
        )
    signed = {"signed_by": author.name, "signed_at": utc_now()}
    digest = digest_of({**row._asdict(), **signed})
    connection.execute(
        update(prescription_versions)
        .where(columns.id == version_id)
        .values(
            **signed,
            signature=digest,
            is_closed=True,
            # A station that still edits it learns of the signature; what is closed stays as it is.
            revision=row.revision + (0 if row.is_closed else 1),
        )
    )
    AuditLog.append(connection, author, SIGNED, PRESCRIPTION, version_id, signature=digest)
    return Signature(version_id, signed["signed_by"], signed["signed_at"], digest)


def is_as_signed(connection: Connection, row: Row[Any]) -> bool:
    """Return whether a signed version still states what was signed, without what was erased.

    Parameters
    ----------
    row
        Of `prescription_versions`.
    """
    return digest_of(row._asdict()) == _expected(row, _logged(connection, row.id).get(row.id))


def note_redaction(connection: Connection, author: Author, row: Row[Any]) -> None:
    """Note in the log what a signed version states after the erasure of its person."""
    digest = digest_of(row._asdict())
    details = {"signature": row.signature, "digest": digest}
    AuditLog.append(connection, author, REDACTED, PRESCRIPTION, row.id, **details)


def verify_signatures(connection: Connection, progress: Progress = SILENT) -> SignatureReport:
    """Compare every signed version with its signature, and that with the audit log.

    Raises
    ------
    Cancelled
    """
    checked, changed, unlogged = 0, [], []
    logged = _logged(connection)
    for row in _signed(connection):
        checked += 1
        if checked % _BATCH == 0:
            progress.step(0.0, "Verifying {count} signatures", count=checked)
        known = logged.pop(row.id, None)
        if digest_of(row._asdict()) != _expected(row, known) or not row.is_closed:
            changed.append(row.id)
        elif known is None or known.signature != row.signature:
            unlogged.append(row.id)
    return SignatureReport(checked, tuple(changed), tuple(unlogged), tuple(sorted(logged)))


def _signed(connection: Connection) -> Iterator[Row[Any]]:
    query = (
        select(prescription_versions)
        .where(prescription_versions.c.signed_at.is_not(None))
        .order_by(prescription_versions.c.id)
        .execution_options(yield_per=_BATCH)
    )
    with connection.execute(query) as result:
        yield from result


@dataclass(frozen=True)
class _Logged:
    """What the audit log knows of a signed version.

    Parameters
    ----------
    redacted
        Digest of what the last erasure has left of it; empty without one.
    """

    signature: str
    redacted: str


def _expected(row: Row[Any], logged: _Logged | None) -> str:
    """Return the digest that a signed version should have."""
    return (logged.redacted if logged is not None else "") or str(row.signature)


def _logged(connection: Connection, version_id: str | None = None) -> dict[str, _Logged]:
    """Return what the audit log knows of signed versions, or of one, without removed ones."""
    actions = [SIGNED, REDACTED, ERASED]
    query = (
        select(audit.c.subject_id, audit.c.action, audit.c.details)
        .where(audit.c.subject_kind == PRESCRIPTION, audit.c.action.in_(actions))
        .order_by(audit.c.seq)
    )
    if version_id is not None:
        query = query.where(audit.c.subject_id == version_id)
    logged: dict[str, _Logged] = {}
    for row in connection.execute(query):
        if row.action == ERASED:
            logged.pop(row.subject_id, None)
            continue
        details = json.loads(row.details)
        logged[row.subject_id] = _Logged(details.get("signature", ""), details.get("digest", ""))
    return logged
