"""What the file of a scan does not say: which foot it is, and in which unit."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QLabel,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from insole_core.geometry.side import Side
from insole_core.scans.mesh_file import Unit
from insole_studio.texts import tr
from insole_studio.widgets.combo_box import ComboBox


@dataclass(frozen=True)
class ScanAnswer:
    """How a scan is to be read; without a unit the size of the surface tells it."""

    side: Side
    unit: Unit | None = None


class ScanDialog(QDialog):
    """Asks for the side, which opens the scan, and offers the units.

    Parameters
    ----------
    name
        Of the file.
    trouble
        Why the scan could not be read in the unit chosen before; empty at first.
    """

    def __init__(self, name: str, trouble: str, parent: QWidget | None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Insole Studio"))
        self.side: Side | None = None
        self.unit = ComboBox(_units())
        form = QFormLayout()
        form.addRow(tr("Unit of the file"), self.unit)
        layout = QVBoxLayout(self)
        for text in (trouble, tr("Which foot is {name}?").format(name=name)):
            if text:
                layout.addWidget(_plain(text))
        layout.addLayout(form)
        layout.addWidget(self._buttons())

    @property
    def answer(self) -> ScanAnswer | None:
        """The answer; None when the scan is not to be opened."""
        unit: Unit | None = self.unit.currentData() or None
        return None if self.side is None else ScanAnswer(self.side, unit)

    def _buttons(self) -> QDialogButtonBox:
        box = QDialogButtonBox()
        for side, text in ((Side.LEFT, tr("Left foot")), (Side.RIGHT, tr("Right foot"))):
            button = QPushButton(text)
            button.setAutoDefault(False)  # Enter opens nothing: no side is the usual one
            button.clicked.connect(lambda _checked=False, side=side: self._take(side))
            box.addButton(button, QDialogButtonBox.ButtonRole.ActionRole)
        box.addButton(tr("Do not open"), QDialogButtonBox.ButtonRole.RejectRole)
        box.rejected.connect(self.reject)
        return box

    def _take(self, side: Side) -> None:
        self.side = side
        self.accept()


def _units() -> tuple[tuple[str, str], ...]:
    return (
        ("", tr("As the size tells")),
        ("mm", tr("Millimetres")),
        ("cm", tr("Centimetres")),
        ("m", tr("Metres")),
        ("inch", tr("Inches")),
    )


def _plain(text: str) -> QLabel:
    label = QLabel(text)
    label.setTextFormat(Qt.TextFormat.PlainText)
    label.setWordWrap(True)
    return label
