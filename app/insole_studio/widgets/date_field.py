"""A line for a date: typed, or chosen in a calendar."""

from __future__ import annotations

from PySide6.QtCore import QDate, QEvent, QPoint, Qt
from PySide6.QtGui import QAction, QKeyEvent
from PySide6.QtWidgets import QCalendarWidget, QLineEdit, QVBoxLayout, QWidget

from insole_core.cases.written_dates import read_date
from insole_core.errors import InputError
from insole_studio.texts import tr
from insole_studio.widgets.icons import icon

ISO = Qt.DateFormat.ISODate


class DateField(QLineEdit):
    """A line for a date, ISO 8601, with a button that opens a calendar.

    What is typed is text until whoever owns the field has read it; a day chosen in the calendar is
    entered like a typed one. F4 or Alt+Down opens the calendar.
    """

    def __init__(self, value: str = "", parent: QWidget | None = None) -> None:
        super().__init__(value, parent)
        self.setPlaceholderText(tr("YYYY-MM-DD"))
        self._button = QAction(icon("calendar"), tr("Choose in the calendar (F4)"), self)
        self._button.triggered.connect(self.open_calendar)
        self.addAction(self._button, QLineEdit.ActionPosition.TrailingPosition)

    def open_calendar(self) -> None:
        """Open the calendar below the field, at the date in it or today."""
        popup = _CalendarPopup(self)
        popup.calendar.setSelectedDate(self._typed_day() or QDate.currentDate())
        popup.calendar.clicked.connect(self._choose)
        popup.calendar.activated.connect(self._choose)
        popup.adjustSize()
        popup.move(self._place_for(popup))
        popup.show()
        popup.calendar.setFocus()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Open the calendar by the keys that open a combo box."""
        is_alt_down = (
            event.key() == Qt.Key.Key_Down and event.modifiers() & Qt.KeyboardModifier.AltModifier
        )
        if event.key() == Qt.Key.Key_F4 or is_alt_down:
            self.open_calendar()
        else:
            super().keyPressEvent(event)

    def changeEvent(self, event: QEvent) -> None:
        """Redraw the icon in the colours of the palette."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "_button"):
            self._button.setIcon(icon("calendar"))

    def _typed_day(self) -> QDate | None:
        try:
            day = read_date(self.text(), None)
        except InputError:
            return None
        return QDate(day.year, day.month, day.day)

    def _choose(self, day: QDate) -> None:
        popup = self.sender().parent()
        assert isinstance(popup, _CalendarPopup)
        popup.close()
        self.setText(day.toString(ISO))
        self.setModified(True)
        self.editingFinished.emit()

    def _place_for(self, popup: QWidget) -> QPoint:
        """Return the corner of the popup below the field, above it where the screen ends."""
        below = self.mapToGlobal(QPoint(0, self.height()))
        screen = self.screen().availableGeometry()
        x = max(screen.left(), min(below.x(), screen.right() - popup.width()))
        if below.y() + popup.height() <= screen.bottom():
            return QPoint(x, below.y())
        return QPoint(x, self.mapToGlobal(QPoint(0, 0)).y() - popup.height())


class _CalendarPopup(QWidget):
    """A month of days, which closes when anything else is clicked or on Escape."""

    def __init__(self, field: QWidget) -> None:
        super().__init__(field, Qt.WindowType.Popup)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.calendar = QCalendarWidget(self)
        self.calendar.setGridVisible(False)
        self.calendar.setFirstDayOfWeek(self.locale().firstDayOfWeek())
        self.calendar.setVerticalHeaderFormat(QCalendarWidget.VerticalHeaderFormat.NoVerticalHeader)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(1, 1, 1, 1)
        layout.addWidget(self.calendar)
