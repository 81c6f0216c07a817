"""Windows killed while the database goes and comes: what a window said was kept is there again.

A window changes the foot of a visit on PostgreSQL, and notes each change of which the status line
says that it is saved, or kept on this computer. Meanwhile the server is stopped without warning and
started again, and a second window of the same user starts, all at random moments; then the windows
are killed with signal 9. The next window, which may start while the server is away, hands over what
was left, and opens the visit: it must show the last change that was said to be kept, or a later
one. The faults must be 0.

``KILLS=20`` asks for fewer kills.
"""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests/insole_studio"))
from killed_windows import FAULTS, binaries
from killed_windows import main as kill_windows

from benchmarks._measure import print_table


def main() -> None:
    if binaries() is None:
        print("PostgreSQL is not installed; nothing was tried.")
        return
    started_at = time.monotonic()
    kills, seed = int(os.environ.get("KILLS", "200")), os.environ.get("FUZZ_SEED", "1")
    counts = kill_windows(kills, seed)
    names = ("kills", "stops", "second windows", "said to be kept", "handed over", *FAULTS)
    seconds = round(time.monotonic() - started_at)
    print_table([*names, "seconds"], [[*(counts[key] for key in names), seconds]])
    if any(counts[fault] for fault in FAULTS):
        raise SystemExit(1)
