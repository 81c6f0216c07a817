"""Distortion correction: leave-one-out on real walls, and its speed and memory.

    python benchmarks/calibration_distortion.py [folder with walls_1, walls_2, …]

Without a folder only the speed is measured, from files of simulated frames (21 captures of 10 and
of 100 frames): wall time, processor time and memory. Nearly all of it is reading: inflating a noisy
frame of 125 kB takes about 3 ms, undoing its filter 1 ms, detecting motion 0.8 ms, summing 0.6 ms.
Two captures are read at a time, since none of that holds Python's lock.
"""

from __future__ import annotations

import resource
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from insole_core.calibration.walls.captures import read_captures
from insole_core.calibration.walls.distortion import calibrate_distortion
from insole_core.calibration.walls.wall_plane import expected_raw, plane_rows
from insole_core.evaluation.wall import WallError, leave_one_out
from insole_core.recording.images import encode_png
from insole_core.sensing.sensor import BURRUS
from insole_core.sensing.sensor import DEPTH_CAMERA as CAMERA

FRAMES, DIFFERENT = (10, 100), 5
DISTANCES_MM = np.arange(800, 1001, 10)


def print_table(name: str, errors: dict[str, list[WallError]]) -> None:
    print(f"\n{name}: mean absolute error, mm, leave-one-out")
    distances = [error.distance_mm for error in errors["raw"]]
    print(f"{'distance':12}" + "".join(f"{distance:8.0f}" for distance in distances))
    for row, listed in errors.items():
        values = [error.mean_abs_mm for error in listed]
        cells = "".join(f"{value:8.2f}" for value in values)
        print(f"{row:12}{cells}   mean {np.mean(values):.2f}")


def write_frames(folder: Path, frames: int) -> None:
    """Write a few frames of each wall, each under several names."""
    generator = np.random.default_rng(0)
    for distance_mm in DISTANCES_MM:
        wall = folder / f"{distance_mm} mm"
        wall.mkdir()
        clean = expected_raw(np.array([0.01, -0.02, 1.0]) / distance_mm, plane_rows(CAMERA), BURRUS)
        for number in range(DIFFERENT):
            noisy = clean + generator.normal(0, 0.6, clean.shape)
            content = encode_png(np.round(noisy).astype(np.uint16))
            (wall / f"depth_{number:03d}.png").write_bytes(content)
        for number in range(DIFFERENT, frames):
            original = wall / f"depth_{number % DIFFERENT:03d}.png"
            (wall / f"depth_{number:03d}.png").hardlink_to(original)


def measure_speed(frames: int) -> None:
    """Measure from the files to the map, including whatever runs in parallel."""
    with tempfile.TemporaryDirectory() as folder:
        write_frames(Path(folder), frames)
        start, used = time.perf_counter(), time.process_time()
        captures = read_captures(Path(folder))
        read, read_used = time.perf_counter(), time.process_time()
        calibrate_distortion(captures, CAMERA, BURRUS)
        done, done_used = time.perf_counter(), time.process_time()
    peak_mb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(
        f"{len(captures)} captures of {frames:3d} frames: {read - start:.1f} s reading and "
        f"averaging, {done - read:.1f} s map, {done - start:.1f} s in all (limit 10 s with 100 "
        f"frames); of the processors {read_used - used:.1f} + {done_used - read_used:.1f} s; "
        f"peak memory {peak_mb:.0f} MB (limit 500 MB)"
    )


def main() -> None:
    for frames in FRAMES:
        measure_speed(frames)
    if len(sys.argv) > 1:
        for folder in sorted(Path(sys.argv[1]).glob("walls_*")):
            print_table(folder.name, leave_one_out(read_captures(folder), CAMERA, BURRUS))


if __name__ == "__main__":
    main()
