"""Captures of both feet: is a side ever swapped, and is a foot as accurate as captured alone?

``scenes`` draws feet, distances, angles and four to six sensors, simulates them (ideal sensors, one
frame) and reconstructs both feet. Counted are the feet that are nearer to the true surface of the
other foot than to their own, or look like a foot of the other side, and the scenes refused; a swap
may not occur.

``accuracy`` compares the soles with those of single captures of the same feet (sensors with their
matching window, ten frames): mean distance in height from the truth after the best rigid fit. Alone
a foot is captured by three other sensors; alone in its place, by the same sensors as both, but with
the other place empty: what the other foot does by hiding, and by what it adds to the pictures.

``python -c "import benchmarks.both_feet as b; b.scenes(1000)"`` runs all; ``main()`` a sample.
"""

from __future__ import annotations

import time
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from benchmarks._measure import print_table
from insole_core.compare.comparison import compare_surfaces
from insole_core.errors import InsoleError
from insole_core.foot.side_check import seen_side
from insole_core.geometry.side import BOTH, Side
from insole_core.recording.session import Session
from insole_core.simulate import SimulatedSession, SimulationOptions, simulate_session
from insole_core.simulate.simulation import StandingFoot
from insole_core.workflows.make_feet import ReconstructedFoot, reconstruct_feet
from insole_core.workflows.make_foot import MeasuredSession, reconstruct_session

SAMPLE, ALL = 10, 1000


def main() -> None:
    scenes(SAMPLE)
    accuracy(1)


def scenes(count: int, first: int = 0) -> None:
    counts: Counter[str] = Counter()
    start = time.perf_counter()
    for seed in range(first, first + count):
        simulated = simulate_session(_random_options(seed))
        try:
            feet = reconstruct_feet(_opened(simulated.session), method="thesis")
        except InsoleError as error:
            counts["refused"] += 1
            print(f"seed {seed} refused: {error}", flush=True)
            continue
        swapped = [foot.side for foot in feet if _is_swapped(foot, simulated)]
        counts["swapped"] += bool(swapped)
        counts["right"] += not swapped
        if swapped:
            print(f"seed {seed} swapped: {swapped}", flush=True)
        if (seed + 1 - first) % 50 == 0:
            print(f"{seed + 1 - first} scenes: {dict(counts)}", flush=True)
    seconds = (time.perf_counter() - start) / count
    print_table(
        ["scenes", "right", "swapped", "refused", "s a scene"],
        [[count, counts["right"], counts["swapped"], counts["refused"], f"{seconds:.2f}"]],
    )


def _random_options(seed: int) -> SimulationOptions:
    rng = np.random.default_rng(seed)
    return SimulationOptions(
        seed=seed,
        side=BOTH,
        distance_mm=rng.uniform(700, 900),
        half_angle_deg=rng.uniform(20, 30),
        sensors=int(rng.integers(4, 7)),
        frames=1,
        color_size=(640, 480),
        foot_cell_mm=5.0,
        ideal=True,
    )


def _opened(session: Session) -> MeasuredSession:
    return MeasuredSession(Path("simulated"), session, {}, {})


def _is_swapped(foot: ReconstructedFoot, simulated: SimulatedSession) -> bool:
    points = foot.result.mesh.vertices
    apart = {
        side: float(np.mean(cKDTree(truth.vertices).query(points)[0]))
        for side, truth in simulated.truths.items()
    }
    is_nearer = apart[foot.side] > apart[foot.side.other]
    return is_nearer or seen_side(foot.result.mesh) is foot.side.other


def accuracy(seeds: int, first: int = 1) -> None:
    rows = []
    for seed in range(first, first + seeds):
        options = SimulationOptions(seed=seed)
        alone = {side: simulate_session(replace(options, side=side)) for side in Side}
        feet = {side: StandingFoot(alone[side].foot.shape, side) for side in Side}
        single = {side: _shape_error_mm(one, side) for side, one in alone.items()}
        for sensors in (4, 6):
            rig = replace(options, side=BOTH, sensors=sensors)
            both = simulate_session(replace(rig, standing=tuple(feet.values())))
            for side in Side:
                one = simulate_session(replace(rig, standing=(feet[side],)))
                errors = single[side], _shape_error_mm(one, side), _shape_error_mm(both, side)
                difference = f"{errors[2] - errors[1]:+.3f}"
                rows.append([seed, side, sensors, *(f"{mm:.3f}" for mm in errors), difference])
                print(*rows[-1], flush=True)
    header = ["alone (mm)", "alone in its place", "of both", "by the other foot"]
    print_table(["seed", "foot", "sensors", *header], rows)


def _shape_error_mm(simulated: SimulatedSession, side: Side) -> float:
    """Return the mean distance in height of a sole from the truth after the best fit."""
    foot = _opened(simulated.session).of_foot(side)
    mesh = reconstruct_session(foot).mesh
    return float(np.nanmean(np.abs(compare_surfaces(mesh, simulated.truths[side]).signed_mm)))
