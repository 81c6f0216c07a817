"""Distortion correction: leave-one-out on real walls, and its speed and memory.

    python benchmarks/calibration_distortion.py [folder with walls_1, walls_2, …]

Without a folder only the speed is measured, from files of simulated frames (21 captures of 100
frames): wall time, processor time and memory.
"""

from __future__ import annotations

import resource
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from insole_core.calibration.captures import capture_from_frames, read_captures, read_frames
from insole_core.calibration.distortion import calibrate_distortion
from insole_core.calibration.wall_plane import expected_raw, plane_rows
from insole_core.evaluation.leave_one_out import leave_one_out
from insole_core.evaluation.wall import WallError
from insole_core.recording.images import encode_png
from insole_core.sensing.nominal import BURRUS
from insole_core.sensing.nominal import DEPTH_CAMERA as CAMERA

FRAMES, DIFFERENT = 100, 5
DISTANCES_MM = np.arange(800, 1001, 10)


def print_table(name: str, errors: dict[str, list[WallError]]) -> None:
    print(f"\n{name}: mean absolute error, mm, leave-one-out")
    distances = [error.distance_mm for error in errors["raw"]]
    print(f"{'distance':12}" + "".join(f"{distance:8.0f}" for distance in distances))
    for row, listed in errors.items():
        values = [error.mean_abs_mm for error in listed]
        cells = "".join(f"{value:8.2f}" for value in values)
        print(f"{row:12}{cells}   mean {np.mean(values):.2f}")


def write_frames(folder: Path) -> list[list[Path]]:
    """Write a few frames of each wall; they are read again and again as so many."""
    generator = np.random.default_rng(0)
    walls = []
    for distance_mm in DISTANCES_MM:
        clean = expected_raw(np.array([0.01, -0.02, 1.0]) / distance_mm, plane_rows(CAMERA), BURRUS)
        paths = [folder / f"{distance_mm}_{number}.png" for number in range(DIFFERENT)]
        for path in paths:
            noisy = clean + generator.normal(0, 0.6, clean.shape)
            path.write_bytes(encode_png(np.round(noisy).astype(np.uint16)))
        walls.append(paths * (FRAMES // DIFFERENT))
    return walls


def measure_speed() -> None:
    """From the files to the map, whatever of it runs beside each other."""
    with tempfile.TemporaryDirectory() as folder:
        walls = write_frames(Path(folder))
        start, used = time.perf_counter(), time.process_time()
        captures = [
            capture_from_frames(f"{distance} mm", read_frames(paths))
            for distance, paths in zip(DISTANCES_MM, walls, strict=True)
        ]
        read, read_used = time.perf_counter(), time.process_time()
        calibrate_distortion(captures, CAMERA, BURRUS)
        done, done_used = time.perf_counter(), time.process_time()
    peak_mb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(
        f"\n{len(captures)} captures of {FRAMES} frames: {read - start:.1f} s reading and "
        f"averaging, {done - read:.1f} s map, {done - start:.1f} s in all; of the processors "
        f"{read_used - used:.1f} + {done_used - read_used:.1f} s; peak memory {peak_mb:.0f} MB"
    )


def main() -> None:
    measure_speed()
    if len(sys.argv) > 1:
        for folder in sorted(Path(sys.argv[1]).glob("walls_*")):
            print_table(folder.name, leave_one_out(read_captures(folder), CAMERA, BURRUS))


if __name__ == "__main__":
    main()
