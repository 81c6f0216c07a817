"""``insole-studio pressure-change``: how load moves from one design to another, in per cent."""

from __future__ import annotations

import argparse
import json
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from insole_core.errors import InputError, UsageError
from insole_core.geometry.side import Side
from insole_core.progress import Progress
from insole_studio.cli import devices, foot_argument
from insole_studio.cli.argument_parser import number
from insole_studio.cli.path_arguments import OutputPath

if TYPE_CHECKING:
    from insole_core.contact.change import Loading, PressureChange
    from insole_core.contact.designs import Shoe
    from insole_core.contact.fit import Fitted
    from insole_core.foot.foot import Foot
    from insole_core.insole.prescription.design import InsoleDesign
    from insole_core.messages import Message

    Designs: TypeAlias = tuple[InsoleDesign, InsoleDesign | None]

NAME = "pressure-change"
HELP = "tell how load moves from one design to another, in per cent, by a model"

_SAME_FOOT_MM = 1.0
_A_PLACE = re.compile(r"^-\d")
"""What begins like a negative number is a place, and no option."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser._negative_number_matcher = _A_PLACE
    parser.add_argument(
        "foot", type=Path, metavar="FOOT", help=f"a session, or {foot_argument.A_MESH}"
    )
    parser.add_argument(
        "--prescription", type=Path, required=True, metavar="NEW.json", help="the new design"
    )
    parser.add_argument(
        "--against", type=Path, metavar="OLD.json", help="the old design (default: a flat shoe)"
    )
    parser.add_argument(
        "--weight-kg", type=number, required=True, metavar="KG", help="weight of the person"
    )
    parser.add_argument("--report", action=OutputPath, required=True, metavar="change.json")
    foot_argument.add_arguments(parser)
    parser.add_argument(
        "--at", type=_place, nargs="+", action="extend", default=[], metavar="X,Y",
        help="places to tell the change at, mm, insole frame",
    )  # fmt: skip
    parser.add_argument(
        "--posture", choices=["standing", "heel_strike", "push_off"], default="standing",
        help="standing on both feet (default), or an instant of a step",
    )  # fmt: skip
    parser.add_argument(
        "--shoe", choices=["rigid", "soft"], default="rigid",
        help="below the insole: a stiff sole (default), or a midsole of foam",
    )  # fmt: skip
    parser.add_argument(
        "--shore-a", type=number, metavar="A",
        help="hardness of the foam of all insoles, whatever the designs say",
    )  # fmt: skip
    parser.add_argument(
        "--measured", type=Path, metavar="CASE.insole",
        help="a case of this scan with a map under the foot, to which the tissue is fitted: of the "
        "bare foot on a plate, in this posture",
    )  # fmt: skip
    parser.add_argument(
        "--materials", type=Path, metavar="materials.json",
        help="table of materials (default: the clinic's)",
    )  # fmt: skip


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read foot and designs, compute the change, print and write it."""
    _check(arguments)
    from insole_core.contact.change import SENTENCE
    from insole_core.contact.change_report import change_report
    from insole_core.contact.designs import left_out_of
    from insole_core.files.atomic import write_text
    from insole_core.files.transaction import Transaction

    with Transaction() as outputs:
        report_file = outputs.file(arguments.report)
        new, old = _designs(arguments)
        of_weight = _notes_of_weight(arguments.foot)
        reading = progress.part(0.0, 0.7)
        foot = foot_argument.read_foot(arguments.foot, new.side, arguments, reading)
        of_sole = _loading(foot, arguments).sole.notes or of_weight
        notes = [*of_sole, *_shoe(arguments).assumed(new, old), *left_out_of(new, old)]
        fitted = _fitted(foot, arguments, progress.part(0.7, 0.8))
        told = _changed(foot, (new, old), fitted, arguments, progress.part(0.8, 1.0))
        for note in notes:
            print(f"Warning: {note}", file=sys.stderr)
        content = change_report(told, arguments.at, notes, fitted)
        write_text(json.dumps(content, indent=1, ensure_ascii=False) + "\n", report_file)
    _print_regions(told)
    if fitted is not None and fitted.error_percent is not None:
        print(
            f"Fitted to the map; regions that were held out are off by {fitted.error_percent:.0f} %"
        )
    print(SENTENCE)
    progress.step(1.0, f"Done: {arguments.report}")


def _check(arguments: argparse.Namespace) -> None:
    from insole_core.contact.change import WEIGHT_KG
    from insole_core.insole.prescription.materials import SHORE_A

    if arguments.report.suffix.lower() != ".json":
        raise UsageError(f"--report is {arguments.report}, but the report is written as .json.")
    if arguments.weight_kg not in WEIGHT_KG:
        raise UsageError(
            f"--weight-kg is {arguments.weight_kg:g}, but a person weighs {WEIGHT_KG}; correct it."
        )
    least, most = SHORE_A
    if arguments.shore_a is not None and not least <= arguments.shore_a <= most:
        raise UsageError(
            f"--shore-a is {arguments.shore_a:g}, but it must be {least:g} to {most:g}; correct it."
        )


def _designs(arguments: argparse.Namespace) -> Designs:
    from insole_core.insole.prescription.design_json import read_design

    new = read_design(arguments.prescription)
    old = None if arguments.against is None else read_design(arguments.against)
    sides = {new.side, *([] if old is None else [old.side])}
    if arguments.side is not None:
        sides.add(Side(arguments.side))
    if len(sides) > 1:
        raise UsageError(
            "--side and the prescriptions name different feet; the change can only be told for "
            "one, so correct them."
        )
    return new, old


def _notes_of_weight(path: Path) -> tuple[Message, ...]:
    """Return what has to be told of the weight on the foot.

    Raises
    ------
    InputError
        When the whole weight was on it.
    """
    from insole_core.contact.stance import check_weight, notes_of_weight
    from insole_core.recording.reader import is_session, read_session
    from insole_core.scans.scan_folder import holds_scans

    if not is_session(path) or holds_scans(path):
        return notes_of_weight(None)
    condition = read_session(path).manifest.capture_condition
    if condition is None:
        return notes_of_weight(None)
    check_weight(condition.weight_bearing)
    return notes_of_weight(condition.weight_bearing)


def _shoe(arguments: argparse.Namespace) -> Shoe:
    from insole_core.contact.designs import Shoe
    from insole_core.contact.hardness import foam
    from insole_core.contact.stance import SOFT_SHOE

    return Shoe(
        table=devices.materials(arguments.materials),
        layers=SOFT_SHOE if arguments.shoe == "soft" else (),
        body=None if arguments.shore_a is None else foam(arguments.shore_a),
    )


def _loading(foot: Foot, arguments: argparse.Namespace) -> Loading:
    from insole_core.contact.change import Loading
    from insole_core.contact.load_case import Posture
    from insole_core.contact.stance import Sole

    return Loading(Sole.of(foot), arguments.weight_kg, Posture(arguments.posture))


def _fitted(foot: Foot, arguments: argparse.Namespace, progress: Progress) -> Fitted | None:
    """Return what the map of a case tells of the foot; None without one.

    Raises
    ------
    InputError
        When the case has no map under this foot, or it does not fit the posture.
    """
    from insole_core.cases.case_file import read_case
    from insole_core.contact.fit import fit_tissue

    if arguments.measured is None:
        return None
    record = read_case(arguments.measured).of_side(foot.side)
    laid = None if record is None else record.plantar.pressure
    if record is None or laid is None:
        raise InputError(
            "{path} has no map under a {side} foot; lay one with insole-studio pressure.",
            path=arguments.measured,
            side=foot.side,
        )
    if abs(record.foot.length_mm - foot.length_mm) > _SAME_FOOT_MM:
        raise InputError(
            "The foot in {path} is {other:.0f} mm long, and that of the scan {own:.0f} mm; give a "
            "case of this scan.",
            path=arguments.measured,
            other=record.foot.length_mm,
            own=foot.length_mm,
        )
    return fit_tissue(_loading(foot, arguments), laid, progress)


def _changed(
    foot: Foot,
    designs: Designs,
    fitted: Fitted | None,
    arguments: argparse.Namespace,
    progress: Progress,
) -> PressureChange:
    from insole_core.contact.change import pressure_change

    loading, shoe, (new, old) = _loading(foot, arguments), _shoe(arguments), designs
    sole = loading.sole
    before = shoe.floor(sole, new) if old is None else shoe.built(sole, old, progress.part(0, 0.3))
    after = shoe.built(sole, new, progress.part(0.3, 0.6))
    return pressure_change(
        loading,
        before,
        after,
        material_is_known=not shoe.assumed(new, old),
        points=arguments.at,
        assumed=None if fitted is None else fitted.assumed,
        progress=progress.part(0.6, 1.0),
    )


def _print_regions(told: PressureChange) -> None:
    from insole_core.contact.change_report import signed

    for name, one in told.regions.items():
        if one.reason or one.percent is None or one.limits is None:
            print(f"{name:<16} cannot tell: {one.reason}")
        else:
            percent, low, high = map(signed, (one.percent, *one.limits))
            print(f"{name:<16} {percent} % ({low} to {high})")


def _place(text: str) -> tuple[float, float]:
    try:
        x, y = (number(part) for part in text.split(","))
    except (ValueError, argparse.ArgumentTypeError) as error:
        raise argparse.ArgumentTypeError(
            f"{text!r} is no place; give x and y in mm, such as 12,150"
        ) from error
    return x, y
