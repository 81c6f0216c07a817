"""The clinic's own rules for what may leave the house, kept beside the settings."""

from __future__ import annotations

from pathlib import Path

from insole_core.solids.export_rules import ExportRules, read_rules, write_rules


class ClinicExportRules:
    """Gives the rules that hold, and remembers changed ones.

    Parameters
    ----------
    path
        Of the clinic's rules; until there are any, those of the product hold.
    """

    def __init__(self, path: Path) -> None:
        self._path = path

    def load(self) -> ExportRules:
        """Give the rules.

        Raises
        ------
        InputError
            When the file is there and cannot be read.
        """
        return read_rules(self._path if self._path.exists() else None)

    def save(self, rules: ExportRules) -> None:
        """Remember the rules.

        Raises
        ------
        OutputError
            When the place cannot be written.
        """
        self._path.parent.mkdir(parents=True, exist_ok=True)
        write_rules(rules, self._path)
