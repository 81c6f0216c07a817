"""The clinic's table of materials, as the window uses it."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from insole_core.insole.prescription.materials import MaterialTable, read_materials


class MaterialModel(QObject):
    """Holds the table; that of the product until the clinic's is taken."""

    changed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self._table = read_materials()

    @property
    def table(self) -> MaterialTable:
        """The table that applies."""
        return self._table

    def take(self, table: MaterialTable) -> None:
        """Use another table."""
        self._table = table
        self.changed.emit()
