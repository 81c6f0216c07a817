"""The devices and forms to choose from, the product's and the clinic's, and which one is usual."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

from insole_core.errors import InputError
from insole_core.files.atomic import make_output_folder, replacing_file
from insole_core.forgiving_json import remembered
from insole_core.insole.forms.form_file import read_form, write_form
from insole_core.insole.prescription.base_form import Form
from insole_core.insole.prescription.device import Device, read_device, write_device
from insole_core.insole.prescription.item_name import key_of
from insole_core.messages import Message
from insole_core.resources import resource_path
from insole_core.workflows.named_files import NamedFiles

DEFAULT_DEVICE = "EVA, full length"
"""The device of new designs, while a clinic has chosen no other."""
AS_SCANNED = "As scanned"
"""The device that leaves the contact surface as it is, thesis 3.3."""


def clinic_devices(folder: Path) -> NamedFiles[Device]:
    """Return the storage of devices.

    Parameters
    ----------
    folder
        Of the clinic's settings.
    """
    return NamedFiles(resource_path("devices"), folder / "devices", read_device, write_device)


def clinic_forms(folder: Path) -> NamedFiles[Form]:
    """Return the storage of base forms.

    Parameters
    ----------
    folder
        Of the clinic's settings.
    """
    return NamedFiles(resource_path("forms"), folder / "forms", read_form, write_form)


def find_device(devices: Mapping[str, Device], name: str) -> Device:
    """Return the device of a name, in whatever case and punctuation.

    Parameters
    ----------
    devices
        As `clinic_devices(folder).load().items`.

    Raises
    ------
    InputError
        Naming the devices that there are.
    """
    device = devices.get(key_of(name))
    if device is None:
        raise InputError(
            'There is no device "{name}"; choose one of {known}.',
            name=name,
            known=", ".join(devices),
        )
    return device


def default_device(devices: Mapping[str, Device], name: str) -> tuple[Device, Message | None]:
    """Return the device of new designs.

    Parameters
    ----------
    devices
        As `clinic_devices(folder).load().items`.
    name
        The clinic's choice.

    Returns
    -------
    device : Device
        The one of this name, or that of the product if it is gone.
    problem : Message or None
        A sentence that says so.
    """
    chosen = devices.get(key_of(name))
    if chosen is not None:
        return chosen, None
    usual = find_device(devices, DEFAULT_DEVICE)
    problem = Message(
        'The clinic\'s device "{name}" is gone, so new designs start with "{usual}"; choose '
        "another one as the clinic's.",
        name=name,
        usual=usual.name,
    )
    return usual, problem


class DefaultDevice:
    """Storage of the clinic's choice beside the settings; a bad file costs only a warning.

    Parameters
    ----------
    folder
        Of the clinic's settings.
    """

    def __init__(self, folder: Path) -> None:
        self._path = folder / "default_device.json"

    def load(self) -> str:
        """Return the name of the device."""
        return str(remembered(self._path, {"device": str}).get("device", DEFAULT_DEVICE))

    def save(self, name: str) -> None:
        """Start new designs with a device.

        Raises
        ------
        OutputError
            When the place cannot be written.
        """
        make_output_folder(self._path.parent)
        with replacing_file(self._path) as beside:
            beside.write_text(json.dumps({"device": name}), encoding="utf-8", newline="\n")
