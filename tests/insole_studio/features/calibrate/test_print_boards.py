"""Boards and marker templates are printed at true size from the stage and from the menu."""

from __future__ import annotations

import re
import zlib
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QImage, QPainter
from PySide6.QtPrintSupport import QPrinter
from pytestqt.qtbot import QtBot

from insole_core.calibration.boards.board import Chequerboard
from insole_core.calibration.boards.printed_page import chequerboard_page
from insole_core.calibration.markers.reference_file import load_reference_system
from insole_core.geometry.arrays import FloatArray
from insole_core.resources import resource_path
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.acquisition.capture_setup import DEFAULT_SYSTEM
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.app.bootstrap import Application
from insole_studio.features.calibrate.print_dialog import PAPERS_MM, PrintDialog, paint_page
from insole_studio.features.calibrate.rows import BoardSize
from insole_studio.features.calibrate.stage import CalibrateStage

MM_PER_PT = 25.4 / 72
NUMBER = rb"(-?[\d.]+)"


@pytest.fixture
def dialog(qtbot: QtBot, tmp_path: Path) -> PrintDialog:
    system = load_reference_system(resource_path(DEFAULT_SYSTEM))
    made = PrintDialog(BoardSize(10, 7, 25), system, ask_file=lambda proposed: tmp_path / proposed)
    qtbot.addWidget(made)
    made.show()
    return made


def choose(qtbot: QtBot, dialog: PrintDialog, what: str, paper: str) -> None:
    """Choose by keyboard."""
    for box, key in ((dialog.what, what), (dialog.paper, paper)):
        qtbot.keyClick(box, Qt.Key.Key_Home)
        for _ in range(box.findData(key)):
            qtbot.keyClick(box, Qt.Key.Key_Down)
        assert box.currentData() == key


def papers_mm(pdf: bytes) -> list[tuple[float, float]]:
    boxes = re.findall(rb"/MediaBox \[ ?0 0 ([\d.]+) ([\d.]+)", pdf)
    return [(float(w) * MM_PER_PT, float(h) * MM_PER_PT) for w, h in boxes]


def drawn_boxes_mm(pdf: bytes) -> FloatArray:
    """Width and height of the rectangles on the first page, as its two scales make them."""
    contents = re.findall(rb"stream\r?\n(.*?)endstream", pdf, re.DOTALL)
    page = next(text for c in contents if b" re\n" in (text := inflated(c)))
    scales = re.findall(NUMBER + rb" 0 0 " + NUMBER + rb" \S+ \S+ cm", page)[:2]
    scale = np.prod([abs(float(x)) for x, _ in scales]) * MM_PER_PT
    sizes = re.findall(rb"^\S+ \S+ " + NUMBER + b" " + NUMBER + rb" re$", page, re.MULTILINE)
    return np.array(sizes, dtype=float) * scale


def inflated(content: bytes) -> bytes:
    try:
        return zlib.decompress(content)
    except zlib.error:
        return b""


@pytest.mark.parametrize("paper", ["A4", "A3", "Tabloid"])
def test_a_board_is_saved_at_true_size(
    paper: str, dialog: PrintDialog, qtbot: QtBot, tmp_path: Path
) -> None:
    choose(qtbot, dialog, "chequerboard", paper)
    qtbot.mouseClick(dialog.save, Qt.MouseButton.LeftButton)
    pdf = (tmp_path / f"chequerboard-{paper.lower()}.pdf").read_bytes()
    preview, words = dialog._preview.geometry(), dialog._hint.geometry()
    assert not preview.intersects(words)  # though there is one line more by now
    assert papers_mm(pdf) == [pytest.approx(PAPERS_MM[paper], abs=1e-4)]
    sizes = drawn_boxes_mm(pdf)
    assert len(sizes) == 44
    assert np.allclose(sizes, 25, atol=0.01)


@pytest.mark.parametrize("board", [Chequerboard(10, 7, 25), Chequerboard(9, 5, 25)])
def test_the_painted_board_is_found_with_its_true_size_and_a_ruler(board: Chequerboard) -> None:
    px_per_mm = 5.0
    page = chequerboard_page(board, PAPERS_MM["A4"])
    width, height = (round(px_per_mm * side) for side in page.size_mm)
    image = QImage(width, height, QImage.Format.Format_Grayscale8)
    image.fill(QColor("white"))
    painter = QPainter(image)
    painter.scale(px_per_mm, px_per_mm)
    paint_page(painter, page)
    painter.end()
    pixels = np.frombuffer(image.constBits(), np.uint8).reshape(height, image.bytesPerLine())
    grey = np.ascontiguousarray(pixels[:, :width])
    found = board.find("print", grey).pixels.reshape(board.rows, board.columns, 2)
    steps = np.linalg.norm(np.diff(found, axis=1), axis=-1)
    assert np.allclose(steps / px_per_mm, 25, atol=0.05)
    low = page.boxes_mm[:, :2].min(axis=0)
    high = (page.boxes_mm[:, :2] + page.boxes_mm[:, 2:]).max(axis=0)
    x0, y0, x1, y1 = np.rint(px_per_mm * np.concatenate([low, high])).astype(int)
    grey[y0 : y1 + 1, x0 : x1 + 1] = 255
    ink = np.argwhere(grey < 128)[:, ::-1] / px_per_mm  # of ruler and words
    assert (ink.min(axis=0) > 5).all()  # usual printers leave less white than that
    assert (ink.max(axis=0) < np.array(page.size_mm) - 5).all()
    lines = [*(grey < 128), *(grey < 128).T]
    assert max(map(longest_run, lines)) / px_per_mm == pytest.approx(100, abs=0.5)


def longest_run(line: np.ndarray) -> int:
    """Return how many neighbours in a row of bools (n,) are true."""
    ends = np.flatnonzero(np.diff(np.concatenate([[False], line, [False]])))
    return int(np.diff(ends)[::2].max(initial=0))


def test_other_boards_and_templates(dialog: PrintDialog, qtbot: QtBot, tmp_path: Path) -> None:
    for paper in PAPERS_MM:
        choose(qtbot, dialog, "charuco", paper)
        assert dialog.save.isEnabled()
    choose(qtbot, dialog, "markers", "A3")
    qtbot.mouseClick(dialog.save, Qt.MouseButton.LeftButton)
    assert len(papers_mm((tmp_path / "markers-a3.pdf").read_bytes())) == 2


def test_what_does_not_fit_is_said_and_cannot_be_printed(dialog: PrintDialog, qtbot: QtBot) -> None:
    dialog.square.selectAll()
    qtbot.keyClicks(dialog.square, "30")
    qtbot.keyClick(dialog.square, Qt.Key.Key_Return)
    assert not dialog.save.isEnabled()
    assert not dialog.print.isEnabled()
    assert "330×240 mm does not fit a page of 297×210 mm" in dialog._problem.text()
    choose(qtbot, dialog, "chequerboard", "A3")
    assert dialog.save.isEnabled()
    assert not dialog._problem.isVisible()


def test_a_file_that_cannot_be_written_is_said(
    dialog: PrintDialog, qtbot: QtBot, tmp_path: Path
) -> None:
    (tmp_path / "chequerboard-a4.pdf").mkdir()
    qtbot.mouseClick(dialog.save, Qt.MouseButton.LeftButton)
    assert "cannot be written" in dialog._problem.text()


def test_a_printer_gets_the_page_at_true_size(
    dialog: PrintDialog, qtbot: QtBot, tmp_path: Path
) -> None:
    printer = QPrinter(QPrinter.PrinterMode.HighResolution)
    printer.setOutputFormat(QPrinter.OutputFormat.PdfFormat)
    printer.setOutputFileName(str(tmp_path / "printed.pdf"))
    printer.setFullPage(True)
    dialog._ask_printer = lambda: printer
    choose(qtbot, dialog, "chequerboard", "A3")
    qtbot.mouseClick(dialog.print, Qt.MouseButton.LeftButton)
    pdf = (tmp_path / "printed.pdf").read_bytes()
    assert papers_mm(pdf) == [pytest.approx(PAPERS_MM["A3"], abs=0.4)]
    assert np.allclose(drawn_boxes_mm(pdf), 25, atol=0.01)


def test_the_panel_opens_it_with_the_board_in_use(qtbot: QtBot, tmp_path: Path) -> None:
    store = SensorStore(tmp_path / "sensors")
    stage = CalibrateStage(store, SensorSource(store), tmp_path / "pictures")
    stage.show()
    stage.view.show_board(BoardSize(12, 8, 20))
    qtbot.mouseClick(stage.view.print_boards, Qt.MouseButton.LeftButton)
    opened = stage.findChild(PrintDialog)
    assert opened.isVisible()
    assert (opened.columns.value(), opened.rows.value(), opened.square.value()) == (12, 8, 20)
    stage.close()
    stage.deleteLater()


def test_the_menu_opens_it(app: Application) -> None:
    action = next(a for menu in app.window.menuBar().actions() for a in menu.menu().actions()
                  if a.text() == "Print calibration boards…")  # fmt: skip
    action.trigger()
    stage = app.features.calibrate.stage
    assert stage is not None
    assert stage.findChild(PrintDialog).isVisible()
