"""Warn about scans of a case that have changed or look suspicious, and dates that are none."""

from __future__ import annotations

from datetime import date

from PySide6.QtCore import QObject

from insole_core.cases.case_record import CaseRecord
from insole_core.cases.days import doubtful_days
from insole_core.foot.measure_table import unlike_sizes
from insole_core.messages import joined
from insole_core.progress import Progress
from insole_core.workflows.scanned_feet import change_of_source
from insole_studio.services.app_services import AppServices
from insole_studio.texts import translate_core_message

CHANNEL = "sources"
SOURCES, SIZES, DAYS = "sources", "sizes", "days"


class ScanMonitor(QObject):
    """Checks the scans of each opened case, the sizes of its feet, and the patient's dates."""

    def __init__(self, services: AppServices, parent: QObject) -> None:
        super().__init__(parent)
        self._services = services
        self._case = case = services.case
        self._notices = services.notices
        self._sizes = self._days = ""
        case.closing.connect(self._forget)
        case.opened.connect(self._look_at_sources)
        case.opened.connect(self._look_at_sizes)
        case.changed.connect(self._look_at_sizes)
        case.opened.connect(self._look_at_days)
        case.changed.connect(self._look_at_days)

    def _forget(self) -> None:
        self._services.jobs.cancel(CHANNEL)
        self._sizes = self._days = ""

    def _look_at_sources(self) -> None:
        record = self._case.record
        if self._case.path is None or not record.feet:
            return

        def look(progress: Progress) -> str:
            return changes_of(record, progress)

        def tell(sentences: str) -> None:
            if sentences:
                self._notices.put(SOURCES, translate_core_message(sentences))

        self._services.run(CHANNEL, look, tell)

    def _look_at_sizes(self) -> None:
        feet = self._case.record.feet
        sentence = unlike_sizes(feet[0].foot, feet[1].foot) if len(feet) == 2 else ""
        if sentence == self._sizes:
            return
        self._sizes = sentence
        if sentence:
            self._notices.put(SIZES, translate_core_message(sentence))
        else:
            self._notices.drop(SIZES)

    def _look_at_days(self) -> None:
        sentence = doubtful_days(self._case.record.patient, date.today())
        if sentence == self._days:
            return
        self._days = sentence
        if sentence:
            self._notices.put(DAYS, translate_core_message(sentence))
        else:
            self._notices.drop(DAYS)


def changes_of(record: CaseRecord, progress: Progress) -> str:
    """Return one sentence per foot whose scan has changed; empty if none has."""
    sentences = (change_of_source(foot.source, progress) for foot in record.feet)
    return joined(filter(None, sentences), " ")
