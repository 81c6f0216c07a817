"""``insole-studio simulate``: simulate a recorded session."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, TypeVar

from insole_core.errors import UsageError
from insole_core.geometry.side import BOTH, Side, sides_from
from insole_core.progress import Progress
from insole_studio.cli.argument_parser import number, whole
from insole_studio.cli.path_arguments import OutputPath

if TYPE_CHECKING:
    from insole_core.simulate.known_bodies import KnownBody

_Number = TypeVar("_Number", int, float)
NAME = "simulate"
HELP = "write a simulated session with its true surface and poses"

_DISTANCES_MM = {"kinect": 800.0, "d415": 520.0, "mixed": 520.0}
"""Kind of sensor, and how far it stands from the foot where nobody says."""
_INFRARED_FRAMES, _WALLS = 6, 12
_COLOR_SIZES = {"1280x1024": (1280, 1024), "1280x960": (1280, 960), "640x480": (640, 480)}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("out", action=OutputPath, metavar="OUT", help="folder or .zip to write")
    parser.add_argument("--seed", type=whole, default=0, help="same seed, same session (default 0)")
    parser.add_argument(
        "--sensor-seed",
        type=whole,
        metavar="SEED",
        help="capture with the sensors of the session with that seed (default: that of --seed)",
    )
    parser.add_argument(
        "--foot-seed",
        type=whole,
        metavar="SEED",
        help="the foot of the session with that seed, taken off and put back, to rehearse evaluate "
        "repeat (default: that of --seed, in its place)",
    )
    parser.add_argument("--side", choices=[*map(str, Side), BOTH], default="left")
    parser.add_argument(
        "--sensors",
        type=whole,
        metavar="N",
        help="sensors around both feet, 4 to 6 (default 4); one foot has three",
    )
    parser.add_argument(
        "--sensor",
        choices=list(_DISTANCES_MM),
        default="kinect",
        help="Kinects (default), stereo cameras as a RealSense D415, or those below and a Kinect "
        "behind",
    )
    parser.add_argument(
        "--distance",
        type=number,
        metavar="MM",
        help="sensors to foot (default 800, with stereo cameras 520)",
    )
    parser.add_argument(
        "--bursts",
        type=whole,
        default=1,
        metavar="N",
        help="places each sensor stands in (default 1)",
    )
    body = parser.add_mutually_exclusive_group()
    for name in ("ball", "cylinder"):
        body.add_argument(
            f"--{name}", type=number, metavar="MM",
            help=f"a {name} of this diameter instead of a foot, to rehearse evaluate chain",
        )  # fmt: skip
    body.add_argument(
        "--reference-foot", action="store_true",
        help="the printed reference foot on its stand, to rehearse evaluate chain",
    )  # fmt: skip
    parser.add_argument(
        "--color-frames",
        type=whole,
        default=1,
        metavar="N",
        help="colour pictures a view, each with its own noise (default 1)",
    )
    parser.add_argument(
        "--color-size",
        choices=list(_COLOR_SIZES),
        default="1280x1024",
        help="size of the colour pictures (default 1280x1024)",
    )
    parser.add_argument(
        "--ideal",
        action="store_true",
        help="sensors without a matching window, which see finer than real ones (quicker)",
    )
    _add_infrared_arguments(parser)


def _add_infrared_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--infrared", action="store_true",
        help="with the infrared pictures of the Kinects' dots",
    )  # fmt: skip
    parser.add_argument(
        "--infrared-frames", type=whole, metavar="N",
        help=f"infrared pictures a view (default {_INFRARED_FRAMES})",
    )  # fmt: skip
    parser.add_argument(
        "--learnt-from", type=whole, metavar="N",
        help="learn the dots of every sensor from so many simulated walls (4 to 30), and put them "
        "into the session",
    )  # fmt: skip
    parser.add_argument(
        "--walls", action=OutputPath, metavar="FOLDER",
        help="write infrared pictures and depth of walls before every sensor, for calibrate "
        "infrared: a folder for each, named by its serial number",
    )  # fmt: skip
    parser.add_argument(
        "--wall-count", type=whole, metavar="N",
        help=f"walls before a sensor (default {_WALLS})",
    )  # fmt: skip
    parser.add_argument(
        "--disturbed", action="append", choices=["speckle", "noise", "sunlight", "drift", "skin"],
        default=[],
        help="what spoils depth and infrared picture: speckle of 50 %%, twice the noise, sunlight "
        "on half of the foot, dots that have moved by 0.1 px, or hair and a glossy nail; may be "
        "repeated",
    )  # fmt: skip


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Simulate a session and write it."""
    from insole_core.recording.writer import check_session_target, write_session
    from insole_core.simulate import SimulationOptions, simulate_session
    from insole_core.simulate.infrared_walls import with_patterns, write_walls

    check_session_target(arguments.out)
    if not arguments.infrared and (arguments.walls or arguments.learnt_from is not None):
        raise UsageError("--walls and --learnt-from are for infrared pictures; add --infrared.")
    if arguments.wall_count is not None and not arguments.walls:
        raise UsageError("--wall-count is for the walls of --walls; name their folder, too.")
    if arguments.infrared_frames is not None and not arguments.infrared:
        raise UsageError("--infrared-frames is for infrared pictures; add --infrared.")
    both = arguments.side == BOTH
    if arguments.sensors is not None and not both:
        raise UsageError("--sensors is for both feet; add --side both, or leave it out.")
    options = SimulationOptions(
        seed=arguments.seed,
        sensor_seed=arguments.sensor_seed,
        foot_seed=arguments.foot_seed,
        side=sides_from(arguments.side),
        sensor=arguments.sensor,
        distance_mm=_given_or(arguments.distance, _DISTANCES_MM[arguments.sensor]),
        bursts=arguments.bursts,
        color_frames=arguments.color_frames,
        color_size=_COLOR_SIZES[arguments.color_size],
        ideal=arguments.ideal,
        sensors=_given_or(arguments.sensors, 4),
        body=_body(arguments),
        infrared_frames=_given_or(
            arguments.infrared_frames, _INFRARED_FRAMES if arguments.infrared else 0
        ),
        disturbances=tuple(arguments.disturbed),
    )
    if arguments.walls:
        write_walls(
            options,
            _given_or(arguments.wall_count, _WALLS),
            arguments.walls,
            progress.part(0.0, 0.4),
        )
    simulated = simulate_session(options, progress.part(0.4, 0.6))
    session = simulated.session
    if arguments.learnt_from is not None:
        session = with_patterns(session, options, arguments.learnt_from, progress.part(0.6, 0.8))
    write_session(
        session,
        arguments.out,
        simulated.truths if both else simulated.truth,
        simulated.sensor2reference,
        progress.part(0.8, 1.0),
    )
    progress.step(1.0, f"Done: {arguments.out}")


def _given_or(given: _Number | None, default: _Number) -> _Number:
    return default if given is None else given


def _body(arguments: argparse.Namespace) -> KnownBody | None:
    """Return what is in the place of the foot, if it is no foot."""
    from insole_core.simulate.known_bodies import ball, printed_foot, upright_cylinder

    if arguments.reference_foot:
        return printed_foot()
    if arguments.ball is not None:
        return ball(arguments.ball)
    if arguments.cylinder is not None:
        return upright_cylinder(arguments.cylinder)
    return None
