"""Make the small recorded sessions that the tests of window and command line open.

    python tests/data/make.py

Each stays under 3 MB: few depth frames, colour at 640 x 480, a coarser true surface or none.
"""

from __future__ import annotations

from pathlib import Path

from insole_core.geometry.side import BOTH
from insole_core.recording.writer import write_session
from insole_core.simulate import SimulationOptions, simulate_session

SMALL = SimulationOptions(seed=2, frames=3, color_size=(640, 480), foot_cell_mm=3.5)


BOTH_SMALL = SimulationOptions(seed=5, side=BOTH, frames=2, color_size=(640, 480), foot_cell_mm=3.5)
SESSIONS = Path(__file__).parent / "sessions"


def main() -> None:
    simulated = simulate_session(SMALL)
    path = SESSIONS / "left_small.zip"
    write_session(simulated.session, path, simulated.truth, simulated.sensor2reference)
    write_session(simulate_session(BOTH_SMALL).session, SESSIONS / "both_small.zip")


if __name__ == "__main__":
    main()
