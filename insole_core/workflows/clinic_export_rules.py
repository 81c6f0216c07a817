"""The clinic's own export rules, stored beside the settings."""

from __future__ import annotations

from pathlib import Path

from insole_core.files.atomic import make_output_folder
from insole_core.forgiving_json import keep_unreadable
from insole_core.solids.export_rules import ExportRules, read_rules, write_rules


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
