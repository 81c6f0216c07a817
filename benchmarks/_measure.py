"""Time and memory of whole processes and of calls, measured alike for product and peer."""

from __future__ import annotations

import mmap
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class ProcessCost:
    """The resources that one process used from start to end."""

    seconds: float
    peak_mb: float


def run_process(arguments: list[str]) -> ProcessCost:
    """Run a command of the product and measure its process from outside."""
    start = time.perf_counter()
    process = subprocess.Popen(
        [sys.executable, "-m", "insole_studio", *arguments], stderr=subprocess.DEVNULL
    )
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.perf_counter() - start
    if os.waitstatus_to_exitcode(status) != 0:
        raise RuntimeError(f"{' '.join(arguments)} failed")
    return ProcessCost(seconds, usage.ru_maxrss / 1024)


def median_ms(call: Callable[[], object], repeats: int = 7) -> float:
    """Return the median time of a call, after one warm-up call."""
    call()
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return 1000 * statistics.median(times)


def print_table(head: Iterable[str], rows: Iterable[Iterable[object]]) -> None:
    """Print rows below a header, with aligned columns."""
    table = [[str(cell) for cell in row] for row in [head, *rows]]
    widths = [max(len(row[i]) for row in table) for i in range(len(table[0]))]
    for row in table:
        cells = [cell.ljust(width) for cell, width in zip(row, widths, strict=True)]
        print("  ".join(cells).rstrip())


def recorded_session(folder: Path) -> Path:
    """Simulate the session for benchmarks of the whole pipeline."""
    path = folder / "session"
    subprocess.run(
        [sys.executable, "-m", "insole_studio", "simulate", str(path), "--seed", "7"],
        check=True,
        stderr=subprocess.DEVNULL,
    )
    return path


def resident_mb() -> float:
    """Memory of this process, where the system tells it as Linux does; else nothing."""
    told = Path("/proc/self/statm")
    pages = int(told.read_text(encoding="ascii").split()[1]) if told.exists() else 0
    return pages * mmap.PAGESIZE / 1e6
