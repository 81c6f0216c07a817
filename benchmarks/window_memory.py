"""Memory of the window while cases and large scans are opened and closed, in one process.

    python -m benchmarks window_memory

Limit: 50 cases opened and closed leave no more than 150 MB over the first. Shown offscreen. The
peer is the same window whose heap nobody tends: one for each thread, and freed memory kept.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from benchmarks._measure import print_table, resident_mb

CASES, SCANS = 50, 3
SCAN_TRIANGLES = 3_000_000
_TENDED, _LEFT = "tended", "left to the C library"
_CALL = "import sys, benchmarks.window_memory as b; b.measure(*sys.argv[1:])"


def main() -> None:
    rows = []
    with tempfile.TemporaryDirectory() as name:
        scan = Path(name) / "scan.ply"
        write_large_scan(scan)
        for heaps in (_TENDED, _LEFT):
            done = subprocess.run(
                [sys.executable, "-c", _CALL, str(scan), heaps],
                check=True, capture_output=True, text=True,
                env={**os.environ, "QT_QPA_PLATFORM": "offscreen"},
            )  # fmt: skip
            figures = [float(word) for word in done.stdout.split()]
            more = figures[2] - figures[1]
            rows.append([heaps, *(f"{mb:.0f}" for mb in figures), f"{more:+.0f}"])
    print_table(
        [
            "MB resident", "empty window", "1 case closed", f"{CASES} closed",
            f"then {SCANS} scans of {SCAN_TRIANGLES / 1e6:g} M triangles closed",
            f"1 to {CASES} (<= 150)",
        ],
        rows,
    )  # fmt: skip


def measure(scan: str, heaps: str) -> None:
    """Print the resident memory at each stage; in a process of its own."""
    from insole_studio import native_heap

    if heaps == _LEFT:
        native_heap._glibc = lambda: None  # type: ignore[assignment]
    from insole_core.cases.case_record import CaseRecord
    from insole_core.geometry.side import Side
    from insole_core.resources import resource_path
    from insole_studio.app.scripted import ScriptedWindow
    from insole_studio.features.case_files.open_actions import EXAMPLE
    from insole_studio.user_paths import UserPaths

    with tempfile.TemporaryDirectory() as name:
        places = UserPaths(Path(name) / "settings.json", Path(name) / "autosave")
        with ScriptedWindow(places) as studio:
            figures = [resident_mb()]

            def open_and_close(path: Path) -> None:
                studio.open(path, Side.LEFT)
                studio.app.case.open(CaseRecord(), None)
                studio.settle()

            for count in range(CASES):
                open_and_close(resource_path(EXAMPLE))
                if count in (0, CASES - 1):
                    figures.append(resident_mb())
            for _ in range(SCANS):
                open_and_close(Path(scan))
            figures.append(resident_mb())
    print(*figures)


def write_large_scan(path: Path) -> None:
    """Write a simulated foot whose triangles are divided until there are enough of them."""
    import trimesh

    from insole_core.formats.ply import write_ply
    from insole_core.geometry.mesh import TriangleMesh
    from insole_core.simulate.foot_model import build_foot
    from insole_core.simulate.foot_shape import FootShape

    mesh = build_foot(FootShape(), np.random.default_rng(7)).mesh
    vertices, triangles = mesh.vertices, mesh.triangles
    while 4 * len(triangles) <= SCAN_TRIANGLES:
        vertices, triangles = trimesh.remesh.subdivide(vertices, triangles)
    part = np.arange(len(triangles)) < (SCAN_TRIANGLES - len(triangles)) // 3
    vertices, triangles = trimesh.remesh.subdivide(vertices, triangles, np.flatnonzero(part))
    write_ply(TriangleMesh(vertices, triangles.astype(np.int32)), path)
