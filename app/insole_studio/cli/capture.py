"""``insole-studio capture``: record a session with the sensors."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable, Sequence
from contextlib import ExitStack, closing
from dataclasses import replace
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import InsoleError, UsageError
from insole_core.geometry.side import sides_from
from insole_core.progress import Progress
from insole_studio.cli.argument_parser import whole
from insole_studio.cli.path_arguments import OutputPath
from insole_studio.cli.sensor_arguments import (
    add_camera_arguments,
    add_rig_arguments,
    sensor_source_of,
    with_camera_arguments,
)
from insole_studio.cli.stopping import Stopped

if TYPE_CHECKING:
    from insole_core.recording.session import Manifest
    from insole_studio.acquisition.capture_plan import CapturePlan, CaptureStep, PlanRequest
    from insole_studio.acquisition.capture_setup import CaptureSetup
    from insole_studio.acquisition.draft import Draft
    from insole_studio.acquisition.messages import CaptureStatus
    from insole_studio.acquisition.rig import Rig
    from insole_studio.acquisition.sensor_port import OpenSensor
    from insole_studio.acquisition.sensor_source import SensorSource

NAME = "capture"
HELP = "capture a foot with the sensors, one after the other or all at once, as a session"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "--out", action=OutputPath, required=True, metavar="SESSION", help="folder or .zip"
    )
    parser.add_argument(
        "--views", nargs="+", metavar="VIEW=SERIAL",
        help="which sensor gives which view, in the order of the capture; a sensor that is named "
        "twice is moved by hand in between",
    )  # fmt: skip
    parser.add_argument(
        "--side", choices=["left", "right", "both"],
        help="of the foot, or both feet in the reference system for two",
    )  # fmt: skip
    parser.add_argument("--frames", type=whole, default=10, help="depth frames a view (10)")
    parser.add_argument("--color-frames", type=whole, default=1, help="colour pictures a view (1)")
    parser.add_argument(
        "--simultaneous", action="store_true",
        help="all sensors at once; for sensors that do not see the same surface",
    )  # fmt: skip
    parser.add_argument("--bursts", type=whole, help="series a view, a degree of tilt apart (1)")
    parser.add_argument("--weight-bearing", choices=["none", "semi", "full"], default="none")
    parser.add_argument("--held", action="store_true", help="somebody held the foot")
    parser.add_argument("--notes", default="", help="about the capture")
    parser.add_argument(
        "--reference", type=Path, metavar="system.json", help="another reference system"
    )
    parser.add_argument(
        "--resume", type=Path, metavar="FOLDER",
        help="go on with what a capture that failed has kept; its views are not taken again",
    )  # fmt: skip
    add_camera_arguments(parser)
    add_rig_arguments(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Capture every view, then move the session to its destination."""
    from insole_core.recording.writer import check_session_target

    check_session_target(arguments.out)
    from insole_studio.acquisition.unfinished_captures import hold_draft, holding_target

    with ExitStack() as held:
        held.enter_context(holding_target(arguments.out))
        if arguments.resume:
            held.callback(hold_draft(arguments.resume).release)
        _capture(arguments, progress, held)


def _capture(arguments: argparse.Namespace, progress: Progress, held: ExitStack) -> None:
    """Capture while the destination, and a draft that is resumed, are ours alone."""
    from insole_studio.acquisition.capture_runner import (
        CaptureCallbacks,
        CaptureRunner,
        close_sensors,
    )
    from insole_studio.acquisition.messages import Capability
    from insole_studio.acquisition.sensor_port import lacking

    source = with_camera_arguments(sensor_source_of(arguments, arguments.reference), arguments)
    rig, setup = source.rig(), source.setup()
    looked = rig.require()
    for problem in looked.problems:
        print(f"Warning: {problem}", file=sys.stderr)
    found = len(looked.sensors)
    left = _left_draft(arguments.resume, held) if arguments.resume else None
    request = _request(arguments, source, found, left)
    sensors = _open_sensors(rig, request, left)
    with ExitStack() as opened:
        opened.callback(close_sensors, sensors.values())
        _check_camera_options(arguments, sensors.values())
        if request.bursts > 1:
            without_motor = lacking(sensors.values(), Capability.TILT)
            request = replace(request, without_motor=without_motor)
        plan = request.plan()
        draft = left or _new_draft(arguments, request, source, setup, held)
        draft.expect(plan.views)

        def report(status: CaptureStatus) -> None:
            progress.step(0.95 * status.fraction, status.sentence)

        try:
            callbacks = CaptureCallbacks(report, wait_for_hand=partial(_wait_for_hand, source))
            todo = _missing(plan, draft.views)
            warnings = CaptureRunner(sensors, todo, setup, draft, callbacks).run()
            opened.close()
            progress.step(0.95, "Checking the session")
            draft.publish(arguments.out)
        except InsoleError as error:
            raise _with_draft(error, draft) from error
        except Stopped as stopped:
            if draft.views:
                stopped.outcome = _kept(draft)
            raise
    for warning in warnings:
        print(f"Warning: {warning}", file=sys.stderr)
    progress.step(1.0, f"Done: {arguments.out}")


def _left_draft(folder: Path, held: ExitStack) -> Draft:
    from insole_studio.acquisition.draft import Draft

    return held.enter_context(closing(Draft.reopen(folder)))


def _open_sensors(rig: Rig, request: PlanRequest, left: Draft | None) -> dict[str, OpenSensor]:
    from insole_studio.acquisition.capture_runner import open_sensors

    try:
        return open_sensors(rig, request.plan().serials)
    except InsoleError as error:
        if left is None:
            raise
        raise _with_draft(error, left) from error


def _check_camera_options(arguments: argparse.Namespace, sensors: Iterable[OpenSensor]) -> None:
    """Refuse what can be set of RealSense cameras where none of the sensors has it."""
    from insole_studio.acquisition.messages import Capability

    able = {capability for sensor in sensors for capability in sensor.capabilities}
    given = {
        "--preset": (arguments.preset, Capability.PRESET),
        "--laser-power": (arguments.laser_power, Capability.LASER),
        "--infrared-pair": (arguments.infrared_pair, Capability.HAS_PAIR),
    }
    for option, (value, needed) in given.items():
        if value is not None and needed not in able:
            raise UsageError(
                f"{option} is for RealSense cameras that can be set so, and none of the sensors "
                "is one; leave it out."
            )


def _request(
    arguments: argparse.Namespace, source: SensorSource, found: int, left: Draft | None
) -> PlanRequest:
    """Return what to capture: by the arguments, else as begun, else as in the emulated session."""
    from insole_studio.acquisition.capture_plan import PlanRequest, kept_request, parse_assignment

    kept = kept_request(left.manifest.extra) if left else None
    if kept and arguments.views is None:
        return kept
    assignment = parse_assignment(arguments.views) if arguments.views else source.usual_views()
    if not assignment:
        raise UsageError(
            f"Say which of the {found} sensors gives which view, for example --views left=SERIAL "
            "right=SERIAL top=SERIAL; insole-studio sensors lists the serial numbers."
        )
    usual_bursts = 1 if arguments.views else source.usual_bursts()
    return PlanRequest(
        tuple(assignment),
        arguments.frames,
        arguments.color_frames,
        arguments.simultaneous,
        usual_bursts if arguments.bursts is None else arguments.bursts,
    )


def _missing(plan: CapturePlan, finished: Sequence[str]) -> CapturePlan:
    return plan.only([view for view in plan.views if view not in finished]) if finished else plan


def _new_draft(
    arguments: argparse.Namespace,
    request: PlanRequest,
    source: SensorSource,
    setup: CaptureSetup,
    held: ExitStack,
) -> Draft:
    from insole_studio.acquisition.draft import Draft, drafts_folder_of_user
    from insole_studio.acquisition.unfinished_captures import Drafts

    views = request.plan().views
    manifest = replace(_manifest(arguments, source, setup), extra=request.as_extra())
    name = f"{manifest.recorded_at.replace(':', '')}-{manifest.side}"
    drafts = Drafts(drafts_folder_of_user())
    drafts.sweep()
    begun = drafts.begin(name)
    held.callback(begun.release)
    return held.enter_context(closing(Draft(begun.folder, manifest, views)))


def _manifest(arguments: argparse.Namespace, source: SensorSource, setup: CaptureSetup) -> Manifest:
    from insole_core.recording.session import CaptureCondition, Manifest

    recorded = source.session.manifest.side if source.session else None
    side = sides_from(arguments.side) if arguments.side else recorded
    if side is None:
        raise UsageError("Say which foot is captured: --side left, right or both.")
    setup = setup.of_side(side)
    return Manifest(
        recorded_at=datetime.now(UTC).isoformat(timespec="milliseconds"),
        side=side,
        reference_system=setup.system,
        views=(),
        volume_of_interest=setup.volume_of_interest,
        capture_condition=CaptureCondition(
            arguments.weight_bearing, arguments.held, arguments.notes
        ),
    )


def _wait_for_hand(source: SensorSource, step: CaptureStep) -> None:
    """Ask the user to move a sensor; emulated sensors need nobody."""
    from insole_studio.acquisition.capture_runner import hand_sentence

    if source.emulated_rig is not None:
        source.put(step)
        return
    print(f"{hand_sentence(step)}, then press Enter.", file=sys.stderr, flush=True)
    if not sys.stdin.readline():
        raise UsageError(
            "A sensor has to be moved by hand, but nobody can press Enter here; run this in a "
            "terminal, or name every sensor once."
        )


def _kept(draft: Draft) -> str:
    return f"the finished views are kept. Go on with --resume {draft.folder}"


def _with_draft(error: InsoleError, draft: Draft) -> InsoleError:
    """Add to the error where the finished views are, if there are any."""
    if not draft.views:
        return error
    return type(error)(f"{error} Go on with --resume {draft.folder}")
