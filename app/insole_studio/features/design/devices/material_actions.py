"""Edit, import and export the clinic's table of materials."""

from __future__ import annotations

from dataclasses import replace

from insole_core.cases.case_record import CaseRecord
from insole_core.errors import InsoleError
from insole_core.insole.prescription.materials import (
    MaterialTable,
    read_materials,
    with_least_thickness,
)
from insole_core.workflows.clinic_tables import ClinicMaterials, export_materials
from insole_studio.document.material_model import MaterialModel
from insole_studio.features.design.devices.materials_dialog import MaterialsDialog
from insole_studio.services.app_services import AppServices
from insole_studio.services.files import MATERIALS_SUFFIX, Kept, material_kinds
from insole_studio.texts import tr, translate_core_message

_UNREADABLE = "unreadable materials"


class MaterialActions:
    """Opens the table, and stores what was edited.

    Parameters
    ----------
    model
        Gets the clinic's table now, and whenever it is edited.
    """

    def __init__(self, services: AppServices, model: MaterialModel) -> None:
        self._services = services
        self._model = model
        self._storage = ClinicMaterials(services.paths.settings_folder)
        self._dialog: MaterialsDialog | None = None
        table, problem = self._storage.load()
        model.take(table)
        if problem is not None:
            sentence = translate_core_message(problem)
            services.notices.put(_UNREADABLE, sentence, stays=True)

    @property
    def dialog(self) -> MaterialsDialog | None:
        """The table, while it is open."""
        return self._dialog

    def open(self) -> None:
        """Open the table."""
        supplied = read_materials().materials
        self._dialog = MaterialsDialog(self._model.table.materials, supplied, self._services.window)
        self._dialog.import_requested.connect(self._import)
        self._dialog.export_requested.connect(self._export)
        self._dialog.accepted.connect(self._keep)
        self._dialog.finished.connect(self._close)
        self._dialog.open()

    def _keep(self) -> None:
        """Store the table, and give the designs of the case what it now asks for."""
        assert self._dialog is not None
        table = MaterialTable(self._dialog.materials)
        if table.materials == self._model.table.materials:
            return
        try:
            self._storage.save(table.materials)
        except InsoleError as error:
            self._services.messages.show_error(error)
            return
        self._services.notices.drop(_UNREADABLE)
        case = self._services.case
        case.apply(_with_table(case.record, table), tr("Change the table of materials"))
        self._model.take(table)
        self._services.messages.say(tr("Stored: {name}").format(name=tr("Table of materials")))

    def _import(self) -> None:
        """Show the rows of another clinic's file; they count once the table is saved."""
        assert self._dialog is not None
        questions = self._services.messages.questions.on(self._dialog)
        path = questions.file_to_open(material_kinds(), Kept.CASES)
        if path is None:
            return
        try:
            self._dialog.show_materials(read_materials(path).materials)
        except InsoleError as error:
            self._services.messages.show_error(error, self._dialog)

    def _export(self) -> None:
        assert self._dialog is not None
        questions = self._services.messages.questions.on(self._dialog)
        name = f"{tr('materials')}{MATERIALS_SUFFIX}"
        path = questions.file_to_write(name, material_kinds(), Kept.CASES)
        if path is None:
            return
        try:
            export_materials(self._dialog.materials, path)
        except InsoleError as error:
            self._services.messages.show_error(error, self._dialog)
            return
        self._services.messages.say(tr("Written: {name}").format(name=path.name))

    def _close(self) -> None:
        dialog, self._dialog = self._dialog, None
        if dialog is not None:
            dialog.deleteLater()


def _with_table(record: CaseRecord, table: MaterialTable) -> CaseRecord:
    """Return a case whose chosen designs are as thick at least as a table asks for.

    Variants that are not chosen stay as they were kept.
    """
    feet = record
    for foot in record.feet:
        design = with_least_thickness(foot.design, table)
        if design is not foot.design:
            feet = feet.with_foot(foot.with_design(design))
    return feet if feet is record else replace(feet, at_hand=record.at_hand)
