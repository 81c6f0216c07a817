"""Comparing every row with what the audit log says of it."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from sqlalchemy import Connection, select

from insole_core.messages import Message, counted
from insole_core.progress import SILENT, Progress
from insole_core.records.audit import SEALED_ROWS, AuditLog
from insole_core.records.author import Author
from insole_core.records.clinic import ERASING
from insole_core.records.content_store import IDENTITY_VALUE
from insole_core.records.rights import ACCOUNTS_ON, accounts_are_on
from insole_core.records.row_seals import ROW, SEALED, all_digests
from insole_core.records.schema import audit

SWITCHED_ON, SWITCHED_OFF = "switched on", "switched off"
_PROVEN_OTHERWISE = (ACCOUNTS_ON, IDENTITY_VALUE)
"""Settings without a digest, as those of an erasure: the log tells the one, the folder of the files
the other."""


@dataclass(frozen=True)
class RowReport:
    """What a comparison of the rows with the audit log found, by what its lines call them.

    Parameters
    ----------
    checked
        Number of rows that were compared.
    changed
        Ids of rows that are not what was stored.
    missing
        Ids of rows that are gone, although nobody has erased them.
    unlogged
        Ids of rows that no line knows.
    were_accounts_on
        What the log says where the record says otherwise; None where both agree.
    """

    checked: int = 0
    changed: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    missing: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    unlogged: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    were_accounts_on: bool | None = None


def problems_of_rows(rows: RowReport) -> Iterator[Message]:
    """Yield what is wrong with rows, a sentence for each kind."""
    for found, one, several in (
        (
            rows.changed,
            "One row of {kind} is not what the audit log says was stored: {first}; compare it with "
            "a backup.",
            "{count} rows of {kind} are not what the audit log says was stored, the first is "
            "{first}; compare them with a backup.",
        ),
        (
            rows.missing,
            "One row of {kind} is gone that the audit log knows: {first}; compare the record with "
            "a backup.",
            "{count} rows of {kind} are gone that the audit log knows, the first is {first}; "
            "compare the record with a backup.",
        ),
        (
            rows.unlogged,
            "One row of {kind} is in no line of the audit log: {first}; compare the record with a "
            "backup.",
            "{count} rows of {kind} are in no line of the audit log, the first is {first}; compare "
            "the record with a backup.",
        ),
    ):
        for kind, ids in found.items():
            yield counted(len(ids), one, several, kind=kind, first=ids[0][:12])
    if rows.were_accounts_on:
        yield Message(
            "Accounts are off, although nobody has switched them off: anybody may do anything; "
            "switch them on again, and compare the record with a backup."
        )
    elif rows.were_accounts_on is False:
        yield Message(
            "Accounts are on, although nobody has switched them on; compare the record with a "
            "backup."
        )


def verify_rows(connection: Connection, progress: Progress = SILENT) -> RowReport:
    """Compare all rows that lines of the audit log are about with the digests in it.

    Raises
    ------
    Cancelled
    """
    known, said_on = _logged(connection)
    checked = 0
    changed: dict[str, list[str]] = {}
    unlogged: dict[str, list[str]] = {}
    for number, (kind, table) in enumerate(SEALED.items()):
        progress.step(number / len(SEALED), "Comparing the record with the audit log")
        for id_, digest in all_digests(connection, table):
            checked += 1
            logged = known[kind].pop(id_, None)
            is_proven = id_ in _PROVEN_OTHERWISE or id_.startswith(ERASING)
            if logged is None and not is_proven:
                unlogged.setdefault(kind, []).append(id_)
            elif logged not in (None, digest):
                changed.setdefault(kind, []).append(id_)
    are_on = accounts_are_on(connection)
    return RowReport(
        checked,
        {kind: tuple(ids) for kind, ids in changed.items()},
        {kind: tuple(sorted(ids)) for kind, ids in known.items() if ids},
        {kind: tuple(ids) for kind, ids in unlogged.items()},
        said_on if said_on != are_on else None,
    )


def seal_everything(connection: Connection, author: Author) -> None:
    """Note all rows in the log as they are: of a record from before it kept digests."""
    for kind, table in SEALED.items():
        AuditLog.seal(connection, author, kind, [id_ for id_, _ in all_digests(connection, table)])


def _logged(connection: Connection) -> tuple[dict[str, dict[str, str]], bool]:
    """Return the last digest of every row by kind and id, and whether accounts were left on."""
    known: dict[str, dict[str, str]] = {kind: {} for kind in SEALED}
    are_on = False
    query = select(audit.c.action, audit.c.subject_kind, audit.c.subject_id, audit.c.details)
    for row in connection.execute(query.order_by(audit.c.seq).execution_options(yield_per=5000)):
        if row.action in (SWITCHED_ON, SWITCHED_OFF):
            are_on = row.action == SWITCHED_ON
        if row.action == SEALED_ROWS:
            for id_, digest in json.loads(row.details).items():
                known[row.subject_kind][id_] = digest
                if not digest:
                    del known[row.subject_kind][id_]
        elif f'"{ROW}":' in row.details and row.subject_kind in known:
            known[row.subject_kind][row.subject_id] = json.loads(row.details)[ROW]
    return known, are_on
