"""Make and write what the user orders for the open case."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np

from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.days import doubtful_days
from insole_core.errors import DesignError, InputError
from insole_core.export.lettering import letters_note
from insole_core.export.shop_order import OrderTerms, Release, serial_number
from insole_core.files.transaction import Transaction
from insole_core.formats.file_formats import (
    CHECKS,
    JOB_SHEET,
    OUTLINES,
    PIN_HOLES,
    PROGRAM,
    SETUP_SHEET,
    can_carry,
)
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.materials import MaterialTable
from insole_core.messages import Message, Translate
from insole_core.milling.plan import MillingPlan
from insole_core.pressure.laid_map import PressureMap
from insole_core.progress import SILENT, Progress
from insole_core.solids.checks import Override
from insole_core.solids.export_job import (
    ExportJob,
    ExportPaths,
    Printing,
    drawn_parts,
    opened,
    run_export_job,
)
from insole_core.solids.export_rules import ExportRules
from insole_core.solids.marking import Relief
from insole_core.solids.order import Order, Part, checked_together, make_part
from insole_core.solids.prescription_paper import NOBODY, Responsible, require_statement
from insole_core.solids.print_presets import read_print_presets
from insole_core.solids.shop import Block, Shop
from insole_core.solids.solid import Kind, SolidOptions
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_core.workflows.mill import (
    MillingChoice,
    plan_job,
    program_paths,
    require_no_other_program,
    write_milling,
)
from insole_core.workflows.nameless import require_nameless
from insole_core.workflows.print_order import PrintChoice, zoned_print
from insole_core.workflows.starting_design import StartingDevice

if TYPE_CHECKING:
    from insole_core.export.insole_drawing import DrawnInsole

Package: TypeAlias = Literal["", "zip", "folder"]
_SIDE_WORDS = ("left", "right", "pair")


@dataclass(frozen=True)
class OrderChoice:
    """The values of the export form.

    Parameters
    ----------
    both
        Whether the other foot of the case is made too.
    alone
        Which foot is made where not both are; None for the current one.
    suffix, ascii_stl
        The file format.
    layered
        Whether the layers are separate parts, in formats that carry bodies.
    draft_deg, chamfer_mm
        Of the walls.
    most_triangles
        None for no limit.
    most_deviation_mm
        Largest deviation that reducing the triangles may cause.
    relief
        How the text is applied; None for no text.
    pseudonym, text
        Or order number, in place of the patient's name; text on the solid, by default pseudonym,
        side and date.
    numbered
        Whether serial number and lot of the material stand below the text.
    release
        Number and revision that the serial number is of.
    material
        Of feet whose prescription names none.
    own_materials
        Of a foot, in place of the one that its prescription names.
    block
        None for parts that stay where they were designed.
    printing, milling
        For which printer or router; None for a file that any program reads.
    job_sheet, prescription, checks
        Which papers are written.
    outlines
        Whether the outlines are written too, as DXF.
    terms
        Quantity, colour and so on, for the shop.
    package
        Whether all is written as one order, in an archive or a folder; empty for single files.
    """

    kind: Kind = "insole"
    both: bool = False
    alone: Side | None = None
    suffix: str = ".stl"
    ascii_stl: bool = False
    layered: bool = False
    draft_deg: float = 3.0
    chamfer_mm: float = 0.0
    most_triangles: int | None = 40_000
    most_deviation_mm: float = 0.05
    relief: Relief | None = None
    pseudonym: str = ""
    text: str = ""
    numbered: bool = False
    release: Release = field(default_factory=Release)
    material: str = ""
    own_materials: Mapping[Side, str] = field(default_factory=dict)
    block: Block | None = None
    printing: PrintChoice | None = None
    milling: MillingChoice | None = None
    job_sheet: bool = True
    prescription: bool = False
    checks: bool = False
    outlines: bool = False
    terms: OrderTerms = field(default_factory=OrderTerms)
    package: Package = ""

    @property
    def has_layers(self) -> bool:
        """Whether the file keeps the layers apart."""
        return self.layered and can_carry(self.suffix, "bodies") and self.printing is None

    def makes_alike(self, other: OrderChoice) -> bool:
        """Return whether both give the same solids; papers and formats do not matter."""
        return self._of_the_solid == other._of_the_solid

    @property
    def _of_the_solid(self) -> OrderChoice:
        relief = self.relief
        is_numbered = relief is not None and self.numbered
        return replace(
            self, suffix="", ascii_stl=False, layered=False, material="", own_materials={},
            printing=None, milling=None,
            job_sheet=False, prescription=False, checks=False, outlines=False,
            terms=OrderTerms(lot=self.terms.lot) if is_numbered else OrderTerms(), package="",
            numbered=is_numbered, release=self.release if is_numbered else Release(),
            pseudonym=self.pseudonym if relief else "", text=self.text if relief else "",
        )  # fmt: skip


def feet_of(record: CaseRecord, choice: OrderChoice) -> tuple[FootRecord, ...]:
    """Return the feet to make: one, or both, the left one first."""
    if choice.both and len(record.feet) == 2:
        return record.feet
    foot = None if choice.alone is None else record.of_side(choice.alone)
    foot = foot or record.current
    return () if foot is None else (foot,)


def ordered_material(choice: OrderChoice, design: InsoleDesign) -> str:
    """Return the material that a foot's insole is ordered in; empty if nobody has named one."""
    prescribed = choice.material if design.shell is None else design.shell.material
    return choice.own_materials.get(design.side, prescribed)


def prescribed_alone(record: CaseRecord, starting: StartingDevice) -> Side | None:
    """Return the one of two feet that alone has a prescription; None if none or both have one.

    It is made alone unless one says otherwise, since the other may be there to be compared with.

    Parameters
    ----------
    starting
        The device that new prescriptions begin with: a design as it begins is none.
    """
    prescribed = [foot.side for foot in record.feet if starting.prescribes(foot.design)]
    return prescribed[0] if len(record.feet) == 2 and len(prescribed) == 1 else None


def mark_of(choice: OrderChoice, side: Side) -> tuple[str, ...]:
    """Return the lines of text on the part of a side; empty without a relief."""
    if choice.relief is None:
        return ()
    numbers = _numbers_on(choice, side) if choice.numbered else ()
    if choice.text.strip():
        return (*choice.text.splitlines(), *numbers)
    day = date.today().isoformat()
    return tuple(filter(None, (choice.pseudonym.strip(), f"{side} {day}", *numbers)))


def _numbers_on(choice: OrderChoice, side: Side) -> tuple[str, ...]:
    serial = serial_number(choice.release, choice.pseudonym.strip(), side)
    return (f"SN {serial}", f"LOT {choice.terms.lot}" if choice.terms.lot else "")


def make_parts(
    record: CaseRecord,
    choice: OrderChoice,
    rules: ExportRules,
    progress: Progress = SILENT,
    *,
    materials: MaterialTable | None = None,
) -> tuple[Part, ...]:
    """Build, make and check the ordered parts.

    Parameters
    ----------
    rules
        Limits of the checks; the block of `choice` replaces theirs, and without one none is
        checked. A pair in a block is checked against it together.
    materials
        Of the clinic, for the warnings; by default those of the product.

    Returns
    -------
    tuple of Part
        The left one first.

    Raises
    ------
    DesignError
        When one of the parts cannot be made.
    Cancelled
    """
    feet = feet_of(record, choice)
    block = choice.block
    rules = replace(rules, block_mm=None if block is None else block.size_mm)
    parts = tuple(
        _part(foot, choice, rules, materials, step)
        for foot, step in zip(feet, progress.parts(len(feet)), strict=True)
    )
    if block is None or len(parts) == 1:
        return parts
    left, right = parts
    return checked_together(left, right, block.size_mm, rules.policies.get("block", "off"))


def _part(
    foot: FootRecord,
    choice: OrderChoice,
    rules: ExportRules,
    materials: MaterialTable | None,
    progress: Progress,
) -> Part:
    insole = build_insole(foot.foot, foot.design, progress.part(0.0, 0.4))
    order = Order(
        kind=choice.kind,
        options=SolidOptions(draft_deg=choice.draft_deg, chamfer_mm=choice.chamfer_mm),
        mark=mark_of(choice, foot.side),
        relief=choice.relief or "engraved",
        most_triangles=choice.most_triangles,
        most_deviation_mm=choice.most_deviation_mm,
        layered=choice.has_layers,
    )
    return make_part(
        insole,
        order,
        rules,
        progress.part(0.4, 1.0),
        landmarks=landmarks_of(foot),
        materials=materials,
    )


@dataclass(frozen=True, eq=False)
class MadeFor:
    """What a printer or a router gets beside the solids; None for what is not chosen."""

    printing: Printing | None = None
    milling: MillingPlan | None = None


def prepare(
    parts: Sequence[Part],
    choice: OrderChoice,
    shop: Shop,
    maps: Mapping[Side, PressureMap],
    progress: Progress = SILENT,
) -> MadeFor:
    """Make the zones for the printer, or the tool paths for the router.

    Parameters
    ----------
    parts
        From `make_parts`, with a choice that `makes_alike`.
    maps
        Pressures under the feet, for zones of pressure.

    Raises
    ------
    DesignError
        When a zone cannot be made, no block is chosen, or block, machine or a cutter is too small.
    InputError, UsageError
        When the file of zones or the preset cannot be used.
    Cancelled
    """
    if choice.printing is not None:
        if not can_carry(choice.suffix, "print settings"):
            raise DesignError(
                "Only a 3MF holds zones and settings for a slicer; choose 3MF as the format, or "
                "no printer."
            )
        presets = read_print_presets()
        return MadeFor(printing=zoned_print(parts, choice.printing, presets, maps, progress))
    if choice.milling is not None:
        if choice.block is None:
            raise DesignError(
                "A router mills the insole from a block, and none is chosen; choose the block."
            )
        job = ExportJob(tuple(parts), shop, block=choice.block)
        how = choice.milling
        plan = plan_job(
            job, choice.block, how.machine, both_sides=how.both_sides, progress=progress
        )
        return MadeFor(milling=plan)
    return MadeFor()


def write_order(
    parts: Sequence[Part],
    choice: OrderChoice,
    path: Path,
    *,
    shop: Shop,
    patient: Patient,
    responsible: Responsible = NOBODY,
    override: Override | None = None,
    made: MadeFor | None = None,
    release: Release | None = None,
    translate: Translate = str,
    progress: Progress = SILENT,
) -> tuple[Path, ...]:
    """Write the parts with their papers: all of them or nothing.

    Parameters
    ----------
    parts
        From `make_parts`, with a choice that `makes_alike`.
    path
        As the user chose it; the side is inserted into each name once.
    patient
        For the prescription; the workshop gets nothing of it.
    responsible
        Who prescribes and who makes, for the prescription.
    override
        Accepts failed checks. It is recorded in the file of the checks, which is then always
        written.
    made
        From `prepare` of the same parts and choice; None to do that
        here, without maps of pressures.
    release
        Number, revision and who released it, for job sheet and drawing.
    translate
        Into the language of the papers.

    Returns
    -------
    tuple of Path
        The files of the solids.

    Raises
    ------
    DesignError
        When a blocking check failed without an override, or a pair does not fit its block.
    InputError
        When a text for the workshop holds the patient's name, the pieces carry serial numbers of
        another order or revision, or the prescription lacks what it states.
    OutputError
        When a place cannot be written, or files of an earlier program lie beside it.
    Cancelled
    """
    named = (ordered_material(choice, part.insole.design) for part in parts)
    materials = ", ".join(dict.fromkeys(filter(None, named)))
    release = release or Release()
    _require_nameless(choice, materials, path, patient, override=override, release=release)
    _require_serials(choice, release, [part.side for part in parts])
    if choice.prescription:
        require_prescription(choice, patient, responsible)
    require_no_other_programs(parts, choice, path)
    places = _all_places(parts, choice, path, override is not None)
    if made is None:
        made = prepare(parts, choice, shop, {}, progress.part(0.0, 0.5))
        progress = progress.part(0.5, 1.0)
    groups = _groups(_laid_out(parts, choice), choice)
    drawn = drawn_parts(parts, translate) if choice.job_sheet else ()
    with Transaction() as transaction:
        beside = [opened(place, transaction) for place in places]
        steps = progress.parts(len(groups))
        for group, place, temporary, step in zip(groups, places, beside, steps, strict=True):
            job = _export_job(
                group,
                choice,
                of_order=parts,
                shop=shop,
                patient=patient,
                responsible=responsible,
                override=override,
                drawn=drawn,
                release=release,
                translate=translate,
                printing=made.printing,
            )
            run_export_job(job, place, temporary, step.part(0.0, 0.8))
            if made.milling is not None and choice.block is not None:
                write_milling(
                    made.milling, choice.block, place, temporary,
                    identification=_order_facts(choice, release, materials),
                    translate=translate, progress=step.part(0.8, 1.0),
                )  # fmt: skip
    return tuple(place.solid for place in places)


def _order_facts(choice: OrderChoice, release: Release, materials: str) -> dict[str, str]:
    """Return by what the operator of a router knows an order."""
    facts = {
        "pseudonym": choice.pseudonym,
        "order number": release.number,
        "revision": str(release.revision) if release.number else "",
        "material": materials,
        "lot of the material": choice.terms.lot,
        "date": date.today().isoformat(),
    }
    return {name: text for name, text in facts.items() if text or name == "pseudonym"}


def _laid_out(parts: Sequence[Part], choice: OrderChoice) -> list[Part]:
    """Return the parts with layers of their own, or in one piece, as the choice says now."""
    return [replace(part, order=replace(part.order, layered=choice.has_layers)) for part in parts]


def _export_job(
    group: Sequence[Part],
    choice: OrderChoice,
    *,
    of_order: Sequence[Part],
    shop: Shop,
    patient: Patient,
    responsible: Responsible,
    override: Override | None,
    printing: Printing | None,
    drawn: tuple[DrawnInsole, ...],
    release: Release,
    translate: Translate,
) -> ExportJob:
    """Return the job that writes the parts of one file with their papers.

    Parameters
    ----------
    of_order
        All its parts, which each file's papers show.
    """
    return ExportJob(
        tuple(group),
        shop,
        identification={"pseudonym": choice.pseudonym} if choice.pseudonym else {},
        patient=_patient_facts(patient),
        responsible=responsible,
        materials={part.side: ordered_material(choice, part.insole.design) for part in of_order},
        block=choice.block,
        override=override,
        ascii_stl=choice.ascii_stl,
        terms=choice.terms,
        printing=printing,
        drawn=drawn,
        release=release,
        translate=translate,
    )


def require_prescription(choice: OrderChoice, patient: Patient, responsible: Responsible) -> None:
    """Check that the prescription can state what it has to.

    Raises
    ------
    InputError
        Naming what is missing, or the date that cannot be right.
    """
    require_statement(responsible, {"name": patient.name, "pseudonym": choice.pseudonym})
    doubts = doubtful_days(patient, date.today())
    if doubts:
        raise InputError(
            "The prescription cannot be written: {doubts} Correct it in the patient panel.",
            doubts=doubts,
        )


def _require_nameless(
    choice: OrderChoice,
    materials: str,
    path: Path,
    patient: Patient,
    *,
    override: Override | None,
    release: Release,
) -> None:
    texts = {
        "number of the order": release.number,
        "name of who released the order": release.by,
        "file name": path.stem,
        "pseudonym": choice.pseudonym,
        "text on the bottom": choice.text,
        "name of the material": materials,
        "reason for the export": "" if override is None else override.reason,
        "colour": choice.terms.colour,
        "cover": choice.terms.cover,
        "lot of the material": choice.terms.lot,
        "remarks": choice.terms.remarks,
    }
    require_nameless(patient, texts)


def _require_serials(choice: OrderChoice, release: Release, sides: Sequence[Side]) -> None:
    """Check that the serial numbers on the pieces are those of the order."""
    if choice.relief is None or not choice.numbered:
        return
    known = choice.pseudonym.strip()
    for side in sides:
        made, ordered = (serial_number(of, known, side) for of in (choice.release, release))
        if made != ordered:
            raise InputError(
                "The pieces carry the serial number {made}, and it is {ordered} in the order; "
                "write it to another place, or without serial numbers on the pieces.",
                made=made,
                ordered=ordered,
            )


def files_of(
    parts: Sequence[Part], choice: OrderChoice, path: Path, overridden: bool
) -> tuple[Path, ...]:
    """Return all files that `write_order` would write.

    Parameters
    ----------
    overridden
        Whether failed checks are overridden, which adds the file of the checks.
    """
    places = _all_places(parts, choice, path, overridden)
    return tuple(file for place in places for file in place.files)


def letters_told(choice: OrderChoice, patient: Patient, responsible: Responsible) -> Message | None:
    """Say which letters the papers of an order cannot show; None if they can show all.

    Parameters
    ----------
    patient, responsible
        For the prescription, which names them.
    """
    terms = choice.terms
    texts = [choice.pseudonym, choice.material, *choice.own_materials.values()]
    texts += [terms.colour, terms.cover, terms.remarks, terms.lot]
    named = [patient.name, *vars(responsible).values()] if choice.prescription else []
    return letters_note([*texts, *named])


def programs_of(parts: Sequence[Part], choice: OrderChoice, path: Path) -> tuple[Path, ...]:
    """Return the programs of a router that `write_order` would write; none for other machines."""
    places = _all_places(parts, choice, path, overridden=False)
    return tuple(program for place in places for program in place.programs)


def require_no_other_programs(parts: Sequence[Part], choice: OrderChoice, path: Path) -> None:
    """Check that no files of an earlier program of the same order lie beside the new ones.

    Raises
    ------
    OutputError
        Naming those files.
    """
    if choice.milling is not None:
        for group in _groups(parts, choice):
            program = _program(path, _stem(path, _word(group), choice))
            require_no_other_program(program, choice.milling, choice.pseudonym)


def word_of(parts: Sequence[Part], choice: OrderChoice) -> str:
    """Return the word that each name has: left, right or pair; none where each has its own."""
    groups = _groups(parts, choice)
    return _word(groups[0]) if len(groups) == 1 else ""


def _groups(parts: Sequence[Part], choice: OrderChoice) -> list[Sequence[Part]]:
    """Return the parts of each file."""
    return [parts] if choice.block is not None else [[part] for part in parts]


def _all_places(
    parts: Sequence[Part], choice: OrderChoice, path: Path, overridden: bool
) -> list[ExportPaths]:
    return [_places(path, _word(group), choice, overridden) for group in _groups(parts, choice)]


def _word(group: Sequence[Part]) -> str:
    return str(group[0].side) if len(group) == 1 else "pair"


def _places(path: Path, word: str, choice: OrderChoice, overridden: bool) -> ExportPaths:
    """Return the paths of one export."""
    stem = _stem(path, word, choice)

    def named(wanted: bool, ending: str) -> Path | None:
        return path.with_name(stem + ending) if wanted else None

    return ExportPaths(
        path.with_name(stem + choice.suffix),
        named(choice.checks or overridden, CHECKS.ending),
        named(choice.job_sheet, JOB_SHEET.ending),
        named(choice.prescription, "-prescription.pdf"),
        () if choice.milling is None else program_paths(_program(path, stem), choice.milling),
        named(choice.milling is not None, SETUP_SHEET.ending),
        named(choice.milling is not None and choice.milling.both_sides, PIN_HOLES.ending),
        named(choice.outlines, OUTLINES.ending),
    )


def _stem(path: Path, word: str, choice: OrderChoice) -> str:
    """Return what the names of one export begin with; left, right or pair is part of it."""
    stem = path.stem if path.suffix.lower() == choice.suffix else path.name
    return "-".join([*(part for part in stem.split("-") if part not in _SIDE_WORDS), word])


def _program(path: Path, stem: str) -> Path:
    return path.with_name(stem + PROGRAM.ending)


def _patient_facts(patient: Patient) -> dict[str, str]:
    facts = {"name": patient.name, "born": patient.born, "visit": patient.visit}
    return {key: value for key, value in facts.items() if value}


def block_edges(block: Block) -> list[FloatArray]:
    """Return the edges of a block, to draw it.

    Returns
    -------
    list of (n, 3) float64, mm
        Polylines; the block has a corner at the origin, its length along +y and its width along +x.
    """
    length, width, height = block.sides_mm
    rings = [
        np.array([(0, 0, z), (width, 0, z), (width, length, z), (0, length, z), (0, 0, z)], float)
        for z in (0.0, height)
    ]
    return [*rings, *(np.stack(pair) for pair in zip(*(ring[:4] for ring in rings), strict=True))]
