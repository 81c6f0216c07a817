"""The dialogs on one account: a new one, its name and role, another password."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox, QDialogButtonBox, QFormLayout, QLineEdit, QWidget

from insole_core.errors import InputError
from insole_core.records.author import Role
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.features.clinic.record_dialog import (
    PasswordFields,
    RecordDialog,
    password_hint,
    secret_line,
)
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.form_parts import ComboBox, mark_labels

if TYPE_CHECKING:
    from insole_core.records.accounts import Account
    from insole_core.records.records import Records

_WIDTH_PX = 460
_MOST_NAME, _MOST_FULL_NAME = 60, 200


class AccountForm(RecordDialog):
    """A form whose button changes the record, and closes the dialog once that is done."""

    changed = Signal()

    def __init__(self, title: str, verb: str, clinic: ClinicRecord, parent: QWidget | None) -> None:
        super().__init__(title, clinic, parent)
        self.setMinimumWidth(_WIDTH_PX)
        self.form = QFormLayout()
        self.form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        self.content.addLayout(self.form)
        self.accept_button = self.buttons.addButton(verb, QDialogButtonBox.ButtonRole.AcceptRole)
        self.make_primary(self.accept_button)
        self.close_button.setText(tr("Cancel"))
        self.buttons.accepted.connect(self._try)

    def prepared(self) -> Callable[[Records], object]:
        """Return what changes the record, from what was typed.

        Raises
        ------
        InputError
            When the two lines of a password differ.
        """
        raise NotImplementedError

    def _try(self) -> None:
        try:
            change = self.prepared()
        except InputError as error:
            self.refuse(error)
            return
        self.change(change, self._finish)

    def _finish(self, _answer: object) -> None:
        self.changed.emit()
        self.accept()


class NewAccount(AccountForm):
    """Adds an account, with a password that its owner is told and changes."""

    def __init__(self, clinic: ClinicRecord, parent: QWidget | None) -> None:
        super().__init__(tr("New account"), tr("Add account"), clinic, parent)
        self.name = QLineEdit()
        self.name.setMaxLength(_MOST_NAME)
        self.full_name = QLineEdit()
        self.full_name.setMaxLength(_MOST_FULL_NAME)
        self.role = ComboBox(roles())
        self.passwords = PasswordFields()
        self.passwords.first.setToolTip(password_hint())
        self.form.addRow(tr("Account"), self.name)
        self.form.addRow(tr("Full name"), self.full_name)
        self.form.addRow(tr("Role"), self.role)
        self.passwords.add_to(self.form, tr("First password"))
        mark_labels(self.form)
        self.say(password_hint())
        self.name.setFocus()

    def prepared(self) -> Callable[[Records], object]:
        """Return what adds the account."""
        name, full_name = self.name.text(), self.full_name.text()
        role, password = Role(self.role.currentData()), self.passwords.read()
        return lambda records: records.accounts.add(name, full_name, role, password)


class ChangedAccount(AccountForm):
    """Changes full name, role and system user of an account, or disables it."""

    def __init__(self, account: Account, clinic: ClinicRecord, parent: QWidget | None) -> None:
        title = tr("Account {name}").format(name=account.name)
        super().__init__(title, tr("Change account"), clinic, parent)
        self._account = account
        self.full_name = QLineEdit(account.full_name)
        self.full_name.setMaxLength(_MOST_FULL_NAME)
        self.role = ComboBox(roles())
        self.role.show_value(str(account.role))
        self.system_user = QLineEdit(account.system_user)
        self.system_user.setMaxLength(_MOST_FULL_NAME)
        self.system_user.setPlaceholderText(tr("Nobody: commands ask for the password"))
        self.system_user.setToolTip(
            tr("User of the operating system who runs commands with this account, unasked")
        )
        self.disabled = QCheckBox(tr("Disabled: nobody can sign in with it"))
        self.disabled.setChecked(account.is_disabled)
        self.form.addRow(tr("Full name"), self.full_name)
        self.form.addRow(tr("Role"), self.role)
        self.form.addRow(tr("System user"), self.system_user)
        self.form.addRow("", self.disabled)
        mark_labels(self.form)
        self.full_name.setFocus()

    def prepared(self) -> Callable[[Records], object]:
        """Return what changes the account."""
        changed = replace(
            self._account,
            full_name=self.full_name.text(),
            role=Role(self.role.currentData()),
            is_disabled=self.disabled.isChecked(),
            system_user=self.system_user.text().strip(),
        )
        return lambda records: records.accounts.change(changed)


class ResetPassword(AccountForm):
    """Gives somebody who has forgotten it another password."""

    def __init__(self, account: Account, clinic: ClinicRecord, parent: QWidget | None) -> None:
        title = tr("New password for {name}").format(name=account.name)
        super().__init__(title, tr("Set password"), clinic, parent)
        self._account = account
        self.passwords = PasswordFields()
        self.passwords.add_to(self.form, tr("New password"))
        mark_labels(self.form)
        self.say(password_hint())
        self.passwords.first.setFocus()

    def prepared(self) -> Callable[[Records], object]:
        """Return what sets the password."""
        account_id, password = self._account.id, self.passwords.read()
        return lambda records: records.accounts.reset_password(account_id, password)


class OwnPassword(AccountForm):
    """Lets whoever has signed in choose another password."""

    def __init__(self, name: str, clinic: ClinicRecord, parent: QWidget | None) -> None:
        super().__init__(tr("Change my password"), tr("Change password"), clinic, parent)
        self._name = name
        self.old = secret_line()
        self.passwords = PasswordFields()
        self.form.addRow(tr("Present password"), self.old)
        self.passwords.add_to(self.form, tr("New password"))
        mark_labels(self.form)
        self.say(password_hint())
        self.old.setFocus()

    def prepared(self) -> Callable[[Records], object]:
        """Return what changes the password."""
        name, old, new = self._name, self.old.text(), self.passwords.read()
        return lambda records: records.accounts.change_password(name, old, new)


def roles() -> list[tuple[str, str]]:
    """Return key and name of each role."""
    return [(str(role), translate_core_message(role)) for role in Role]
