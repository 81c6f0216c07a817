"""Export of the insole with its documents, printing of its outline, and the actions."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QWidget

from insole_core.cases.case_record import CaseRecord
from insole_core.export.order_verification import Verification, verify_order
from insole_core.export.shop_order import ORDER_FILE
from insole_core.formats.file_formats import mesh_format
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.build import build_insole
from insole_core.insole.prescription.item_name import key_of
from insole_core.progress import Progress
from insole_core.solids.prescription_paper import Responsible
from insole_core.solids.shop import Block, read_shop
from insole_core.workflows.clinic_tables import ClinicBlocks, ClinicExportRules, ClinicMaterials
from insole_core.workflows.last_order import LastOrder
from insole_core.workflows.make_order import Package
from insole_core.workflows.mill import clinic_machines
from insole_core.workflows.order_package import Ordered
from insole_core.workflows.starting_design import starting_device
from insole_studio.document.case_names import foot_stem, whose
from insole_studio.features.export.outline_print import print_outline
from insole_studio.services.action_record import ActionRecord
from insole_studio.services.app_services import AppServices
from insole_studio.services.files import Kept
from insole_studio.services.questions import Questions
from insole_studio.services.stage_window import StageWindow
from insole_studio.services.user_messages import LONG_MS
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.form_parts import Field

if TYPE_CHECKING:
    from insole_studio.features.export.rows import ToldOnPapers
    from insole_studio.features.export.stage import ExportStage

EXPORT_ACTIONS: tuple[ActionRecord[ExportActions], ...] = (
    ActionRecord(
        "export",
        lambda: tr("Check & export…").replace("&", "&&"),
        lambda: tr("Check the insole and write it for the shop, with its papers"),
        lambda exporter, _on: exporter.open(),
        icon="export",
        shortcut="Ctrl+E",
        needs_foot=True,
    ),
    ActionRecord(
        "print_outline",
        lambda: tr("Print outline 1:1…"),
        lambda: tr("Write the outline of the insole in true size as a PDF"),
        lambda exporter, _on: exporter.ask_print_outline(),
        shortcut="Ctrl+P",
        needs_foot=True,
    ),
    ActionRecord(
        "verify_order",
        lambda: tr("Verify order…"),
        lambda: tr("Say whether the files of an order are as they were written"),
        lambda exporter, _on: exporter.ask_verify_order(),
    ),
)


def _machine_files() -> str:
    return tr("Router (*.json)")


CHANNEL = "export"
LEFT_NOTICE = "order"
_MOST_LINES = 8
"""Of what is wrong with an order, in a dialog."""


class ExportActions(StageWindow["ExportStage"]):
    """Opens the export stage, and prints the outline.

    Parameters
    ----------
    drawn
        Returns the insole as the design shows it; None while it shows none.
    told
        Returns what was ticked to stand on the papers of a case.
    """

    changed = Signal()
    exported_files = Signal(object, object, str)
    """Emitted with the record that was exported, an `Ordered`, and the visit that it is of."""

    def __init__(
        self,
        services: AppServices,
        drawn: Callable[[], TriangleMesh | None],
        told: ToldOnPapers,
    ) -> None:
        super().__init__(services.window)
        self._drawn, self._told = drawn, told
        self._services = services
        self._case = services.case
        self._messages = services.messages
        self._left: list[ExportStage] = []
        """Stages of cases that were left, hidden while they still write."""
        self.exported: CaseRecord | None = None
        """What was exported last of the open case."""
        self._case.opened.connect(self._forget_exported)

    def make_stage(self) -> ExportStage:
        """Create the stage with the clinic's rules and the last order."""
        from insole_studio.features.export.stage import ExportStage

        shop, folder = read_shop(), self._services.paths.settings_folder
        blocks, machines = ClinicBlocks(folder / "blocks.json"), clinic_machines(folder)
        return ExportStage(
            case=self._case,
            rules=ClinicExportRules(folder / "export.json"),
            materials=ClinicMaterials(folder).load()[0],
            shop=shop,
            blocks=blocks,
            asker=self,
            memory=LastOrder(folder / "order.json", shop, blocks, machines),
            machines=machines,
            dark=self._services.dark,
            drawn=self._drawn(),
            told=self._told,
            starting=lambda: starting_device(folder),
        )

    def connect_stage(self, stage: ExportStage) -> None:
        """Record what the stage exports."""
        stage.exported.connect(self._note)

    def leave_case(self) -> None:
        """Close the stage of the case that is left; what it is writing is finished, and told."""
        stage = self.stage
        if stage is None or not stage.is_writing:
            super().close()
            return
        stage.closed.disconnect(self._forget)
        stage.exported.disconnect(self._note)
        stage.exported.connect(partial(self._tell_of_left, self._services.keeper.visit_id))
        stage.jobs.ended.connect(self._close_left, Qt.ConnectionType.QueuedConnection)
        stage.hide_until_written()
        self._left.append(stage)
        self.stage = None
        self._services.notices.put(
            LEFT_NOTICE,
            tr("The order of the case before is still being written."),
            (tr("Cancel"), self._cancel_left),
            stays=True,
        )

    def close(self) -> None:
        """Close the stage, and cancel what is still being written of cases that were left."""
        for stage in self._left:
            stage.presenter.cancel()
        self._close_left()
        super().close()

    def _cancel_left(self) -> None:
        for stage in self._left:
            stage.presenter.cancel()
        self._messages.say(tr("Writing the order of the case before was stopped."), LONG_MS)

    def _tell_of_left(self, visit_id: str, record: CaseRecord, ordered: Ordered) -> None:
        """Tell that the order of a case that was left is written, and which visit it is of."""
        self._messages.say(tr("The order of the case before has been written."), LONG_MS)
        self.exported_files.emit(record, ordered, visit_id)

    def _close_left(self) -> None:
        """Close the stages of cases that were left and whose files are written."""
        written = [stage for stage in self._left if not stage.is_writing]
        self._left = [stage for stage in self._left if stage.is_writing]
        for stage in written:
            stage.close()
            stage.deleteLater()
        if not self._left:
            self._services.notices.drop(LEFT_NOTICE)

    def path(self, pseudonym: str, word: str, suffix: str) -> Path | None:
        """Let the user choose a file for the workshop, which never gets the patient's name."""
        form = mesh_format(suffix)
        kinds = f"{form.name} ({form.patterns})"
        stem = re.sub(r'[<>:"/\\|?*\s]+', "_", pseudonym)
        name = "-".join(filter(None, (stem, word)))
        return self._questions.name_to_write(name + suffix, kinds, Kept.EXPORTS)

    def package_path(self, number: str, package: Package) -> Path | None:
        """Let the user choose where an order is written; a folder is named after its number."""
        if package == "zip":
            return self._questions.name_to_write(f"{number}.zip", "ZIP (*.zip)", Kept.EXPORTS)
        title = tr("Choose the folder to put the folder of order {number} into")
        within = self._questions.folder_to_open(title.format(number=number), Kept.EXPORTS)
        return None if within is None else within / number

    def may_replace(self, paths: Sequence[Path]) -> bool:
        """Ask whether existing files may be overwritten."""
        return self._questions.may_replace(paths)

    def blocks(self, own: Sequence[Block], stock: Sequence[Block]) -> tuple[Block, ...] | None:
        """Let the user edit the clinic's own blocks."""
        from insole_studio.features.export.blocks_dialog import ask_blocks

        return ask_blocks(own, stock, self._over)

    def machine_file(self) -> Path | None:
        """Let the user choose the file of a router."""
        return self._questions.file_to_open(_machine_files(), Kept.EXPORTS)

    def machine_file_to_write(self, name: str) -> Path | None:
        """Let the user choose where to save the file of a router."""
        return self._questions.file_to_write(f"{key_of(name)}.json", _machine_files(), Kept.EXPORTS)

    def zones_file(self) -> Path | None:
        """Let the user choose a file of zones."""
        return self._questions.file_to_open(tr("Zones (*.json)"), Kept.EXPORTS)

    def responsible(self) -> Responsible:
        """Return who prescribes and makes, as the settings say."""
        settings = self._services.settings
        return Responsible(
            prescriber=self._case.author,
            clinic=settings.clinic,
            maker=settings.maker,
            maker_address=settings.maker_address,
        )

    def ask_missing(self) -> bool:
        """Ask for what a prescription lacks, if anything; False if cancelled."""
        missing = self.responsible().missing or not self._case.record.patient.name
        return self.ask_responsible() if missing else True

    def when_newest(self, then: Callable[[], None]) -> None:
        """Go on where nothing newer is stored elsewhere; if it is, offer to open it.

        An order is of the newest version: an older one would be made, and another one be noted.
        """
        self._services.keeper.when_newest(then, self._offer_newer)

    def _offer_newer(self) -> None:
        if self._questions.may_open_newer():
            self._services.keeper.open_newer(self.tell)

    def ask_responsible(self) -> bool:
        """Let the user say who prescribes and makes, and for whom if that is missing."""
        patient, known = self._case.record.patient, self.responsible()
        fields = [
            Field("prescriber", tr("Prescriber"), known.prescriber),
            Field("clinic", tr("Clinic, if any"), known.clinic, required=False),
            Field("maker", tr("Maker of the insole"), known.maker),
            Field("maker_address", tr("Address of the maker"), known.maker_address),
        ]
        if not patient.name:
            fields.insert(0, Field("name", tr("Name of the patient")))
        given = self._questions.fields(
            tr("Prescriber and maker"),
            tr(
                "The prescription states who prescribes the insole and who makes it, as Annex XIII "
                "of the EU regulation on medical devices asks for. The shop does not get it."
            ),
            fields,
        )
        if given is None:
            return False
        if "name" in given:
            named = replace(patient, name=given.pop("name"))
            self._case.apply(named, tr("Edit the patient's fields"))
        self._keep(Responsible(**given))
        return True

    def tell(self, error: Exception) -> None:
        """Tell that an export has failed, on the window it was asked from."""
        self._messages.show_error(error, over=self._over)

    def _keep(self, responsible: Responsible) -> None:
        settings = self._services.settings
        self._case.author = settings.author = responsible.prescriber
        settings.clinic, settings.maker = responsible.clinic, responsible.maker
        settings.maker_address = responsible.maker_address
        self._services.save_settings()

    @property
    def _over(self) -> QWidget:
        """The window that questions of the stage are asked on."""
        return self.stage or self._services.window

    @property
    def _questions(self) -> Questions:
        return self._messages.questions.on(self._over)

    def _forget_exported(self) -> None:
        self.exported = None

    def _note(self, record: CaseRecord, ordered: Ordered) -> None:
        self.exported = record
        self.changed.emit()
        self.exported_files.emit(record, ordered, self._services.keeper.visit_id)
        names = ", ".join(path.name for path in ordered.paths)
        self._messages.say(tr("Exported {name}").format(name=names))

    def ask_verify_order(self) -> None:
        """Let the user choose an order, and say whether its files are as they were written."""
        kinds = tr("Order") + f" (*.zip {ORDER_FILE})"
        path = self._messages.questions.file_to_open(kinds, Kept.EXPORTS)
        if path is not None:
            self.verify_order(path.parent if path.name == ORDER_FILE else path)

    def verify_order(self, path: Path) -> None:
        """Compare the files of an order, a folder or an archive, with its list."""
        self._services.run(
            CHANNEL, lambda progress: verify_order(path, progress), self._tell_verified
        )

    def _tell_verified(self, verified: Verification) -> None:
        number = verified.order.release.number
        if not verified.problems:
            sentence = tr("Order {number} is complete.").format(number=number)
            answer = f"{sentence} {translate_core_message(verified.compared())}"
            if verified.has_digest:
                self._messages.say(answer, LONG_MS)
            else:
                self._messages.show_sentence(answer)
            return
        lines = [translate_core_message(problem) for problem in verified.problems]
        more = len(lines) - _MOST_LINES
        if more > 0:
            lines[_MOST_LINES:] = [tr("And {count} more.").format(count=more)]
        heading = tr("Order {number} is not as it was written; do not make it:")
        self._messages.show_sentence("\n".join([heading.format(number=number), *lines]))

    def ask_print_outline(self) -> None:
        """Let the user choose a PDF file and print the outline into it."""
        self.when_newest(self._ask_print_outline)

    def _ask_print_outline(self) -> None:
        path = self._messages.questions.file_to_write(
            f"{foot_stem(self._case)}-{tr('outline')}.pdf", "PDF (*.pdf)", Kept.PAPERS
        )
        if path is not None:
            self.print_outline_to(path)

    def print_outline_to(self, path: Path) -> None:
        """Write the outline at 1:1 as PDF."""
        record = self._case.record
        foot, design = record.foot, record.design
        if foot is None or design is None:
            return
        text = "   ".join(part for part in (whose(record), record.patient.visit) if part)

        def write(progress: Progress) -> str:
            insole = build_insole(foot, design, progress.part(0.0, 0.9))
            progress.step(0.9, tr("Writing the file"))
            return print_outline(insole, text, path)

        def done(paper: str) -> None:
            told = tr("Written: {name}, to be printed on {paper} paper")
            self._messages.say(told.format(name=path.name, paper=paper))

        self._services.run(CHANNEL, write, done)
