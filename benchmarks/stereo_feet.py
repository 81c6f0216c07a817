"""Feet before three simulated D415, 450 to 600 mm away, beside Open3D on the same frames.

``python -m benchmarks stereo_feet`` simulates 20 feet, each at one of four distances. The product
finds the poses, and takes the depth of the camera or matches its infrared pair anew; Open3D is
given the depth and the true poses. Sessions are kept in ``benchmarks/results/stereo``
and are not made twice. ``FEET`` is the number of feet (20).

Sole and tendon: mean and 95 % of the distance after a rigid best fit (shape), mean in place, share
of the sole within 1.5 mm, mm.
"""

from __future__ import annotations

import os
from collections import defaultdict
from pathlib import Path

import numpy as np
import trimesh

from benchmarks._measure import print_table
from benchmarks._open3d_peers import open3d_peers, readings_of, with_true_poses
from benchmarks.infrared import figures
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.reconstruct import reconstruct
from insole_core.reconstruct.fusion.fused_surface import fuse
from insole_core.reconstruct.fusion.prepared_view import prepare
from insole_core.recording.reader import read_session
from insole_core.recording.writer import write_session
from insole_core.simulate import SimulationOptions, simulate_session

KEPT = Path(__file__).parent / "results" / "stereo"
FEET = int(os.environ.get("FEET", "20"))
DISTANCES_MM = (450.0, 500.0, 550.0, 600.0)
SHAPE_MM, SHAPE_95_MM = 0.20, 0.60
"""Wanted at every distance."""
_FRAMES = 6


def main() -> None:
    KEPT.mkdir(parents=True, exist_ok=True)
    rows: dict[tuple[float, str], list[dict[str, float]]] = defaultdict(list)
    for number in range(FEET):
        distance_mm = DISTANCES_MM[number % len(DISTANCES_MM)]
        for name, found in _compared(number, distance_mm).items():
            rows[distance_mm, name].append(found)
            print(number, f"{distance_mm:.0f}", name, _shown([found]), flush=True)
    head = ["distance", "", "feet", *next(iter(rows.values()))[0]]
    print_table(
        head,
        [[f"{mm:.0f}", name, len(of), *_shown(of)] for (mm, name), of in sorted(rows.items())],
    )


def _compared(number: int, distance_mm: float) -> dict[str, dict[str, float]]:
    folder = kept_foot(number, distance_mm)
    session = read_session(folder)
    truth = trimesh.load(folder / "truth.ply", process=False, force="mesh")
    surfaces: dict[str, TriangleMesh] = {
        "fused, pair matched anew": reconstruct(session).mesh,
        "fused, chip's depth": reconstruct(session, depth="chip").mesh,
    }
    placed = with_true_poses(readings_of(session), folder)
    surfaces["fused, chip's depth, true poses"] = fuse([prepare(one) for one in placed]).mesh
    for name, peer in open3d_peers().items():
        surfaces[name] = peer(placed)
    return {name: figures(mesh, truth) for name, mesh in surfaces.items()}


def kept_foot(number: int, distance_mm: float) -> Path:
    """Return the folder of a foot's session with its truth; it is simulated once."""
    folder = KEPT / f"foot_{number:02d}_{distance_mm:.0f}"
    if not folder.exists():
        side = list(Side)[number // len(DISTANCES_MM) % 2]
        made = simulate_session(
            SimulationOptions(
                seed=2000 + number,
                side=side,
                distance_mm=distance_mm,
                frames=_FRAMES,
                sensor="d415",
            )
        )
        write_session(made.session, folder, made.truth, made.sensor2reference)
    return folder


def _shown(found: list[dict[str, float]]) -> list[str]:
    return [f"{np.mean([one[key] for one in found]):.3f}" for key in found[0]]
