"""Rehearsal of the proof of the whole chain: bodies, distances, and corrections right and wrong.

`python -c "import benchmarks.chain_proof as b; b.main()"` simulates each capture anew and proves
the chain with it: with the correction of the product, and with one that moves readings the wrong
way. Errors (mean and 95 %, mm) without and with it, sizes and verdicts are printed; a verdict other
than the one expected ends with an error.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks._measure import print_table
from insole_core.evaluation.known_form import Scan
from insole_core.evaluation.known_object import KnownObject, KnownRound, KnownScan
from insole_core.geometry.transforms import rigid, rotation_about
from insole_core.reconstruct.fusion import matching_error
from insole_core.reconstruct.fusion.matching_error import MatchingModel, Network
from insole_core.recording.writer import write_session
from insole_core.simulate import SimulationOptions, simulate_session
from insole_core.simulate.known_bodies import KnownBody, ball, upright_cylinder
from insole_core.workflows.calibration.chain_proof import prove_chain

BODIES: tuple[tuple[str, Callable[[], KnownBody | None], KnownObject | None], ...] = (
    ("ball 100 mm", lambda: ball(100), KnownRound("ball", 100, 100)),
    ("ball 130 mm", lambda: ball(130), KnownRound("ball", 130, 130)),
    ("size 6 basketball", lambda: ball(232.6), KnownRound("ball", 232.6, 232.6)),
    ("cylinder 110 mm", lambda: upright_cylinder(110), KnownRound("cylinder", 110, 110)),
    ("cast of a foot", lambda: None, None),
)
DISTANCES_MM = (700, 800)
_ELSEWHERE = rigid(rotation_about(np.array([1.0, 2.0, 0.5]), 70), np.array([200.0, -80.0, 33.0]))


def main(bodies: int = len(BODIES)) -> None:
    rows, wrong = [], []
    for seed, (name, body, known) in enumerate(BODIES[:bodies], start=1):
        for distance_mm in DISTANCES_MM:
            options = SimulationOptions(seed=seed, distance_mm=distance_mm, body=body())
            simulated = simulate_session(options)
            scan = known or KnownScan(Scan(simulated.truth.transformed(_ELSEWHERE)), "cast")
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "session"
                write_session(simulated.session, path)
                for kind, expected in (("right", "learnt"), ("inverted", "none")):
                    with _correction(kind):
                        proof = prove_chain([path], scan)
                    without, learnt = proof.evaluation.results.values()
                    errors = [one.surface.all for one in (without, learnt)]
                    rows.append(
                        [
                            f"{name}, {distance_mm} mm, {kind}",
                            *(f"{one.mean_abs_mm:.2f} / {one.p95_mm:.2f}" for one in errors),
                            *(f"{one.size_error_mm:+.2f}" for one in (without, learnt)),
                            f"{learnt.missing_share:.3f}",
                            proof.verdict.use,
                        ]
                    )
                    if proof.verdict.use != expected:
                        wrong.append(rows[-1][0])
            print(".", end="", flush=True)
    print()
    headings = ("body", "without", "learnt", "size without", "size learnt", "missing", "verdict")
    print_table(headings, rows)
    if wrong:
        raise SystemExit(f"other verdicts than expected: {'; '.join(wrong)}")


@contextmanager
def _correction(kind: str) -> Iterator[None]:
    """Replace the learnt correction by a wrong one for a while."""
    learnt, load = MatchingModel.load(), matching_error._model
    if kind == "inverted":
        matching_error._model = lambda: replace(learnt, network=_inverted(learnt.network))  # type: ignore[assignment]
    try:
        yield
    finally:
        matching_error._model = load


def _inverted(network: Network) -> Network:
    *layers, last = network.weights
    return replace(network, weights=(*layers, -last))
