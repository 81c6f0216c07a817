"""Measures of feet by chip and by infrared pictures, beside those of their true surfaces.

``python -m benchmarks infrared_measures`` simulates feet before the four sets of sensors of the
benchmark ``infrared``, 705 to 790 mm away, whose dots are learnt from 12 walls: one half feet of
chance, the other real feet and a template in other sizes. For each measure and either depth: bias
and root mean square of the error, the ± that the product states, and the share of the feet in
which the truth lies within it. Sessions are kept in ``benchmarks/results`` and are not made twice.

``MEASURED`` is the number of feet (60), ``SEED`` chooses them.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from benchmarks.infrared import Captured, with_patterns
from benchmarks.measures import Compared, judged, print_errors, scaled_body, varied
from insole_core.geometry.side import Side
from insole_core.recording.session import Session
from insole_core.recording.writer import write_session
from insole_core.scans.mesh_file import read_mesh
from insole_core.simulate import SimulationOptions, simulate_session
from insole_core.workflows.make_foot import make_foot, open_session

KEPT = Path(__file__).parent / "results" / "infrared_measures"
MEASURED, SEED = int(os.environ.get("MEASURED", "60")), int(os.environ.get("SEED", "2000"))
_PATTERN = "12 walls"
_FRAMES = 6


def main() -> None:
    found: dict[str, list[Compared]] = {"chip": [], "infrared": []}
    for captured, folder in _kept_sessions():
        opened = open_session(folder)
        sessions = {
            "chip": _without_pictures(opened.session),
            "infrared": with_patterns(opened.session, captured),
        }
        truth = read_mesh(folder / "truth.ply").mesh
        for depth, session in sessions.items():
            foot = make_foot(replace(opened, session=session)).scan.foot
            found[depth].append(judged(folder.name, foot, truth))
        print(".", end="", flush=True)
    for depth, compared in found.items():
        print(f"\nby {depth}:")
        print_errors(compared)


def _without_pictures(session: Session) -> Session:
    return replace(session, views=tuple(replace(view, dots=None) for view in session.views))


def _kept_sessions() -> Iterator[tuple[Captured, Path]]:
    for number, options in enumerate(_options()):
        folder = KEPT / f"{SEED}_{number:02d}"
        if not folder.exists():
            made = simulate_session(options)
            write_session(made.session, folder, made.truth, made.sensor2reference)
        yield Captured(number, _PATTERN), folder


def _options() -> Iterator[SimulationOptions]:
    """Yield feet of chance and others in turn, so that every set of sensors sees all origins."""
    others = list(varied(MEASURED // 2, SEED))
    for number in range(MEASURED):
        sensor_seed, distance_mm = Captured(number, _PATTERN).sensors
        before_sensors = SimulationOptions(
            seed=SEED + number,
            sensor_seed=sensor_seed,
            distance_mm=distance_mm,
            side=list(Side)[number // 4 % 2],
            infrared_frames=_FRAMES,
        )
        is_of_chance = number // 4 % 2 == 0
        if not is_of_chance:
            file, side, scale, _, mirrored = others[number // 8 * 4 + (number + number // 8) % 4]
            shown, body = scaled_body(file, side, scale, mirrored)
            before_sensors = replace(before_sensors, side=shown, body=body)
        yield before_sensors
