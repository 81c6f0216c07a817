"""Verifying something of the record in a job, such as the whole of it, with a report."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QPushButton, QWidget

from insole_core.progress import Progress
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.features.clinic.record_dialog import Answer, Done, RecordDialog
from insole_studio.jobs import JobProgress, Jobs
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.message_label import MessageLabel, ProgressBar

if TYPE_CHECKING:
    from insole_core.records.context import RecordsContext
    from insole_core.records.verify import VerifyReport

_WIDTH_PX = 560
_VERIFY = "verify"


class VerifyingDialog(RecordDialog):
    """Shows how far a verification is; closing the dialog stops it.

    Parameters
    ----------
    channel
        Of the job.
    """

    def __init__(
        self, title: str, clinic: ClinicRecord, jobs: Jobs, channel: str, parent: QWidget | None
    ) -> None:
        super().__init__(title, clinic, parent)
        self._jobs, self._channel = jobs, channel
        self._button: QPushButton | None = None
        self.progress = ProgressBar()
        jobs.progressed.connect(self._show_progress)
        jobs.ended.connect(self._end)

    def add_verify_button(self, text: str, run: Callable[[], object]) -> QPushButton:
        """Add the button that verifies; it cannot be pressed while that is being done."""
        self._button = self.add_button(text, run)
        return self._button

    def run_verification(self, task: Callable[[Progress], Answer], done: Done[Answer]) -> None:
        """Verify in a job; a refusal is told in the dialog."""
        self.say("")
        if self._button is not None:
            self._button.setEnabled(False)
        self._jobs.start(self._channel, task, self.while_open(done), self.while_open(self.refuse))

    def reject(self) -> None:
        """Stop verifying, and close the dialog."""
        self._jobs.cancel(self._channel)
        super().reject()

    def _show_progress(self, news: JobProgress) -> None:
        if news.channel == self._channel:
            self.progress.show_work(news.fraction, news.text)

    def _end(self, channel: str) -> None:
        if channel == self._channel:
            self.progress.show_work(0, "")
            if self._button is not None:
                self._button.setEnabled(True)


class VerifyDialog(VerifyingDialog):
    """Verifies the whole record as it opens, and says what was found."""

    def __init__(self, clinic: ClinicRecord, jobs: Jobs, parent: QWidget | None = None) -> None:
        super().__init__(tr("Verify the record"), clinic, jobs, _VERIFY, parent)
        self.setMinimumWidth(_WIDTH_PX)
        self.verdict = MessageLabel()
        self.content.addWidget(self.verdict)
        self.content.addWidget(self.progress)
        self.content.addStretch(1)
        self.again = self.add_verify_button(tr("Verify again"), self.verify)
        self.verify()

    def verify(self) -> None:
        """Read the audit log, the signatures and all files."""
        self.verdict.say("")
        context = self.clinic.ask_now(lambda records: records.context)
        self.run_verification(_verification(context), self._show)

    def _show(self, report: VerifyReport) -> None:
        compared = translate_core_message(report.compared())
        problems = report.problems()
        sound = [] if problems else [tr("Everything is what was stored.")]
        self.verdict.say_all([*sound, compared])
        self.say_all(list(problems), warns=True)


def _verification(context: RecordsContext) -> Callable[[Progress], VerifyReport]:
    def verify(progress: Progress) -> VerifyReport:
        from insole_core.records.verify import verify_record

        return verify_record(context, progress=progress)

    return verify
