"""``insole-studio pressure``: lay a map of plantar pressure under a foot, without a window."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from insole_core.errors import UsageError
from insole_core.geometry.side import Side
from insole_core.progress import Progress
from insole_studio.cli.argument_parser import number, whole
from insole_studio.cli.path_arguments import OutputPath

if TYPE_CHECKING:
    from insole_core.cases.case_record import CaseRecord, FootRecord
    from insole_core.pressure.laid_map import PressureMap
    from insole_core.pressure.recording import Answers, PressureRecording
    from insole_core.workflows.lay_plantar import LaidPressure, Shown

NAME = "pressure"
HELP = "lay a map of plantar pressure under a foot of a case, and print its peaks"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "map", type=Path, metavar="MAP",
        help="an export of emed, F-Scan, pedar, XSENSOR or footscan, or a table (.csv .txt)",
    )  # fmt: skip
    parser.add_argument("--case", type=Path, required=True, metavar="CASE.insole")
    parser.add_argument(
        "--out", action=OutputPath, metavar="NEW.insole", help="the case with the map in it"
    )
    parser.add_argument("--report", action=OutputPath, metavar="pressure.json")
    parser.add_argument(
        "--side", choices=[side.value for side in Side],
        help="which foot it is; needed where the file does not say",
    )  # fmt: skip
    parser.add_argument(
        "--insole", type=whole, metavar="N", help="which of several insoles in the file, from 1"
    )
    parser.add_argument(
        "--pitch", type=_pitch, metavar="MM",
        help="distance of the sensors: 5, or 5x7 (across x along)",
    )  # fmt: skip
    parser.add_argument(
        "--length", type=number, metavar="MM", help="of an insole whose file does not state it"
    )
    parser.add_argument("--unit", choices=["kPa", "N/cm2", "mmHg", "psi", "g/cm2", "kg/cm2", "N"])
    parser.add_argument("--seen-from", choices=["above", "below"])
    parser.add_argument("--step", type=whole, metavar="N", help="one contact only, from 1")
    parser.add_argument(
        "--frames", default="peak", metavar="peak|mean|N",
        help="the greatest of all frames (default), their mean, or one frame from 1",
    )  # fmt: skip
    parser.add_argument(
        "--threshold", type=number, default=200.0, metavar="KPA",
        help="from which on a relief is proposed under a metatarsal head (default: 200)",
    )  # fmt: skip


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read case and map, align the map, and print its peaks."""
    from insole_core.cases.case_file import read_case, write_case
    from insole_core.files.atomic import write_text
    from insole_core.files.transaction import Transaction
    from insole_core.pressure.read_pressure import read_pressure
    from insole_core.pressure.regions import overloaded_heads, region_peaks
    from insole_core.workflows.foot_landmarks import landmarks_of
    from insole_core.workflows.lay_plantar import lay_pressure
    from insole_core.workflows.plantar_pressure import with_pressure

    with Transaction() as outputs:
        out = arguments.out and outputs.file(arguments.out)
        report = arguments.report and outputs.file(arguments.report)
        progress.step(0.0, "Reading the case")
        record = read_case(arguments.case)
        progress.step(0.3, "Reading the map")
        recording = _chosen(read_pressure(arguments.map), arguments.insole)
        foot = _foot(record, _side(arguments) or recording.side)
        progress.step(0.5, "Aligning the map")
        laid = lay_pressure(
            foot.foot, recording, _answers(arguments), _shown(arguments), arguments.map.name
        )
        for doubt in laid.doubts:
            print(f"Warning: {doubt}", file=sys.stderr)
        after = record.with_foot(with_pressure(foot, laid.pressure))
        peaks = region_peaks(laid.pressure, landmarks_of(after))
        heads = overloaded_heads(peaks, arguments.threshold)
        for name, peak in peaks.items():
            print(f"{name:<12} {'-' if peak is None else f'{peak:.0f} kPa'}")
        for head in heads:
            print(f"Proposed: relief under metatarsal head {head}")
        if report:
            content = _content(laid, peaks, heads, arguments.threshold)
            write_text(json.dumps(content, indent=1, ensure_ascii=False) + "\n", report)
        if out:
            write_case(after.at(record.at_hand or foot.side), out)
    progress.step(1.0, "Done")


def _content(
    laid: LaidPressure, peaks: dict[str, float | None], heads: tuple[int, ...], threshold: float
) -> dict[str, Any]:
    pressure: PressureMap = laid.pressure
    return {
        "unit": "kPa",
        "device": pressure.device,
        "shown": pressure.shown,
        "placement": vars(pressure.placement),
        "peaks": peaks,
        "threshold": threshold,
        "relief_proposed_under_heads": list(heads),
        "warnings": [str(doubt) for doubt in laid.doubts],
    }


def _foot(record: CaseRecord, side: Side | None) -> FootRecord:
    """Return the foot of a side; of a case with one foot that foot, if the side is not known."""
    if side is None and len(record.feet) == 1:
        side = record.feet[0].side
    foot = None if side is None else record.of_side(side)
    if foot is None:
        raise UsageError(
            "The case has no foot, or two and the map does not say which one; name it with --side."
            if side is None
            else f"The case has no {side} foot; name the other one with --side, or another case."
        )
    return foot


def _chosen(recordings: tuple[PressureRecording, ...], number: int | None) -> PressureRecording:
    if len(recordings) == 1 and number in (None, 1):
        return recordings[0]
    if number is None or not 1 <= number <= len(recordings):
        names = ", ".join(f"{n} = {one.name}" for n, one in enumerate(recordings, 1))
        raise UsageError(f"The file holds {len(recordings)} maps ({names}); choose with --insole.")
    return recordings[number - 1]


def _side(arguments: argparse.Namespace) -> Side | None:
    return None if arguments.side is None else Side(arguments.side)


def _answers(arguments: argparse.Namespace) -> Answers:
    from insole_core.pressure.recording import Answers, PressureUnit, SeenFrom

    unit = None if arguments.unit is None else PressureUnit.written(arguments.unit)
    seen_from = None if arguments.seen_from is None else SeenFrom(arguments.seen_from)
    return Answers(_side(arguments), arguments.pitch, arguments.length, unit, seen_from)


def _shown(arguments: argparse.Namespace) -> Shown:
    from insole_core.workflows.lay_plantar import Shown

    step = None if arguments.step is None else arguments.step - 1
    if arguments.frames in ("peak", "mean"):
        return Shown(arguments.frames, step)
    if not arguments.frames.isdigit() or step is not None:
        raise UsageError("--frames is peak, mean, or the number of a frame without --step.")
    return Shown("frame", frame=int(arguments.frames) - 1)


def _pitch(text: str) -> tuple[float, float]:
    across, _, along = text.partition("x")
    try:
        return number(across), number(along or across)
    except argparse.ArgumentTypeError as error:
        raise argparse.ArgumentTypeError(
            f"{text!r} is no distance of sensors; give one in mm, such as 5, or two such as 5x7 "
            "(across x along)"
        ) from error
