"""The change in a region by the height of a pad, with the target as a line."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QWidget

from insole_core.contact.change_report import signed
from insole_core.contact.dose import DoseCurve
from insole_studio.texts import localised

_LEFT_PX, _RIGHT_PX, _TOP_PX, _BOTTOM_PX = 56.0, 14.0, 8.0, 22.0
_CURVE, _TARGET = QColor("#1565c0"), QColor("#c25100")
_DOT_PX = 4.0


class DoseChart(QWidget):
    """A plot of a dose curve; hidden while there is none."""

    def __init__(self) -> None:
        super().__init__()
        self._curve: DoseCurve | None = None
        self._percent = 0.0
        self._factor = 1.0
        self.hide()

    def show_curve(self, curve: DoseCurve | None, percent: float, factor: float = 1.0) -> None:
        """Show a curve, and the change that is asked for; None hides the plot.

        Parameters
        ----------
        factor
            By which the field of the pad shows its height: -1 for a depth.
        """
        self._curve, self._percent, self._factor = curve, percent, factor
        self.setVisible(curve is not None)
        self.update()

    def sizeHint(self) -> QSize:
        """Return the size of a small plot."""
        return QSize(300, 120)

    def minimumSizeHint(self) -> QSize:
        """Return the size hint: the plot does not shrink."""
        return self.sizeHint()

    def dose_text(self, dose_mm: float) -> str:
        """Return how the axis names a height, which is a depth of a relief."""
        return f"{localised(self._factor * dose_mm + 0.0)} mm"

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw axes, curve, target and the dose that reaches it."""
        curve = self._curve
        if curve is None:
            return
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        area = QRectF(self.rect()).adjusted(_LEFT_PX, _TOP_PX, -_RIGHT_PX, -_BOTTOM_PX)
        values = (*curve.percents, self._percent, 0.0)
        low, high = min(values), max(values)
        end = curve.doses_mm[-1]

        def place(dose: float, percent: float) -> QPointF:
            along = (high - percent) / max(high - low, 1.0)
            return QPointF(
                area.left() + area.width() * dose / end, area.top() + area.height() * along
            )

        painter.setPen(QPen(self.palette().windowText().color(), 1.0))
        for percent in dict.fromkeys((low, 0.0, high)):
            text = QRectF(0, place(0, percent).y() - 9, _LEFT_PX - 6, 18)
            right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
            painter.drawText(text, right, f"{signed(percent)} %")
        for dose in (0.0, end):
            middle = place(dose, low).x()
            text = QRectF(middle - 40, area.bottom() + 2, 40 + _RIGHT_PX, 18)
            painter.drawText(text, Qt.AlignmentFlag.AlignRight, self.dose_text(dose))
        painter.drawLine(area.bottomLeft(), area.bottomRight())
        painter.drawLine(area.bottomLeft(), area.topLeft())
        painter.setPen(QPen(_TARGET, 1.5, Qt.PenStyle.DashLine))
        painter.drawLine(place(0, self._percent), place(end, self._percent))
        painter.setPen(QPen(_CURVE, 2.0))
        pairs = zip(curve.doses_mm, curve.percents, strict=True)
        painter.drawPolyline([place(dose, percent) for dose, percent in pairs])
        reached = curve.reaching(self._percent)
        if reached is not None:
            painter.setBrush(_TARGET)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.drawEllipse(place(reached, self._percent), _DOT_PX, _DOT_PX)
        painter.end()
