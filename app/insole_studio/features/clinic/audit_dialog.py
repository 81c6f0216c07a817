"""The audit log: who saw, changed and exported what, in words; and whether it is intact."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from datetime import date
from functools import partial
from typing import TYPE_CHECKING, Final

from PySide6.QtWidgets import QGridLayout, QLabel, QLineEdit, QPushButton, QWidget

from insole_core.cases.days import read_day
from insole_core.errors import InputError
from insole_core.geometry.side import Side
from insole_core.messages import counted
from insole_core.records.author import Role
from insole_core.records.order import OrderState
from insole_core.records.person import Person
from insole_core.records.record_field import fields_of
from insole_core.records.retention import YEARS_VALUE
from insole_core.records.visit import Visit
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.features.clinic.verify_dialog import VerifyingDialog
from insole_studio.jobs import Jobs
from insole_studio.texts import moment_text, tr, translate_core_message
from insole_studio.widgets.date_field import DateField
from insole_studio.widgets.form_parts import ComboBox, allow
from insole_studio.widgets.row_table import RowTable, TableRow

if TYPE_CHECKING:
    from insole_core.progress import Progress
    from insole_core.records.audit import AuditReport
    from insole_core.records.audit_search import AuditFilter, ShownLine
    from insole_core.records.records import Records

NAMES: Final[Mapping[str, Callable[[], str]]] = {
    "audit_seq": lambda: tr("last line"),
    "captures": lambda: tr("captures"),
    "count": lambda: tr("count"),
    "damaged": lambda: tr("damaged"),
    "digest": lambda: tr("digest"),
    "failures": lambda: tr("failed attempts"),
    "fields": lambda: tr("fields"),
    "files": lambda: tr("files"),
    "has_system_user": lambda: tr("has a user of the system"),
    "is_disabled": lambda: tr("disabled"),
    "is_pseudonymous": lambda: tr("under a pseudonym"),
    "kept_until": lambda: tr("kept until"),
    "merge": lambda: tr("merge"),
    "merged": lambda: tr("merged"),
    "orders": lambda: tr("orders"),
    "person": lambda: tr("person"),
    "prescriptions": lambda: tr("prescriptions"),
    "reason": lambda: tr("reason"),
    "release": lambda: tr("release"),
    "removed": lambda: tr("removed"),
    "revision": lambda: tr("revision"),
    "role": lambda: tr("role"),
    "rows": lambda: tr("rows"),
    "sha256": lambda: "SHA-256",
    "side": lambda: tr("side"),
    "signature": lambda: tr("signature"),
    "signed_in_by": lambda: tr("signed in by"),
    "state": lambda: tr("state"),
    "visit": lambda: tr("visit"),
    "visits": lambda: tr("visits"),
    "years": lambda: tr("years"),
    "years_before": lambda: tr("years before"),
}
"""Names of details."""
SETTINGS: Final[Mapping[str, Callable[[], str]]] = {
    YEARS_VALUE: lambda: tr("years of keeping"),
}
"""Names of the clinic's settings, which others have by their key."""
WORDS: Final[Mapping[str, Callable[[], str]]] = {
    "True": lambda: tr("yes"),
    "False": lambda: tr("no"),
    "None": lambda: tr("nothing"),
    "request": lambda: tr("on request"),
    "retention over": lambda: tr("time of keeping over"),
    "sample": lambda: tr("sample patient"),
    "password": lambda: tr("password"),
    "system user": lambda: tr("user of the system"),
    **{
        str(word): partial(translate_core_message, str(word))
        for kind in (Side, Role, OrderState)
        for word in kind
    },
}
"""Values that are words."""
FIELDS: Final[Mapping[str, Callable[[], str]]] = {
    name: partial(translate_core_message, field.noun)
    for kind in (Person, Visit)
    for name, field in fields_of(kind).items()
}
"""Fields of a person and of a visit, whose names a line lists when they were changed."""
_SIZE = (980, 600)
_PAGE = 200
_MOST_LETTERS = 60
_VERIFY = "verify-audit"
_EVERYBODY = ""


def details_text(details: Mapping[str, str]) -> str:
    """Say the details of a line in the language of the window; what is no word stays as it is."""
    return ", ".join(f"{_word(NAMES, key)}: {_value(key, text)}" for key, text in details.items())


def _value(key: str, text: str) -> str:
    if key == "fields":
        return " · ".join(_word(FIELDS, name) for name in text.split())
    return WORDS.get(text, lambda: text)()


def _word(words: Mapping[str, Callable[[], str]], key: str) -> str:
    return words.get(key, lambda: key.replace("_", " "))()


class AuditDialog(VerifyingDialog):
    """The latest lines, by patient, author and day; older ones on request."""

    def __init__(self, clinic: ClinicRecord, jobs: Jobs, parent: QWidget | None = None) -> None:
        super().__init__(tr("Audit log"), clinic, jobs, _VERIFY, parent)
        self.resize(*_SIZE)
        self._lines: list[ShownLine] = []
        self._filter: AuditFilter | None = None
        self.pseudonym = QLineEdit()
        self.pseudonym.setMaxLength(_MOST_LETTERS)
        self.pseudonym.setPlaceholderText(tr("Pseudonym: P-…"))
        self.author = ComboBox([(_EVERYBODY, tr("Everybody"))])
        self.first_day, self.last_day = DateField(), DateField()
        self.show_button = QPushButton(tr("Show"))
        self.show_button.setDefault(True)
        self.show_button.clicked.connect(self.show_lines)
        headings = ("#", tr("When"), tr("By"), tr("At"), tr("What"), tr("Subject"), tr("Details"))
        self.table = RowTable(headings, stretched=6)
        self.table.setAccessibleName(tr("Audit log"))
        self.more = self.add_button(tr("Older lines"), self._read_more)
        self.verify = self.add_verify_button(tr("Verify the log"), self._verify)
        self._lay_out()
        self.ask(_authors, self._show_authors)

    def show_lines(self) -> None:
        """Show the latest lines that pass the filter."""
        from insole_core.records.audit_search import AuditFilter

        self._lines = []  # those of another filter do not stay below what is told of this one
        self._show_more([])
        allow(self.more, tr("No lines are shown yet."))
        try:
            wanted = AuditFilter(
                self.pseudonym.text().strip(),
                self.author.currentData(),
                self._day(self.first_day),
                self._day(self.last_day),
            )
        except InputError as error:
            self.refuse(error)
            return
        self.say("")
        self._filter = wanted
        self.ask(lambda records: _search(records, wanted, None), self._show)

    def _lay_out(self) -> None:
        grid = QGridLayout()
        grid.setHorizontalSpacing(8)
        fields: tuple[tuple[str, QWidget], ...] = (
            (tr("Patient"), self.pseudonym),
            (tr("By"), self.author),
            (tr("From"), self.first_day),
            (tr("To"), self.last_day),
        )
        for column, (text, field) in enumerate(fields):
            label = QLabel(text)
            label.setBuddy(field)
            grid.addWidget(label, 0, column)
            grid.addWidget(field, 1, column)
            grid.setColumnStretch(column, 1)
        grid.addWidget(self.show_button, 1, len(fields))
        self.content.addLayout(grid)
        self.content.addWidget(self.table, 1)
        self.content.addWidget(self.progress)

    def _day(self, field: DateField) -> date | None:
        written = read_day("visit", field.text(), date.today())
        return date.fromisoformat(written) if written else None

    def _show_authors(self, authors: list[str]) -> None:
        for author in authors:
            self.author.addItem(author, author)
        self.show_lines()

    def _read_more(self) -> None:
        wanted, last = self._filter, self._lines[-1].line.seq
        if wanted is not None:
            self.ask(lambda records: _search(records, wanted, last), self._show_more)

    def _show(self, lines: list[ShownLine]) -> None:
        self._lines = []
        self._show_more(lines)
        if not lines:
            self.say(tr("Nothing was written that fits."))

    def _show_more(self, lines: list[ShownLine]) -> None:
        self._lines += lines
        allow(self.more, "" if len(lines) == _PAGE else tr("There are no older lines."))
        self.table.show_rows([_row(shown) for shown in self._lines])

    def _verify(self) -> None:
        context = self.clinic.ask_now(lambda records: records.context)

        def verify(progress: Progress) -> AuditReport:
            from insole_core.records.audit_search import verify_audit

            return verify_audit(context, progress)

        self.run_verification(verify, self._show_report)

    def _show_report(self, report: AuditReport) -> None:
        if report.problem is not None:
            self.say(report.problem, warns=True)
        else:
            sentence = counted(
                report.lines,
                "The one line is what was written, and none is missing.",
                "All {count} lines are what was written, and none is missing.",
            )
            self.say(sentence)


def _authors(records: Records) -> list[str]:
    from insole_core.records.audit_search import authors_of_audit

    return authors_of_audit(records.context)


def _search(records: Records, wanted: AuditFilter, before: int | None) -> list[ShownLine]:
    from insole_core.records.audit_search import search_audit

    return search_audit(records.context, wanted, before, _PAGE)


def _row(shown: ShownLine) -> TableRow:
    line = shown.line
    named = _word(SETTINGS, shown.subject) if line.subject_kind == "clinic" else shown.subject
    subject = f"{translate_core_message(line.subject_kind)} {named}"
    cells = (
        str(line.seq),
        moment_text(line.at),
        line.author,
        line.station,
        translate_core_message(line.action),
        subject,
        details_text(shown.details),
    )
    return TableRow(str(line.seq), cells, tip=line.details)
