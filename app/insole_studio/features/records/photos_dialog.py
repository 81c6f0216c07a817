"""The photos of a visit, with what is drawn and written on them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtGui import QImage, QKeyEvent
from PySide6.QtWidgets import (
    QDialog,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QVBoxLayout,
    QWidget,
)

from insole_core.records.field_checks import MOST_NAME
from insole_core.records.photo import MOST_LETTERS, Photo, PhotoMark
from insole_studio.texts import tr
from insole_studio.widgets.form_parts import allow, mark_labels, plain_button
from insole_studio.widgets.picture_view import Line, MarkedPicture
from insole_studio.widgets.row_table import RowTable, TableRow

_SIZE = (1040, 640)
_SIDE_PX = 300


class PhotosDialog(QDialog):
    """The list of photos, the chosen one to draw on, and its marks; all is kept at once."""

    add_requested = Signal()
    delete_requested = Signal(str)
    photo_chosen = Signal(str)
    edited = Signal(object)
    """Emitted with a `Photo` whose caption or marks are others now."""

    def __init__(
        self, title: str, parent: QWidget | None = None, *, why_not_change: str = ""
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.resize(*_SIZE)
        self._photos: dict[str, Photo] = {}
        self._why_not_change = why_not_change
        self.table = RowTable((tr("Photo"), tr("Caption")), stretched=1)
        self.table.setAccessibleName(tr("Photos"))
        self.table.current_changed.connect(self._choose_photo)
        self.picture = MarkedPicture()
        self.picture.show_editable(not why_not_change)
        self.picture.drawn.connect(self._add_mark)
        self._hint = QLabel(tr("Drag to draw a line, click to mark a place; then write the text."))
        self._hint.setObjectName("quiet")
        self._hint.setWordWrap(True)
        self._none = QLabel(tr("No photo yet. Add a JPEG or PNG of camera or phone."))
        self._none.setObjectName("quiet")
        self._none.setWordWrap(True)
        self.caption, self.text = QLineEdit(), QLineEdit()
        for field, most in ((self.caption, MOST_NAME), (self.text, MOST_LETTERS)):
            field.setMaxLength(most)
            field.setReadOnly(bool(why_not_change))
        self.caption.editingFinished.connect(self._edit_caption)
        self.text.editingFinished.connect(self._edit_text)
        self.marks = RowTable((tr("No."), tr("Text")), stretched=1)
        self.marks.setAccessibleName(tr("Marks"))
        self.marks.current_changed.connect(self._choose_mark)
        self.add = plain_button(tr("Add a photo…"), self.add_requested)
        self.delete = plain_button(tr("Delete the photo…"), self._request_delete)
        self.remove = plain_button(tr("Remove the mark"), self._remove_mark)
        self.leave = plain_button(tr("Close"), self.reject)
        self._lay_out()
        self._show_chosen()

    @property
    def chosen(self) -> Photo | None:
        """The photo that is shown."""
        return self._photos.get(self.table.current_key)

    def show_photos(self, photos: Sequence[Photo], chosen: str = "") -> None:
        """Show photos; what is being typed stays.

        Parameters
        ----------
        chosen
            Id of the photo to show; by default the same one as before, else the first.
        """
        self._photos = {photo.id: photo for photo in photos}
        wanted = chosen or self.table.current_key
        self.table.show_rows(
            [TableRow(photo.id, (str(photo.number), photo.caption)) for photo in photos]
        )
        if wanted in self._photos:
            self.table.selectRow(list(self._photos).index(wanted))
        elif photos:
            self.table.take_first()
        self._show_chosen()

    def show_picture(self, photo_id: str, image: QImage) -> None:
        """Show the picture of a photo, if it is still the chosen one."""
        if photo_id == self.table.current_key:
            self.picture.show_picture(image)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Let Enter end a text, and not press a button."""
        if event.text() not in ("\r", "\n"):
            super().keyPressEvent(event)

    def _lay_out(self) -> None:
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(tr("Caption"), self.caption)
        form.addRow(tr("Text of the mark"), self.text)
        mark_labels(form)
        side = QWidget()
        side.setFixedWidth(_SIDE_PX)
        column = QVBoxLayout(side)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(8)
        for part in (self.add, self._none, self.table):
            column.addWidget(part)
        column.addLayout(form)
        for part in (self.marks, self._hint):
            column.addWidget(part)
        row = QHBoxLayout()
        row.addWidget(self.remove)
        row.addWidget(self.delete)
        row.addStretch(1)
        row.addWidget(self.leave)
        upper = QHBoxLayout()
        upper.setSpacing(16)
        upper.addWidget(side)
        upper.addWidget(self.picture, 1)
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        layout.addLayout(upper, 1)
        layout.addLayout(row)

    def _show_chosen(self) -> None:
        photo = self.chosen
        marks = () if photo is None else photo.marks
        self._none.setVisible(not self._photos)
        self._hint.setVisible(photo is not None and not self._why_not_change)
        if not self.caption.hasFocus() or not self.caption.isModified():
            self.caption.setText("" if photo is None else photo.caption)
        with QSignalBlocker(self.marks):
            self.marks.show_rows(
                [TableRow(str(n), (str(n + 1), mark.text)) for n, mark in enumerate(marks)]
            )
        no_photo = "" if photo is not None else tr("Choose a photo first.")
        allow(self.add, self._why_not_change)
        allow(self.caption, no_photo)
        allow(self.delete, self._why_not_change or no_photo)
        self._show_mark()

    def _show_mark(self) -> None:
        photo, number = self.chosen, self._mark
        marks = () if photo is None else photo.marks
        self.picture.show_marks([mark.points for mark in marks], number)
        has_mark = 0 <= number < len(marks)
        no_mark = "" if has_mark else tr("Choose a mark first, or draw one.")
        allow(self.text, no_mark)
        allow(self.remove, self._why_not_change or no_mark)
        if not self.text.hasFocus() or not self.text.isModified():
            self.text.setText(marks[number].text if has_mark else "")

    @property
    def _mark(self) -> int:
        """Number of the chosen mark; -1 for none."""
        key = self.marks.current_key
        return int(key) if key else -1

    def _choose_photo(self, photo_id: str) -> None:
        self.picture.show_picture(QImage())
        self._show_chosen()
        if photo_id:
            self.photo_chosen.emit(photo_id)

    def _choose_mark(self, _key: str) -> None:
        self._show_mark()

    def _add_mark(self, line: Line) -> None:
        photo = self.chosen
        if photo is None:
            return
        self._edit_text()
        photo = self._photos[photo.id]
        self._edit(replace(photo, marks=(*photo.marks, PhotoMark(line))))
        self.marks.selectRow(len(photo.marks))
        self.text.setFocus()

    def _remove_mark(self) -> None:
        photo, number = self.chosen, self._mark
        if photo is not None and number >= 0:
            marks = photo.marks[:number] + photo.marks[number + 1 :]
            self.text.setModified(False)
            self._edit(replace(photo, marks=marks))

    def _edit_caption(self) -> None:
        photo = self.chosen
        if photo is not None and self.caption.isModified():
            self.caption.setModified(False)
            self._edit(replace(photo, caption=self.caption.text().strip()))

    def _edit_text(self) -> None:
        photo, number = self.chosen, self._mark
        if photo is not None and number >= 0 and self.text.isModified():
            self.text.setModified(False)
            marks = list(photo.marks)
            marks[number] = replace(marks[number], text=self.text.text().strip())
            self._edit(replace(photo, marks=tuple(marks)))

    def _edit(self, photo: Photo) -> None:
        self._photos[photo.id] = photo
        self.show_photos(list(self._photos.values()))
        self.edited.emit(photo)

    def _request_delete(self) -> None:
        self.delete_requested.emit(self.table.current_key)
