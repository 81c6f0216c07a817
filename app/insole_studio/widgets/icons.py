"""One family of icons, by their meaning in this program."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import qtawesome
from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QGuiApplication, QIcon, QPalette
from PySide6.QtWidgets import QAbstractButton
from qtawesome.iconic_font import IconicFont

_NAMES = {
    "open": "mdi6.folder-open-outline",
    "capture": "mdi6.camera-outline",
    "session": "mdi6.folder-image",
    "mesh": "mdi6.cube-outline",
    "save": "mdi6.content-save-outline",
    "export": "mdi6.printer-3d-nozzle-outline",
    "undo": "mdi6.undo",
    "redo": "mdi6.redo",
    "orbit": "mdi6.rotate-orbit",
    "key_point": "mdi6.map-marker-outline",
    "turn": "mdi6.axis-z-rotate-counterclockwise",
    "pelott": "mdi6.egg-outline",
    "outline": "mdi6.vector-curve",
    "rim": "mdi6.bowl-outline",
    "device": "mdi6.shoe-print",
    "copy": "mdi6.content-copy",
    "free_hand": "mdi6.lasso",
    "brush": "mdi6.brush-outline",
    "posting": "mdi6.angle-acute",
    "plane": "mdi6.square-opacity",
    "section": "mdi6.box-cutter",
    "tape": "mdi6.tape-measure",
    "plantar": "mdi6.foot-print",
    "eye": "mdi6.eye-outline",
    "eye-off": "mdi6.eye-off-outline",
    "up": "mdi6.chevron-up",
    "down": "mdi6.chevron-down",
    "remove": "mdi6.close",
    "link": "mdi6.link-variant",
    "map": "mdi6.palette-outline",
    "mirror": "mdi6.flip-horizontal",
    "name": "mdi6.pencil-outline",
    "fit": "mdi6.fit-to-screen-outline",
    "dark": "mdi6.theme-light-dark",
    "calendar": "mdi6.calendar-month-outline",
    "patients": "mdi6.account-group-outline",
    "new_patient": "mdi6.account-plus-outline",
    "visit": "mdi6.calendar-account-outline",
    "order": "mdi6.clipboard-list-outline",
    "search": "mdi6.magnify",
}


def icon(name: str) -> QIcon:
    """Return an icon in the colours of the palette.

    Raises
    ------
    KeyError
        If the name is unknown.
    """
    palette = QGuiApplication.palette()
    group, role = QPalette.ColorGroup, QPalette.ColorRole
    plain, on = palette.color(role.ButtonText), palette.color(role.HighlightedText)
    disabled = palette.color(group.Disabled, role.ButtonText)
    # The colours are passed each time: qtawesome caches icons by their arguments.
    found: QIcon = _letters().icon(
        _NAMES[name],
        color=plain,
        color_active=plain,
        color_on=on,
        color_on_active=on,
        color_disabled=disabled,
        color_on_disabled=disabled,
    )
    return found


@cache
def _letters() -> IconicFont:
    """Return the only one of qtawesome's fonts that is used; it would read all of them."""
    folder = Path(qtawesome.__file__).parent / "fonts"
    (font,) = folder.glob("materialdesignicons6-*.ttf")
    (names,) = folder.glob("materialdesignicons6-*.json")
    return IconicFont(("mdi6", font.name, names.name, str(folder)))


class _Redrawn(QObject):
    """Draws the icon of a button again when the colours of the palette change."""

    def __init__(self, button: QAbstractButton, name: str) -> None:
        super().__init__(button)
        self._name = name
        button.setIcon(icon(name))
        button.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.PaletteChange and isinstance(watched, QAbstractButton):
            watched.setIcon(icon(self._name))
        return super().eventFilter(watched, event)


def give_icon(button: QAbstractButton, name: str) -> None:
    """Give a button an icon that stays in the colours of the palette, also in another theme."""
    _Redrawn(button, name)
