"""Measure how long a click takes to a painted window.

Usage: ``python packaging/measure_start.py [PROGRAM]``, with Xvfb and PySide6, which looks at the
screen. A run counts until most of the screen is no longer black; the last picture is kept in
``build/start.png``. Each run has a home of its own, kept for a second start. Beside the time on the
wall stands that of the processors, which other programs lengthen less; Linux only.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication

from bundle import product

DISPLAY = ":87"
RUNS = 3
AFTERWARDS_S = 4.0
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
        longest_s = 0.0
        for run in range(RUNS):
            with tempfile.TemporaryDirectory() as home:
                for name in ("first start", "second start"):
                    start = _start(program, home, application)
                    load = os.getloadavg()[0]
                    print(f"{name} {run + 1}: {start}; load of the machine {load:.1f}", flush=True)
                    longest_s = max(longest_s, start.wall_s)
    finally:
        server.terminate()
        server.wait()
    return 1 if longest_s >= LONGEST_S else 0


@dataclass(frozen=True)
class Start:
    """How long a start took until the window was painted, and what the processors did after."""

    wall_s: float
    processor_s: float
    afterwards_s: float
    """Of the processors, within `AFTERWARDS_S` after the first picture."""

    def __str__(self) -> str:
        return (
            f"painted after {self.wall_s:.2f} s ({self.processor_s:.2f} s of a processor, "
            f"{self.afterwards_s:.2f} s more in the next {AFTERWARDS_S:.0f} s)"
        )


def _start(program: str, home: str, application: QApplication) -> Start:
    began = time.monotonic()
    environment = {**os.environ, "HOME": home}
    window = subprocess.Popen([program], env=environment, start_new_session=True)
    try:
        while time.monotonic() - began < LONGEST_S:
            picture = application.primaryScreen().grabWindow(0).toImage()
            if _share_painted(picture) > PAINTED:
                break
            time.sleep(0.02)
        wall_s, processor_s = time.monotonic() - began, _processor_seconds(window.pid)
        time.sleep(AFTERWARDS_S)
        application.primaryScreen().grabWindow(0).save(str(product.BUILD / "start.png"))
        afterwards_s = _processor_seconds(window.pid) - processor_s
    finally:
        window.terminate()
        window.wait()
    return Start(wall_s, processor_s, afterwards_s)


def _processor_seconds(session: int) -> float:
    """Return what all processes of a session have used up to now."""
    ticks = 0
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = path.read_text().rpartition(")")[2].split()
        except OSError:  # it has just ended
            continue
        if int(fields[3]) == session:
            ticks += int(fields[11]) + int(fields[12])
    return ticks / os.sysconf("SC_CLK_TCK")


def _share_painted(picture: QImage) -> float:
    """Return the share of a coarse grid of points that is not black."""
    points = [(x, y) for x in range(8, picture.width(), 40) for y in range(8, picture.height(), 40)]
    black = sum(picture.pixelColor(x, y).lightness() == 0 for x, y in points)
    return 1.0 - black / len(points)


if __name__ == "__main__":
    sys.exit(main())
