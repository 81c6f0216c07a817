"""Scans of others, of more than forty kinds: read right, asked, refused, or wrong without a word.

Each is opened as the command line does with ``--side left``, in a process of its own. Right is a
foot of the right side and within 1.5 % of its length; told is one that comes with a warning. Fails
if a scan is opened wrongly without a word, or ends in a traceback. For each: processor seconds and
the memory at its peak. ``ONLY`` names the kinds that are wanted by a part of their names.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

from benchmarks._measure import print_table
from benchmarks._odd_scans import OddScan, odd_scans

ONLY = os.environ.get("ONLY", "")
_MOST_SHARE = 0.015
_OPENED = """
import json, resource, sys, time
from pathlib import Path
from insole_core.errors import InsoleError
from insole_core.foot.foot_placement import DoubtfulScanError
from insole_core.geometry.side import Side
from insole_core.workflows.open_scan import open_scan
start = time.process_time()
said = {}
try:
    scanned = open_scan(Path(sys.argv[1]), Side.LEFT)
    said = {"length_mm": scanned.foot.length_mm, "words": " ".join(scanned.warnings)}
except DoubtfulScanError as error:
    said = {"asked": str(error)}
except InsoleError as error:
    said = {"refused": str(error)}
said["seconds"] = time.process_time() - start
said["peak_mb"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
print(json.dumps(said))
"""


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        rows = [
            _row(scan, Path(folder) / scan.name)
            for scan in odd_scans()
            if ONLY.lower() in scan.kind.lower()
        ]
    print_table(("scan", "MB", "found", "s", "peak MB", "words"), rows)
    counts = Counter(row[2] for row in rows)
    print(", ".join(f"{kind}: {count}" for kind, count in sorted(counts.items())))
    if counts["WRONG"] or counts["TRACEBACK"]:
        sys.exit(1)


def _row(scan: OddScan, path: Path) -> tuple[str, ...]:
    path.write_bytes(scan.content)
    done = subprocess.run(
        [sys.executable, "-c", _OPENED, str(path)], capture_output=True, text=True, check=False
    )
    path.unlink()
    size = f"{len(scan.content) / 1e6:.1f}"
    if done.returncode:
        return scan.kind, size, "TRACEBACK", "", "", done.stderr.strip().splitlines()[-1][:60]
    said = json.loads(done.stdout)
    found, words = _verdict(scan, said)
    words = words.removeprefix(f"{path} ")[:70]
    return scan.kind, size, found, f"{said['seconds']:.1f}", f"{said['peak_mb']:.0f}", words


def _verdict(scan: OddScan, said: dict[str, object]) -> tuple[str, str]:
    """Return what was made of a scan, and the words that came with it."""
    for kind in ("asked", "refused"):
        if kind in said:
            return kind, str(said[kind])
    length_mm, words = float(str(said["length_mm"])), str(said["words"])
    true_mm = scan.length_mm
    is_right = true_mm is not None and abs(length_mm / true_mm - 1) <= _MOST_SHARE
    if is_right:
        return ("right, told" if words else "right"), words
    return ("told" if words else "WRONG"), words or f"{length_mm:.0f} mm"


if __name__ == "__main__":
    main()
