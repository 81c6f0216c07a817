"""The clinic's own blocks, materials and export rules, stored beside the settings."""

from __future__ import annotations

import json
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
from insole_core.json_object import JsonObject
from insole_core.messages import Message
from insole_core.solids.export_rules import ExportRules, read_rules, write_rules
from insole_core.solids.shop import Block, read_block

FORMAT, VERSION = "insole-blocks", 1


class ClinicBlocks:
    """Storage of the clinic's own blocks.

    Parameters
    ----------
    path
        While there is no such file, the clinic has none.
    """

    def __init__(self, path: Path) -> None:
        self._path = path

    def load(self) -> tuple[Block, ...]:
        """Return the clinic's blocks.

        Raises
        ------
        InputError
            When the file exists and cannot be read.
        """
        if not self._path.exists():
            return ()
        root = JsonObject.read(self._path)
        root.check_format(FORMAT, VERSION)
        return tuple(read_block(item) for item in root.objects("blocks"))

    def save(self, blocks: Sequence[Block]) -> None:
        """Store the clinic's blocks; a file that cannot be read is kept under another name.

        Raises
        ------
        OutputError
            When the place cannot be written.
        """
        make_output_folder(self._path.parent)
        keep_unreadable(self._path, self.load)
        listed = [{"name": block.name, "size_mm": list(block.size_mm)} for block in blocks]
        content = {"format": FORMAT, "version": VERSION, "blocks": listed}
        with replacing_file(self._path) as beside:
            beside.write_text(json.dumps(content, indent=1), encoding="utf-8", newline="\n")


def require_names(own: Sequence[Block], stock: Sequence[Block]) -> None:
    """Check that every block of the clinic has a name that no other block has.

    Raises
    ------
    InputError
        Naming the first name that is missing or taken.
    """
    taken = {block.name.casefold() for block in stock}
    for block in own:
        if not block.name:
            raise InputError("A block needs a name; type one.")
        if block.name.casefold() in taken:
            raise InputError(
                "There is a block {name} already; give this one another name.", name=block.name
            )
        taken.add(block.name.casefold())


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


class ClinicExportRules:
    """Storage of the export rules.

    Parameters
    ----------
    path
        Of the clinic's rules; while there is no such file, the defaults of the product apply.
    """

    def __init__(self, path: Path) -> None:
        self._path = path

    def load(self) -> ExportRules:
        """Return the rules that apply.

        Raises
        ------
        InputError
            When the file exists and cannot be read.
        """
        return read_rules(self._path if self._path.exists() else None)

    def save(self, rules: ExportRules) -> None:
        """Store the rules of the clinic; a file that cannot be read is kept under another name.

        Raises
        ------
        OutputError
            When the place cannot be written.
        """
        make_output_folder(self._path.parent)
        keep_unreadable(self._path, self.load)
        write_rules(rules, self._path)
