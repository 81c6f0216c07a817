"""The clinic's own blocks, stored beside the settings; those of the shop come with the product."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from insole_core.errors import InputError
from insole_core.files.atomic import make_output_folder, replacing_file
from insole_core.forgiving_json import keep_unreadable
from insole_core.json_object import JsonObject
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
