"""Which device new designs start with: the product's usual one, or the clinic's choice."""

from __future__ import annotations

import json
from pathlib import Path

from insole_core.files.atomic import make_output_folder, replacing_file
from insole_core.forgiving_json import remembered
from insole_core.workflows.clinic_devices import DEFAULT_DEVICE


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
