"""A dialog that verifies something of the record in a job."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtWidgets import QPushButton, QWidget

from insole_core.progress import Progress
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.features.clinic.record_dialog import Answer, Done, RecordDialog
from insole_studio.jobs import JobProgress, Jobs
from insole_studio.widgets.message_label import ProgressBar


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
