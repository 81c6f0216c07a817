"""The clinic's table of materials, stored beside the settings."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from insole_core.errors import InputError
from insole_core.files.atomic import make_output_folder, replacing_file
from insole_core.forgiving_json import keep_unreadable
from insole_core.insole.prescription.materials import (
    Material,
    MaterialTable,
    read_materials,
    write_materials,
)
from insole_core.messages import Message


class ClinicMaterials:
    """Storage of the table of materials.

    Parameters
    ----------
    folder
        Of the clinic's settings; while there is no table in it, that of the product applies.
    """

    def __init__(self, folder: Path) -> None:
        self._path = folder / "materials.json"

    def load(self) -> tuple[MaterialTable, Message | None]:
        """Return the table that applies.

        Returns
        -------
        table : MaterialTable
            That of the product if the clinic's cannot be read.
        problem : Message or None
            A sentence that says so.
        """
        if not os.path.lexists(self._path):
            return read_materials(), None
        try:
            return read_materials(self._path), None
        except InputError as error:
            return read_materials(), error.message

    def save(self, materials: Sequence[Material]) -> None:
        """Store the clinic's table; a file that cannot be read is kept under another name.

        Raises
        ------
        OutputError
            When the place cannot be written.
        """
        make_output_folder(self._path.parent)
        if self._path.exists():
            keep_unreadable(self._path, lambda: read_materials(self._path))
        export_materials(materials, self._path)


def export_materials(materials: Sequence[Material], path: Path) -> None:
    """Write a table for another clinic to import.

    Raises
    ------
    OutputError
        When the place cannot be written.
    """
    with replacing_file(path) as beside:
        write_materials(materials, beside)
