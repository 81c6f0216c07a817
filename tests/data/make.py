"""Make the small recorded session that the tests of window and command line open.

    python tests/data/make.py

It stays under 3 MB: three depth frames, colour at 640 x 480, a coarser true surface.
"""

from __future__ import annotations

from pathlib import Path

from insole_core.recording.writer import write_session
from insole_core.simulate import SimulationOptions, simulate_session

SMALL = SimulationOptions(seed=2, frames=3, color_size=(640, 480), foot_cell_mm=3.5)


def main() -> None:
    simulated = simulate_session(SMALL)
    path = Path(__file__).parent / "sessions" / "left_small.zip"
    write_session(simulated.session, path, simulated.truth, simulated.sensor2reference)


if __name__ == "__main__":
    main()
