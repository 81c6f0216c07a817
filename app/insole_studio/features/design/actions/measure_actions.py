"""Export the table of measures to the clipboard or to a file."""

from __future__ import annotations

import io

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication, QImage, QPixmap
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QLabel, QVBoxLayout, QWidget

from insole_core.errors import InputError
from insole_core.files.atomic import replacing_file
from insole_core.foot.measure_table import table_csv
from insole_core.workflows.measured_feet import measured_feet
from insole_studio.document.case import Case
from insole_studio.features.design.patient.measure_texts import table_of
from insole_studio.services.files import Kept
from insole_studio.services.user_messages import UserMessages
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.form_parts import Field

_MOST_LETTERS = 120


class MeasureActions:
    """Exports and explains the measures of all feet of the case; asks what points are to say."""

    def __init__(self, case: Case, messages: UserMessages, window: QWidget) -> None:
        self._case = case
        self._messages = messages
        self._window = window

    def ask_text(self, before: str) -> str | None:
        """Ask what is to be written on a custom point of the foot; None if cancelled."""
        given = self._messages.questions.fields(
            tr("Text of the point"),
            tr("What is to be seen here? The text stands at the point, in the record."),
            [Field("text", tr("Text"), before)],
        )
        return None if given is None else given["text"].strip()[:_MOST_LETTERS]

    def copy(self) -> None:
        """Copy the table to the clipboard."""
        QGuiApplication.clipboard().setText(table_csv(table_of(self._case.record)))

    def explain_angles(self) -> None:
        """Show a drawing of what the angles of the feet are."""
        from insole_core.workflows.foot_sheet import WINDOW_IN, draw_angles

        drawn = io.BytesIO()
        try:
            draw_angles(
                measured_feet(self._case.record.feet), drawn, translate_core_message, WINDOW_IN
            )
        except InputError as error:  # only mirror images
            self._messages.show_error(error)
            return
        dialog = QDialog(self._window)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.setWindowTitle(tr("Angles of the feet"))
        picture = QLabel()
        picture.setPixmap(QPixmap.fromImage(QImage.fromData(drawn.getvalue())))
        picture.setAccessibleName(tr("Angles of the feet"))
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.rejected.connect(dialog.reject)
        layout = QVBoxLayout(dialog)
        layout.addWidget(picture)
        layout.addWidget(buttons)
        dialog.open()

    def ask_sheet(self) -> None:
        """Let the user choose a file, and write the foot sheet."""
        from insole_core.workflows.foot_sheet import check_any, write_foot_sheet

        record = self._case.record
        feet = measured_feet(record.feet)
        try:
            check_any(feet)
        except InputError as error:
            self._messages.show_error(error)
            return
        path = self._messages.questions.file_to_write(
            f"{tr('measures')}.pdf", "PDF (*.pdf)", Kept.PAPERS
        )
        if path is None:
            return
        sources = {foot.side: foot.source for foot in record.feet}
        pseudonym = record.patient.pseudonym
        write_foot_sheet(feet, sources, path, translate_core_message, pseudonym)
        self._messages.say(tr("Written: {name}").format(name=path.name))

    def ask_save(self) -> None:
        """Let the user choose a file, and write the table."""
        path = self._messages.questions.file_to_write(
            f"{tr('measures')}.csv", "CSV (*.csv)", Kept.PAPERS
        )
        if path is not None:
            with replacing_file(path) as beside:
                beside.write_text(
                    table_csv(table_of(self._case.record)), encoding="utf-8", newline="\n"
                )
            self._messages.say(tr("Written: {name}").format(name=path.name))
