"""The dialog that asks what of a patient is exported."""

from __future__ import annotations

from PySide6.QtWidgets import QDialog, QDialogButtonBox, QRadioButton, QVBoxLayout, QWidget

from insole_studio.texts import tr
from insole_studio.widgets.message_label import MessageLabel

_WIDTH_PX = 480


class PersonExportDialog(QDialog):
    """Everything, or nothing that names or describes the patient."""

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Export patient"))
        self.setMinimumWidth(_WIDTH_PX)
        what = MessageLabel()
        what.say(
            tr(
                "{name}: visits, prescriptions, insoles (STL), scans and orders as a folder that "
                "opens without this program."
            ).format(name=name)
        )
        self.everything = QRadioButton(tr("Everything, for the patient or another clinic"))
        self.pseudonymous = QRadioButton(
            tr("Without name, birth date, texts and scans, for a shop or for research")
        )
        self.everything.setChecked(True)
        buttons = QDialogButtonBox()
        buttons.addButton(tr("Choose folder…"), QDialogButtonBox.ButtonRole.AcceptRole)
        buttons.addButton(tr("Cancel"), QDialogButtonBox.ButtonRole.RejectRole)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        for widget in (what, self.everything, self.pseudonymous, buttons):
            layout.addWidget(widget)
