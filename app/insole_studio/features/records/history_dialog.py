"""All versions of a visit's prescriptions, and what each of them changed."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QVBoxLayout, QWidget

from insole_core.geometry.side import Side
from insole_core.records.prescription import VersionSummary
from insole_studio.texts import moment_text, tr
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.row_table import RowTable, TableRow

_SIZE = (860, 480)


class HistoryDialog(QDialog):
    """A table of versions, the newest first, and the changes of the chosen one below it."""

    version_chosen = Signal(str)
    sign_requested = Signal(str)

    def __init__(
        self, title: str, versions: Sequence[VersionSummary], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.resize(*_SIZE)
        self._versions = {version.id: version for version in versions}
        headings = (tr("Foot"), tr("Version"), tr("By"), tr("Changed"), tr("Reason"), tr("Signed"))
        self.table = RowTable(headings, stretched=4)
        self.table.setAccessibleName(tr("Versions"))
        self.table.current_changed.connect(self._choose)
        self.changes = MessageLabel()
        buttons = QDialogButtonBox()
        role = QDialogButtonBox.ButtonRole
        self.sign = buttons.addButton(tr("Sign this version"), role.ActionRole)
        self.sign.setAutoDefault(False)
        self.sign.clicked.connect(self._sign)
        buttons.addButton(tr("Close"), role.RejectRole)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        layout.addWidget(self.table, 1)
        layout.addWidget(self.changes)
        layout.addWidget(buttons)
        self.table.show_rows([_row(version) for version in versions])
        self.table.take_first()

    def show_changes(self, version_id: str, lines: Sequence[str]) -> None:
        """Say what a version changed in the one before it, if it is still the chosen one."""
        if version_id == self.table.current_key:
            self.changes.say_all(lines)

    def _choose(self, version_id: str) -> None:
        version = self._versions.get(version_id)
        self.sign.setEnabled(version is not None and version.signed_by is None)
        self.changes.say("")
        if version is not None:
            self.version_chosen.emit(version_id)

    def _sign(self) -> None:
        self.sign_requested.emit(self.table.current_key)
        self.accept()


def _row(version: VersionSummary) -> TableRow:
    left = version.side is Side.LEFT
    signed = ""
    if version.signed_by is not None:
        signed = f"{version.signed_by}, {moment_text(version.signed_at or '')}"
    return TableRow(
        version.id,
        (
            tr("LEFT") if left else tr("RIGHT"),
            str(version.number),
            f"{version.author}, {version.station}",
            moment_text(version.changed_at),
            version.reason,
            signed,
        ),
    )
