"""Restoring the record: what a backup holds, what it would replace, and then the restoring."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from threading import Event
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFormLayout, QHBoxLayout, QLineEdit

from insole_core.messages import counted
from insole_core.progress import Progress
from insole_studio.document.record_location import RecordLocation, settings_for
from insole_studio.features.clinic.backups import Backups, entries_text, files_text
from insole_studio.features.clinic.record_dialog import RecordDialog, secret_line
from insole_studio.jobs import JobProgress, Result, Task
from insole_studio.services.app_services import AppServices
from insole_studio.services.files import Kept
from insole_studio.texts import fill, moment_text, tr, translate_core_message
from insole_studio.widgets.form_parts import allow, mark_labels, plain_button
from insole_studio.widgets.message_label import MessageLabel, ProgressBar
from insole_studio.widgets.row_table import RowTable, TableRow

if TYPE_CHECKING:
    from insole_core.records.backup.backup_folder import SnapshotName
    from insole_core.records.backup.restore import RestoreReport
    from insole_core.records.backup.snapshot import Manifest

_SIZE = (640, 560)
_LIST, _OPEN, _RESTORE = "restore-list", "restore-open", "restore"
MEGABYTE = 1e6


@dataclass(frozen=True)
class _Plan:
    """What is restored, and to where."""

    folder: Path
    secret: str
    number: int
    location: RecordLocation


class RestoreDialog(RecordDialog):
    """Restores a backup; a record that is there is set aside only after a word about it.

    Parameters
    ----------
    backups
        One that is being stopped is waited for.
    """

    closing_requested = Signal(object)
    """Asks to close the record and the case of it, then to call the function that comes along."""
    restored = Signal(object)
    """Emitted with the `RestoreReport`."""

    def __init__(self, services: AppServices, backups: Backups) -> None:
        super().__init__(tr("Restore from a backup"), services.clinic, services.window)
        self.resize(*_SIZE)
        self._backups = backups
        self._jobs = jobs = backups.jobs
        self._paths = services.paths
        self._messages = services.messages
        folder = services.settings.backup_folder
        self._listed: Path | None = None
        self._replaces = False
        self._is_opened = False
        self._stop = Event()
        self.folder = QLineEdit(folder)
        self.folder.editingFinished.connect(self._note_folder)
        self.choose = plain_button(tr("Choose…"), self._choose_folder)
        self.table = RowTable((tr("Backup"), tr("Made")), stretched=1)
        self.table.setAccessibleName(tr("Backups in the folder"))
        self.table.current_changed.connect(lambda _key: self._forget_opened())
        self.secret = secret_line()
        self.secret.textEdited.connect(lambda _text: self._forget_opened())
        self.contents = MessageLabel()
        self.progress = ProgressBar()
        self.show_button = self.add_button(tr("Show what it holds"), self.show_contents)
        self.show_button.setDefault(True)
        self.restore_button = self.add_button(tr("Restore"), self.restore)
        self.cancel = self.add_button(tr("Cancel restoring"), self._cancel)
        self.cancel.hide()
        self._lay_out()
        jobs.progressed.connect(self._show_progress)
        jobs.ended.connect(self._end)
        self._forget_opened()
        if folder:
            self.list_snapshots()

    def reject(self) -> None:
        """Close the dialog, unless it is restoring."""
        if not self._jobs.is_running(_RESTORE):
            super().reject()

    def list_snapshots(self) -> None:
        """Show the backups in the folder, the newest first; this needs no passphrase."""
        self._listed = folder = self._folder
        if folder is None:
            self.table.show_rows([])
            return
        self._run(_LIST, lambda _progress: _snapshots(folder), self._show_snapshots)

    def show_contents(self) -> None:
        """Open the chosen backup and show what it holds."""
        plan = self._plan()
        if plan is not None:
            self.contents.say(tr("Opening the backup…"))
            self._run(_OPEN, lambda _progress: _opened(plan), self._show_opened)

    def restore(self) -> None:
        """Restore the backup that is shown, in place of the record."""
        plan = self._plan()
        if plan is None:
            return
        self.say("")
        replaces = self._replaces
        self._stop = stop = Event()

        def run() -> None:
            self._run(_RESTORE, lambda p: self._restore(plan, replaces, p, stop), self._finish)
            self.cancel.setEnabled(True)
            self._allow()
            self.cancel.setFocus()

        self.closing_requested.emit(run)

    def _restore(
        self, plan: _Plan, replaces: bool, progress: Progress, stop: Event
    ) -> RestoreReport:
        """Restore, in the thread of a job."""
        from insole_core.records.author import Author
        from insole_core.records.backup.restore import restore

        stoppable = Progress(progress.report, stop.is_set)
        with self._backups.alone(stoppable):
            return restore(
                plan.folder,
                plan.secret,
                plan.location.place(),
                Author.of_user(),
                number=plan.number,
                replace_existing=replaces,
                settings=self._paths.backed_up_folders,
                revise=settings_for(plan.location, self._paths),
                progress=stoppable,
            )

    def _lay_out(self) -> None:
        row = QHBoxLayout()
        row.addWidget(self.folder, 1)
        row.addWidget(self.choose)
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(tr("Folder"), row)
        form.addRow(tr("Passphrase or private key"), self.secret)
        mark_labels(form)
        self.content.addLayout(form)
        self.content.addWidget(self.table, 1)
        self.content.addWidget(self.contents)
        self.content.addWidget(self.progress)

    @property
    def _folder(self) -> Path | None:
        text = self.folder.text().strip()
        return Path(text) if text else None

    def _plan(self) -> _Plan | None:
        if self._folder is None or not self.table.current_key:
            self.say(tr("Choose a folder and one of its backups first."), warns=True)
            return None
        if not self.secret.text():
            self.say(tr("Type the passphrase of the backup."), warns=True)
            self.secret.setFocus()
            return None
        number = int(self.table.current_key)
        return _Plan(self._folder, self.secret.text(), number, self.clinic.location)

    def _run(self, channel: str, task: Task[Result], done: Callable[[Result], None]) -> None:
        self._jobs.start(channel, task, self.while_open(done), self.while_open(self.refuse))

    def _note_folder(self) -> None:
        """List another folder; the focus that only leaves the line changes nothing."""
        if self._folder != self._listed:
            self.list_snapshots()

    def _choose_folder(self) -> None:
        path = self._messages.questions.on(self).folder_to_open(
            tr("Folder of the backups"), Kept.BACKUPS
        )
        if path is not None:
            self.folder.setText(str(path))
            self.list_snapshots()

    def _show_snapshots(self, snapshots: list[SnapshotName]) -> None:
        self.say("")
        newest_first = reversed(snapshots)
        rows = [
            TableRow(str(s.number), (str(s.number), moment_text(s.made_at))) for s in newest_first
        ]
        self.table.show_rows(rows)
        self.table.take_first()
        self.secret.setFocus()

    def _show_opened(self, manifest: Manifest) -> None:
        self.say("")
        rows = {table.name: table.rows for table in manifest.tables}
        patients = manifest.patients
        lines = [
            fill(
                tr(
                    "It holds: patients {patients}, visits {visits}, versions of prescriptions "
                    "{versions}, orders {orders}, files {files} ({size_mb:.1f} MB). Made by "
                    "Insole Studio {program}."
                ),
                patients=rows.get("persons", 0) if patients is None else patients,
                visits=rows.get("visits", 0),
                versions=rows.get("prescription_versions", 0),
                orders=rows.get("orders", 0),
                files=manifest.contents,
                size_mb=manifest.contents_bytes / MEGABYTE,
                program=manifest.program_version,
            )
        ]
        if manifest.damaged:
            lines.append(_lost_text(len(manifest.damaged)))
        self.contents.say_all(lines)
        self.make_room()
        self._is_opened = True
        self._allow()
        self.restore_button.setFocus()

    def _forget_opened(self) -> None:
        self._is_opened = False
        self._set_replaces(False)
        self.contents.say("")
        self._allow()

    def _set_replaces(self, replaces: bool) -> None:
        self._replaces = replaces
        self.restore_button.setText(
            tr("Set the present record aside and restore") if replaces else tr("Restore")
        )

    def _allow(self) -> None:
        is_running = self._jobs.is_running(_RESTORE)
        busy = tr("Wait until the record is restored, or cancel that.") if is_running else ""
        unopened = "" if self._is_opened else tr("Show what the backup holds first.")
        unchosen = "" if self.table.current_key else tr("Choose a backup in the list first.")
        allow(self.restore_button, busy or unopened)
        allow(self.show_button, busy or unchosen)
        allow(self.close_button, busy)
        self.cancel.setVisible(is_running)

    def _cancel(self) -> None:
        """Ask the restoring to stop; it is over only once its thread says so."""
        self._stop.set()
        self.cancel.setEnabled(False)

    def _show_progress(self, news: JobProgress) -> None:
        if news.channel in (_RESTORE, _OPEN):
            self.progress.show_work(news.fraction, news.text)

    def _end(self, channel: str) -> None:
        self.progress.show_work(0, "")
        had_focus = self.cancel.hasFocus()
        self._allow()
        if had_focus:
            self.close_button.setFocus()
        if channel == _RESTORE:
            self.clinic.open()
            if self._stop.is_set():
                self.say(tr("Restoring was stopped; the record is as it was."))

    def refuse(self, error: Exception) -> None:
        """Tell why nothing was restored; a record that is there is replaced by another press."""
        from insole_core.records.backup.restore import PlaceTaken

        super().refuse(error)
        if not self._is_opened:
            self.contents.say("")
        if isinstance(error, PlaceTaken) and not self.clinic.location.is_shared:
            self._set_replaces(True)
            self.restore_button.setFocus()

    def _finish(self, report: RestoreReport) -> None:
        self.restored.emit(report)
        self._is_opened = False
        self._set_replaces(False)
        self._allow()
        self.say_all(restored_lines(report), warns=report.audit.problem is not None)


def restored_lines(report: RestoreReport) -> list[str]:
    """Say what was restored, and what is to be known of it."""
    made = moment_text(report.snapshot.made_at)
    lines = [
        tr("The record is as it was on {moment}: {rows} and {files}.").format(
            moment=made, rows=entries_text(report.rows), files=files_text(report.contents)
        )
    ]
    if report.set_aside is not None:
        lines.append(tr("The record before is kept as {path}.").format(path=report.set_aside))
    if report.erased_again:
        erased = counted(
            report.erased_again,
            "One patient was erased after the backup, and now again.",
            "{count} patients were erased after the backup, and now again.",
        )
        lines.append(translate_core_message(erased))
    if report.is_erasure_unknown:
        lines.append(
            tr(
                "The record before cannot be read: who was erased after the backup may be in the "
                "list of patients again; erase them once more."
            )
        )
    if report.left_out:
        lines.append(_lost_text(len(report.left_out)))
    if report.kept_files:
        kept = counted(
            report.kept_files,
            "One file of the settings was there already, and stays.",
            "{count} files of the settings were there already, and stay.",
        )
        lines.append(translate_core_message(kept))
    if report.audit.problem is not None:
        lines.append(translate_core_message(report.audit.problem))
    return lines


def _lost_text(count: int) -> str:
    return translate_core_message(
        counted(
            count,
            "One file was lost before it was made, and is not in it.",
            "{count} files were lost before it was made, and are not in it.",
        )
    )


def _snapshots(folder: Path) -> list[SnapshotName]:
    from insole_core.records.backup.backup_folder import BackupFolder

    backups = BackupFolder(folder)
    backups.head()
    return list(backups.finished_snapshots().values())


def _opened(plan: _Plan) -> Manifest:
    from insole_core.records.backup.snapshot import open_snapshot

    return open_snapshot(plan.folder, plan.secret, plan.number).manifest
