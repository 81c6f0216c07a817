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

from insole_core.calibration.captures import capture_from_frames, read_captures
from insole_core.calibration.distortion import calibrate_distortion
from insole_core.calibration.wall_plane import expected_raw, plane_rows
from insole_core.evaluation.leave_one_out import leave_one_out
from insole_core.evaluation.wall import WallError
from insole_core.geometry.arrays import RawArray
from insole_core.sensing.nominal import BURRUS
from insole_core.sensing.nominal import DEPTH_CAMERA as CAMERA

FRAMES = 100
DISTANCES_MM = np.arange(800, 1001, 10)


def print_table(name: str, errors: dict[str, list[WallError]]) -> None:
    print(f"\n{name}: mean absolute error, mm, leave-one-out")
    distances = [error.distance_mm for error in errors["raw"]]
    print(f"{'distance':12}" + "".join(f"{distance:8.0f}" for distance in distances))
    for row, listed in errors.items():
        values = [error.mean_abs_mm for error in listed]
        cells = "".join(f"{value:8.2f}" for value in values)
        print(f"{row:12}{cells}   mean {np.mean(values):.2f}")


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
            print_table(folder.name, leave_one_out(read_captures(folder), CAMERA, BURRUS))


if __name__ == "__main__":
    main()
