"""What comes into the record and leaves it: tables, case files, patients."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QRadioButton, QVBoxLayout, QWidget

from insole_core.errors import InsoleError
from insole_core.export.csv_text import csv_text
from insole_core.files.atomic import write_text
from insole_core.messages import Message
from insole_core.progress import Progress
from insole_core.records.person_import import (
    ImportLine,
    ImportPlan,
    count_added,
    count_outcomes,
    import_persons,
    plan_import,
)
from insole_core.records.person_table import (
    ColumnMapping,
    PersonRows,
    asks_date_order,
    propose_mapping,
    read_persons,
)
from insole_core.records.records import Records
from insole_core.records.text_table import Reading, TextTable, UnclearCharacterSet, read_table
from insole_core.solids.prescription_paper import Responsible
from insole_core.workflows.records.import_cases import CaseLine, CasePlan, import_cases, plan_cases
from insole_core.workflows.records.plain_name import free_folder
from insole_studio.features.records.import_dialog import (
    CharacterSetDialog,
    ImportDialog,
    ImportRow,
    TableImportDialog,
)
from insole_studio.jobs import Result, Task
from insole_studio.services.app_services import AppServices
from insole_studio.services.files import Kept, table_kinds
from insole_studio.texts import (
    language_code,
    tr,
    translate_core_message,
    translation_into,
)
from insole_studio.widgets.message_label import MessageLabel

_WIDTH_PX = 480

IMPORT, EXPORT = "records-import", "records-export"
_WHICH_ORDER = Message(
    "Some dates can be read in two ways; say whether the day or the month comes first."
)


class PersonExportDialog(QDialog):
    """Everything, or nothing that names or describes the patient."""

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Export patient"))
        self.setMinimumWidth(_WIDTH_PX)
        what = MessageLabel()
        what.say(
            tr(
                "{name}: visits, prescriptions, insoles (STL), scans and orders as a folder that "
                "opens without this program."
            ).format(name=name)
        )
        self.everything = QRadioButton(tr("Everything, for the patient or another clinic"))
        self.pseudonymous = QRadioButton(
            tr("Without name, birth date, texts and scans, for a shop or for research")
        )
        self.everything.setChecked(True)
        buttons = QDialogButtonBox()
        buttons.addButton(tr("Choose folder…"), QDialogButtonBox.ButtonRole.AcceptRole)
        buttons.addButton(tr("Cancel"), QDialogButtonBox.ButtonRole.RejectRole)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        for widget in (what, self.everything, self.pseudonymous, buttons):
            layout.addWidget(widget)


@dataclass(frozen=True)
class _DryRun:
    """What an import of a table would do.

    Parameters
    ----------
    asks_order
        Whether dates have two readings.
    rows, plan
        None until somebody has said their order.
    """

    asks_order: bool
    rows: PersonRows | None = None
    plan: ImportPlan | None = None


class RecordTransfer(QObject):
    """Imports tables and case files, exports patients; all long work is done in jobs."""

    imported = Signal()
    """Patients were added."""

    def __init__(self, services: AppServices) -> None:
        super().__init__(services.window)
        self._services = services
        self._messages = services.messages

    def import_table(self) -> None:
        """Ask for a table, show what becomes of its rows, and add the new patients."""
        path = self._messages.questions.file_to_open(table_kinds(), Kept.CASES)
        if path is not None and self._records() is not None:
            self._read_table(path)

    def _read_table(self, path: Path, encoding: str | None = None) -> None:
        def read(progress: Progress) -> tuple[TextTable, ColumnMapping] | UnclearCharacterSet:
            progress.step(0.0, "Reading {name}", name=path.name)
            try:
                table = read_table(path, encoding)
            except UnclearCharacterSet as unclear:
                return unclear
            return table, propose_mapping(table)

        def show(found: tuple[TextTable, ColumnMapping] | UnclearCharacterSet) -> None:
            if isinstance(found, UnclearCharacterSet):
                self._ask_character_set(path, found.readings)
            else:
                self._show_table(path, *found)

        self._services.run(IMPORT, read, show)

    def _ask_character_set(self, path: Path, readings: Sequence[Reading]) -> None:
        dialog = CharacterSetDialog(path.name, readings, self._services.window)
        dialog.finished.connect(dialog.deleteLater)
        dialog.chosen.connect(lambda encoding: self._read_table(path, encoding))
        dialog.open()

    def import_cases(self) -> None:
        """Ask for a folder, show what becomes of its case files, and add them as visits."""
        title = tr("Import case files")
        folder = self._messages.questions.folder_to_open(title, Kept.CASES)
        records = self._records()
        if folder is None or records is None:
            return
        dialog = ImportDialog(title, tr("File"), self._services.window)

        def show(plan: CasePlan) -> None:
            dialog.show_rows([_case_row(line) for line in plan.lines], count_outcomes(plan.lines))

        def add(with_doubtful: bool) -> None:
            def work(progress: Progress) -> Message:
                plan = import_cases(records, folder, with_doubtful=with_doubtful, progress=progress)
                return count_added(plan.lines, with_doubtful=with_doubtful)

            self._add(dialog, work)

        dialog.add_requested.connect(add)
        self._open(dialog)
        self._start(dialog, lambda progress: plan_cases(records, folder, progress), show)

    def export(self, person_id: str, name: str) -> None:
        """Ask what of a patient to export and where to, and write the folder."""
        dialog = PersonExportDialog(name, self._services.window)
        dialog.finished.connect(dialog.deleteLater)
        dialog.accepted.connect(
            lambda: self._export(person_id, is_pseudonymous=dialog.pseudonymous.isChecked())
        )
        dialog.open()

    def _export(self, person_id: str, *, is_pseudonymous: bool) -> None:
        from insole_core.workflows.records.export_person import PersonExport, export_person
        from insole_core.workflows.records.person_summary import Wording

        records = self._records()
        parent = self._messages.questions.folder_to_open(tr("Export patient into"), Kept.EXPORTS)
        if records is None or parent is None:
            return

        settings = self._services.settings
        responsible = Responsible(
            clinic=settings.clinic, maker=settings.maker, maker_address=settings.maker_address
        )

        language = settings.language

        def write(progress: Progress) -> PersonExport:
            wording = Wording(language_code(language), translation_into(language))
            pseudonym = records.persons.get(person_id).pseudonym
            folder = free_folder(parent, pseudonym, "patient")
            return export_person(
                records,
                person_id,
                folder,
                is_pseudonymous=is_pseudonymous,
                responsible=responsible,
                wording=wording,
                progress=progress,
            )

        def tell(export: PersonExport) -> None:
            sentence = tr("Exported to {folder}.").format(folder=export.folder)
            if not export.left_out:
                self._messages.say(sentence)
                return
            left_out = "\n".join(map(translate_core_message, export.left_out))
            heading = tr("Not exported:")
            self._messages.show_sentence(f"{sentence}\n\n{heading}\n{left_out}")

        self._services.run(EXPORT, write, tell)

    def _show_table(self, path: Path, table: TextTable, mapping: ColumnMapping) -> None:
        records = self._records()
        if records is None:
            return
        dialog = TableImportDialog(table, mapping, path.name, self._services.window)
        latest: list[PersonRows] = []

        def show(dry_run: _DryRun) -> None:
            dialog.ask_order(dry_run.asks_order)
            if dry_run.rows is None or dry_run.plan is None:
                dialog.wait(_WHICH_ORDER)
                return
            latest[:] = [dry_run.rows]
            lines = dry_run.plan.lines
            dialog.show_rows([_table_row(line) for line in lines], count_outcomes(lines))

        def look() -> None:
            mapping = dialog.mapping
            dialog.wait()
            self._start(dialog, lambda _progress: _dry_run(records, table, mapping), show)

        def add(with_doubtful: bool) -> None:
            (rows,) = latest

            def work(progress: Progress) -> Message:
                plan = import_persons(records, rows, with_doubtful=with_doubtful, progress=progress)
                return count_added(plan.lines, with_doubtful=with_doubtful)

            self._add(dialog, work)

        dialog.mapping_changed.connect(look)
        dialog.add_requested.connect(add)
        self._open(dialog)
        look()

    def _add(self, dialog: ImportDialog, work: Task[Message]) -> None:
        """Add what is new, tell how much that was, and close the dialog."""
        dialog.wait()

        def tell(counts: Message) -> None:
            said = translate_core_message(counts)
            sentence = tr("Import: {counts}").format(counts=said)
            self._services.notices.put(IMPORT, sentence, stays=True)
            dialog.accept()
            self.imported.emit()

        self._start(dialog, work, tell)

    def _start(
        self, dialog: ImportDialog, task: Task[Result], done: Callable[[Result], None]
    ) -> None:
        """Run a task of a dialog, which shows what a user can put right."""

        def fail(error: Exception) -> None:
            if isinstance(error, InsoleError):
                dialog.wait(error.message)
            else:
                self._messages.show_error(error, over=dialog)

        self._services.jobs.start(IMPORT, task, done, fail)

    def _open(self, dialog: ImportDialog) -> None:
        dialog.report_requested.connect(lambda: self._save_report(dialog))
        dialog.rejected.connect(lambda: self._services.jobs.cancel(IMPORT))
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()

    def _save_report(self, dialog: ImportDialog) -> None:
        questions = self._messages.questions.on(dialog)
        path = questions.file_to_write(tr("import report") + ".csv", table_kinds(), Kept.PAPERS)
        if path is None:
            return
        rows = [(row.place, str(row.outcome), row.name, row.reason) for row in dialog.rows]
        try:
            write_text(csv_text([("place", "outcome", "name", "reason"), *rows]), path)
        except InsoleError as error:
            self._messages.show_error(error, over=dialog)

    def _records(self) -> Records | None:
        """Return the open record; where there is none, say so."""
        try:
            return self._services.clinic.ask_now(lambda records: records)
        except InsoleError as error:
            self._messages.show_error(error)
            return None


def _dry_run(records: Records, table: TextTable, mapping: ColumnMapping) -> _DryRun:
    """Return what an import of a table would do.

    Raises
    ------
    InputError
        When the columns make no person.
    """
    mapping.check()
    asks_order = asks_date_order(table, mapping)
    if mapping.date_order is None and asks_order:
        return _DryRun(asks_order)
    rows = read_persons(table, mapping, date.today())
    return _DryRun(asks_order, rows, plan_import(records, rows))


def _table_row(line: ImportLine) -> ImportRow:
    name = "" if line.person is None else line.person.name
    return ImportRow(str(line.line), line.outcome, name, line.reason)


def _case_row(line: CaseLine) -> ImportRow:
    return ImportRow(line.path, line.outcome, line.name, line.reason)
