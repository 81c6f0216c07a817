"""The accounts of the clinic: switched on, added, changed, unlocked, switched off."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import (
    QFormLayout,
    QHBoxLayout,
    QLineEdit,
    QPushButton,
    QSpinBox,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from insole_core.errors import InputError
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.features.clinic.account_form import (
    ChangedAccount,
    NewAccount,
    ResetPassword,
)
from insole_studio.features.clinic.record_dialog import PasswordFields, RecordDialog, password_hint
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.form_parts import allow, mark_labels, plain_button
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.row_table import RowTable, TableRow

if TYPE_CHECKING:
    from insole_core.records.accounts import Account
    from insole_core.records.records import Records

_SIZE = (720, 460)
_MOST_MINUTES = 240
_MOST_NAME, _MOST_FULL_NAME = 60, 200


@dataclass(frozen=True)
class _Shown:
    """What the dialog shows.

    Parameters
    ----------
    accounts
        None while accounts are off.
    """

    accounts: list[Account] | None
    lock_minutes: int


class AccountsDialog(RecordDialog):
    """A form for the first administrator while accounts are off, a table of them afterwards."""

    lock_minutes_changed = Signal(int)

    def __init__(self, clinic: ClinicRecord, parent: QWidget | None = None) -> None:
        super().__init__(tr("Accounts"), clinic, parent)
        self.resize(*_SIZE)
        self._accounts: dict[str, Account] = {}
        self._pages = QStackedWidget()
        self.content.addWidget(self._pages)
        self._pages.addWidget(self._make_first())
        self._pages.addWidget(self._make_list())
        self._pages.hide()
        self.read()

    def read(self) -> None:
        """Show the accounts as they are now."""
        self.ask(_read, self._show)

    def _make_first(self) -> QWidget:
        """Return the page that switches accounts on."""
        words = MessageLabel()
        words.say_all(
            [
                tr(
                    "Accounts are off: whoever can use this computer can use the record, and the "
                    "computer's user is noted with every change."
                ),
                tr(
                    "Switching them on makes the first administrator, who manages accounts and "
                    "backups and does not see patients. Then add an account for everybody who "
                    "treats patients, yourself included."
                ),
                password_hint(),
            ]
        )
        self.name = QLineEdit("admin")
        self.name.setMaxLength(_MOST_NAME)
        self.full_name = QLineEdit()
        self.full_name.setMaxLength(_MOST_FULL_NAME)
        self.passwords = PasswordFields()
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(tr("Administrator's account"), self.name)
        form.addRow(tr("Full name"), self.full_name)
        self.passwords.add_to(form, tr("Password"))
        mark_labels(form)
        self.switch_on = QPushButton(tr("Switch accounts on"))
        self.switch_on.setObjectName("primary")
        self.switch_on.clicked.connect(self._switch_on)
        row = QHBoxLayout()
        row.addStretch(1)
        row.addWidget(self.switch_on)
        page = QWidget()
        layout = QVBoxLayout(page)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(12)
        layout.addWidget(words)
        layout.addLayout(form)
        layout.addLayout(row)
        layout.addStretch(1)
        return page

    def _make_list(self) -> QWidget:
        """Return the page of the accounts that there are."""
        headings = (tr("Account"), tr("Full name"), tr("Role"), tr("State"))
        self.table = RowTable(headings, stretched=1)
        self.table.setAccessibleName(tr("Accounts"))
        self.table.chosen.connect(lambda _key: self._open_change())
        self.table.current_changed.connect(self._allow)
        row = QHBoxLayout()
        row.setSpacing(8)
        self.add = plain_button(tr("Add account…"), self._open_new)
        self.edit = plain_button(tr("Change…"), self._open_change)
        self.reset = plain_button(tr("New password…"), self._open_reset)
        self.unlock = plain_button(tr("Unlock"), self._unlock)
        self.switch_off = plain_button(tr("Switch accounts off"), self._switch_off)
        for button in (self.add, self.edit, self.reset, self.unlock):
            row.addWidget(button)
        row.addStretch(1)
        row.addWidget(self.switch_off)
        self.minutes = QSpinBox()
        self.minutes.setRange(0, _MOST_MINUTES)
        self.minutes.setSuffix(tr(" min"))
        self.minutes.setSpecialValueText(tr("never"))
        self.minutes.editingFinished.connect(self._keep_minutes)
        form = QFormLayout()
        form.addRow(tr("Lock windows without input after"), self.minutes)
        mark_labels(form)
        page = QWidget()
        layout = QVBoxLayout(page)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(12)
        layout.addWidget(self.table, 1)
        layout.addLayout(row)
        layout.addLayout(form)
        return page

    def _show(self, shown: _Shown) -> None:
        self._pages.setCurrentIndex(0 if shown.accounts is None else 1)
        self._pages.show()
        self.minutes.setValue(shown.lock_minutes)
        self._minutes = shown.lock_minutes
        self._accounts = {account.id: account for account in shown.accounts or ()}
        self.table.show_rows([_row(account) for account in self._accounts.values()])
        self._allow()
        if shown.accounts is None:
            self.full_name.setFocus()
        elif not self.table.current_key:
            self.table.take_first()
            self.table.setFocus()

    def _allow(self, _key: str = "") -> None:
        account = self._current
        no_account = "" if account is not None else tr("Choose an account first.")
        for button in (self.edit, self.reset):
            allow(button, no_account)
        is_free = account is not None and not account.failures
        allow(self.unlock, tr("This account is not locked.") if is_free else no_account)

    @property
    def _current(self) -> Account | None:
        return self._accounts.get(self.table.current_key)

    def _switch_on(self) -> None:
        name, full_name = self.name.text(), self.full_name.text()
        try:
            password = self.passwords.read()
        except InputError as error:
            self.refuse(error)
            return
        self.change(
            lambda records: records.accounts.switch_on(name, full_name, password),
            lambda _account: self.accept(),  # the window then asks to sign in
        )

    def _switch_off(self) -> None:
        self.change(lambda records: records.accounts.switch_off(), lambda _none: self.accept())

    def _open_new(self) -> None:
        self._open(NewAccount(self.clinic, self))

    def _open_change(self) -> None:
        if self._current is not None:
            self._open(ChangedAccount(self._current, self.clinic, self))

    def _open_reset(self) -> None:
        if self._current is not None:
            self._open(ResetPassword(self._current, self.clinic, self))

    def _open(self, form: NewAccount | ChangedAccount | ResetPassword) -> None:
        self.say("")
        form.changed.connect(self.read)
        form.open()

    def _unlock(self) -> None:
        account = self._current
        if account is not None:
            unlock = account.id
            self.change(lambda r: r.accounts.unlock(unlock), lambda _none: self.read())

    def _keep_minutes(self) -> None:
        minutes = self.minutes.value()
        if minutes == self._minutes:
            return

        def keep(records: Records) -> None:
            from insole_core.records.accounts import LOCK_MINUTES

            records.clinic.set(LOCK_MINUTES, minutes)

        self.change(keep, partial(self._note_minutes, minutes))

    def _note_minutes(self, minutes: int, _answer: object) -> None:
        self._minutes = minutes
        self.lock_minutes_changed.emit(minutes)


def read_lock_minutes(records: Records) -> int:
    """Return after how many minutes without input a window is locked; 0 for never."""
    from insole_core.records.accounts import LOCK_MINUTES, USUAL_LOCK_MINUTES

    return int(records.clinic.get(LOCK_MINUTES, USUAL_LOCK_MINUTES))


def _read(records: Records) -> _Shown:
    accounts = records.accounts.all() if records.accounts.are_on else None
    return _Shown(accounts, read_lock_minutes(records))


def _row(account: Account) -> TableRow:
    state = ""
    if account.is_disabled:
        state = tr("disabled")
    elif account.has_first_password:
        state = tr("first password")
    elif account.failures:
        state = tr("wrong passwords: {count}").format(count=account.failures)
    cells = (account.name, account.full_name, translate_core_message(account.role), state)
    return TableRow(account.id, cells, attention=bool(account.failures))
