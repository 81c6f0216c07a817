"""The notices have the height that they need, in the toolbar of a window."""

from __future__ import annotations

from PySide6.QtWidgets import QMainWindow, QToolBar
from pytestqt.qtbot import QtBot

from insole_studio.widgets.notice_bar import Notice, NoticeBar

TEXT = (
    "The file does not say how the foot lies: the way that looks most like a foot was taken. " * 3
)


def test_the_bar_gives_the_height_of_a_notice_back_when_it_goes(qtbot: QtBot) -> None:
    window, bar = QMainWindow(), NoticeBar()
    qtbot.addWidget(window)
    toolbar = QToolBar(window)
    toolbar.addWidget(bar)
    window.addToolBar(toolbar)
    window.resize(900, 400)
    window.show()
    first, second = (Notice(key, TEXT) for key in "ab")
    bar.show_notices((first,))
    qtbot.waitUntil(lambda: 0 < bar.height() == bar.sizeHint().height())
    one_px = bar.height()
    bar.show_notices((first, second))
    qtbot.waitUntil(lambda: bar.height() > one_px)
    bar.show_notices((first,))
    qtbot.waitUntil(lambda: bar.height() == one_px)
