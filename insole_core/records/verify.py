"""Verifying a whole record: audit log, signatures, files, and what refers to what."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from sqlalchemy import Connection, ForeignKeyConstraint, and_, exists, func, select, text

from insole_core.messages import Message, counted
from insole_core.progress import SILENT, Progress
from insole_core.records.audit import AuditReport, compared_with_note, verify_chain
from insole_core.records.content_store import ContentReport
from insole_core.records.context import RecordsContext
from insole_core.records.rights import Right, require
from insole_core.records.row_report import RowReport, problems_of_rows, verify_rows
from insole_core.records.schema import contents, metadata
from insole_core.records.signing import SignatureReport, verify_signatures


@dataclass(frozen=True)
class VerifyReport:
    """What a verification of the record found.

    Parameters
    ----------
    references
        Tables with rows that refer to something that is not there, and the number of such rows.
    rows
        Of persons, visits, captures, prescriptions, orders, follow-ups, accounts and settings.
    database_problem
        What the database itself says about its file; empty if all is well, or on a server.
    is_noted
        Whether the last line of the audit log was noted beside the files, to compare with.
    """

    audit: AuditReport
    signatures: SignatureReport
    contents: ContentReport
    references: Mapping[str, int]
    rows: RowReport
    database_problem: str = ""
    is_noted: bool = True

    def compared(self) -> Message:
        """Return what was compared, and with what."""
        return Message(
            "Compared: {lines} of the audit log {others}; {rows} (persons, visits, captures, "
            "prescriptions, orders, follow-ups, accounts with roles and passwords, settings) with "
            "what the log says of their last change; whether accounts are on; {signatures}; "
            "{files}, by their SHA-256. Not compared: who works where just now, failed sign-ins, "
            "and what is drawn from other rows, such as the words of the search.",
            lines=counted(self.audit.lines, "1 line", "{count} lines"),
            others=Message("with each other and with the last one noted beside the files")
            if self.is_noted
            else Message("with each other, and not with the last one, which is not noted"),
            rows=counted(self.rows.checked, "1 row", "{count} rows"),
            signatures=counted(self.signatures.checked, "1 signature", "{count} signatures"),
            files=counted(self.contents.checked, "1 file", "{count} files"),
        )

    @property
    def is_sound(self) -> bool:
        """Whether everything is what was stored."""
        return not self.problems()

    def problems(self) -> list[Message]:
        """Return what is wrong, a sentence for each kind."""
        found: list[Message] = []
        if self.database_problem:
            found.append(
                Message(
                    "The database is damaged ({reason}); restore it from a backup.",
                    reason=self.database_problem,
                )
            )
        if self.audit.problem is not None:
            found.append(self.audit.problem)
        for ids, one, several in (
            (
                self.signatures.changed,
                "One signed prescription is not what was signed: {first}; compare it with a "
                "backup.",
                "{count} signed prescriptions are not what was signed, the first is {first}; "
                "compare them with a backup.",
            ),
            (
                self.signatures.unlogged,
                "One signed prescription has a signature that the audit log does not know: "
                "{first}; compare it with a backup.",
                "{count} signed prescriptions have a signature that the audit log does not know, "
                "the first is {first}; compare them with a backup.",
            ),
            (
                self.signatures.missing,
                "One signed prescription is gone: {first}; compare the record with a backup.",
                "{count} signed prescriptions are gone, the first is {first}; compare the record "
                "with a backup.",
            ),
            (
                self.contents.damaged,
                "One file was changed since the record stored it: {first}; restore it from a "
                "backup.",
                "{count} files were changed since the record stored them, the first is {first}; "
                "restore them from a backup.",
            ),
            (
                self.contents.missing,
                "One file of the record is missing: {first}; restore it from a backup.",
                "{count} files of the record are missing, the first is {first}; restore them from "
                "a backup.",
            ),
        ):
            if ids:
                found.append(counted(len(ids), one, several, first=ids[0][:12]))
        found += problems_of_rows(self.rows)
        found += [
            counted(
                count,
                "One row of {table} refers to something that is not there; restore the record from "
                "a backup.",
                "{count} rows of {table} refer to something that is not there; restore the record "
                "from a backup.",
                table=table,
            )
            for table, count in self.references.items()
        ]
        return found


def verify_record(
    context: RecordsContext,
    known: Mapping[int, str] | None = None,
    progress: Progress = SILENT,
) -> VerifyReport:
    """Verify all that the record holds; nothing is changed.

    Parameters
    ----------
    known
        Hashes of lines of the audit log by number, as backups keep them.

    Raises
    ------
    NotAllowed
    Unreachable
        When database or files do not answer.
    Cancelled
    """
    # Before the moment that the transaction sees, after which others may write further lines.
    noted = context.database.witness.read()
    with context.database.reading() as connection:
        require(connection, context.author, Right.BACK_UP)
        problem = _problem_of_file(connection) if context.database.is_sqlite else ""
        audit = verify_chain(connection, noted | dict(known or {}), progress.part(0, 0.2))
        rows = verify_rows(connection, progress.part(0.2, 0.3))
        signatures = verify_signatures(connection, progress.part(0.3, 0.4))
        references = _dangling(connection)
        query = select(contents.c.sha256, contents.c.size)
        used = {row.sha256: row.size for row in connection.execute(query)}
    files = context.contents.verify(used, progress.part(0.4, 1))
    return VerifyReport(
        compared_with_note(audit, noted), signatures, files, references, rows, problem, bool(noted)
    )


def _problem_of_file(connection: Connection) -> str:
    found = str(connection.execute(text("PRAGMA quick_check(1)")).scalar_one())
    return "" if found == "ok" else found[:200]


def _dangling(connection: Connection) -> dict[str, int]:
    """Count the rows whose references lead nowhere, which the database should not allow."""
    found: dict[str, int] = {}
    for table in metadata.sorted_tables:
        for constraint in table.foreign_key_constraints:
            count = _count_dangling(connection, constraint)
            if count:
                found[table.name] = found.get(table.name, 0) + count
    return found


def _count_dangling(connection: Connection, constraint: ForeignKeyConstraint) -> int:
    (key,) = constraint.elements
    target = key.column.table.alias()
    refers = and_(target.c[key.column.name] == key.parent)
    query = select(func.count()).where(key.parent.is_not(None), ~exists().where(refers))
    return int(connection.execute(query).scalar_one())
