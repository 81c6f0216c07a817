"""Actions of devices, findings and base forms: choose, keep, share, and back to the imprint."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from insole_core.errors import InsoleError
from insole_core.geometry.side import Side
from insole_core.insole.forms.kept_form import form_of
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import Device, apply_device, device_of
from insole_core.insole.prescription.item_name import key_of
from insole_core.workflows.clinic_devices import (
    AS_SCANNED,
    clinic_devices,
    clinic_forms,
    find_device,
)
from insole_core.workflows.findings import Finding, apply_finding, load_findings
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_core.workflows.pad_library import LibraryPad
from insole_studio.document.insole_preview import InsolePreview
from insole_studio.features.design.devices.device_choices import (
    Choice,
    Kind,
    device_choices,
    finding_choices,
    form_choices,
)
from insole_studio.features.design.devices.devices_presenter import DevicesPresenter
from insole_studio.features.design.devices.devices_view import DevicesView, MenuEntry
from insole_studio.services.app_services import AppServices
from insole_studio.services.file_kinds import DEVICE_SUFFIX, device_kinds
from insole_studio.services.last_folders import Kept
from insole_studio.texts import tr, translate_core_message


class DeviceActions:
    """Opens the list of devices, and does what its menu offers.

    Parameters
    ----------
    preview
        Of the insole whose form is kept.
    pads
        The library that findings propose from.
    behind_heads_mm
        The clinic's rule on the place of pads.
    """

    def __init__(
        self,
        services: AppServices,
        preview: InsolePreview,
        pads: Sequence[LibraryPad],
        behind_heads_mm: float,
    ) -> None:
        self._services = services
        self._case = services.case
        self._preview = preview
        self._pads = pads
        self._behind_heads_mm = behind_heads_mm
        folder = services.paths.settings_folder
        self._devices, self._forms = clinic_devices(folder), clinic_forms(folder)
        self._view: DevicesView | None = None
        self._presenter: DevicesPresenter | None = None
        self._designed: dict[Side, InsoleDesign] = {}
        """The design of each foot before it was last shown as scanned."""
        services.case.closing.connect(self._forget)

    @property
    def view(self) -> DevicesView | None:
        """The list, while it is open."""
        return self._view

    def open(self) -> None:
        """Open the list of devices and findings."""
        choices = self._choices()
        self._view = DevicesView(self._services.window)
        self._presenter = DevicesPresenter(
            self._view, self._case, choices, self._default, self._entries
        )
        self._view.apply_requested.connect(self._view.accept)
        self._view.entry_chosen.connect(self._take_entry)
        self._view.finished.connect(self._close)
        self._view.open()

    def toggle_as_scanned(self) -> None:
        """Change between the imprint of the foot and the device that was designed last."""
        design = self._case.record.design
        if design is None:
            return
        devices = self._devices.load().items
        if design.finish is None:
            before = self._designed.get(design.side)
            device = find_device(devices, self._default)
            changed = apply_device(device, design) if before is None else _device_part(before, design)
            self._case.apply(changed, tr("Design the rim"))
        else:
            self._designed[design.side] = design
            changed = apply_device(find_device(devices, AS_SCANNED), design)
            self._case.apply(changed, tr("As scanned"))
