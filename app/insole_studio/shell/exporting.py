"""What leaves for the shop: the solid of the insole, and its outline on paper."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, Signal

from insole_core.cases.record import CaseRecord
from insole_core.export.solid_file import write_solids
from insole_core.export.three_mf import Part
from insole_core.insole.build import build_insole
from insole_core.progress import Progress
from insole_core.solids.solid import make_solid
from insole_studio.jobs import Jobs
from insole_studio.shell.dialogue import Dialogue
from insole_studio.shell.file_kinds import SOLID_KINDS
from insole_studio.shell.outline_print import print_outline
from insole_studio.shell.saving import file_stem
from insole_studio.shell.steps import whose
from insole_studio.texts import tr
from insole_studio.workbench.case import Case

CHANNEL = "export"


class Exporting(QObject):
    """Builds the chosen design of the foot at hand anew and writes it, beside the window."""

    changed = Signal()
    """Something was exported."""

    def __init__(
        self, case: Case, jobs: Jobs, dialogue: Dialogue, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._case = case
        self._jobs = jobs
        self._dialogue = dialogue
        self.exported: CaseRecord | None = None
        """What was exported last."""

    def ask_export(self) -> None:
        """Let the user choose where the STL file goes."""
        path = self._dialogue.questions.file_to_write(f"{file_stem(self._case)}.stl", SOLID_KINDS)
        if path is not None:
            self.export_to(path if path.suffix else path.with_suffix(".stl"))

    def export_to(self, path: Path) -> None:
        """Build the insole anew and write it, beside the window."""
        record = self._case.record
        foot, design = record.foot, record.design
        if foot is None or design is None:
            self._dialogue.show_sentence(
                tr("There is no insole to export yet; open a session or a mesh.")
            )
            return

        def write(progress: Progress) -> None:
            insole = build_insole(foot, design, progress.part(0.0, 0.8))
            solid = make_solid(insole, progress=progress.part(0.8, 0.9))
            progress.step(0.9, tr("Writing the file"))
            write_solids([Part(solid, f"{design.side} insole")], path)

        def done(_nothing: None) -> None:
            self.exported = record
            self.changed.emit()
            self._dialogue.say(tr("Exported {name}").format(name=path.name))

        self._jobs.start(CHANNEL, write, done, self._dialogue.show_error)

    def ask_print_outline(self) -> None:
        """Let the user choose where the PDF goes."""
        path = self._dialogue.questions.file_to_write(
            f"{file_stem(self._case)}-outline.pdf", "PDF (*.pdf)"
        )
        if path is not None:
            self.print_outline_to(path.with_suffix(".pdf"))

    def print_outline_to(self, path: Path) -> None:
        """Write the outline in true size."""
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
            self._dialogue.say(tr("Written: {name}").format(name=path.name))

        self._jobs.start(CHANNEL, write, done, self._dialogue.show_error)
