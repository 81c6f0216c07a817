"""Painting of boards and templates at true size: on paper, into a PDF, on the screen."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QMarginsF, QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import (
    QBrush,
    QColor,
    QFont,
    QPagedPaintDevice,
    QPageLayout,
    QPageSize,
    QPainter,
    QPaintEvent,
    QPdfWriter,
    QPen,
)
from PySide6.QtWidgets import QWidget

from insole_core.calibration.boards.printed_page import RULER_MM, PrintedPage
from insole_core.files.atomic import replacing_file
from insole_studio.services.true_size import exact_pages, memory
from insole_studio.texts import tr, translate_core_message

_DPI = 1200
_INCH_MM = 25.4
_BASE_MM = 2.0
"""Of the ruler, above the lower edge of the page."""
_TEXT_MM, _LABEL_MM = 2.2, 2.8


def write_pdf(pages: Sequence[PrintedPage], path: Path) -> None:
    """Write pages at true size.

    Raises
    ------
    OutputError
        If the file cannot be written.
    """
    content = memory()
    writer = QPdfWriter(content)
    writer.setResolution(_DPI)
    paint_pages(writer, pages)
    with replacing_file(path) as beside:
        beside.write_bytes(exact_pages(content, [page.size_mm for page in pages]))


def paint_pages(device: QPagedPaintDevice, pages: Sequence[PrintedPage]) -> None:
    """Paint each page on a sheet of its size, from edge to edge."""
    device.setPageLayout(layout_of(pages[0]))
    painter = QPainter(device)
    # Printers may have other dots across than along.
    across, along = device.logicalDpiX() / _INCH_MM, device.logicalDpiY() / _INCH_MM
    for number, page in enumerate(pages):
        if number:
            device.setPageLayout(layout_of(page))
            device.newPage()
        painter.save()
        painter.scale(across, along)
        paint_page(painter, page)
        painter.restore()
    painter.end()


def layout_of(page: PrintedPage) -> QPageLayout:
    """Return the layout of a sheet without margins."""
    short, long = sorted(page.size_mm)
    wide = page.size_mm[0] > page.size_mm[1]
    turned = QPageLayout.Orientation.Landscape if wide else QPageLayout.Orientation.Portrait
    size = QPageSize(QSizeF(short, long), QPageSize.Unit.Millimeter)
    return QPageLayout(size, turned, QMarginsF(0, 0, 0, 0))


def paint_page(painter: QPainter, page: PrintedPage) -> None:
    """Paint a page with a painter whose unit is mm."""
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QBrush(QColor(page.color)))
    painter.drawRects([QRectF(*box) for box in page.boxes_mm.tolist()])
    # Without caps, which would make the ruler longer by its width.
    flat = Qt.PenCapStyle.FlatCap
    painter.setPen(QPen(Qt.GlobalColor.black, 0.2, Qt.PenStyle.SolidLine, flat))
    for text, x, y in page.labels:
        _write(painter, text, x, y, _LABEL_MM)
    base = page.size_mm[1] - _BASE_MM
    painter.drawLine(QPointF(10, base), QPointF(10 + RULER_MM, base))
    for x in (10.0, 10.0 + RULER_MM):
        painter.drawLine(QPointF(x, base - 1.5), QPointF(x, base + 1))
    ruler = tr("This line is 100 mm long. If not, print without scaling.")
    note = f"{ruler}  {translate_core_message(page.note)}"
    _write(painter, note, 14 + RULER_MM, base, _TEXT_MM)


def _write(painter: QPainter, text: str, x: float, y: float, height_mm: float) -> None:
    """Write a line whose middle is at height `y`."""
    font = QFont(painter.font())
    font.setPixelSize(100)  # fonts have whole pixels, and a page in mm only few of them
    painter.save()
    painter.translate(x, y)
    painter.scale(height_mm / 100, height_mm / 100)
    painter.setFont(font)
    painter.drawText(QPointF(0, 35), text)
    painter.restore()


class PagePreview(QWidget):
    """Shows a page as it will be printed; empty without one."""

    def __init__(self) -> None:
        super().__init__()
        self._page: PrintedPage | None = None
        self.setMinimumSize(360, 260)

    def show_page(self, page: PrintedPage | None) -> None:
        """Show a page."""
        self._page = page
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Paint the sheet as large as there is room."""
        if self._page is None:
            return
        wide, tall = self._page.size_mm
        scale = min(self.width() / wide, self.height() / tall)
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.translate((self.width() - scale * wide) / 2, (self.height() - scale * tall) / 2)
        painter.scale(scale, scale)
        painter.fillRect(QRectF(0, 0, wide, tall), Qt.GlobalColor.white)
        paint_page(painter, self._page)
        painter.end()
