"""What is printed at true size: papers, their rulers, and PDF pages that no printer scales.

Qt rounds the size of a page to whole points (A4 becomes 595 × 842, and has 595.28 × 841.89): a
program that fits the page to the paper then makes 100 mm of it 100.05 mm.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Final

from PySide6.QtCore import QBuffer, QIODevice

from insole_studio.texts import tr

POINTS_PER_MM: Final = 72 / 25.4
_MEDIA_BOX: Final = re.compile(rb"/MediaBox \[0 0 (\d+\.\d+) (\d+\.\d+)\]")

UPRIGHT_MM: Final = {
    "A4": (210.0, 297.0),
    "A3": (297.0, 420.0),
    "Letter": (215.9, 279.4),
    "Tabloid": (279.4, 431.8),
}
"""Width and height of papers."""
WHITE_MM: Final = 5.0
"""What usual printers leave white at the edges of a paper, at most."""


def ruler_text() -> str:
    """Return what stands beside a ruler of 100 mm."""
    return tr("This line is 100 mm long. If not, print without scaling.")


def memory() -> QBuffer:
    """Return a place for a PDF in memory, since Qt does not tell whether a file was written."""
    content = QBuffer()
    content.open(QIODevice.OpenModeFlag.WriteOnly)
    return content


def exact_pages(content: QBuffer, sizes_mm: Sequence[tuple[float, float]]) -> bytes:
    """Return a PDF that Qt has written, its pages exactly as large as their papers.

    Parameters
    ----------
    sizes_mm
        Width and height of each page.
    """
    sizes = iter(sizes_mm)

    def sized(found: re.Match[bytes]) -> bytes:
        """Return the box in as many letters, for places in the file are counted in bytes."""
        exact = zip(next(sizes), found.groups(), strict=True)
        numbers = [f"{mm * POINTS_PER_MM:.6f}".encode()[: len(rounded)] for mm, rounded in exact]
        return b"/MediaBox [0 0 " + b" ".join(numbers) + b"]"

    return _MEDIA_BOX.sub(sized, bytes(content.data().data()))
