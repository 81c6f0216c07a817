"""``insole-studio calibrate reference``: check a reference system, and survey one as built."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import CalibrationError, UsageError
from insole_core.progress import Progress
from insole_studio.cli.argument_parser import number
from insole_studio.cli.path_arguments import OutputPath
from insole_studio.cli.report_arguments import add_report_argument, check_reports

if TYPE_CHECKING:
    from insole_core.calibration.markers.marker_survey import KnownLength, MarkerSurvey
    from insole_core.recording.session import ReferenceSystem

NAME = "reference"
HELP = "check a reference system; with sessions, measure where its markers really are"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "system", type=Path, nargs="?", metavar="SYSTEM.json",
        help="by default the 20-marker system of the product",
    )  # fmt: skip
    parser.add_argument(
        "--sessions", type=Path, nargs="+", default=[], metavar="SESSION",
        help="recordings of the built system by calibrated sensors, from many sides",
    )  # fmt: skip
    parser.add_argument(
        "--length", nargs=3, action="append", default=[], metavar=("ID", "ID", "MM"),
        help="a distance measured by hand; one for all faces that are linked, again for another",
    )  # fmt: skip
    parser.add_argument(
        "--rigid", action="store_true",
        help="the sensors stood still to each other in all sessions, while the system was turned "
        "between them: links the faces that they see",
    )  # fmt: skip
    parser.add_argument(
        "--out", action=OutputPath, metavar="built.json", help="write the system as it was measured"
    )
    parser.add_argument(
        "--moved", type=number, default=1.0, metavar="MM",
        help="a marker that is farther from its place was bumped (default 1 mm)",
    )  # fmt: skip
    add_report_argument(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Check the system, and survey it if sessions are given."""
    check_reports(arguments)
    if bool(arguments.sessions) != bool(arguments.length):
        raise UsageError("Measuring a built system needs both --sessions and --length.")
    if arguments.out and not arguments.sessions:
        raise UsageError("--out writes what --sessions have measured; name them too.")
    from insole_core.calibration.markers.reference_file import load_reference_system
    from insole_core.resources import resource_path

    path = arguments.system or resource_path("reference_systems/lego-20.json")
    system = load_reference_system(path)
    if arguments.sessions:
        _survey(system, arguments, progress)
    else:
        _check(system, arguments)
    progress.step(1.0, "Done")


def _check(system: ReferenceSystem, arguments: argparse.Namespace) -> None:
    from insole_core.calibration.markers.reference_file import check_reference_system
    from insole_core.evaluation.calibration_sections import reference_section
    from insole_core.evaluation.report import section_lines
    from insole_core.workflows.calibration.report_files import make_report, write_reports

    checks = check_reference_system(system)
    section = reference_section(system, checks)
    write_reports(make_report(section.title, "", [section]), arguments.report)
    print("\n".join(section_lines(section)))
    problems = [f"face {check.face}: {text}" for check in checks for text in check.problems]
    if problems:
        raise CalibrationError(
            f"The reference system {system.name} is not fit to tell where a sensor stands; "
            f"{'; '.join(problems)}."
        )


def _survey(system: ReferenceSystem, arguments: argparse.Namespace, progress: Progress) -> None:
    from insole_core.calibration.markers.marker_survey import check_survey, survey_markers
    from insole_core.calibration.markers.reference_file import save_reference_system
    from insole_core.evaluation.calibration_sections import survey_section
    from insole_core.evaluation.report import section_lines
    from insole_core.files.transaction import Transaction
    from insole_core.workflows.calibration.marker_views import read_marker_views
    from insole_core.workflows.calibration.report_files import make_report, write_reports

    lengths = _lengths(arguments.length)
    views, left_out = read_marker_views(
        arguments.sessions, system, arguments.rigid, progress.part(0, 0.7)
    )
    for sentence in left_out:
        print(f"Warning: {sentence}", file=sys.stderr)
    progress.step(0.7, f"Measuring the markers in {len(views)} views")
    survey = survey_markers(system, views, lengths)
    _check_certain(survey, arguments.moved)
    bump = check_survey(system, survey, arguments.moved)
    section = survey_section(survey, bump)
    with Transaction() as outputs:
        reports = [outputs.file(path) for path in arguments.report]
        write_reports(make_report(section.title, "", [section]), reports)
        if arguments.out:
            save_reference_system(survey.system, outputs.file(arguments.out))
    print("\n".join(section_lines(section)))
    if bump.bumped and not arguments.out:
        raise CalibrationError(
            f"The reference system was bumped: {', '.join(bump.moved)} moved; put them back, or "
            "keep the measured places with --out."
        )


def _check_certain(survey: MarkerSurvey, moved_mm: float) -> None:
    worst = max(math.hypot(*one) for one in survey.deviation_mm.values())
    if worst > moved_mm:
        raise CalibrationError(
            f"The views lie too near together to measure the markers: a standard deviation of "
            f"{worst:.1f} mm is more than the {moved_mm:g} mm asked for; record the system from "
            "sides that lie 30 degrees or more apart."
        )


def _lengths(given: Sequence[Sequence[str]]) -> list[KnownLength]:
    from insole_core.calibration.markers.marker_survey import KnownLength

    return [KnownLength(first, second, _length_mm(text)) for first, second, text in given]


def _length_mm(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise UsageError(
            f'--length ends with "{text}"; give two marker names and their distance in mm.'
        ) from None
