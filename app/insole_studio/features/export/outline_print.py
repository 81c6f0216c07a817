"""Print the outline of the insole at 1:1."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PySide6.QtCore import QMarginsF, QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import (
    QFont,
    QPageLayout,
    QPageSize,
    QPainter,
    QPdfWriter,
    QPen,
    QPolygonF,
    QTextOption,
)

from insole_core.calibration.boards.printed_page import RULER_MM
from insole_core.files.atomic import replacing_file
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.build import Insole
from insole_core.insole.elements import Pelott
from insole_core.insole.pads.pad_heights import pad_outline
from insole_core.solids.solid_outline import outline_of
from insole_studio.services.true_size import (
    UPRIGHT_MM,
    WHITE_MM,
    exact_pages,
    memory,
    ruler_text,
)
from insole_studio.texts import tr

DPI = 600
_ROOM_MM = WHITE_MM + 1.0
"""To the edges of the paper."""
_BESIDE_MM = 44.0
"""At the left, for words and ruler: so an insole of 285 mm finds room on A4."""
_PAPERS_MM = {name: UPRIGHT_MM[name] for name in ("A4", "A3")}
"""The last is taken for what finds room on none."""


def print_outline(insole: Insole, whose: str, path: Path) -> str:
    """Write the outline and the pads at 1:1 as a PDF of one page, seen from the foot's side.

    Parameters
    ----------
    insole
        The insole whose outline is printed.
    whose
        Text beside the outline: patient, side, date.
    path
        The PDF file.

    Returns
    -------
    str
        Name of the paper that it has to be printed on.

    Raises
    ------
    OutputError
        If the file cannot be written.
    """
    outline = outline_of(insole)
    paper = _paper_for(outline)
    page_mm = _PAPERS_MM[paper]
    content = memory()
    writer = QPdfWriter(content)
    writer.setResolution(DPI)
    writer.setTitle(whose)
    size = QPageSize(QSizeF(*page_mm), QPageSize.Unit.Millimeter)
    layout = QPageLayout(size, QPageLayout.Orientation.Portrait, QMarginsF(0, 0, 0, 0))
    writer.setPageLayout(layout)
    painter = QPainter(writer)
    painter.scale(DPI / 25.4, DPI / 25.4)  # from here on in mm
    _draw_outline(painter, insole, outline, page_mm)
    seen = tr("Seen from above: the foot stands on this side, toes up.")
    words = [whose, seen, tr("Paper: {paper}").format(paper=paper)]
    _draw_beside(painter, page_mm, "\n\n".join(words))
    painter.end()
    with replacing_file(path) as beside:
        beside.write_bytes(exact_pages(content, [page_mm]))
    return paper


def _paper_for(outline: FloatArray) -> str:
    needed = np.ptp(outline, axis=0) + 2 * _ROOM_MM + np.array([_BESIDE_MM, 0.0])
    fitting = (name for name, size_mm in _PAPERS_MM.items() if (needed <= size_mm).all())
    return next(fitting, list(_PAPERS_MM)[-1])


def _draw_outline(
    painter: QPainter, insole: Insole, outline: FloatArray, page_mm: tuple[float, float]
) -> None:
    middle = (outline.min(axis=0) + outline.max(axis=0)) / 2
    left = (page_mm[0] + _BESIDE_MM) / 2 - middle[0]
    bottom = page_mm[1] / 2 + middle[1]

    def on_page(places: FloatArray) -> QPolygonF:
        return QPolygonF([QPointF(left + x, bottom - y) for x, y in places])

    painter.setPen(QPen(Qt.GlobalColor.black, 0.4))
    painter.drawPolygon(on_page(outline))
    painter.setPen(QPen(Qt.GlobalColor.darkGray, 0.25))
    for pad in insole.design.of(Pelott):
        painter.drawPolygon(on_page(pad_outline(pad, 180)))


def _draw_beside(painter: QPainter, page_mm: tuple[float, float], words: str) -> None:
    """Write what the sheet shows, and draw a ruler to verify the scale: printers shrink pages."""
    # Without caps, which would make the ruler longer by its width.
    flat = Qt.PenCapStyle.FlatCap
    painter.setPen(QPen(Qt.GlobalColor.black, 0.2, Qt.PenStyle.SolidLine, flat))
    font = QFont(painter.font())
    font.setPixelSize(4)
    painter.setFont(font)
    wrapped = QTextOption()
    wrapped.setWrapMode(QTextOption.WrapMode.WrapAtWordBoundaryOrAnywhere)
    x, top = _ROOM_MM + 2.0, page_mm[1] - _ROOM_MM - 4.0 - RULER_MM
    painter.drawText(QRectF(x, _ROOM_MM, _BESIDE_MM - 2.0, top - 20.0), words, wrapped)
    painter.drawLine(QPointF(x, top), QPointF(x, top + RULER_MM))
    for y in np.arange(0.0, RULER_MM + 1, 10.0):
        painter.drawLine(QPointF(x, top + y), QPointF(x + (3 if y % 50 == 0 else 1.5), top + y))
    at = QRectF(x + 5.0, top, _BESIDE_MM - 7.0, RULER_MM)
    painter.drawText(at, ruler_text(), wrapped)
