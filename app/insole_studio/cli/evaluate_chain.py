"""``insole-studio evaluate chain``: the whole chain against an object of known form."""

from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import UsageError
from insole_core.progress import Progress
from insole_core.visible_text import visible_line
from insole_studio.cli import evaluate_reference_foot
from insole_studio.cli.argument_parser import number
from insole_studio.cli.report_arguments import (
    add_limit_arguments,
    add_report_argument,
    check_reports,
    conclude,
)
from insole_studio.cli.sensor_arguments import add_store_argument, store_folder

if TYPE_CHECKING:
    from insole_core.evaluation.known_object import KnownObject
    from insole_core.evaluation.printed_body import PrintedBar

NAME = "chain"
HELP = "the whole chain, with and without the learnt correction, against an object of known form"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "sessions", type=Path, nargs="+", metavar="SESSION",
        help="the object, captured like a foot; several of the same sensors are judged together",
    )  # fmt: skip
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument(
        "--ball", dest="kind", action="store_const", const="ball", help="the object is a ball"
    )
    what.add_argument(
        "--cylinder", dest="kind", action="store_const", const="cylinder",
        help="the object is a cylinder, such as a pipe",
    )  # fmt: skip
    what.add_argument(
        "--scan", type=Path, metavar="FILE",
        help="what another scanner measured of the object, such as a plaster cast",
    )  # fmt: skip
    what.add_argument(
        "--body", choices=[evaluate_reference_foot.NAME],
        help="the object is the reference foot that evaluate reference-foot writes, printed",
    )  # fmt: skip
    size = parser.add_mutually_exclusive_group()
    for name in ("diameter", "circumference"):
        size.add_argument(
            f"--{name}", type=number, nargs="+", metavar="MM",
            help=f"true {name}; two numbers where it is only known to lie between them",
        )  # fmt: skip
    parser.add_argument("--unit", choices=("mm", "cm", "m", "inch"), help="of the scan")
    parser.add_argument(
        "--bar", type=number, nargs=3, metavar=("X", "Y", "Z"),
        help="the scan is the drawing of a printed body: edges, mm, of the bar drawn beside it",
    )  # fmt: skip
    parser.add_argument(
        "--callipers", type=number, nargs=5, metavar=("X", "Y", "Z", "D", "E"),
        help="what callipers read of the printed bar: its edges and the two diagonals of its face "
        "in x and y, first the one from the corner of least x and y; size and skew are corrected",
    )  # fmt: skip
    parser.add_argument(
        "--tolerance", type=number, metavar="MM",
        help="how far the measured diameter may be off before it counts as another object "
        "(default: 4, or 2 %% if that is more)",
    )  # fmt: skip
    add_limit_arguments(parser, judged_by_default=True)
    add_report_argument(parser)
    parser.add_argument(
        "--apply", action="store_true",
        help="use what is better from now on for sessions of these sensors, unless a limit is "
        "exceeded",
    )  # fmt: skip
    add_store_argument(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Compare the reconstructed object with the truth, judge it, and keep what follows."""
    check_reports(arguments)
    known = _known(arguments)
    from insole_core.evaluation.chain_section import chain_section
    from insole_core.workflows.calibration.chain_proof import prove_chain
    from insole_core.workflows.calibration.correction_choice import CorrectionChoices

    proof = prove_chain(arguments.sessions, known, progress.part(0.0, 0.9))
    for note in proof.notes:
        print(f"Warning: {note}", file=sys.stderr)
    progress.step(0.9, "Writing the report")
    conclude(chain_section(proof.evaluation, proof.verdict), ", ".join(proof.serials), arguments)
    if arguments.apply and not proof.is_learnt:
        print(f"Warning: Nothing is stored. {proof.verdict.reason}", file=sys.stderr)
    elif arguments.apply:
        path = proof.keep(CorrectionChoices(store_folder(arguments)))
        print(f"From now on used for these sensors: {proof.verdict.use}, as {path} says.")


def _known(arguments: argparse.Namespace) -> KnownObject:
    if arguments.scan is not None or arguments.body is not None:
        if arguments.diameter or arguments.circumference or arguments.tolerance is not None:
            raise UsageError(
                "--scan and --body tell the size themselves; leave out --diameter, --circumference "
                "and --tolerance."
            )
        return _scan(arguments) if arguments.body is None else _reference_foot(arguments)
    if arguments.bar is not None or arguments.callipers is not None:
        raise UsageError(
            "--bar and --callipers are of a printed body; name its file with --scan, or --body."
        )
    if arguments.unit is not None:
        raise UsageError("--unit is that of a --scan; sizes are given in millimetres.")
    from insole_core.evaluation.known_object import KnownRound

    least, most = _diameters(arguments)
    return KnownRound(arguments.kind, least, most, arguments.tolerance)


def _diameters(arguments: argparse.Namespace) -> tuple[float, float]:
    given = arguments.diameter or arguments.circumference
    if given is None:
        raise UsageError(
            f"Give the size of the {arguments.kind}: --diameter MM, or --circumference MM as a "
            "tape measures it."
        )
    if len(given) > 2:
        raise UsageError("A size is one number, or two that it lies between; leave out the rest.")
    scale = 1 if arguments.diameter else 1 / math.pi
    return min(given) * scale, max(given) * scale


def _scan(arguments: argparse.Namespace) -> KnownObject:
    from insole_core.evaluation.known_form import Scan
    from insole_core.evaluation.known_object import KnownScan
    from insole_core.scans.mesh_file import read_mesh

    bar = _bar(arguments)
    read = read_mesh(arguments.scan, arguments.unit)
    for note in read.notes:
        print(visible_line(f"{arguments.scan.name}: {note}"), file=sys.stderr)
    mesh = read.mesh if bar is None else bar.printed(read.mesh)
    return KnownScan(Scan(mesh), arguments.scan.name, bar)


def _reference_foot(arguments: argparse.Namespace) -> KnownObject:
    if arguments.bar is not None or arguments.unit is not None:
        raise UsageError("The bar and the unit of the reference foot are known; leave them out.")
    from insole_core.workflows.calibration.reference_foot_files import known_reference_foot

    return known_reference_foot(arguments.callipers)


def _bar(arguments: argparse.Namespace) -> PrintedBar | None:
    if (arguments.bar is None) != (arguments.callipers is None):
        raise UsageError(
            "Give both the drawn edges of the printed bar (--bar) and its readings (--callipers)."
        )
    if arguments.bar is None:
        return None
    from insole_core.evaluation.printed_body import PrintedBar

    *edges, first, second = arguments.callipers
    return PrintedBar(tuple(arguments.bar), tuple(edges), (first, second))
