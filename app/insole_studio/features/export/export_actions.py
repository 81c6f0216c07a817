"""Export of the insole with its documents, and printing of its outline."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal

from insole_core.cases.case_record import CaseRecord
from insole_core.insole.build import build_insole
from insole_core.progress import Progress
from insole_core.solids.shop import read_shop
from insole_core.workflows.clinic_export_rules import ClinicExportRules
from insole_core.workflows.last_order import LastOrder
from insole_studio.document.case_name import file_stem, whose
from insole_studio.features.export.outline_print import print_outline
from insole_studio.services.app_services import AppServices
from insole_studio.services.stage_window import StageWindow
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_studio.features.export.stage import ExportStage

CHANNEL = "export"


class ExportActions(StageWindow["ExportStage"]):
    """Opens the export stage, and prints the outline."""

    changed = Signal()
    """Emitted after an export."""

    def __init__(self, services: AppServices) -> None:
        super().__init__(services.window)
        self._services = services
        self._case = services.case
        self._messages = services.messages
        self.exported: CaseRecord | None = None
        """What was exported last of the open case."""
        self._case.opened.connect(self._forget_exported)

    def make_stage(self) -> ExportStage:
        """Create the stage with the clinic's rules and the last order."""
        from insole_studio.features.export.stage import ExportStage

        shop, folder = read_shop(), self._services.paths.settings_folder
        return ExportStage(
            case=self._case,
            rules=ClinicExportRules(folder / "export.json"),
            shop=shop,
            ask_path=self._ask_path,
            may_replace=self._messages.questions.may_replace,
            memory=LastOrder(folder / "order.json", shop),
            dark=self._services.dark,
        )

    def connect_stage(self, stage: ExportStage) -> None:
        """Record what the stage exports."""
        stage.exported.connect(self._note)

    def leave_case(self) -> None:
        """Close the stage of the case that is left, once nothing is being written."""
        if self.stage is not None and self.stage.is_writing:
            self.stage.jobs.ended.connect(self.leave_case, Qt.ConnectionType.QueuedConnection)
        else:
            self.close()

    def _ask_path(self, word: str, suffix: str) -> Path | None:
        stem = file_stem(self._case)
        if self._case.side is not None:
            stem = stem.removesuffix(f"-{self._case.side}")
        kinds = f"{suffix[1:].upper()} (*{suffix})"
        return self._messages.questions.file_to_write(f"{stem}-{word}{suffix}", kinds)

    def _forget_exported(self) -> None:
        self.exported = None

    def _note(self, record: CaseRecord, paths: Sequence[Path]) -> None:
        self.exported = record
        self.changed.emit()
        names = ", ".join(path.name for path in paths)
        self._messages.say(tr("Exported {name}").format(name=names))

    def ask_print_outline(self) -> None:
        """Let the user choose a PDF file and print the outline into it."""
        path = self._messages.questions.file_to_write(
            f"{file_stem(self._case)}-outline.pdf", "PDF (*.pdf)"
        )
        if path is not None:
            self.print_outline_to(path.with_suffix(".pdf"))

    def print_outline_to(self, path: Path) -> None:
        """Write the outline at 1:1 as PDF."""
        record = self._case.record
        foot, design = record.foot, record.design
        if foot is None or design is None:
            return
        text = "   ".join(part for part in (whose(record), record.patient.visit) if part)

        def write(progress: Progress) -> None:
            insole = build_insole(foot, design, progress.part(0.0, 0.9))
            progress.step(0.9, tr("Writing the file"))
            print_outline(insole, text, path)

        def done(_nothing: None) -> None:
            self._messages.say(tr("Written: {name}").format(name=path.name))

        self._services.run(CHANNEL, write, done)
