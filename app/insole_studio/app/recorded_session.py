"""A session to try the program on where no sensor is."""

from __future__ import annotations

from pathlib import Path

from insole_core.progress import SILENT, Progress

SEED = 12


def record_simulated(path: Path, progress: Progress = SILENT) -> None:
    """Simulate three views of a foot and write them as a recorded session.

    Parameters
    ----------
    path
        A folder, or a zip archive by its suffix.

    Raises
    ------
    OutputError
        When the place cannot be written.
    """
    from insole_core.recording.writer import write_session
    from insole_core.simulate import SimulationOptions, simulate_session

    simulated = simulate_session(SimulationOptions(seed=SEED), progress)
    write_session(simulated.session, path, simulated.truth, simulated.sensor2reference)
