"""The dialog that asks for name and password of an account."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QDialogButtonBox, QFormLayout, QLineEdit, QWidget

from insole_core.errors import FirstPassword, InputError, NotAllowed
from insole_core.records.author import Author
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.features.clinic.record_dialog import (
    PasswordFields,
    RecordDialog,
    password_hint,
    secret_line,
)
from insole_studio.texts import tr
from insole_studio.widgets.form_parts import mark_labels
from insole_studio.widgets.message_label import MessageLabel

_WIDTH_PX = 420
_MOST_NAME = 200


class SignInDialog(RecordDialog):
    """Asks until somebody has signed in.

    Parameters
    ----------
    name
        Whose account it was before; empty at the start.
    is_lock
        Whether the window is locked: then the dialog stays until somebody has signed in.

    Whoever signs in with a password that somebody else has chosen chooses their own first. A record
    that may only be read says why, and offers the restoring, which asks for the
    passphrase of a backup and for no account.
    """

    signed_in = Signal(object)
    """Emitted with the `Author`."""
    quit_requested = Signal()
    restore_requested = Signal()

    def __init__(
        self, clinic: ClinicRecord, name: str, *, is_lock: bool, parent: QWidget | None
    ) -> None:
        title = tr("The window is locked") if is_lock else tr("Sign in")
        super().__init__(title, clinic, parent)
        self.setMinimumWidth(_WIDTH_PX)
        self._is_lock = is_lock
        self.name = QLineEdit(name)
        self.name.setMaxLength(_MOST_NAME)
        self.password = secret_line()
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(tr("Account"), self.name)
        form.addRow(tr("Password"), self.password)
        self.own = PasswordFields()
        self.own.first.setToolTip(password_hint())
        self.own.add_to(form, tr("Your own password"))
        mark_labels(form)
        self._form = form
        for line in (self.name, self.password):  # which are another account's then
            line.textEdited.connect(lambda _text: self._ask_for_own(asked=False))
        self._ask_for_own(asked=False)
        self.problem = MessageLabel("warning")
        self.content.addWidget(self.problem)
        self.content.addLayout(form)
        self.restore = self.add_button(tr("Restore from a backup…"), self._ask_to_restore)
        self.sign_in = self.buttons.addButton(tr("Sign in"), QDialogButtonBox.ButtonRole.AcceptRole)
        self.make_primary(self.sign_in)
        self.sign_in.setDefault(True)
        self.buttons.accepted.connect(self._try)
        if is_lock:
            self.close_button.setText(tr("Quit"))
            self.buttons.rejected.disconnect()
            self.buttons.rejected.connect(self.quit_requested)
        else:
            self.close_button.setText(tr("Files only"))
        self._show_problem()
        (self.password if name else self.name).setFocus()

    def reject(self) -> None:
        """Close the dialog, unless the window is locked."""
        if not self._is_lock:
            super().reject()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Let no key but those of the fields do anything while the window is locked."""
        super().keyPressEvent(event)
        event.accept()

    def refuse(self, error: Exception) -> None:
        """Tell why it was refused, and wait for another password."""
        super().refuse(error)
        self._show_problem()
        if isinstance(error, FirstPassword):
            self._ask_for_own(asked=True)
        elif isinstance(error, NotAllowed):
            self._ask_for_own(asked=False)
            self.password.clear()
            self.password.setFocus()

    def _ask_for_own(self, *, asked: bool) -> None:
        """Ask for a password of one's own, after the first one was right."""
        for line in (self.own.first, self.own.again):
            self._form.setRowVisible(line, asked)
        self.own.clear()
        if asked:
            self.own.first.setFocus()

    def _show_problem(self) -> None:
        """Say why nothing can be changed, which may have turned out only now."""
        problem = self.clinic.problem
        if problem is None:
            self.problem.say("")
        else:
            reading = tr("Until then, what can be read is shown after signing in.")
            self.problem.say_all([problem, reading])
        self.restore.setVisible(problem is not None and not self._is_lock)

    def _ask_to_restore(self) -> None:
        self.close()
        self.restore_requested.emit()

    def _try(self) -> None:
        if not self.name.text().strip():
            self.name.setFocus()
            return
        try:
            own = self.own.read()
        except InputError as error:
            self.refuse(error)
            return
        self.setEnabled(False)
        self.say(tr("Signing in…"))
        self.clinic.sign_in(
            self.name.text(),
            self.password.text(),
            self.while_open(self._take),
            self.while_open(self.refuse),
            own=own,
        )

    def _take(self, author: Author) -> None:
        self.setEnabled(True)
        self.signed_in.emit(author)
