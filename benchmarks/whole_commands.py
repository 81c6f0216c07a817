"""Wall time and peak memory of whole commands as processes, beside a bare start of Python."""

from __future__ import annotations

import tempfile
from pathlib import Path

from benchmarks._measure import print_table, recorded_session, run_process


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        session = str(recorded_session(folder))
        foot, insole = str(folder / "foot.ply"), str(folder / "insole.stl")
        calls = {
            "--version (start alone)": ["--version"],
            "reconstruct thesis": ["reconstruct", session, "--out", foot, "--method", "thesis"],
            "reconstruct fused": ["reconstruct", session, "--out", foot],
            "design": ["design", session, "--out", insole],
        }
        rows = []
        for title, call in calls.items():
            costs = [run_process(call) for _ in range(3)]
            best = min(cost.seconds for cost in costs)
            rows.append([title, f"{best:.2f}", f"{max(c.peak_mb for c in costs):.0f}"])
        print_table(["command", "seconds (best of 3)", "peak MB"], rows)
