"""Verifying the whole record, with a report."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QWidget

from insole_core.progress import Progress
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.features.clinic.record_dialog import RecordDialog
from insole_studio.jobs import JobProgress, Jobs
from insole_studio.texts import fill, tr
from insole_studio.widgets.message_label import MessageLabel, ProgressBar

if TYPE_CHECKING:
    from insole_core.records.context import RecordsContext
    from insole_core.records.verify import VerifyReport

_WIDTH_PX = 560
_VERIFY = "verify"
_MEGABYTE = 1e6


class VerifyDialog(RecordDialog):
    """Verifies the whole record as it opens, and says what was found."""

    def __init__(self, clinic: ClinicRecord, jobs: Jobs, parent: QWidget | None = None) -> None:
        super().__init__(tr("Verify the record"), clinic, parent)
        self.setMinimumWidth(_WIDTH_PX)
        self._jobs = jobs
        self.verdict = MessageLabel()
        self.progress = ProgressBar()
        self.content.addWidget(self.verdict)
        self.content.addWidget(self.progress)
        self.content.addStretch(1)
        self.again = self.add_button(tr("Verify again"), self.verify)
        jobs.progressed.connect(self._show_progress)
        jobs.ended.connect(self._end)
        self.verify()

    def verify(self) -> None:
        """Read the audit log, the signatures and all files."""
        self.verdict.say("")
        self.say("")
        self.again.setEnabled(False)
        context = self.clinic.ask_now(lambda records: records.context)
        self._jobs.start(
            _VERIFY,
            _verification(context),
            self.while_open(self._show),
            self.while_open(self.refuse),
        )

    def reject(self) -> None:
        """Stop, and close the dialog."""
        self._jobs.cancel(_VERIFY)
        super().reject()

    def _show(self, report: VerifyReport) -> None:
        sentences = fill(
            tr(
                "Verified: lines of the audit log {lines}, signatures {signatures}, files {files} "
                "({size_mb:.1f} MB)."
            ),
            lines=report.audit.lines,
            signatures=report.signatures.checked,
            files=report.contents.checked,
            size_mb=report.contents.checked_bytes / _MEGABYTE,
        )
        problems = report.problems()
        sound = [] if problems else [tr("Everything is what was stored.")]
        self.verdict.say_all([*sound, sentences])
        self.say_all(list(problems), warns=True)

    def _show_progress(self, news: JobProgress) -> None:
        if news.channel == _VERIFY:
            self.progress.show_work(news.fraction, news.text)

    def _end(self, channel: str) -> None:
        if channel == _VERIFY:
            self.progress.show_work(0, "")
            self.again.setEnabled(True)


def _verification(context: RecordsContext) -> Callable[[Progress], VerifyReport]:
    def verify(progress: Progress) -> VerifyReport:
        from insole_core.records.verify import verify_record

        return verify_record(context, progress=progress)

    return verify
