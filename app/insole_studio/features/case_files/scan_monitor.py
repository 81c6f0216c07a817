"""Warn about scans of a case that have changed or look suspicious."""

from __future__ import annotations

from PySide6.QtCore import QObject

from insole_core.cases.case_record import CaseRecord
from insole_core.foot.measure_table import unlike_sizes
from insole_core.messages import joined
from insole_core.progress import Progress
from insole_core.workflows.scanned_foot import change_of_source
from insole_studio.services.app_services import AppServices
from insole_studio.texts import translate_core_message

CHANNEL = "sources"
SOURCES, SIZES = "sources", "sizes"


class ScanMonitor(QObject):
    """Checks the scans of each opened case, and the sizes of its feet."""

    def __init__(self, services: AppServices, parent: QObject) -> None:
        super().__init__(parent)
        self._services = services
        self._case = case = services.case
        self._notices = services.notices
        self._sizes = ""
        case.closing.connect(self._forget)
        case.opened.connect(self._look_at_sources)
        case.opened.connect(self._look_at_sizes)
        case.changed.connect(self._look_at_sizes)

    def _forget(self) -> None:
        self._services.jobs.cancel(CHANNEL)
        self._sizes = ""

    def _look_at_sources(self) -> None:
        record = self._case.record
        if self._case.path is None or not record.feet:
            return

        def look(_progress: Progress) -> str:
            return changes_of(record)

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


def changes_of(record: CaseRecord) -> str:
    """Return one sentence per foot whose scan has changed; empty if none has."""
    sentences = (change_of_source(foot.source) for foot in record.feet)
    return joined(filter(None, sentences), " ")
