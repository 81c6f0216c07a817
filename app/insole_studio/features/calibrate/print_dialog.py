"""Boards and marker templates at true size: painted, and the dialog that prints them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
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
from PySide6.QtWidgets import (
    QDialog,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from insole_core.calibration.boards.board import Charuco, Chequerboard
from insole_core.calibration.boards.printed_page import (
    RULER_MM,
    PrintedPage,
    charuco_page,
    chequerboard_page,
    marker_pages,
)
from insole_core.errors import InsoleError
from insole_core.files.atomic import replacing_file
from insole_core.recording.session import ReferenceSystem
from insole_studio.features.calibrate.rows import BoardSize
from insole_studio.services.files import Kept
from insole_studio.services.questions import Questions
from insole_studio.services.true_size import (
    UPRIGHT_MM,
    WHITE_MM,
    exact_pages,
    memory,
    ruler_text,
)
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.form_parts import ComboBox
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.number_field import NumberField

_DPI = 1200
_INCH_MM = 25.4
_BASE_MM = WHITE_MM + 2.6
"""Of the ruler, within the edge of the page."""
_CLEAR_MM = 3.4
"""White between the ruler and what is measured in a picture."""
_TEXT_MM, _LABEL_MM = 2.2, 2.8
PAPERS_MM = {name: (tall, wide) for name, (wide, tall) in UPRIGHT_MM.items()}
"""Paper sizes, landscape."""
_CHEQUERBOARD, _CHARUCO, _MARKERS = "chequerboard", "charuco", "markers"
_CHARUCO_SQUARES = (10, 7)
_MARKER_SHARE = 0.75
"""Side of a ChArUco marker as a share of its square's."""


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
    _paint_pages(writer, pages)
    with replacing_file(path) as beside:
        beside.write_bytes(exact_pages(content, [page.size_mm for page in pages]))


def _paint_pages(device: QPagedPaintDevice, pages: Sequence[PrintedPage]) -> None:
    """Paint each page on a sheet of its size, from edge to edge."""
    device.setPageLayout(_layout_of(pages[0]))
    painter = QPainter(device)
    # Printers may have other dots across than along.
    across, along = device.logicalDpiX() / _INCH_MM, device.logicalDpiY() / _INCH_MM
    for number, page in enumerate(pages):
        if number:
            device.setPageLayout(_layout_of(page))
            device.newPage()
        painter.save()
        painter.scale(across, along)
        paint_page(painter, page)
        painter.restore()
    painter.end()


def _layout_of(page: PrintedPage) -> QPageLayout:
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
    painter.save()
    _go_to_ruler(painter, page)
    painter.drawLine(QPointF(0, 0), QPointF(RULER_MM, 0))
    for x in (0.0, RULER_MM):
        painter.drawLine(QPointF(x, -1.5), QPointF(x, 1))
    _write(painter, ruler_text(), 4 + RULER_MM, -1.3, _TEXT_MM)
    _write(painter, translate_core_message(page.note), 4 + RULER_MM, 1.3, _TEXT_MM)
    painter.restore()


def _go_to_ruler(painter: QPainter, page: PrintedPage) -> None:
    """Go to where the ruler begins: along the lower edge, or the left one where it is wider."""
    left, low = page.boxes_mm[:, 0].min(), page.boxes_mm[:, [1, 3]].sum(axis=1).max()
    below = page.size_mm[1] - low
    if below < _BASE_MM + _CLEAR_MM and left > below:
        painter.translate(_BASE_MM, page.size_mm[1] - 10)
        painter.rotate(-90)
    else:
        painter.translate(10, page.size_mm[1] - min(_BASE_MM, max(below - _CLEAR_MM, 1.5)))


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


class _PagePreview(QWidget):
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


class PrintDialog(QDialog):
    """Chooses a board and a paper, and prints the board or saves it as PDF.

    Parameters
    ----------
    board
        The board in use, which is proposed.
    system
        The reference system whose marker templates can be printed.
    questions
        Ask for the PDF file; by default with folders of their own.
    ask_file
        Lets the user choose a PDF file by a proposed name; by default in a dialog.
    ask_printer
        Lets the user choose a printer; by default in a dialog.
    """

    def __init__(
        self,
        board: BoardSize,
        system: ReferenceSystem,
        parent: QWidget | None = None,
        *,
        questions: Questions | None = None,
        ask_file: Callable[[str], Path | None] | None = None,
        ask_printer: Callable[[], QPagedPaintDevice | None] | None = None,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Print boards"))
        self._system = system
        self._questions = questions.on(self) if questions else Questions(self)
        self._ask_file = ask_file or self._choose_file
        self._ask_printer = ask_printer or self._choose_printer
        self._pages: Sequence[PrintedPage] = ()
        self.what = ComboBox(
            [
                (_CHEQUERBOARD, tr("Chequerboard")),
                (_CHARUCO, tr("ChArUco board")),
                (_MARKERS, tr("Templates of the marker faces")),
            ]
        )
        self.paper = ComboBox([(name, name) for name in PAPERS_MM])
        self.columns, self.rows = QSpinBox(), QSpinBox()
        for field, value in ((self.columns, board.columns), (self.rows, board.rows)):
            field.setRange(3, 50)
            field.setValue(value)
        self.square = NumberField("mm", least=5, greatest=200, step=0.5, decimals=2)
        self.square.show_value(board.square_mm)
        self._preview = _PagePreview()
        self._problem, self._done = MessageLabel("warning"), MessageLabel("quiet")
        self.save = QPushButton(tr("Save as PDF…"))
        self.print = QPushButton(tr("Print…"))
        self._lay_out()
        self._connect()
        self._lay_out_pages()

    def _connect(self) -> None:
        for choice in (self.what, self.paper):
            choice.edited.connect(lambda _key: self._lay_out_pages())
        for field in (self.columns, self.rows):
            field.valueChanged.connect(lambda _count: self._lay_out_pages())
        self.square.edited.connect(lambda _side: self._lay_out_pages())
        self.save.clicked.connect(self._save)
        self.print.clicked.connect(self._print)

    def _lay_out(self) -> None:
        corners = QHBoxLayout()
        corners.addWidget(self.columns, 1)
        corners.addWidget(QLabel("×"))
        corners.addWidget(self.rows, 1)
        self._form = QFormLayout()
        self._form.addRow(tr("Board"), self.what)
        self._form.addRow(tr("Paper"), self.paper)
        self._form.addRow(tr("Inner corners"), corners)
        self._form.addRow(tr("Side of a square"), self.square)
        self._hint = QLabel(
            tr("Print at 100 %, check the line at the edge, and glue the page to something stiff.")
        )
        self._hint.setWordWrap(True)
        close = QPushButton(tr("Close"))
        close.clicked.connect(self.close)
        buttons = QHBoxLayout()
        buttons.addStretch(1)
        for button in (self.save, self.print, close):
            button.setAutoDefault(False)
            buttons.addWidget(button)
        layout = QVBoxLayout(self)
        layout.addLayout(self._form)
        layout.addWidget(self._preview, 1)
        for label in (self._hint, self._problem, self._done):
            layout.addWidget(label)
        layout.addLayout(buttons)

    def _lay_out_pages(self) -> None:
        """Lay out what is chosen, or say why it cannot be printed."""
        self._form.setRowVisible(2, self.what.currentData() == _CHEQUERBOARD)
        self._form.setRowVisible(3, self.what.currentData() == _CHEQUERBOARD)
        self._done.say("")
        try:
            self._pages = self._chosen()
        except InsoleError as error:
            self._pages = ()
            self._tell(self._problem, str(error))
        else:
            self._problem.say("")
        self._preview.show_page(self._pages[0] if self._pages else None)
        for button in (self.save, self.print):
            button.setEnabled(bool(self._pages))

    def _tell(self, label: MessageLabel, sentence: str) -> None:
        """Say something, and let the dialog grow by it: else words would lie over the preview."""
        label.say(sentence)
        layout = self.layout()
        if self.isVisible() and layout is not None:
            height_px = layout.totalHeightForWidth(self.width())
            self.resize(self.width(), max(self.height(), height_px))

    def _chosen(self) -> list[PrintedPage]:
        paper_mm = PAPERS_MM[self.paper.currentData()]
        if self.what.currentData() == _MARKERS:
            return marker_pages(self._system, paper_mm)
        if self.what.currentData() == _CHARUCO:
            return [charuco_page(_charuco_for(paper_mm), paper_mm)]
        board = Chequerboard(self.columns.value(), self.rows.value(), self.square.value())
        return [chequerboard_page(board, paper_mm)]

    def _save(self) -> None:
        path = self._ask_file(f"{self.what.currentData()}-{self.paper.currentData().lower()}.pdf")
        if path is None:
            return
        try:
            write_pdf(self._pages, path)
        except InsoleError as error:
            self._tell(self._problem, str(error))
        else:
            self._tell(self._done, tr("Saved: {path}").format(path=path))

    def _print(self) -> None:
        printer = self._ask_printer()
        if printer is not None:
            _paint_pages(printer, self._pages)

    def _choose_file(self, proposed: str) -> Path | None:
        return self._questions.file_to_write(proposed, "PDF (*.pdf)", Kept.PAPERS)

    def _choose_printer(self) -> QPagedPaintDevice | None:
        from PySide6.QtPrintSupport import QPrintDialog, QPrinter

        printer = QPrinter(QPrinter.PrinterMode.HighResolution)
        printer.setFullPage(True)
        dialog = QPrintDialog(printer, self)
        return printer if dialog.exec() == QDialog.DialogCode.Accepted else None


def _charuco_for(paper_mm: tuple[float, float]) -> Charuco:
    """Return the ChArUco board with the largest squares, whole mm, that fit a paper."""
    columns, rows = _CHARUCO_SQUARES
    side = int(min((paper_mm[0] - 10) / columns, (paper_mm[1] - 10) / rows))
    return Charuco(columns, rows, side, round(_MARKER_SHARE * side))
