"""Measure how long a click takes to a painted window.

Usage: ``python packaging/measure_start.py [PROGRAM]``, with Xvfb and PySide6, which looks at the
screen. A run counts until most of the screen is no longer black; the last picture is kept in
``build/start.png``.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication

from bundle import product

DISPLAY = ":87"
RUNS = 5
PAINTED = 0.5
"""Share of the screen."""
LONGEST_S = 60.0


def main() -> int:
    """Print the seconds of each run; return 1 if a window did not come."""
    program = sys.argv[1] if len(sys.argv) > 1 else str(product.FROZEN / product.COMMAND)
    screen = ["Xvfb", DISPLAY, "-screen", "0", "1600x1000x24", "-nolisten", "tcp"]
    server = subprocess.Popen(screen, stderr=subprocess.DEVNULL)
    try:
        time.sleep(1.0)
        os.environ.update(DISPLAY=DISPLAY, QT_QPA_PLATFORM="xcb")
        application = QApplication([])
        seconds = [_seconds_to_window(program, application) for _ in range(RUNS)]
    finally:
        server.terminate()
        server.wait()
    print("seconds to a painted window:", *(f"{value:.2f}" for value in seconds))
    return 1 if max(seconds) >= LONGEST_S else 0


def _seconds_to_window(program: str, application: QApplication) -> float:
    with tempfile.TemporaryDirectory() as home:
        began = time.monotonic()
        window = subprocess.Popen([program], env={**os.environ, "HOME": home})
        try:
            while time.monotonic() - began < LONGEST_S:
                picture = application.primaryScreen().grabWindow(0).toImage()
                if _share_painted(picture) > PAINTED:
                    break
                time.sleep(0.02)
            taken = time.monotonic() - began
            time.sleep(2.0)  # what comes after the first picture
            application.primaryScreen().grabWindow(0).save(str(product.BUILD / "start.png"))
        finally:
            window.terminate()
            window.wait()
    return taken


def _share_painted(picture: QImage) -> float:
    """Return the share of a coarse grid of points that is not black."""
    points = [(x, y) for x in range(8, picture.width(), 40) for y in range(8, picture.height(), 40)]
    black = sum(picture.pixelColor(x, y).lightness() == 0 for x, y in points)
    return 1.0 - black / len(points)


if __name__ == "__main__":
    sys.exit(main())
