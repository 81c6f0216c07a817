"""The export stage as a window of its own: checks the parts and exports them."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Signal
from PySide6.QtGui import QCloseEvent

from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.prescription.materials import MaterialTable
from insole_core.milling.machine import Machine
from insole_core.solids.shop import Shop
from insole_core.workflows.clinic_tables import ClinicBlocks, ClinicExportRules
from insole_core.workflows.last_order import LastOrder
from insole_core.workflows.named_files import NamedFiles
from insole_core.workflows.starting_design import StartingDevice
from insole_studio.document.case import Case
from insole_studio.features.export.order_form import Stock
from insole_studio.features.export.presenter import WRITING, ExportPresenter, OrderAsker
from insole_studio.features.export.rows import ToldOnPapers, nothing_told
from insole_studio.features.export.view import ExportView
from insole_studio.jobs import Jobs
from insole_studio.texts import tr
from insole_studio.widgets.tab_order import StageFrame

_SIZE = (1280, 700)


class ExportStage(StageFrame):
    """Window "Check & export".

    Parameters
    ----------
    case
        The open case.
    rules
        Storage of the clinic's rules.
    materials
        Of the clinic, for the warnings of the design.
    shop
        The workshop that receives the order.
    blocks
        Storage of the clinic's own blocks.
    asker
        Asks for what the order needs, and tells of a failure.
    memory
        Storage of the last order.
    machines
        Storage of the routers.
    dark
        Whether to use the dark theme.
    drawn
        The insole as the design shows it, until the piece is made.
    told
        Returns what was ticked to stand on the papers of a case.
    starting
        Returns the device that new prescriptions begin with.
    """

    closed = Signal()
    exported = Signal(object, object)
    """Emitted with the exported record and an `Ordered`."""

    def __init__(
        self,
        *,
        case: Case,
        rules: ClinicExportRules,
        materials: MaterialTable,
        shop: Shop,
        blocks: ClinicBlocks,
        asker: OrderAsker,
        memory: LastOrder,
        machines: NamedFiles[Machine],
        dark: bool,
        drawn: TriangleMesh | None = None,
        told: ToldOnPapers = nothing_told,
        starting: Callable[[], StartingDevice],
    ) -> None:
        super().__init__()
        self.setWindowTitle(tr("Check & export") + " – Insole Studio")
        self.resize(*_SIZE)
        self.view = ExportView(Stock(shop.blocks, shop.materials), dark)
        self.hold(self.view)
        self.view.close_requested.connect(self.close)
        self.jobs = Jobs(self)
        self.presenter = ExportPresenter(
            self.view,
            case=case,
            jobs=self.jobs,
            rules=rules,
            materials=materials,
            shop=shop,
            blocks=blocks,
            asker=asker,
            memory=memory,
            machines=machines,
            exported=self.exported.emit,
            drawn=drawn,
            told=told,
            starting=starting,
        )

    @property
    def is_writing(self) -> bool:
        """Whether files are being written."""
        return self.jobs.is_running(WRITING)

    def hide_until_written(self) -> None:
        """Show nothing more of the case, which is left; the files are written all the same."""
        self.presenter.close()
        self.hide()

    def go_back(self) -> None:
        """Cancel what is being made; else close the window."""
        if self.view.cancel.isVisible():
            self.view.cancel.click()
        else:
            self.close()

    def step_aside(self) -> None:
        """Close the window, unless files are being written."""
        if not self.is_writing:
            self.close()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Cancel the running job and free the renderer."""
        self.presenter.close()
        self.jobs.close()
        self.view.model.scene.close_scene()
        event.accept()
        self.closed.emit()
