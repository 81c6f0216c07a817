"""``insole-studio order``: all that a shop needs for an order, in one place."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import InputError, UsageError
from insole_core.export.shop_order import OrderTerms
from insole_core.formats.file_formats import SOLID_SUFFIXES
from insole_core.geometry.side import Side
from insole_core.given_file import check_once
from insole_core.messages import counted
from insole_core.progress import SILENT, Progress
from insole_core.visible_text import visible_line
from insole_studio.cli.argument_parser import Command, Step, add_steps, day, from_one
from insole_studio.cli.export_arguments import check_terms
from insole_studio.cli.order_nest import NEST
from insole_studio.cli.path_arguments import OutputPath
from insole_studio.cli.records.arguments import add_language, wording_of

if TYPE_CHECKING:
    from insole_core.solids.shop import Shop
    from insole_core.workflows.make_order import OrderChoice
    from insole_core.workflows.order_package import PackedItem

_ENDING_OF_A_FILE = re.compile(r"\.(?!zip$)(?=\w*[a-z])\w{2,6}")

NAME = "order"
HELP = "write an order to a shop, verify one that arrived, or nest several on one block"


def _add_create_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("cases", type=Path, nargs="+", metavar="CASE.insole")
    parser.add_argument(
        "--out", action=OutputPath, required=True, metavar="FOLDER|ORDER.zip",
        help="a new or empty folder, an earlier order, or a .zip file",
    )  # fmt: skip
    parser.add_argument(
        "--side", choices=["left", "right", "both"], default="both",
        help="which feet (default: all that a case has)",
    )  # fmt: skip
    parser.add_argument(
        "--kind", choices=["insole", "block", "positive"], default="insole",
        help="the insole (default), the contact surface in a block, or the foot as a mould",
    )  # fmt: skip
    names = [suffix[1:] for suffix in SOLID_SUFFIXES]
    parser.add_argument("--format", choices=names, default="stl")
    parser.add_argument(
        "--triangles", type=from_one, default=40_000, metavar="N", help="at most (default: 40000)"
    )
    parser.add_argument(
        "--dxf", action="store_true", help="outlines of insole, cover, block and shoe, too"
    )
    terms = parser.add_argument_group("what is ordered")
    terms.add_argument("--quantity", type=from_one, default=1, metavar="N", help="of each pair")
    terms.add_argument("--material", default="", metavar="TEXT")
    terms.add_argument("--colour", default="", metavar="TEXT")
    terms.add_argument("--cover", default="", metavar="TEXT", help="what is glued on top")
    terms.add_argument("--lot", default="", metavar="TEXT", help="of the material")
    terms.add_argument("--remarks", default="", metavar="TEXT")
    terms.add_argument("--deliver-on", type=day, metavar="2026-11-20")
    terms.add_argument("--number", metavar="TEXT", help="of the order (default: a new one)")
    terms.add_argument(
        "--add", action="append", default=[], type=_added, metavar="SIDE=FILE",
        help="a file made elsewhere, such as G-code, of a single case; left, right or both",
    )  # fmt: skip
    parser.add_argument(
        "--released-by", metavar="NAME", help="on the drawing (default: the author of the settings)"
    )
    add_language(parser)
    parser.add_argument("--rules", type=Path, metavar="rules.json", help="of the clinic and shop")
    parser.add_argument("--shop", type=Path, metavar="shop.json", help="its blocks and layers")


def _run_create(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the cases, make the parts and write the order."""
    from insole_core.solids.order_number import new_order_number
    from insole_core.solids.shop import read_shop
    from insole_core.workflows.order_package import write_package

    if arguments.add and len(arguments.cases) > 1:
        raise UsageError("--add belongs to one case, and several are named; write an order each.")
    _check_out(arguments.out)
    check_once(arguments.cases, "{path} is named twice; order more of a case with --quantity.")
    now = datetime.now().astimezone()
    terms = _terms(arguments)
    check_terms(terms)
    number = arguments.number or new_order_number(now.date())
    _check_replaced(arguments.out, number)
    shop = read_shop(arguments.shop)
    items = _items(arguments, terms, number, shop, progress)
    order = write_package(
        items, arguments.out,
        number=number, shop=shop, now=now, released_by=_released_by(arguments),
        translate=wording_of(arguments).translate, progress=SILENT,
    )  # fmt: skip
    files = counted(len(order.files), "1 file", "{count} files")
    progress.step(1.0, f"Done: order {number} with {files} in {arguments.out}")


def _check_out(path: Path) -> None:
    """Refuse to make a folder where the name is that of a file."""
    if _ENDING_OF_A_FILE.fullmatch(path.suffix.lower()) and not path.is_dir():
        raise UsageError(
            f"--out is {path}, and an order is a folder or a .zip file; name one of them."
        )


def _check_replaced(path: Path, number: str) -> None:
    """Refuse to write an order over one of another number, which a shop may already have."""
    from insole_core.export.order_verification import read_order

    try:
        before = read_order(path).release.number
    except InputError:  # there is none, or what is there is told when the order is written
        return
    if before != number:
        raise UsageError(
            f"{path} holds order {before}, and this one is {number}; name another --out, remove "
            f"that order, or make its next revision with --number {before}."
        )


def _released_by(arguments: argparse.Namespace) -> str:
    from insole_studio.settings import load_settings
    from insole_studio.user_paths import UserPaths

    if arguments.released_by is not None:
        return str(arguments.released_by)
    return load_settings(UserPaths.of_user().settings_file).author


def _terms(arguments: argparse.Namespace) -> OrderTerms:
    return OrderTerms(
        arguments.quantity,
        arguments.colour.strip(),
        arguments.cover.strip(),
        arguments.remarks.strip(),
        arguments.deliver_on,
        arguments.lot.strip(),
    )


def _items(
    arguments: argparse.Namespace, terms: OrderTerms, number: str, shop: Shop, progress: Progress
) -> Iterator[PackedItem]:
    """Make the parts of one case after the other; a number stands for pseudonyms not given.

    Of several cases each has its place behind the number. Nothing is drawn for them: the next
    revision of the order calls the same pieces the same.
    """
    from insole_core.cases.case_file import read_case
    from insole_core.solids.export_rules import read_rules
    from insole_core.solids.prescription_paper import NOBODY
    from insole_core.workflows.make_order import letters_told, make_parts
    from insole_core.workflows.order_package import PackedItem

    rules = read_rules(arguments.rules)
    steps = progress.part(0.0, 0.95).parts(len(arguments.cases))
    several = len(arguments.cases) > 1
    for place, (path, step) in enumerate(zip(arguments.cases, steps, strict=True), 1):
        record = read_case(path)
        if arguments.side != "both":
            side = Side(arguments.side)
            if side not in {foot.side for foot in record.feet}:
                raise UsageError(f"{path} has no {side} foot, which --side asks for; change one.")
            record = record.at(side)
        elif not record.feet:
            raise UsageError(f"{path} has no foot; add one in the window first.")
        known = record.patient.pseudonym
        if not known:
            known = f"{number}-{place}" if several else number
            if several:
                print(visible_line(f"{path.name} is {known} in the order."), file=sys.stderr)
        choice = _choice(arguments, terms, known)
        parts = make_parts(record, choice, rules, step)
        letters = letters_told(choice, record.patient, NOBODY)
        if letters is not None:
            print(visible_line(f"Warning: {path.name}: {letters}"), file=sys.stderr)
        for sentence in dict.fromkeys(
            s
            for p in parts
            for s in (*p.warnings, *(f.sentence for f in p.findings if not f.passed))
        ):
            print(visible_line(f"Warning: {path.name}: {sentence}"), file=sys.stderr)
        added = {
            file: tuple(part.side for part in parts) if side is None else (side,)
            for side, file in arguments.add
        }
        yield PackedItem(parts, choice, record.patient, added)


def _choice(arguments: argparse.Namespace, terms: OrderTerms, pseudonym: str) -> OrderChoice:
    from insole_core.workflows.make_order import OrderChoice

    return OrderChoice(
        kind=arguments.kind,
        both=arguments.side == "both",
        suffix=f".{arguments.format}",
        most_triangles=arguments.triangles,
        pseudonym=pseudonym,
        material=arguments.material.strip(),
        outlines=arguments.dxf,
        terms=terms,
    )


def _added(text: str) -> tuple[Side | None, Path]:
    """Return the side, None for both, and the file of ``--add``."""
    word, equals, name = text.partition("=")
    if not equals or not name or word not in ("left", "right", "both"):
        raise argparse.ArgumentTypeError(
            f'"{text}" does not name a foot and a file; write it as left=insole.nc'
        )
    return (None if word == "both" else Side(word)), Path(name)


CREATE = Step(
    "create",
    "write solids, job sheets and order.json of one or more cases into a folder or zip archive",
    _add_create_arguments,
    _run_create,
)


def _add_verify_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("order", type=Path, metavar="FOLDER|ZIP", help="of the order")


def _run_verify(arguments: argparse.Namespace, progress: Progress) -> None:
    """Open the order, print what it holds, and what is wrong with it."""
    from insole_core.export.order_verification import verify_order

    verification = verify_order(arguments.order, progress)
    order = verification.order
    count = sum(item.terms.quantity for item in order.items)
    told = (
        f"Order {order.release.number}, revision {order.release.revision}, of {order.created_at}, "
        f"by {order.program}: "
        f"{counted(len(order.items), '1 patient', '{count} patients')}, "
        f"{counted(count, '1 piece or pair', '{count} pieces or pairs')}, "
        f"{counted(len(order.files), '1 file', '{count} files')}"
    )
    for line in (told, *verification.problems):
        print(visible_line(line))
    if verification.problems:
        raise InputError(
            "{order} is not as it was written: {problems}, listed above; do not make it before "
            "the clinic has answered.",
            order=arguments.order,
            problems=counted(len(verification.problems), "1 problem", "{count} problems"),
        )
    print(visible_line(f"The order is complete. {verification.compared()}"))


VERIFY = Step(
    "verify",
    "say what is missing, changed, added, or of a wrong side in an order; exit code 1 if so",
    _add_verify_arguments,
    _run_verify,
)


STEPS: tuple[Command, ...] = (CREATE, VERIFY, NEST)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the steps."""
    add_steps(parser, STEPS, "STEP")


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Run the chosen step."""
    arguments.step.run(arguments, progress)
