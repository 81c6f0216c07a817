"""Where and when backups are made, with which secret; and one now."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, cast

from PySide6.QtCore import QLocale
from PySide6.QtWidgets import (
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QSpinBox,
    QWidget,
)

from insole_core.errors import InputError, InsoleError
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.features.clinic.backups import (
    BACKUP,
    Backups,
    BackupState,
    damaged_text,
    read_state,
    report_text,
)
from insole_studio.features.clinic.record_dialog import PasswordFields, RecordDialog
from insole_studio.jobs import JobProgress
from insole_studio.services.files import Kept
from insole_studio.services.user_messages import UserMessages
from insole_studio.settings import LAST_HOUR, BackupDay, BackupKeep, Settings
from insole_studio.texts import fill, moment_text, tr
from insole_studio.widgets.form_parts import ComboBox, allow, mark_labels, plain_button
from insole_studio.widgets.message_label import ProgressBar

if TYPE_CHECKING:
    from insole_core.records.backup.back_up import BackupReport
    from insole_core.records.records import Records

_WIDTH_PX = 620
_PASSPHRASE, _RECIPIENT = "passphrase", "recipient"


class BackupDialog(RecordDialog):
    """Folder, schedule and secret of the backups; what is chosen counts at once."""

    def __init__(
        self,
        clinic: ClinicRecord,
        backups: Backups,
        settings: Settings,
        messages: UserMessages,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(tr("Backup"), clinic, parent)
        self.setMinimumWidth(_WIDTH_PX)
        self._backups = backups
        self._messages = messages
        self._state: BackupState | None = None
        self.folder = QLineEdit(settings.backup_folder)
        self.folder.setPlaceholderText(tr("A folder on another disk, or on a share"))
        self.folder.editingFinished.connect(self._keep_plan)
        self.choose = plain_button(tr("Choose…"), self._choose_folder)
        self.day = ComboBox(_days())
        self.day.setAccessibleName(tr("Day of the backup"))
        self.day.show_value(settings.backup_day)
        self.day.edited.connect(lambda _day: self._keep_plan())
        self.hour = QSpinBox()
        self.hour.setRange(0, LAST_HOUR)
        self.hour.setSuffix(":00")
        self.hour.setAccessibleName(tr("Hour of the backup"))
        self.hour.setValue(settings.backup_hour)
        self.hour.editingFinished.connect(self._keep_plan)
        self.keep = ComboBox(_keeps())
        self.keep.setAccessibleName(tr("Old backups"))
        self.keep.show_value(settings.backup_keep)
        self.keep.edited.connect(lambda keep: backups.set_keep(cast("BackupKeep", keep)))
        self.last = QLabel()
        self.last.setWordWrap(True)
        self.words = QLabel(
            tr(
                "Backups are encrypted. Choose a passphrase of four words or more, and keep it on "
                "paper where the backup is not: without it nobody can restore the record."
            )
        )
        self.words.setWordWrap(True)
        self.kind = ComboBox(
            [
                (_PASSPHRASE, tr("Passphrase")),
                (_RECIPIENT, tr("Public key of age (age1…)")),
            ]
        )
        self.kind.edited.connect(lambda _kind: self._show_secret(True))
        self.passphrase = PasswordFields()
        self.recipient = QLineEdit()
        self.progress = ProgressBar()
        self.now = self.add_button(tr("Back up now"), self._begin)
        self.make_primary(self.now)
        for line in (self.passphrase.first, self.passphrase.again, self.recipient):
            line.returnPressed.connect(self.now.click)
        self.cancel = self.add_button(tr("Cancel backup"), self._cancel)
        self._lay_out()
        backups.finished.connect(self._finish)
        backups.failed.connect(self._fail)
        backups.jobs.progressed.connect(self._show_progress)
        backups.jobs.ended.connect(self._end)
        self._allow()
        self.read()

    def read(self) -> None:
        """Show whether backups are set up, and when the last one was made."""
        folder = self._folder
        self.ask(lambda records: read_state(records, folder), self._show)

    def _lay_out(self) -> None:
        folder = QHBoxLayout()
        folder.addWidget(self.folder, 1)
        folder.addWidget(self.choose)
        when = QHBoxLayout()
        when.addWidget(self.day)
        when.addWidget(self.hour)
        when.addStretch(1)
        self._form = form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(tr("Folder"), folder)
        form.addRow(tr("When"), when)
        form.addRow(tr("Old backups"), self.keep)
        form.addRow(tr("Last backup"), self.last)
        form.addRow(self.words)
        form.addRow(tr("Opened by"), self.kind)
        self.passphrase.add_to(form, tr("Passphrase"))
        form.addRow(tr("Public key"), self.recipient)
        mark_labels(form)
        self.content.addLayout(form)
        self.content.addWidget(self.progress)
        self._show_secret(False)

    def _show_secret(self, asks: bool) -> None:
        """Show the fields that are asked once, before the first backup."""
        is_passphrase = self.kind.currentData() == _PASSPHRASE
        for row in (self.words, self.kind):
            self._form.setRowVisible(row, asks)
        for line in (self.passphrase.first, self.passphrase.again):
            self._form.setRowVisible(line, asks and is_passphrase)
        self._form.setRowVisible(self.recipient, asks and not is_passphrase)

    @property
    def _folder(self) -> Path | None:
        text = self.folder.text().strip()
        return Path(text) if text else None

    def _show(self, state: BackupState) -> None:
        self._state = state
        self._show_secret(not state.opened_by)
        self.last.setText(_snapshots_text(state))
        self.adjustSize()
        self._allow()

    def _allow(self) -> None:
        is_running = self._backups.is_running
        why_not = tr("A backup is being made.") if is_running else ""
        if self._state is None:
            why_not = tr("The record is being asked about its backups.")
        allow(self.now, why_not)
        self.cancel.setVisible(is_running)
        self.hour.setEnabled(self.day.currentData() != "never")

    def _choose_folder(self) -> None:
        path = self._messages.questions.on(self).folder_to_open(
            tr("Folder of the backups"), Kept.BACKUPS
        )
        if path is not None:
            self.folder.setText(str(path))
            self._keep_plan()

    def _keep_plan(self) -> None:
        folder = self._folder
        if folder is not None and not folder.is_absolute():
            self.say(tr("Type the whole path of the folder, or choose it."), warns=True)
            return
        is_ready = self._state is not None and bool(self._state.opened_by)
        day = cast("BackupDay", self.day.currentData())
        # Until there is a passphrase, nothing is due.
        self._backups.set_plan(folder, day, self.hour.value(), is_ready=is_ready)
        self._allow()
        self.read()

    def _begin(self) -> None:
        if self._folder is None:
            self.say(tr("Choose the folder of the backups first."), warns=True)
            self.choose.setFocus()
            return
        self._keep_plan()
        assert self._state is not None
        if self._state.opened_by:
            self._start()
            return
        try:
            kind = self.kind.currentData()
            secret = self.recipient.text() if kind == _RECIPIENT else self.passphrase.read()
        except InputError as error:
            self.refuse(error)
            return
        self.change(lambda r: _set_up(r, kind, secret), lambda _none: self._start_first())

    def _start_first(self) -> None:
        self.passphrase.clear()
        self._show_secret(False)
        self._start()
        self.read()

    def _start(self) -> None:
        self.say("")
        self._backups.begin(is_first=True)
        self._allow()
        self.cancel.setFocus()

    def _cancel(self) -> None:
        self._backups.cancel()
        self.say(tr("The backup was stopped; the ones before are as they were."))

    def _show_progress(self, news: JobProgress) -> None:
        if news.channel == BACKUP:
            self.progress.show_work(news.fraction, news.text)
            self._allow()

    def _end(self, channel: str) -> None:
        if channel == BACKUP:
            self.progress.show_work(0, "")
            had_focus = self.cancel.hasFocus()
            self._allow()
            if had_focus:
                self.now.setFocus()

    def _finish(self, report: BackupReport) -> None:
        sentences = [report_text(report)]
        if report.damaged:
            sentences.append(damaged_text(report))
        self.say_all(sentences, warns=bool(report.damaged))
        self.read()

    def _fail(self, error: InsoleError) -> None:
        self.say(error.message, warns=True)


def _set_up(records: Records, kind: str, secret: str) -> None:
    from insole_core.records.backup.back_up import set_up_backups
    from insole_core.records.backup.backup_key import BackupKey

    if kind == _RECIPIENT:
        key = BackupKey.for_recipients([secret])
    else:
        key = BackupKey.with_passphrase(secret)
    set_up_backups(records.context, key)


def _snapshots_text(state: BackupState) -> str:
    """Return when the last backup was made, and how many there are."""
    if not state.snapshots:
        return tr("None yet")
    newest = moment_text(state.snapshots[-1])
    if len(state.snapshots) == 1:
        return newest
    return fill(
        tr("{newest}; backups in the folder: {count}, the oldest of {oldest}"),
        newest=newest,
        count=len(state.snapshots),
        oldest=moment_text(state.snapshots[0]),
    )


def _keeps() -> list[tuple[str, str]]:
    """Return key and name of the rules by which old backups go."""
    return [
        ("months", tr("All of 30 days, then one of each month")),
        ("year", tr("All of 30 days, then one of each month for a year")),
        ("all", tr("All")),
    ]


def _days() -> list[tuple[str, str]]:
    """Return key and name of the days that a backup can be made on."""
    locale = QLocale()
    weekdays = [
        (str(day), tr("Every {day}").format(day=locale.dayName(day + 1))) for day in range(7)
    ]
    return [("never", tr("Only by hand")), ("daily", tr("Every day")), *weekdays]
