"""``insole-studio design``: build an insole from a foot, without a window."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import UsageError
from insole_core.geometry.side import Side
from insole_core.progress import Progress
from insole_studio.cli import export_arguments, foot_argument, prescribed, shoe_arguments
from insole_studio.cli.path_arguments import OutputPath

if TYPE_CHECKING:
    from insole_core.insole.build import Insole
    from insole_core.insole.prescription.design import InsoleDesign

NAME = "design"
HELP = "make the insole of a session or a scanned foot, for the shop"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "foot", type=Path, metavar="FOOT", help="a session, or a mesh (.ply .stl .obj)"
    )
    parser.add_argument(
        "--out", action=OutputPath, required=True, metavar="insole.stl", help=".stl .3mf .ply .obj"
    )
    parser.add_argument("--prescription", type=Path, metavar="design.json")
    parser.add_argument(
        "--pair", type=Path, metavar="FOOT", help="the other foot, nested into one --block"
    )
    parser.add_argument("--pair-prescription", type=Path, metavar="design.json")
    parser.add_argument(
        "--kind", choices=["insole", "block", "positive"], default="insole",
        help="the insole (default), the contact surface in a block, or the foot as a mould",
    )  # fmt: skip
    prescribed.add_arguments(parser)
    shoe_arguments.add_arguments(parser)
    foot_argument.add_arguments(parser)
    export_arguments.add_arguments(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the foot, build the insole and write it."""
    from insole_core.export.solid_file import check_suffix

    check_suffix(arguments.out)
    shoe_arguments.check(arguments)
    if arguments.pair is not None and arguments.block is None:
        raise UsageError("--pair nests two insoles into one block; name it with --block.")
    with export_arguments.outputs(arguments) as beside:
        parts = progress.part(0.0, 0.8).parts(1 if arguments.pair is None else 2)
        side = None if arguments.side is None else Side(arguments.side)
        insoles = [_insole(arguments.foot, side, arguments.prescription, arguments, parts[0])]
        if arguments.pair is not None:
            other = insoles[0].design.side.other
            prescription = arguments.pair_prescription
            insoles.append(_insole(arguments.pair, other, prescription, arguments, parts[1]))
        insoles.sort(key=lambda insole: insole.design.side is Side.RIGHT)
        export_arguments.deliver(tuple(insoles), arguments, beside, progress.part(0.8, 1.0))
    progress.step(1.0, f"Done: {arguments.out}")


def _insole(
    path: Path,
    named: Side | None,
    prescription: Path | None,
    arguments: argparse.Namespace,
    progress: Progress,
) -> Insole:
    """Read a foot and build its insole, printing the warnings about both."""
    from insole_core.insole.build import build_insole

    given = _read_prescription(prescription)
    side = _agreed_side(named, given)
    foot = foot_argument.read_foot(path, side, arguments, progress.part(0.0, 0.8))
    design = prescribed.prescribed(foot, given, arguments)
    design = shoe_arguments.in_shoe(design, arguments)
    insole = build_insole(foot, design, progress.part(0.8, 1.0))
    _print_warnings(insole, arguments.materials)
    return insole


def _read_prescription(path: Path | None) -> InsoleDesign | None:
    from insole_core.insole.prescription.design_json import read_design

    return None if path is None else read_design(path)


def _agreed_side(side: Side | None, design: InsoleDesign | None) -> Side | None:
    """Return the side that the arguments and the prescription agree on, if they name one."""
    if design is None:
        return side
    if side not in (None, design.side):
        raise UsageError(
            f"--side is {side}, but the prescription is for the {design.side} foot; "
            "correct one of the two."
        )
    return design.side


def _print_warnings(insole: Insole, materials: Path | None) -> None:
    """Print what is unusual in the prescription, by the rules and materials of the clinic."""
    from insole_core.foot.landmarks import find_landmarks
    from insole_core.insole.prescription.clinic_rules import design_warnings, load_rules

    landmarks = find_landmarks(insole.foot)
    table = prescribed.materials(materials)
    for warning in design_warnings(insole, landmarks, load_rules(), table):
        print(f"Warning: {warning.sentence}", file=sys.stderr)
