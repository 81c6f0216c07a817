"""Actions of devices, findings and base forms: choose, keep, share, and back to the imprint."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from insole_core.errors import InsoleError
from insole_core.insole.forms.kept_form import form_of
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import apply_device, device_of
from insole_core.workflows.clinic_devices import (
    AS_SCANNED,
    clinic_devices,
    clinic_forms,
    default_device,
    find_device,
    set_default_device,
)
from insole_core.workflows.findings import Finding, apply_finding, load_findings
from insole_core.workflows.foot_landmarks import landmarks_of
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
