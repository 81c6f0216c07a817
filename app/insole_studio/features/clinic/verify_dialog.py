"""Verifying the whole record, with a report."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QWidget

from insole_core.progress import Progress
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.features.clinic.verifying_dialog import VerifyingDialog
from insole_studio.jobs import Jobs
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.message_label import MessageLabel

if TYPE_CHECKING:
    from insole_core.records.context import RecordsContext
    from insole_core.records.verify import VerifyReport

_WIDTH_PX = 560
_VERIFY = "verify"


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
