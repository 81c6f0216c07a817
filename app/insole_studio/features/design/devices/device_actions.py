"""Actions of devices, findings and base forms: choose, keep, share, and back to the imprint."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from insole_core.errors import InsoleError
from insole_core.insole.kept_form import form_of
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import Device, apply_device, device_of
from insole_core.insole.prescription.item_name import key_of
from insole_core.insole.prescription.materials import with_least_thickness
from insole_core.workflows.clinic_devices import (
    AS_SCANNED,
    DEFAULT_DEVICE,
    DefaultDevice,
    clinic_devices,
    clinic_forms,
    find_device,
)
from insole_core.workflows.clinic_findings import ClinicFindings
from insole_core.workflows.findings import Catalogue, Finding, apply_finding
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_core.workflows.named_files import Item, NamedFiles
from insole_core.workflows.pad_library import LibraryPad
from insole_core.workflows.starting_design import starting_device
from insole_studio.document.insole_preview import InsolePreview
from insole_studio.document.material_model import MaterialModel
from insole_studio.features.design.devices.device_choices import (
    Choice,
    Kind,
    device_choices,
    finding_choices,
    form_choices,
)
from insole_studio.features.design.devices.devices_presenter import DevicesPresenter
from insole_studio.features.design.devices.devices_view import DevicesView, MenuEntry
from insole_studio.features.design.devices.finding_actions import FindingActions
from insole_studio.features.design.devices.material_actions import MaterialActions
from insole_studio.services.app_services import AppServices
from insole_studio.services.files import DEVICE_SUFFIX, Kept, device_kinds
from insole_studio.texts import tr, translate_core_message

CHANNEL = "form"
_UNREADABLE = "unreadable devices"


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
    materials
        The clinic's table.
    """

    def __init__(
        self,
        services: AppServices,
        preview: InsolePreview,
        pads: Sequence[LibraryPad],
        behind_heads_mm: float,
        materials: MaterialModel,
    ) -> None:
        self._services = services
        self._case = services.case
        self._preview = preview
        self._pads = pads
        self._behind_heads_mm = behind_heads_mm
        folder = services.paths.settings_folder
        self._devices, self._forms = clinic_devices(folder), clinic_forms(folder)
        self._default_device = DefaultDevice(folder)
        self._findings = ClinicFindings(folder)
        self._of_findings = FindingActions(
            services, self._findings, lambda: self._catalogue, self._renew
        )
        self._materials = materials
        self.table = MaterialActions(services, materials)
        self._view: DevicesView | None = None
        self._presenter: DevicesPresenter | None = None
        self._designed: dict[object, InsoleDesign] = {}
        """The designs before they were last shown as scanned, by the identity of their variant."""
        services.case.closing.connect(self._forget)

    @property
    def view(self) -> DevicesView | None:
        """The list, while it is open."""
        return self._view

    def open(self) -> None:
        """Open the list of devices and findings; say which of the clinic's cannot be read."""
        choices = self._choices()
        self._tell_unreadable()
        self._view = DevicesView(self._services.window)
        self._presenter = DevicesPresenter(
            self._view, self._case, choices, self._default_key, self._entries
        )
        self._view.apply_requested.connect(self._view.accept)
        self._view.entry_chosen.connect(self._take_entry)
        self._view.finished.connect(self._close)
        self._view.open()

    def toggle_as_scanned(self) -> None:
        """Change between the imprint of the foot and the device that was designed last."""
        foot = self._case.record.current
        if foot is None:
            return
        design, variant = foot.design, foot.chosen_variant.identity
        devices = self._devices.load().items
        if design.finish is None:
            before = self._designed.get(variant)
            device = devices[key_of(self._default)]
            if device.values.finish is None:
                device = find_device(devices, DEFAULT_DEVICE)
            changed = apply_device(device, design) if before is None else _again(before, design)
            self._case.apply(self._with_table(changed), tr("Design the rim"))
        else:
            self._designed[variant] = design
            changed = apply_device(find_device(devices, AS_SCANNED), design)
            self._case.apply(changed, tr("As scanned"))

    def save_as_device(self) -> None:
        """Keep the values of this design as a device of the clinic."""
        design = self._case.record.design
        asked = self._services.messages.questions.text(
            tr("Save as a device"),
            tr("Name of the device"),
            "" if design is None else design.device,
        )
        if asked is None or design is None:
            return
        self._store(self._devices, device_of(design, asked), "device")

    def import_device(self) -> None:
        """Take a device from a file of another clinic."""
        path = self._services.messages.questions.file_to_open(device_kinds(), Kept.CASES)
        if path is not None:
            self._store(self._devices, self._devices.read(path), "device")

    def export_device(self, device: Device) -> None:
        """Write a device to a file for another clinic."""
        path = self._services.messages.questions.file_to_write(
            f"{device.key}{DEVICE_SUFFIX}", device_kinds(), Kept.CASES
        )
        if path is not None:
            self._devices.export(device, path)
            self._services.messages.say(tr("Written: {name}").format(name=path.name))

    def make_default(self, device: Device) -> None:
        """Start new designs with a device."""
        self._default_device.save(device.name)
        self._renew("", tr("New designs start with: {name}").format(name=_shown(device)))

    def remove_device(self, device: Device) -> None:
        """Remove a device of the clinic."""
        self._devices.remove(device.name)
        self._renew("", tr("Removed: {name}").format(name=_shown(device)))

    def keep_form(self) -> None:
        """Keep the form of this insole as a base for others."""
        design = self._case.record.design
        insole = self._preview.insole
        if design is None or insole is None:
            return
        asked = self._services.messages.questions.text(
            tr("Keep this insole's form as a base"), tr("Name of the form"), design.device
        )
        if asked is not None:
            self._services.run(
                CHANNEL,
                lambda _progress: form_of(insole, asked),
                lambda form: self._store(self._forms, form, "form"),
            )

    def _store(self, files: NamedFiles[Item], item: Item, kind: str) -> None:
        """Store a device or form of the clinic, unless one of its name is to be kept."""
        questions, key = self._services.messages.questions, key_of(item.name)
        if key not in files.load().own or questions.may_replace_own(item.name):
            files.save(item)
            self._renew(f"{kind}:{key}", tr("Stored: {name}").format(name=item.name))

    @property
    def _default(self) -> str:
        """Name of the device that new designs start with."""
        return starting_device(self._services.paths.settings_folder).device.name

    @property
    def _default_key(self) -> str:
        return f"device:{key_of(self._default)}"

    def _choices(self) -> list[Choice]:
        return [
            *device_choices(self._devices.load(), self._with_device),
            *finding_choices(self._findings.load(), self._with_finding),
            *form_choices(self._forms.load(), self._case.foot),
        ]

    def _tell_unreadable(self) -> None:
        listed = (self._devices.load(), self._forms.load(), self._findings.load())
        sentences = [sentence for of_kind in listed for sentence in of_kind.unreadable]
        text = "\n".join(map(translate_core_message, sentences))
        if text:
            self._services.notices.put(_UNREADABLE, text, stays=True)
        else:
            self._services.notices.drop(_UNREADABLE)

    @property
    def _catalogue(self) -> Catalogue:
        """What findings refer to."""
        devices = self._devices.load().items
        return Catalogue(devices, self._default, self._pads, self._behind_heads_mm)

    def _with_device(self, device: Device, design: InsoleDesign) -> InsoleDesign:
        return self._with_table(apply_device(device, design))

    def _with_finding(self, finding: Finding, design: InsoleDesign) -> InsoleDesign:
        """Return a design with what is proposed for a finding."""
        landmarks, catalogue = landmarks_of(self._case.record), self._catalogue
        changed = apply_finding(finding, design, landmarks, catalogue, self._case.stamped)
        return self._with_table(changed)

    def _with_table(self, design: InsoleDesign) -> InsoleDesign:
        """Return a design as thick at least as the clinic's table asks for its material."""
        return with_least_thickness(design, self._materials.table)

    def _entries(self, choice: Choice | None) -> list[MenuEntry]:
        """Return the menu below the list, for what is chosen in it."""
        is_device = choice is not None and choice.kind is Kind.DEVICE
        is_finding = choice is not None and choice.kind is Kind.FINDING
        is_own = choice is not None and choice.is_own
        has_own = bool(self._findings.load().own)
        return [
            MenuEntry("save", tr("Save this design as a device…")),
            MenuEntry("keep", tr("Keep this design as a finding…")),
            MenuEntry("form", tr("Keep this insole's form as a base…")),
            MenuEntry("", ""),
            MenuEntry("import", tr("Import a device…")),
            MenuEntry("export", tr("Export this device…"), is_device),
            MenuEntry("default", tr("Make it the clinic's default"), is_device),
            MenuEntry("remove", tr("Remove this device"), is_device and is_own),
            MenuEntry("", ""),
            MenuEntry("import_findings", tr("Import findings…")),
            MenuEntry("export_finding", tr("Export this finding…"), is_finding),
            MenuEntry("export_findings", tr("Export the clinic's findings…"), has_own),
            MenuEntry("edit_finding", tr("Edit this finding…"), is_finding),
            MenuEntry("remove_finding", tr("Remove this finding"), is_finding and is_own),
            MenuEntry("reset_findings", tr("Return to the supplied findings"), has_own),
        ]

    def _take_entry(self, key: str) -> None:
        choice = None if self._presenter is None else self._presenter.chosen
        try:
            if key in _ON_DESIGN:
                _ON_DESIGN[key](self)
            elif key in _ON_FINDINGS:
                _ON_FINDINGS[key](self._of_findings)
            else:
                assert choice is not None, "the menu offers the others for a chosen row only"
                kind, _, name = choice.key.partition(":")
                if kind == "device":
                    _ON_DEVICE[key](self, self._devices.load().items[name])
                else:
                    _ON_FINDING[key](self._of_findings, self._findings.load().items[name])
        except InsoleError as error:
            self._services.messages.show_error(error, self._view)

    def _renew(self, chosen: str, said: str) -> None:
        """Show what was stored in the list, if it is open, and say it."""
        self._services.messages.say(said)
        if self._presenter is not None:
            self._presenter.renew(self._choices(), self._default_key, chosen)

    def _close(self) -> None:
        view, self._view, self._presenter = self._view, None, None
        if view is not None:
            view.deleteLater()

    def _forget(self) -> None:
        """Let go of what belongs to the case that is left."""
        self._designed.clear()
        if self._view is not None:
            self._view.reject()


def _again(before: InsoleDesign, design: InsoleDesign) -> InsoleDesign:
    """Return a design with the device part of an earlier one; its corrections stay."""
    changed = apply_device(device_of(before, before.device or AS_SCANNED), design)
    return replace(changed, device=before.device)


def _shown(device: Device) -> str:
    return translate_core_message(device.name)


_ON_DEVICE: dict[str, Callable[[DeviceActions, Device], None]] = {
    "export": DeviceActions.export_device,
    "default": DeviceActions.make_default,
    "remove": DeviceActions.remove_device,
}
_ON_DESIGN: dict[str, Callable[[DeviceActions], None]] = {
    "save": DeviceActions.save_as_device,
    "import": DeviceActions.import_device,
    "form": DeviceActions.keep_form,
}
_ON_FINDING: dict[str, Callable[[FindingActions, Finding], None]] = {
    "export_finding": FindingActions.export,
    "edit_finding": FindingActions.edit,
    "remove_finding": FindingActions.remove,
}
_ON_FINDINGS: dict[str, Callable[[FindingActions], None]] = {
    "keep": FindingActions.keep,
    "import_findings": FindingActions.import_file,
    "export_findings": FindingActions.export_own,
    "reset_findings": FindingActions.reset,
}
