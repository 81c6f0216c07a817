"""PDF pages of Qt with the exact size of their paper, so that no printer scales what is on them.

Qt rounds the size of a page to whole points (A4 becomes 595 × 842, and has 595.28 × 841.89): a
program that fits the page to the paper then makes 100 mm of it 100.05 mm.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Final

from PySide6.QtCore import QBuffer, QIODevice

POINTS_PER_MM: Final = 72 / 25.4
_MEDIA_BOX: Final = re.compile(rb"/MediaBox \[0 0 (\d+\.\d+) (\d+\.\d+)\]")


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
