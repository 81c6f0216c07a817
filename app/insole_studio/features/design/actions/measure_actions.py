"""Export the table of measures to the clipboard or to a file."""

from __future__ import annotations

from PySide6.QtGui import QGuiApplication

from insole_core.files.atomic import replacing_file
from insole_core.foot.measure_table import table_csv
from insole_studio.document.case import Case
from insole_studio.features.design.patient.measure_texts import table_of
from insole_studio.services.files import Kept
from insole_studio.services.user_messages import UserMessages
from insole_studio.texts import tr
from insole_studio.widgets.form_parts import Field

_MOST_LETTERS = 120


class MeasureActions:
    """Exports the measures of all feet of the case, and asks what points are to say."""

    def __init__(self, case: Case, messages: UserMessages) -> None:
        self._case = case
        self._messages = messages

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
