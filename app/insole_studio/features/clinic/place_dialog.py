"""Where the record is: on this computer, or on a server that stations share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import (
    QDialogButtonBox,
    QFormLayout,
    QHBoxLayout,
    QLineEdit,
    QRadioButton,
    QVBoxLayout,
    QWidget,
)

from insole_core.errors import InputError
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.document.record_location import RecordLocation
from insole_studio.features.clinic.record_dialog import RecordDialog, secret_line
from insole_studio.jobs import Jobs
from insole_studio.services.files import Kept
from insole_studio.services.user_messages import UserMessages
from insole_studio.texts import tr
from insole_studio.widgets.form_parts import mark_labels, plain_button
from insole_studio.widgets.message_label import MessageLabel

if TYPE_CHECKING:
    from insole_core.records.place_check import PlaceReport

_WIDTH_PX = 640
_TEST = "record-test"
EXAMPLE = "postgresql://clinic@server/records"


class PlaceDialog(RecordDialog):
    """Asks where the record is; a server is tried before it is used."""

    location_chosen = Signal(object)
    """Emitted with the `RecordLocation`."""

    def __init__(
        self,
        clinic: ClinicRecord,
        jobs: Jobs,
        messages: UserMessages,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(tr("Where the record is"), clinic, parent)
        self.setMinimumWidth(_WIDTH_PX)
        self._jobs = jobs
        self._messages = messages
        present = clinic.location
        self.here = QRadioButton(tr("On this computer"))
        self.shared = QRadioButton(tr("On a PostgreSQL server that several stations share"))
        (self.shared if present.is_shared else self.here).setChecked(True)
        self.shared.toggled.connect(lambda _on: self._allow())
        self.url = QLineEdit(present.url)
        self.url.setPlaceholderText(EXAMPLE)
        self.password = secret_line()
        self.password.setText(present.password)
        self.password.setPlaceholderText(tr("Empty: from PostgreSQL's own password file"))
        self.contents = QLineEdit(present.contents)
        self.contents.setPlaceholderText(tr("A folder on a share that all stations reach"))
        self.choose = plain_button(tr("Choose…"), self._choose_folder)
        self.test = self.add_button(tr("Test the connection"), self._test)
        self.use = self.buttons.addButton(
            tr("Use this record"), QDialogButtonBox.ButtonRole.AcceptRole
        )
        self.make_primary(self.use)
        self.buttons.accepted.connect(self._use)
        self.close_button.setText(tr("Cancel"))
        self._lay_out()
        self._allow()
        (self.shared if present.is_shared else self.here).setFocus()

    def _lay_out(self) -> None:
        folder = QHBoxLayout()
        folder.addWidget(self.contents, 1)
        folder.addWidget(self.choose)
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(tr("Database"), self.url)
        form.addRow(tr("Password"), self.password)
        form.addRow(tr("Large files"), folder)
        mark_labels(form)
        words = MessageLabel("quiet")
        words.say_all(
            [
                tr(
                    "The password is never stored: it is asked again at the next start, unless "
                    "PostgreSQL's own password file has it."
                ),
                tr(
                    "Nothing is moved: to take the present record along, make a backup of it, use "
                    "the new place, and restore it there."
                ),
            ]
        )
        self._server = QWidget()
        inner = QVBoxLayout(self._server)
        inner.setContentsMargins(24, 0, 0, 0)
        inner.setSpacing(12)
        inner.addLayout(form)
        inner.addWidget(words)
        self.content.addWidget(self.here)
        self.content.addWidget(self.shared)
        self.content.addWidget(self._server)
        self.content.addStretch(1)

    def _allow(self) -> None:
        is_shared = self.shared.isChecked()
        self._server.setEnabled(is_shared)
        self.test.setEnabled(is_shared)
        self.say("")

    def _choose_folder(self) -> None:
        path = self._messages.questions.on(self).folder_to_open(
            tr("Folder of the large files"), Kept.RECORDS
        )
        if path is not None:
            self.contents.setText(str(path))

    def _location(self) -> RecordLocation:
        """Return what is chosen.

        Raises
        ------
        InputError
            When the address or the folder cannot be right.
        """
        present = self.clinic.location
        if self.here.isChecked():
            return RecordLocation(present.folder)
        location = replace(
            present,
            url=self.url.text().strip(),
            contents=self.contents.text().strip(),
            password=self.password.text(),
        )
        if not location.is_shared:
            raise InputError(
                "Type the address of the database, or use the record of this computer."
            )
        if replace(location, password="").place().has_password:
            raise InputError(
                "The address holds a password, which would be stored with the settings; take it "
                "out, and type it into its own line."
            )
        return location

    def _test(self) -> None:
        self._try(self._tell)

    def _use(self) -> None:
        self._try(self._take)

    def _try(self, done: Callable[[RecordLocation, PlaceReport], None]) -> None:
        """Ask a server whether the record can be there, then go on."""
        try:
            location = self._location()
        except InputError as error:
            self.refuse(error)
            return
        if not location.is_shared:
            self._finish(location)
            return
        self.say(tr("Asking the database…"))
        self.setEnabled(False)

        def told(report: PlaceReport) -> None:
            self.setEnabled(True)
            done(location, report)

        self._jobs.start(
            _TEST,
            lambda _progress: _check(location),
            self.while_open(told),
            self.while_open(self.refuse),
        )

    def _tell(self, _location: RecordLocation, report: PlaceReport) -> None:
        if report.patients is None:
            self.say(tr("The database answers and is empty: a new record would begin there."))
        elif report.is_older:
            self.say(
                tr(
                    "The database answers and holds a record of an older Insole Studio, which "
                    "would be brought up to date."
                )
            )
        else:
            sentence = tr("The database answers and holds a record; patients in it: {count}.")
            self.say(sentence.format(count=report.patients))

    def _take(self, location: RecordLocation, _report: PlaceReport) -> None:
        self._finish(location)

    def _finish(self, location: RecordLocation) -> None:
        self.location_chosen.emit(location)
        self.accept()


def _check(location: RecordLocation) -> PlaceReport:
    from insole_core.records.place_check import check_place

    return check_place(location.place())
