"""Distortion correction: leave-one-out on real walls, and its speed and memory.

    python benchmarks/calibration_distortion.py [folder with walls_1, walls_2, …]

Without a folder only the speed is measured, on simulated frames (21 captures of 100 frames).
"""

from __future__ import annotations

import resource
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from insole_core.calibration.captures import WallCapture, capture_from_frames, read_captures
from insole_core.calibration.distortion import calibrate_distortion
from insole_core.calibration.thesis_maps import cubic_map, mean_map
from insole_core.calibration.wall_plane import expected_raw, fit_wall, plane_rows
from insole_core.evaluation.wall import Correction, NoCorrection, wall_errors
from insole_core.geometry.arrays import RawArray
from insole_core.sensing.camera import Camera
from insole_core.sensing.disparity import LinearInverseDisparity

CAMERA = Camera(640, 480, 585, 585, 319.5, 239.5)
BURRUS = LinearInverseDisparity(3.3309495, -0.0030711016)
FRAMES = 100
DISTANCES_MM = np.arange(800, 1001, 10)


def leave_one_out(captures: list[WallCapture]) -> dict[str, list[float]]:
    """Mean absolute error in mm of every capture, corrected from the others."""
    rows = plane_rows(CAMERA)
    walls = [fit_wall(capture, rows, BURRUS) for capture in captures]
    table: dict[str, list[float]] = {}
    for i, capture in enumerate(captures):
        others = [j for j in range(len(captures)) if j != i]
        corrections: dict[str, Correction] = {
            "raw": NoCorrection(),
            "algorithm 1": mean_map([walls[j] for j in others]),
            "algorithm 2": cubic_map([walls[j] for j in others], BURRUS),
            "default": calibrate_distortion(
                [captures[j] for j in others], CAMERA, BURRUS
            ).correction,
        }
        for name, (error,) in wall_errors([capture], corrections, CAMERA, BURRUS).items():
            table.setdefault("distance", [])
            table.setdefault(name, []).append(error.mean_abs_mm)
        table["distance"].append(error.distance_mm)
    return table


def print_table(name: str, table: dict[str, list[float]]) -> None:
    print(f"\n{name}: mean absolute error, mm, leave-one-out")
    for row, values in table.items():
        form = "8.0f" if row == "distance" else "8.2f"
        print(f"{row:12}" + "".join(f"{value:{form}}" for value in values)
              + ("" if row == "distance" else f"   mean {np.mean(values):.2f}"))  # fmt: skip


def simulated_frames(distance_mm: float, patterns: list[np.ndarray]) -> Iterator[RawArray]:
    """Cheap frames: the same few noise patterns again and again, so that only our time counts."""
    plane = np.array([0.01, -0.02, 1.0]) / distance_mm
    clean = expected_raw(plane, plane_rows(CAMERA), BURRUS)
    frames = [np.round(clean + pattern).astype(np.uint16) for pattern in patterns]
    for i in range(FRAMES):
        yield frames[i % len(frames)]


def measure_speed() -> None:
    generator = np.random.default_rng(0)
    patterns = [generator.normal(0, 0.6, (480, 640)) for _ in range(5)]
    start = time.perf_counter()
    captures = [
        capture_from_frames(f"{distance} mm", simulated_frames(distance, patterns))
        for distance in DISTANCES_MM
    ]
    averaged = time.perf_counter()
    calibrate_distortion(captures, CAMERA, BURRUS)
    done = time.perf_counter()
    peak_mb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(
        f"\n{len(captures)} captures of {FRAMES} frames: {averaged - start:.1f} s averaging, "
        f"{done - averaged:.1f} s map, {done - start:.1f} s in all; peak memory {peak_mb:.0f} MB"
    )


def main() -> None:
    measure_speed()
    if len(sys.argv) > 1:
        for folder in sorted(Path(sys.argv[1]).glob("walls_*")):
            print_table(folder.name, leave_one_out(read_captures(folder)))


if __name__ == "__main__":
    main()
