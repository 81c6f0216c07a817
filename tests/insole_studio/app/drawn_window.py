"""A program for `test_software_rendering`: answers what is asked before the window, then closes it.

Its arguments are a folder, which gets what was seen, and the button to press.
"""

from __future__ import annotations

import sys
from pathlib import Path

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication, QMessageBox

from insole_studio.app import bootstrap
from insole_studio.app.graphics import examine_graphics
from insole_studio.app.main_window import MainWindow
from insole_studio.user_paths import UserPaths

LOOK_MS = 100


def look(folder: Path, button: str) -> None:
    """Press the button of a question; close a window that is there, and has been drawn."""
    box = QApplication.activeModalWidget()
    if isinstance(box, QMessageBox):
        (folder / "asked.txt").write_text(box.text(), encoding="utf-8")
        next(b for b in box.buttons() if b.text() == button).click()
        return
    for window in QApplication.topLevelWidgets():
        if isinstance(window, MainWindow) and window.isVisible():
            graphics = examine_graphics("xcb")
            assert graphics is not None
            (folder / "drawn.txt").write_text(graphics.renderer, encoding="utf-8")
            window.close()


def main() -> int:
    folder, button = Path(sys.argv[1]), sys.argv[2]
    qt = bootstrap.qt_application()
    timer = QTimer(qt)
    timer.timeout.connect(lambda: look(folder, button))
    timer.start(LOOK_MS)
    return bootstrap.run_application([], UserPaths(folder / "settings.json", folder / "autosave"))


if __name__ == "__main__":
    sys.exit(main())
