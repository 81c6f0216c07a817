"""Every text of both themes can be read: contrast by WCAG 2.1, level AA."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtGui import QAction, QColor
from PySide6.QtWidgets import (
    QAbstractButton,
    QApplication,
    QCheckBox,
    QDockWidget,
    QFileDialog,
    QLabel,
    QMenu,
    QToolButton,
    QWidget,
)
from pytestqt.qtbot import QtBot

from insole_studio.app.bootstrap import Application
from insole_studio.app.theme import DARK, LIGHT, Colors, apply_theme
from insole_studio.scene.painter import MATERIAL, Scheme
from insole_studio.widgets.icons import icon
from insole_studio.widgets.notice_bar import NoticeBar
from insole_studio.widgets.side_switch import COLORS

TEXT, GRAPHICS = 4.5, 3.0
ICON_PX = 22
THEMES = pytest.mark.parametrize("colors", [LIGHT, DARK], ids=["light", "dark"])
SCHEMES = pytest.mark.parametrize("scheme", [Scheme.of(False), Scheme.of(True)])


def luminance(name: str) -> float:
    channels = [c / 255 for c in QColor(name).getRgb()[:3]]  # type: ignore[index]
    linear = [c / 12.92 if c <= 0.03928 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(a: str, b: str) -> float:
    dark, light = sorted((luminance(a), luminance(b)))
    return (light + 0.05) / (dark + 0.05)


def test_the_measure_itself() -> None:
    assert contrast("#000000", "#ffffff") == pytest.approx(21.0)
    assert contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.01)


@THEMES
@pytest.mark.parametrize("ground", ["window", "base", "raised"])
@pytest.mark.parametrize("ink", ["text", "quiet"])
def test_texts(colors: Colors, ink: str, ground: str) -> None:
    assert contrast(getattr(colors, ink), getattr(colors, ground)) >= TEXT


@THEMES
def test_links_choices_and_warnings(colors: Colors) -> None:
    assert contrast(colors.accent, colors.window) >= TEXT
    assert contrast(colors.on_accent, colors.accent) >= TEXT
    assert contrast(colors.on_warning, colors.warning) >= TEXT


@THEMES
def test_the_focus_is_seen(colors: Colors) -> None:
    for ground in (colors.window, colors.base, colors.raised):
        assert contrast(colors.accent, ground) >= GRAPHICS


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("ticked", [False, True])
def test_a_box_to_tick_is_seen(qapp: QApplication, qtbot: QtBot, dark: bool, ticked: bool) -> None:
    apply_theme(qapp, dark)
    box = QCheckBox()
    qtbot.addWidget(box)
    box.setChecked(ticked)
    box.resize(box.sizeHint())
    image = box.grab().toImage()
    places = [(x, y) for x in range(image.width()) for y in range(image.height())]
    seen = {image.pixelColor(x, y).name() for x, y in places}
    apply_theme(qapp, dark=False)
    ground = (DARK if dark else LIGHT).window
    assert max(contrast(color, ground) for color in seen) >= GRAPHICS


def colors_in(menu: QMenu, action: QAction) -> set[str]:
    """The colours of the place where the box or the icon of a line is."""
    place = menu.actionGeometry(action)
    place.setWidth(ICON_PX)
    image = menu.grab(place).toImage()
    places = [(x, y) for x in range(image.width()) for y in range(image.height())]
    return {image.pixelColor(x, y).name() for x, y in places}


@pytest.mark.parametrize("touch", [False, True])
@pytest.mark.parametrize("dark", [False, True])
def test_the_boxes_of_a_menu_are_seen_and_which_line_is_chosen(
    qapp: QApplication, qtbot: QtBot, dark: bool, touch: bool
) -> None:
    apply_theme(qapp, dark, touch)
    menu = QMenu()
    qtbot.addWidget(menu)
    empty, ticked, plain = (menu.addAction(text) for text in ("empty", "ticked", "plain"))
    for action in (empty, ticked):
        action.setCheckable(True)
    ticked.setChecked(True)
    menu.popup(QPoint(0, 0))
    qtbot.waitUntil(menu.isVisible)
    seen, boxed, nothing = (colors_in(menu, action) for action in (empty, ticked, plain))
    qtbot.keyClick(menu, Qt.Key.Key_End)
    chosen = colors_in(menu, plain)
    menu.close()
    apply_theme(qapp, dark=False)
    colors = DARK if dark else LIGHT
    assert max(contrast(color, colors.window) for color in seen) >= GRAPHICS
    assert colors.accent not in seen | nothing
    assert colors.accent in boxed
    assert colors.accent in chosen


@pytest.mark.parametrize("dark", [False, True])
def test_the_signs_to_dismiss_and_to_cancel_follow_the_theme(
    app: Application, qapp: QApplication, dark: bool
) -> None:
    apply_theme(qapp, not dark)
    app.services.notices.put("x", "A notice.")
    bar = app.window.findChild(NoticeBar)
    assert isinstance(bar, NoticeBar)
    apply_theme(qapp, dark)
    (dismiss,) = [b for b in bar.findChildren(QToolButton) if b.toolTip() == "Dismiss"]
    (cancel,) = [
        b for b in app.window.statusBar().findChildren(QToolButton) if b.toolTip() == "Cancel"
    ]
    expected = icon("remove").pixmap(ICON_PX).toImage()
    images = [button.icon().pixmap(ICON_PX).toImage() for button in (dismiss, cancel)]
    app.services.notices.drop("x")
    apply_theme(qapp, dark=False)
    assert images == [expected, expected]


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("ticked", [False, True])
def test_the_icon_of_a_menu_is_seen_and_whether_it_is_ticked(
    app: Application, qapp: QApplication, dark: bool, ticked: bool
) -> None:
    apply_theme(qapp, dark)
    app.window.renew_icons()
    action = app.window.actions_by_key["linked"]
    was_ticked = action.isChecked()
    app.window.check_action("linked", ticked)
    (menu,) = [one for one in app.window.menuBar().findChildren(QMenu) if action in one.actions()]
    menu.popup(app.window.pos())
    seen = colors_in(menu, action)
    menu.close()
    apply_theme(qapp, dark=False)
    app.window.renew_icons()
    app.window.check_action("linked", was_ticked)
    colors = DARK if dark else LIGHT
    assert (colors.on_accent if ticked else colors.text) in seen
    assert (colors.accent in seen) is ticked


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("name", ["float", "close"])
def test_the_signs_of_a_panel_are_seen(
    qapp: QApplication, qtbot: QtBot, dark: bool, name: str
) -> None:
    apply_theme(qapp, dark)
    dock = QDockWidget("Panel")
    qtbot.addWidget(dock)
    dock.resize(200, 100)
    dock.show()
    seen = colors_of_sign(dock, f"qt_dockwidget_{name}button")
    apply_theme(qapp, dark=False)
    ground = (DARK if dark else LIGHT).raised
    assert max(contrast(color, ground) for color in seen) >= GRAPHICS


def colors_of_sign(window: QWidget, name: str) -> set[str]:
    """What the picture of a button of Qt's has, its ground included."""
    button = window.findChild(QAbstractButton, name)
    assert button is not None
    image = button.grab().toImage()
    places = [(x, y) for x in range(image.width()) for y in range(image.height())]
    return {image.pixelColor(x, y).name() for x, y in places}


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("name", ["back", "forward", "toParent", "newFolder", "detailMode"])
def test_the_signs_of_the_dialog_of_files_are_seen(
    qapp: QApplication, qtbot: QtBot, tmp_path: Path, dark: bool, name: str
) -> None:
    """Where the system brings no dialog of its own."""
    apply_theme(qapp, dark)
    dialog = QFileDialog(None, "Open", str(tmp_path))
    dialog.setOption(QFileDialog.Option.DontUseNativeDialog)
    qtbot.addWidget(dialog)
    for folder in (tmp_path.parent, tmp_path.parent.parent):  # so that there is a way back
        dialog.setDirectory(str(folder))
    dialog.show()
    button = dialog.findChild(QToolButton, "backButton")
    assert button is not None
    button.click()  # and one forward
    seen = colors_of_sign(dialog, f"{name}Button")
    apply_theme(qapp, dark=False)
    ground = (DARK if dark else LIGHT).window
    assert max(contrast(color, ground) for color in seen) >= GRAPHICS


class StyledLabel(QLabel):
    """Counts how often it is given a style."""

    times = 0

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802
        self.times += event.type() == QEvent.Type.StyleChange


def test_only_another_theme_styles_the_window_anew(qapp: QApplication, qtbot: QtBot) -> None:
    apply_theme(qapp, dark=False)
    label = StyledLabel()
    qtbot.addWidget(label)
    label.show()
    label.times = 0
    apply_theme(qapp, dark=False)
    assert label.times == 0
    apply_theme(qapp, dark=True)
    assert label.times > 0
    apply_theme(qapp, dark=False)
    assert label.palette().window().color().name() == LIGHT.window


@SCHEMES
def test_what_is_drawn_in_the_views(scheme: Scheme) -> None:
    for ground in (scheme.bottom, scheme.top):
        assert contrast(scheme.text, ground) >= TEXT
        for ink in (scheme.accent, scheme.mark, scheme.alarm):
            assert contrast(ink, ground) >= GRAPHICS


@SCHEMES
@pytest.mark.parametrize("ink", ["accent", "mark", "alarm"])
def test_marks_are_seen_on_an_insole_and_in_their_rims(scheme: Scheme, ink: str) -> None:
    """No colour is seen as well on the dark ground as on the material: this is most of both."""
    assert contrast(getattr(scheme, ink), QColor(*MATERIAL).name()) >= 2.6
    assert contrast(getattr(scheme, ink), "white") >= GRAPHICS


def test_the_badges_of_the_sides() -> None:
    assert all(contrast("white", color) >= TEXT for color in COLORS.values())
