"""Print the outline of the insole at 1:1."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PySide6.QtCore import QMarginsF, QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QFont, QPageLayout, QPageSize, QPainter, QPdfWriter, QPen, QPolygonF

from insole_core.files.atomic import replacing_file
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.build import Insole
from insole_core.insole.elements import Pelott
from insole_core.insole.pads.pad_heights import pad_outline
from insole_core.solids.solid_outline import outline_of
from insole_studio.services.true_size import exact_pages, memory
from insole_studio.texts import tr

DPI = 600
RULER_MM = 100.0
_ROOM_MM = 11.0
_A4_MM = (210.0, 297.0)
_A3_MM = (297.0, 420.0)


def print_outline(insole: Insole, whose: str, path: Path) -> None:
    """Write the outline and the pads at 1:1 as a PDF of one page, seen from the foot's side.

    Parameters
    ----------
    insole
        The insole whose outline is printed.
    whose
        Text beside the outline: patient, side, date.
    path
        The PDF file.

    Raises
    ------
    OutputError
        If the file cannot be written.
    """
    outline = outline_of(insole)
    page_mm = _page_for(outline)
    content = memory()
    writer = QPdfWriter(content)
    writer.setResolution(DPI)
    writer.setTitle(whose)
    size = QPageSize(QSizeF(*page_mm), QPageSize.Unit.Millimeter)
    layout = QPageLayout(size, QPageLayout.Orientation.Portrait, QMarginsF(0, 0, 0, 0))
    writer.setPageLayout(layout)
    painter = QPainter(writer)
    painter.scale(DPI / 25.4, DPI / 25.4)  # from here on in mm
    _draw(painter, insole, outline, page_mm, whose)
    painter.end()
    with replacing_file(path) as beside:
        beside.write_bytes(exact_pages(content, [page_mm]))


def _page_for(outline: FloatArray) -> tuple[float, float]:
    wide, tall = np.ptp(outline, axis=0) + 2 * _ROOM_MM
    fits = wide <= _A4_MM[0] and tall + _ROOM_MM <= _A4_MM[1]
    return _A4_MM if fits else _A3_MM


def _draw(
    painter: QPainter,
    insole: Insole,
    outline: FloatArray,
    page_mm: tuple[float, float],
    whose: str,
) -> None:
    low, high = outline.min(axis=0), outline.max(axis=0)
    left = (page_mm[0] - (high - low)[0]) / 2 - low[0]
    bottom = _ROOM_MM + 4.0 + high[1]

    def on_page(places: FloatArray) -> QPolygonF:
        return QPolygonF([QPointF(left + x, bottom - y) for x, y in places])

    painter.setPen(QPen(Qt.GlobalColor.black, 0.4))
    painter.drawPolygon(on_page(outline))
    painter.setPen(QPen(Qt.GlobalColor.darkGray, 0.25))
    for pad in insole.design.of(Pelott):
        painter.drawPolygon(on_page(pad_outline(pad, 180)))
    # Without caps, which would make the ruler longer by its width.
    flat = Qt.PenCapStyle.FlatCap
    painter.setPen(QPen(Qt.GlobalColor.black, 0.2, Qt.PenStyle.SolidLine, flat))
    font = QFont(painter.font())
    font.setPixelSize(4)
    painter.setFont(font)
    painter.drawText(QRectF(10, 5, page_mm[0] - 20, 8), Qt.AlignmentFlag.AlignLeft, whose)
    _draw_ruler(painter, page_mm)


def _draw_ruler(painter: QPainter, page_mm: tuple[float, float]) -> None:
    """Draw a ruler to verify the scale with: printers tend to shrink pages."""
    y = page_mm[1] - 10.0
    painter.drawLine(QPointF(10, y), QPointF(10 + RULER_MM, y))
    for x in np.arange(0.0, RULER_MM + 1, 10.0):
        painter.drawLine(QPointF(10 + x, y), QPointF(10 + x, y - (3 if x % 50 == 0 else 1.5)))
    words = QRectF(14 + RULER_MM, y - 5, page_mm[0] - RULER_MM - 20, 8)
    text = tr("This line is 100 mm long. If not, print without scaling.")
    painter.drawText(words, Qt.AlignmentFlag.AlignLeft, text)
