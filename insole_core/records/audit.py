"""The audit log: who saw, changed and exported what, in lines that can only be appended.

Each line holds the SHA-256 of itself and of the line before it, and `audit_head` that of the last
one. Whoever changes, removes or inserts a line breaks the chain from there on, unless they write
all later lines again; the heads in backups and on statements tell that as well. The database
refuses to change or delete lines (triggers of the migrations).
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any, Final, TypeAlias

from sqlalchemy import (
    Column,
    ColumnElement,
    Connection,
    Row,
    Select,
    false,
    func,
    insert,
    select,
    update,
)

from insole_core.messages import Message, counted
from insole_core.progress import SILENT, Progress
from insole_core.records.author import Author, Proof, utc_now
from insole_core.records.checked_values import highest, lowest
from insole_core.records.database import Database
from insole_core.records.rights import Right, require
from insole_core.records.row_seals import ROW, SEALED, digests_of
from insole_core.records.schema import FIRST_HASH, audit, audit_head

Detail: TypeAlias = str | int | float | bool | None
LONGEST_DETAIL: Final = 200
"""Details are numbers, ids, hashes and names of fields; a longer text is about a patient."""
SIGNED_IN_BY: Final = "signed_in_by"
"""Detail of every line of somebody who has signed in: how it was proven who they are."""
_WORD: Final = re.compile(r"[a-z][a-z_ ]{0,39}")
_HEAD_ROW: Final = 1
_BATCH: Final = 5000
SEALED_ROWS: Final = "sealed"
_SEALS_OF_LINE: Final = 100
_CHANGES_NOTHING: Final = frozenset(
    {"seen", "exported", "signed in", "refused", "locked", "unlocked", "switched off"}
)
"""What is done to a row that stays what it is: its line vouches for nothing."""
_ENCODER: Final = json.JSONEncoder(separators=(",", ":"))
_COLUMNS: Final = (
    audit.c.seq,
    audit.c.at,
    audit.c.author,
    audit.c.station,
    audit.c.action,
    audit.c.subject_kind,
    audit.c.subject_id,
    audit.c.details,
    audit.c.previous_hash,
    audit.c.hash,
)


@dataclass(frozen=True)
class AuditLine:
    """One line of the log.

    Parameters
    ----------
    seq
        1, 2, 3, … without gaps.
    at
        UTC, by the clock of the station; the order is that of `seq`.
    action, subject_kind, subject_id
        What was done to what, such as "changed", "person", its id.
    details
        JSON object without personal data.
    hash
        Of all the above and of `previous_hash`, see `hash_of_line`.
    """

    seq: int
    at: str
    author: str
    station: str
    action: str
    subject_kind: str
    subject_id: str
    details: str
    previous_hash: str
    hash: str


@dataclass(frozen=True)
class AuditReport:
    """What a verification of the log found.

    Parameters
    ----------
    lines
        Number of lines that are intact, from the first one on.
    head
        Hash of the last intact line.
    broken_line
        `seq` of the first line that is not what was written, or is missing.
    problem
        What is wrong there, in one sentence.
    """

    lines: int
    head: str
    broken_line: int | None = None
    problem: Message | None = None

    @property
    def is_intact(self) -> bool:
        """Whether every line is what was written, and none is missing."""
        return self.problem is None


class AuditLog:
    """The audit log of a record.

    Parameters
    ----------
    who
        Whoever reads it, which only an account with the right to it may.
    """

    def __init__(self, database: Database, who: Author) -> None:
        self._database = database
        self._who = who

    @staticmethod
    def append(
        connection: Connection,
        author: Author,
        action: str,
        subject_kind: str,
        subject_id: str,
        **details: Detail,
    ) -> AuditLine:
        """Write a line in the transaction of what it tells.

        It locks the head of the log, so it comes last in a transaction: until its end, no other
        line can be written.

        Parameters
        ----------
        action, subject_kind
            Words such as "signed" and "prescription".
        details
            Numbers, ids, hashes and names of fields; no personal data.

        Raises
        ------
        ValueError
            When a word or a detail is not such a one: an error of the program.
        """
        (line,) = AuditLog.append_each(
            connection, author, action, subject_kind, [subject_id], **details
        )
        return line

    @staticmethod
    def append_each(
        connection: Connection,
        author: Author,
        action: str,
        subject_kind: str,
        subject_ids: Sequence[str],
        **details: Detail,
    ) -> list[AuditLine]:
        """Do the same as `append` for each of some subjects, at least one.

        The line about a change of a row holds its digest (`row_seals`).
        """
        if author.proof is not Proof.NONE:
            details = {**details, SIGNED_IN_BY: str(author.proof)}
        for subject_id in subject_ids:
            _check_words(action, subject_kind, subject_id, details)
        table = None if action in _CHANGES_NOTHING else SEALED.get(subject_kind)
        digests = {} if table is None else digests_of(connection, table, subject_ids)
        written = [
            _written({**details, ROW: digests[id_]} if id_ in digests else details)
            for id_ in subject_ids
        ]
        return _append(connection, author, (action, subject_kind), subject_ids, written)

    @staticmethod
    def seal(connection: Connection, author: Author, kind: str, ids: Sequence[str]) -> None:
        """Note the digests of rows that change with another one, or came without a line.

        Parameters
        ----------
        kind
            As lines call such rows, of `SEALED`.
        ids
            One that is not there any more is noted as removed.
        """
        for start in range(0, len(ids), _SEALS_OF_LINE):
            some = ids[start : start + _SEALS_OF_LINE]
            found = digests_of(connection, SEALED[kind], some)
            content = _written({id_: found.get(id_, "") for id_ in some})
            _append(connection, author, (SEALED_ROWS, kind), ["rows"], [content])

    def lines(
        self,
        *,
        subject_id: str | None = None,
        about: Select[Any] | None = None,
        author: str | None = None,
        times: tuple[str, str] | None = None,
        before: int | None = None,
        limit: int = 100,
    ) -> list[AuditLine]:
        """Return the latest lines, newest first.

        Parameters
        ----------
        subject_id
            Only lines about this person, visit, … .
        about
            Only lines about one of the ids that this query finds.
        author
            Only lines of this author.
        times
            Only lines of this time: its beginning, and its end, which is not part of it; UTC, as
            the lines have it.
        before
            Only lines with a smaller `seq`: the next page.
        """
        query = select(*_COLUMNS).order_by(audit.c.seq.desc()).limit(limit)
        if subject_id is not None:
            query = query.where(audit.c.subject_id == subject_id)
        if about is not None:
            query = query.where(audit.c.subject_id.in_(about))
        if author is not None:
            is_alone = about is None and subject_id is None
            by = audit.c.author if is_alone else _unindexed(audit.c.author)
            query = query.where(by == author)
        if before is not None:
            query = query.where(audit.c.seq < before)
        with self._reading() as connection:
            if times is not None:
                query = _within(connection, query, times)
            return [AuditLine(**row._mapping) for row in connection.execute(query)]

    def head(self) -> tuple[int, str]:
        """Return number and hash of the last line; 0 and zeros of an empty log."""
        with self._reading() as connection:
            return head_of(connection)

    def verify(
        self, known: Mapping[int, str] | None = None, progress: Progress = SILENT
    ) -> AuditReport:
        """Read all lines and compare them with their hashes, in little memory.

        Parameters
        ----------
        known
            Hashes of lines by number, as backups keep them: who has written all lines again is
            found by these.

        Raises
        ------
        Cancelled
        """
        with self._reading() as connection:
            return verify_chain(connection, known, progress)

    @contextmanager
    def _reading(self) -> Iterator[Connection]:
        with self._database.reading() as connection:
            require(connection, self._who, Right.READ_AUDIT)
            yield connection


def _append(
    connection: Connection,
    author: Author,
    what: tuple[str, str],
    subject_ids: Sequence[str],
    details: Sequence[str],
) -> list[AuditLine]:
    """Write lines behind the last one, which is locked from here on."""
    seq, previous_hash = connection.execute(
        select(audit_head.c.seq, audit_head.c.hash)
        .where(audit_head.c.id == _HEAD_ROW)
        .with_for_update()
    ).one()
    who = (author.name, author.station)
    lines: list[AuditLine] = []
    for number, (subject_id, written) in enumerate(zip(subject_ids, details, strict=True), seq + 1):
        fields = (number, utc_now(), *who, *what, subject_id, written, previous_hash)
        lines.append(AuditLine(*fields, hash=hash_of_line(fields)))
        previous_hash = lines[-1].hash
    connection.execute(insert(audit), [vars(line) for line in lines])
    connection.execute(update(audit_head).values(seq=lines[-1].seq, hash=lines[-1].hash))
    return lines


def _written(details: Mapping[str, Detail]) -> str:
    return json.dumps(details, sort_keys=True, separators=(",", ":"), allow_nan=False)


def head_of(connection: Connection) -> tuple[int, str]:
    """Return number and hash of the last line, as `audit_head` states them."""
    seq, head = connection.execute(select(audit_head.c.seq, audit_head.c.hash)).one()
    return int(seq), str(head)


def _within(connection: Connection, query: Select[Any], times: tuple[str, str]) -> Select[Any]:
    """Return a query of lines of a time alone.

    The first and the last of these lines are found by the index of times. Between them, lines are
    read in their order, which a clock that jumps does not tell.
    """
    begin, end = times
    seq = audit.c.seq + 0  # else PostgreSQL looks for the first one from the first line on
    bounds = select(lowest(seq), highest(seq)).where(audit.c.at >= begin, audit.c.at < end)
    first, last = connection.execute(bounds).one()
    if first is None:
        return query.where(false())
    at = _unindexed(audit.c.at)  # else a database may sort all lines of the time
    return query.where(audit.c.seq >= first, audit.c.seq <= last, at >= begin, at < end)


def _unindexed(column: Column[str]) -> ColumnElement[str]:
    """Return a column for a comparison that is not worth a search by its index."""
    return func.coalesce(column, "")


def hash_of_line(fields: tuple[Any, ...]) -> str:
    """Return the hash of a line: SHA-256 of a JSON array of its fields in ASCII.

    Parameters
    ----------
    fields
        seq, at, author, station, action, subject_kind, subject_id, details, previous_hash.
    """
    return hashlib.sha256(_ENCODER.encode(fields).encode("ascii")).hexdigest()


def verify_chain(
    connection: Connection,
    known: Mapping[int, str] | None = None,
    progress: Progress = SILENT,
) -> AuditReport:
    """Verify the log as a transaction sees it; see `AuditLog.verify`."""
    known = known or {}
    head_seq, head_hash = head_of(connection)
    number, previous = 0, FIRST_HASH
    for row in _rows(connection):
        number += 1
        if number % _BATCH == 0:
            progress.step(min(number / max(head_seq, 1), 1), "Verifying the audit log")
        problem = _problem_of(row, number, previous, known.get(number))
        if problem is not None:
            return AuditReport(number - 1, previous, number, problem)
        previous = row.hash
    last = max(head_seq, *known) if known else head_seq
    if number != last:
        problem = counted(
            last,
            "The audit log ends with line {last}, but one line was written; compare it with a "
            "backup.",
            "The audit log ends with line {last}, but {count} lines were written; compare it with "
            "a backup.",
            last=number,
        )
        return AuditReport(number, previous, min(number, last) + 1, problem)
    if previous != head_hash:
        problem = Message(
            "Line {number} of the audit log is not the last one that was written; compare it with "
            "a backup.",
            number=number,
        )
        return AuditReport(number, previous, number, problem)
    return AuditReport(number, previous)


def compared_with_note(report: AuditReport, noted: Mapping[int, str]) -> AuditReport:
    """Return a report that also tells that no last line was noted beside the files, if so.

    Parameters
    ----------
    noted
        What `HeadWitness.read` returned. Whoever writes a line notes it, so that a log with lines
        has its note, unless somebody took it away.
    """
    if noted or report.problem is not None or report.lines == 0:
        return report
    problem = counted(
        report.lines,
        "The audit log has one line, and it is not noted beside the files any more, so that an end "
        "that was cut off would not be seen; compare the record with a backup. The next change "
        "notes it again.",
        "The audit log has {count} lines, and the last one is not noted beside the files any more, "
        "so that an end that was cut off would not be seen; compare the record with a backup. The "
        "next change notes it again.",
    )
    return replace(report, problem=problem)


def _rows(connection: Connection) -> Iterator[Any]:
    query = select(*_COLUMNS).order_by(audit.c.seq).execution_options(yield_per=_BATCH)
    with connection.execute(query) as result:
        yield from result


def _problem_of(row: Row[Any], number: int, previous: str, known: str | None) -> Message | None:
    """Return what is wrong with the line that should have this number."""
    if row.seq != number:
        return Message(
            "Line {number} of the audit log is missing; compare it with a backup.", number=number
        )
    is_written = row.hash == hash_of_line(tuple(row[:-1])) and row.hash == (known or row.hash)
    if row.previous_hash != previous or not is_written:
        return Message(
            "Line {number} of the audit log ({at}) is not what was written; compare it with a "
            "backup.",
            number=number,
            at=str(row.at)[:40],
        )
    return None


def _check_words(
    action: str, subject_kind: str, subject_id: str, details: Mapping[str, Detail]
) -> None:
    if not (_WORD.fullmatch(action) and _WORD.fullmatch(subject_kind)):
        raise ValueError(f"no words of the audit log: {action!r}, {subject_kind!r}")
    texts = [value for value in (subject_id, *details.values()) if isinstance(value, str)]
    if any(len(text) > LONGEST_DETAIL for text in texts):
        raise ValueError(f"a detail of {action} {subject_kind} is too long for the audit log")
