"""The page that hides everything until somebody has signed in."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QFormLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from insole_studio.texts import tr
from insole_studio.widgets.form_labels import mark_labels
from insole_studio.widgets.message_label import MessageLabel

_WIDTH_PX = 360
_MOST_LETTERS = 200


class SignInPage(QWidget):
    """A form for name and password."""

    sign_in_requested = Signal(str, str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        title = QLabel(tr("Sign in"))
        title.setObjectName("title")
        self.name, self.password = QLineEdit(), QLineEdit()
        self.password.setEchoMode(QLineEdit.EchoMode.Password)
        for line in (self.name, self.password):
            line.setMaxLength(_MOST_LETTERS)
            line.returnPressed.connect(self._request)
        self.refusal = MessageLabel("warning")
        self.button = QPushButton(tr("Sign in"))
        self.button.setObjectName("primary")
        self.button.clicked.connect(self._request)
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(tr("Name"), self.name)
        form.addRow(tr("Password"), self.password)
        mark_labels(form)
        box = QWidget()
        box.setFixedWidth(_WIDTH_PX)
        column = QVBoxLayout(box)
        column.setSpacing(12)
        column.addWidget(title)
        column.addLayout(form)
        column.addWidget(self.refusal)
        column.addWidget(self.button)
        layout = QVBoxLayout(self)
        layout.addStretch(1)
        layout.addWidget(box, 0, Qt.AlignmentFlag.AlignHCenter)
        layout.addStretch(2)

    def begin(self) -> None:
        """Empty the password, and put the focus where something is missing."""
        self.password.clear()
        self.refusal.say("")
        (self.password if self.name.text() else self.name).setFocus()

    def show_refusal(self, sentence: str) -> None:
        """Say why nobody is signed in."""
        self.password.clear()
        self.refusal.say(sentence)
        self.password.setFocus()

    def _request(self) -> None:
        if not self.name.text().strip():
            self.name.setFocus()
        elif not self.password.text():
            self.password.setFocus()
        else:
            self.sign_in_requested.emit(self.name.text().strip(), self.password.text())
