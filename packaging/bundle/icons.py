"""The icon of the program in the forms that Windows and macOS ask for."""

from __future__ import annotations

import io
import os
from pathlib import Path

from bundle import product

ICON = product.ROOT / "resources" / "icons" / f"{product.COMMAND}.svg"
SUFFIXES = {"win32": ".ico", "darwin": ".icns"}
"""By system; Linux takes the drawing itself."""
PIXELS = 1024


def write_icon(folder: Path, system: str) -> Path | None:
    """Write the icon of a system, and return it; none where the drawing will do."""
    if system not in SUFFIXES:
        return None
    from PIL import Image

    folder.mkdir(parents=True, exist_ok=True)
    target = folder / f"{product.COMMAND}{SUFFIXES[system]}"
    picture = Image.open(io.BytesIO(_drawn()))
    if target.suffix == ".ico":
        picture.save(target, sizes=[(side, side) for side in (16, 24, 32, 48, 64, 128, 256)])
    else:
        picture.save(target)
    return target


def _drawn() -> bytes:
    """Return the drawing as PNG."""
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from PySide6.QtCore import QBuffer, QByteArray, QIODevice, Qt
    from PySide6.QtGui import QImage, QPainter
    from PySide6.QtSvg import QSvgRenderer

    image = QImage(PIXELS, PIXELS, QImage.Format.Format_ARGB32)
    image.fill(Qt.GlobalColor.transparent)
    painter = QPainter(image)
    QSvgRenderer(str(ICON)).render(painter)
    painter.end()
    content = QByteArray()
    buffer = QBuffer(content)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    image.save(buffer, b"PNG")
    return bytes(content.data())
