"""The compare stage as a window of its own."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtGui import QCloseEvent

from insole_core.cases.case_record import CaseRecord
from insole_core.workflows.compare_case import REPORT_SUFFIXES
from insole_studio.document.case import Case
from insole_studio.features.compare.presenter import ComparePresenter
from insole_studio.features.compare.rows import FOLDER
from insole_studio.features.compare.view import CompareView
from insole_studio.jobs import Jobs
from insole_studio.services.files import Kept, mesh_kinds
from insole_studio.services.questions import Questions
from insole_studio.texts import tr
from insole_studio.widgets.tab_order import StageFrame

_SIZE = (1280, 700)
_REPORTS = ";;".join(f"{suffix[1:].upper()} (*{suffix})" for suffix in REPORT_SUFFIXES)


class CompareStage(StageFrame):
    """Window that measures how far two surfaces differ.

    Parameters
    ----------
    case
        Offers its feet and insoles.
    dark
        Whether to use the dark theme.
    questions
        Ask the user for paths; by default with folders of their own.
    visits
        Two visits to compare instead, the newer one first, each with its name.
    ask_source, ask_report
        Let the user choose a path; by default in a dialog.
    """

    closed = Signal()

    def __init__(
        self,
        case: Case,
        dark: bool,
        *,
        questions: Questions | None = None,
        visits: Sequence[tuple[str, CaseRecord]] = (),
        ask_source: Callable[[str], Path | None] | None = None,
        ask_report: Callable[[], Path | None] | None = None,
    ) -> None:
        super().__init__()
        self.setWindowTitle(tr("Compare surfaces") + " – Insole Studio")
        self.resize(*_SIZE)
        self.view = CompareView(dark)
        self.hold(self.view)
        self.view.close_requested.connect(self.close)
        self.jobs = Jobs(self)
        self._questions = questions.on(self) if questions else Questions(self)
        self.presenter = ComparePresenter(
            self.view,
            case=case,
            jobs=self.jobs,
            ask_source=ask_source or self._ask_source,
            ask_report=ask_report or self._ask_report,
            visits=visits,
        )

    def go_back(self) -> None:
        """Cancel what is being made; else close the window."""
        if self.view.cancel.isVisible():
            self.view.cancel.click()
        else:
            self.close()

    def step_aside(self) -> None:
        """Close the window."""
        self.close()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Cancel the running job and free the renderers."""
        self.jobs.close()
        self.view.close_scenes()
        event.accept()
        self.closed.emit()

    def _ask_source(self, kind: str) -> Path | None:
        if kind == FOLDER:
            return self._questions.folder_to_open(tr("Open session"), Kept.SCANS)
        return self._questions.file_to_open(mesh_kinds(), Kept.SCANS)

    def _ask_report(self) -> Path | None:
        return self._questions.file_to_write(f"{tr('difference')}.pdf", _REPORTS, Kept.PAPERS)
