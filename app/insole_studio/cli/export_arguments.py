"""What `insole-studio design` delivers to the workshop: the checked solid with its documents."""

from __future__ import annotations

import argparse
import sys
from contextlib import AbstractContextManager
from datetime import UTC, date, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import InputError, UsageError
from insole_core.formats.file_formats import can_carry, carriers
from insole_core.progress import Progress
from insole_core.visible_text import visible_line
from insole_studio.cli import devices, print_arguments
from insole_studio.cli.argument_parser import check_within, from_one, number
from insole_studio.cli.path_arguments import OutputPath

if TYPE_CHECKING:
    from insole_core.export.shop_order import OrderTerms
    from insole_core.geometry.mesh import TriangleMesh
    from insole_core.geometry.side import Side
    from insole_core.insole.build import Insole
    from insole_core.milling.machine import Machine
    from insole_core.milling.plan import MillingPlan
    from insole_core.solids.checks import Override
    from insole_core.solids.export_job import ExportJob, ExportPaths
    from insole_core.solids.export_rules import ExportRules
    from insole_core.solids.order import Order, Part
    from insole_core.solids.prescription_paper import Responsible
    from insole_core.solids.shop import Block, Shop

_LAYERED = " or ".join(f"a {form.ending} file" for form in carriers("bodies"))


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the solid and of the files that accompany it."""
    shape = parser.add_argument_group("make")
    shape.add_argument("--draft", type=number, default=3.0, metavar="DEG", help="lean of the walls")
    shape.add_argument("--chamfer", type=number, default=0.0, metavar="MM", help="bevel of the rim")
    shape.add_argument("--mark", metavar="TEXT", help="write this on the flat bottom")
    shape.add_argument(
        "--relief", choices=["engraved", "raised"], default="engraved", help="of --mark"
    )
    shape.add_argument("--triangles", type=from_one, metavar="N", help="at most so many triangles")
    shape.add_argument(
        "--deviation", type=number, default=0.05, metavar="MM", help="for --triangles"
    )
    shape.add_argument(
        "--layers",
        action="store_true",
        help=f"cover, middle layer and base as objects of {_LAYERED}",
    )
    shape.add_argument("--ascii", action="store_true", help="STL as text")
    shape.add_argument(
        "--material",
        default="",
        metavar="TEXT",
        help="for the papers (default: that of the prescription)",
    )
    shape.add_argument(
        "--lot", type=str.strip, default="", metavar="TEXT", help="of the material, for the papers"
    )
    shape.add_argument(
        "--mark-numbers", action="store_true", help="serial number and lot below --mark"
    )
    shape.add_argument("--block", metavar="NAME", help="of the shop's list; checked, or nested in")
    shape.add_argument(
        "--cutter", type=number, metavar="MM", help="diameter of the ball-nose cutter"
    )
    mill = parser.add_argument_group("mill")
    mill.add_argument(
        "--gcode", action=OutputPath, metavar="insole.nc", help="program of a router, for --block"
    )
    mill.add_argument(
        "--machine", default="LinuxCNC", metavar="NAME",
        help="LinuxCNC (default), GRBL, Mach3, one of the clinic's, or a machine file (.json)",
    )  # fmt: skip
    mill.add_argument("--both-sides", action="store_true", help="turn the block, on two dowels")
    mill.add_argument(
        "--setup-sheet", action=OutputPath, metavar="setup.pdf", help="for the router's operator"
    )
    mill.add_argument(
        "--pin-holes", action=OutputPath, metavar="pins.nc",
        help="program that bores the holes for the dowels of --both-sides into the spoil board",
    )  # fmt: skip
    print_arguments.add_arguments(parser)
    papers = parser.add_argument_group("checks and papers")
    papers.add_argument("--rules", type=Path, metavar="rules.json", help="of the clinic and shop")
    papers.add_argument("--shop", type=Path, metavar="shop.json", help="its blocks and layers")
    papers.add_argument(
        "--checks", action=OutputPath, metavar="checks.json", help="outcome of the checks"
    )
    papers.add_argument("--job-sheet", action=OutputPath, metavar="sheet.pdf")
    papers.add_argument(
        "--dxf", action=OutputPath, metavar="outlines.dxf",
        help="outlines of insole, cover, block and shoe",
    )  # fmt: skip
    papers.add_argument("--prescription-paper", action=OutputPath, metavar="prescription.pdf")
    papers.add_argument(
        "--pseudonym", default="", metavar="TEXT",
        help="of the patient, in the file and on papers; without it, an order number is made",
    )  # fmt: skip
    papers.add_argument("--prescriber", metavar="NAME", help="for the prescription paper")
    papers.add_argument("--clinic", metavar="NAME", help="of the prescriber")
    papers.add_argument("--maker", metavar="NAME", help="who makes the insole, and answers for it")
    papers.add_argument("--maker-address", metavar="TEXT")
    papers.add_argument("--override", metavar="REASON", help="let pass what a rule would stop")


def places(arguments: argparse.Namespace) -> ExportPaths:
    """Return the paths that the arguments name."""
    from insole_core.solids.export_job import ExportPaths

    return ExportPaths(
        arguments.out,
        arguments.checks,
        arguments.job_sheet,
        arguments.prescription_paper,
        _programs(arguments),
        arguments.setup_sheet,
        arguments.pin_holes,
        arguments.dxf,
    )


def _programs(arguments: argparse.Namespace) -> tuple[Path, ...]:
    from insole_core.workflows.mill import MillingChoice, program_paths

    if arguments.gcode is None:
        return ()
    how = MillingChoice(_machine(arguments), arguments.both_sides)
    return program_paths(arguments.gcode, how)


def outputs(arguments: argparse.Namespace) -> AbstractContextManager[ExportPaths]:
    """Open every output file before the work begins; if the work fails, none is kept."""
    from insole_core.solids.export_job import outputs as open_places

    _check_sizes(arguments)
    if arguments.layers and not can_carry(arguments.out.suffix, "bodies"):
        raise UsageError(f"--layers needs {_LAYERED}, and --out is {arguments.out}; change one.")
    if (arguments.gcode, arguments.setup_sheet, arguments.pin_holes) != (None, None, None):
        _check_milling(arguments)
    print_arguments.check(arguments)
    return open_places(places(arguments))


def _check_sizes(arguments: argparse.Namespace) -> None:
    from insole_core.export.shop_order import OrderTerms
    from insole_core.solids.export_rules import GREATEST_CUTTER_MM, LEAST_CUTTER_MM
    from insole_core.solids.solid import LIMITS

    check_terms(OrderTerms(lot=arguments.lot))
    check_within("--draft", arguments.draft, *LIMITS["draft_deg"])
    check_within("--chamfer", arguments.chamfer, *LIMITS["chamfer_mm"])
    if arguments.cutter is not None:
        check_within("--cutter", arguments.cutter, LEAST_CUTTER_MM, GREATEST_CUTTER_MM, "mm")


def check_terms(terms: OrderTerms) -> None:
    """Check what the call wishes of an order, before anything is read.

    Raises
    ------
    UsageError
    """
    try:
        terms.check(date.today())
    except InputError as error:
        raise UsageError("{reason}", reason=error.message) from error


def _check_milling(arguments: argparse.Namespace) -> None:
    from insole_core.workflows.mill import (
        MillingChoice,
        check_program_suffix,
        require_no_other_program,
    )

    if arguments.gcode is None:
        raise UsageError("--setup-sheet and --pin-holes belong to a program; name it with --gcode.")
    check_program_suffix(arguments.gcode)
    if arguments.pin_holes is not None:
        check_program_suffix(arguments.pin_holes)
        if not arguments.both_sides:
            raise UsageError("--pin-holes are for a block that is turned; add --both-sides.")
    if arguments.block is None:
        raise UsageError("--gcode mills the insole from a block; name it with --block.")
    how = MillingChoice(_machine(arguments), arguments.both_sides)
    require_no_other_program(arguments.gcode, how, arguments.pseudonym)


def _machine(arguments: argparse.Namespace) -> Machine:
    from insole_core.workflows.mill import find_machine
    from insole_studio.user_paths import UserPaths

    return find_machine(arguments.machine, UserPaths.of_user().settings_folder)


def deliver(
    insoles: tuple[Insole, ...],
    arguments: argparse.Namespace,
    beside: ExportPaths,
    progress: Progress,
) -> None:
    """Build the solids, check them, and write everything that was requested.

    Parameters
    ----------
    beside
        Paths of the files that accompany the solid.
    """
    from insole_core.export.lettering import letters_note
    from insole_core.export.shop_order import OrderTerms
    from insole_core.solids import export_job
    from insole_core.solids.order import checked_together
    from insole_core.solids.shop import read_shop

    shop = read_shop(arguments.shop)
    terms = OrderTerms(lot=arguments.lot)
    known = pseudonym(arguments)
    block = None if arguments.block is None else find_block(shop, arguments.block)
    responsible = _responsible(arguments, insoles)
    rules = _rules(arguments, block)
    parts = tuple(
        _part(insole, arguments, rules, known, step)
        for insole, step in zip(insoles, progress.part(0.0, 0.8).parts(len(insoles)), strict=True)
    )
    if block is not None and len(parts) == 2:
        policy = rules.policies.get("block", "off")
        parts = checked_together(*parts, block.size_mm, policy)
    for sentence in dict.fromkeys(sentence for part in parts for sentence in _doubts(part)):
        print(f"Warning: {sentence}", file=sys.stderr)
    letters = letters_note((known, arguments.material, arguments.lot, *vars(responsible).values()))
    if letters is not None:
        print(visible_line(f"Warning: {letters}"), file=sys.stderr)
    job = export_job.ExportJob(
        parts,
        shop,
        identification={"pseudonym": known},
        terms=terms,
        responsible=responsible,
        materials={insole.design.side: _material(insole, arguments) for insole in insoles},
        block=block,
        override=_override(arguments),
        ascii_stl=arguments.ascii,
        printing=print_arguments.printing(parts, arguments),
    )
    export_job.run_export_job(job, places(arguments), beside, progress.part(0.8, 0.9))
    if beside.programs and block is not None:
        _mill(job, block, arguments, beside, progress.part(0.9, 1.0))


def _mill(
    job: ExportJob,
    block: Block,
    arguments: argparse.Namespace,
    beside: ExportPaths,
    progress: Progress,
) -> None:
    """Write the program, and print how long it takes and what stays in hollows."""
    from insole_core.workflows.mill import plan_job, write_milling

    plan = plan_job(
        job, block, _machine(arguments),
        both_sides=arguments.both_sides, progress=progress.part(0.0, 0.7),
    )  # fmt: skip
    for line in _facts(plan):
        print(line, file=sys.stderr)
    for note in plan.notes:
        print(f"Warning: {note}", file=sys.stderr)
    write_milling(
        plan, block, places(arguments), beside,
        identification={**job.identification, "date": date.today().isoformat()},
        progress=progress.part(0.7, 1.0),
    )  # fmt: skip


def _facts(plan: MillingPlan) -> list[str]:
    """Return what is told before a program is used, a line each."""
    from insole_core.insole.elements.words import duration_message
    from insole_core.milling.tool_path import Motion

    lines = [
        f"{operation.side}, {operation.name}, {operation.cutter.name}: "
        f"{operation.lengths_mm(Motion.FEED) / 1000:.1f} m, "
        f"{duration_message(operation.minutes(plan.machine))}"
        for operation in plan.operations
    ]
    return [
        *lines,
        *(_place(plan, solid) for solid in plan.solids),
        f"{plan.machine.name}: {plan.length_m:.0f} m of path, {duration_message(plan.minutes)} "
        f"without changes of cutters; at most {plan.most_left_mm:.2f} mm stay in hollows.",
    ]


def _place(plan: MillingPlan, solid: TriangleMesh) -> str:
    """Say where a solid lies, from the zero that the operator sets."""
    from insole_core.milling.gcode import in_machine

    corners = in_machine(solid.bounds_mm, plan)
    (x, y, _), (right, far, _) = corners.min(axis=0), corners.max(axis=0)
    across, along = f"x = {x:.1f} to {right:.1f} mm", f"y = {y:.1f} to {far:.1f} mm"
    return f"From the zero, a piece lies at {across}, {along}."


def _material(insole: Insole, arguments: argparse.Namespace) -> str:
    """Return the material that was named, else that of the prescription."""
    shell = insole.design.shell
    return arguments.material or ("" if shell is None else shell.material)


def _rules(arguments: argparse.Namespace, block: Block | None) -> ExportRules:
    """Return the rules with the block: the named one, else that of the clinic's own rules."""
    from dataclasses import replace

    from insole_core.solids.export_rules import read_rules

    rules = read_rules(arguments.rules)
    cutter_mm = arguments.cutter
    if cutter_mm is None and arguments.gcode is not None:
        cutter_mm = _machine(arguments).finishing.cutter.diameter_mm
    rules = rules.for_maker(cutter_mm, is_printed=arguments.printer is not None)
    if block is not None:
        return replace(rules, block_mm=block.size_mm)
    return rules if arguments.rules is not None else replace(rules, block_mm=None)


def _doubts(part: Part) -> tuple[str, ...]:
    return (*part.warnings, *part.notes, *(f.sentence for f in part.findings if not f.passed))


def _part(
    insole: Insole,
    arguments: argparse.Namespace,
    rules: ExportRules,
    known: str,
    progress: Progress,
) -> Part:
    from insole_core.solids.order import make_part

    table = devices.materials(arguments.materials)
    part = make_part(
        insole, _order(arguments, insole.design.side, known), rules, progress, materials=table
    )
    if part.order.most_triangles is not None:
        print(
            f"{len(part.solid.triangles)} triangles; they deviate by"
            f" {part.deviation_mm:.3f} mm at most.",
            file=sys.stderr,
        )
    return part


def _order(arguments: argparse.Namespace, side: Side, known: str) -> Order:
    from insole_core.solids.order import Order
    from insole_core.solids.solid import SolidOptions

    return Order(
        kind=arguments.kind,
        options=SolidOptions(draft_deg=arguments.draft, chamfer_mm=arguments.chamfer),
        mark=_mark(arguments, side, known),
        relief=arguments.relief,
        most_triangles=arguments.triangles,
        most_deviation_mm=arguments.deviation,
        layered=arguments.layers,
    )


def _mark(arguments: argparse.Namespace, side: Side, known: str) -> tuple[str, ...]:
    """Return the lines on the bottom of a side."""
    from insole_core.export.shop_order import Release, serial_number

    lines = [] if arguments.mark is None else arguments.mark.split("\\n")
    if arguments.mark_numbers:
        lines.append(f"SN {serial_number(Release(), known, side)}")
        lines += [f"LOT {arguments.lot}"] if arguments.lot else []
    return tuple(lines)


def pseudonym(arguments: argparse.Namespace) -> str:
    """Return the pseudonym, or an order number, which is printed."""
    from insole_core.solids.order_number import new_order_number

    if arguments.pseudonym:
        return str(arguments.pseudonym)
    number = new_order_number(date.today())
    print(f"Order number: {number}", file=sys.stderr)
    return number


def _responsible(arguments: argparse.Namespace, insoles: tuple[Insole, ...]) -> Responsible:
    """Return who prescribes and makes: as in the call, else as in the designs and settings."""
    from insole_core.messages import joined
    from insole_core.solids.prescription_paper import NOBODY, Responsible, prescriber_of
    from insole_studio.settings import load_settings
    from insole_studio.user_paths import UserPaths

    if arguments.prescription_paper is None:
        return NOBODY
    settings = load_settings(UserPaths.of_user().settings_file)
    signed = prescriber_of([insole.design for insole in insoles])
    responsible = Responsible(
        prescriber=arguments.prescriber or signed or settings.author,
        clinic=arguments.clinic or settings.clinic,
        maker=arguments.maker or settings.maker,
        maker_address=arguments.maker_address or settings.maker_address,
    )
    if responsible.missing:
        raise UsageError(
            f"--prescription-paper has to state {joined(responsible.missing)}; give --prescriber, "
            "--maker and --maker-address, or put them into the settings of the window."
        )
    return responsible


def find_block(shop: Shop, name: str) -> Block:
    """Return a block of the shop by its name.

    Raises
    ------
    UsageError
        Naming the blocks that there are.
    """
    found = next((block for block in shop.blocks if block.name == name), None)
    if found is None:
        known = ", ".join(f'"{block.name}"' for block in shop.blocks)
        raise UsageError(f'--block is "{name}", and the shop has {known}; choose one of them.')
    return found


def _override(arguments: argparse.Namespace) -> Override | None:
    from insole_core.records.author import Author
    from insole_core.solids.checks import Override

    if not arguments.override:
        return None
    now = datetime.now(UTC).isoformat(timespec="seconds")
    return Override(Author.of_user().name, arguments.override, now)
