"""``insole-studio simulate``: simulate a recorded session."""

from __future__ import annotations

import argparse

from insole_core.geometry.side import Side
from insole_core.progress import Progress
from insole_studio.cli.path_arguments import OutputPath

NAME = "simulate"
HELP = "write a simulated session with its true surface and poses"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("out", action=OutputPath, metavar="OUT", help="folder or .zip to write")
    parser.add_argument("--seed", type=int, default=0, help="same seed, same session (default 0)")
    parser.add_argument("--side", choices=[side.value for side in Side], default="left")
    parser.add_argument(
        "--distance", type=float, default=800.0, metavar="MM", help="sensors to foot (default 800)"
    )
    parser.add_argument(
        "--bursts",
        type=int,
        default=1,
        metavar="N",
        help="places each sensor stands in (default 1)",
    )
    parser.add_argument(
        "--ideal",
        action="store_true",
        help="sensors without a matching window, which see finer than real ones (quicker)",
    )


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Simulate a session and write it."""
    from insole_core.recording.session_layout import check_session_target
    from insole_core.recording.writer import write_session
    from insole_core.simulate import SimulationOptions, simulate_session

    check_session_target(arguments.out)
    options = SimulationOptions(
        seed=arguments.seed,
        side=Side(arguments.side),
        distance_mm=arguments.distance,
        bursts=arguments.bursts,
        ideal=arguments.ideal,
    )
    simulated = simulate_session(options, progress.part(0.0, 0.8))
    write_session(
        simulated.session,
        arguments.out,
        simulated.truth,
        simulated.sensor2reference,
        progress.part(0.8, 1.0),
    )
    progress.step(1.0, f"Done: {arguments.out}")
