"""Presenter of the export stage: makes, checks and exports the order; independent of widgets."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import UTC, date, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import numpy as np

from insole_core.cases.case_record import CaseRecord, FootRecord
from insole_core.cases.days import read_day
from insole_core.cases.order_note import OrderNote
from insole_core.errors import InsoleError
from insole_core.export.shop_order import OrderTerms, Release, ShopOrder
from insole_core.files.write_errors import is_there
from insole_core.formats.solid_content import merged
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.prescription.materials import MaterialTable
from insole_core.milling.machine import Machine
from insole_core.progress import Progress
from insole_core.solids.checks import Finding, Override, worst_findings
from insole_core.solids.export_rules import CheckName, ExportRules, Policy, read_rules
from insole_core.solids.nesting import Nest, closest_nest
from insole_core.solids.order import Part
from insole_core.solids.order_number import new_order_number
from insole_core.solids.prescription_paper import Responsible
from insole_core.solids.shop import Block, Shop
from insole_core.workflows.clinic_tables import ClinicBlocks, ClinicExportRules
from insole_core.workflows.last_order import LastOrder
from insole_core.workflows.make_order import (
    OrderChoice,
    Package,
    block_edges,
    feet_of,
    files_of,
    letters_told,
    make_parts,
    prescribed_alone,
    programs_of,
    require_no_other_programs,
    word_of,
    write_order,
)
from insole_core.workflows.mill import MillingChoice
from insole_core.workflows.named_files import NamedFiles
from insole_core.workflows.order_package import (
    Ordered,
    PackedItem,
    files_of_package,
    write_package,
)
from insole_core.workflows.overwriting import check_overwriting
from insole_core.workflows.print_order import PrintChoice
from insole_core.workflows.starting_design import StartingDevice
from insole_studio.document.case import Case
from insole_studio.features.export.machine_presenter import MachineAsker, MachinePresenter
from insole_studio.features.export.rows import (
    TITLES,
    Buttons,
    ToldOnPapers,
    check_row,
    notes_of,
    nothing_told,
    ordered_foot,
    patient_text,
    sentence_of,
    side_text,
    summary_of,
    summary_of_nest,
)
from insole_studio.jobs import JobProgress, Jobs
from insole_studio.texts import tr, translate_core_message

if TYPE_CHECKING:
    from insole_studio.features.export.view import ExportView

MAKING, WRITING = "make", "write"
_NO_SPOTS = np.zeros((0, 3))
_NEST = "nest"


class OrderAsker(MachineAsker, Protocol):
    """Asks the user for what an order needs, on the window of the stage."""

    def path(self, pseudonym: str, word: str, suffix: str) -> Path | None:
        """Let the user choose a file, given the word for the side, if any; None if cancelled."""

    def package_path(self, number: str, package: Package) -> Path | None:
        """Let the user choose where an order of a number is written; None if cancelled."""

    def may_replace(self, paths: Sequence[Path]) -> bool:
        """Ask whether existing files may be overwritten."""

    def blocks(self, own: Sequence[Block], stock: Sequence[Block]) -> tuple[Block, ...] | None:
        """Let the user edit the clinic's own blocks; None if cancelled."""

    def responsible(self) -> Responsible:
        """Return who prescribes and makes, as far as it is known."""

    def ask_responsible(self) -> bool:
        """Let the user say who prescribes and makes; False if cancelled."""

    def ask_missing(self) -> bool:
        """Ask for what a prescription lacks, if anything; False if cancelled."""

    def when_newest(self, then: Callable[[], None]) -> None:
        """Go on where nothing newer is stored elsewhere; if it is, offer to open it."""


class ExportPresenter:
    """Makes the order again whenever order, rules or case change, and exports it.

    Parameters
    ----------
    panel
        The export panel.
    case
        The open case.
    jobs
        Runs long computations.
    rules
        Storage of the clinic's rules.
    materials
        Of the clinic, for the warnings of the design.
    shop
        The workshop that receives the order.
    blocks
        Storage of the clinic's own blocks.
    asker
        Asks for what the order needs, and tells of a failure.
    memory
        Storage of the last order.
    machines
        Storage of the routers.
    exported
        Called with the exported record and what was ordered.
    drawn
        The insole as the design shows it, until the piece is made.
    told
        Returns what was ticked to stand on the papers of a case.
    starting
        Returns the device that new prescriptions begin with.
    """

    def __init__(
        self,
        panel: ExportView,
        *,
        case: Case,
        jobs: Jobs,
        rules: ClinicExportRules,
        materials: MaterialTable,
        shop: Shop,
        blocks: ClinicBlocks,
        asker: OrderAsker,
        memory: LastOrder,
        machines: NamedFiles[Machine],
        exported: Callable[[CaseRecord, Ordered], None],
        drawn: TriangleMesh | None = None,
        told: ToldOnPapers = nothing_told,
        starting: Callable[[], StartingDevice],
    ) -> None:
        self._panel, self._case, self._jobs = panel, case, jobs
        self._store, self._materials, self._shop = rules, materials, shop
        self._block_store, self._asker, self._exported = blocks, asker, exported
        self._memory, self._told, self._starting = memory, told, starting
        self._own_blocks: tuple[Block, ...] = ()
        self._choice, self._new_number, self._begins_order = memory.load(), "", False
        self._rules = read_rules()
        self._record = CaseRecord()
        self.parts: tuple[Part, ...] = ()
        """The parts made last."""
        self._nest: Nest | None = None
        """Where a pair lies in its block."""
        self._shown = ""
        self._framed = ("", "")
        """What the camera was last fitted to."""
        self._chosen: CheckName | None = None
        self._written = ""
        """What was exported, told until the order is changed or another part is looked at."""
        self._reason = self._problem = self._refused_day = ""
        """Why it is exported all the same, why it is not made, and why its day cannot be right."""
        self._is_case_left = False
        self._complaint = ""
        """Why the clinic's rules could not be read."""
        self._machine = MachinePresenter(
            panel.form,
            jobs=jobs,
            machines=machines,
            shop=shop,
            asker=asker,
            choose=self._choose_machine,
            changed=self._show_prepared,
        )
        panel.choice_edited.connect(self.edit_choice)
        panel.order_chosen.connect(self.choose_order)
        panel.material_edited.connect(self.edit_material)
        panel.blocks_requested.connect(self.edit_blocks)
        panel.deliver_on_edited.connect(self.edit_deliver_on)
        panel.responsible_requested.connect(asker.ask_responsible)
        panel.cutter_edited.connect(self.edit_cutter)
        panel.rule_edited.connect(self.edit_rule)
        panel.check_chosen.connect(self.lead_to)
        panel.part_chosen.connect(self.choose_part)
        panel.reason_edited.connect(self.edit_reason)
        panel.export_requested.connect(self.ask_export)
        panel.cancel_requested.connect(self.cancel)
        jobs.progressed.connect(self._show_progress)
        jobs.ended.connect(self._show_buttons)
        case.opened.connect(self._begin_order)
        case.changed.connect(self._follow)
        case.foot_changed.connect(self._follow_foot)
        panel.show_part(None, None, None, False)
        panel.show_notes([])
        panel.show_error("")
        self._load_rules()
        self._load_blocks()
        self._begin_order()
        self.remake()
        self._show_drawn(drawn)

    def close(self) -> None:
        """Stop observing the case; what is being written is finished. May be called again."""
        if self._is_case_left:
            return
        self._is_case_left = True
        self._case.opened.disconnect(self._begin_order)
        self._case.changed.disconnect(self._follow)
        self._case.foot_changed.disconnect(self._follow_foot)

    def edit_choice(self, choice: OrderChoice) -> None:
        """Set the order; changes that concern only files and documents do not make it again."""
        if self._is_case_left:
            return  # a field lets go of what was typed as its window closes
        before, self._choice, self._written = self._choice, choice, ""
        if choice.terms != before.terms:
            self._case.note_order(replace(self._case.record.order, terms=choice.terms))
        same_maker = _maker(choice) == _maker(before)
        if choice.makes_alike(before) and same_maker and not self._problem:
            self._show_order()
            if (choice.printing, choice.milling) != (before.printing, before.milling):
                self._prepare()
        else:
            self.remake()

    def choose_order(self, is_new: bool) -> None:
        """Choose between a revision of the order that was exported last, and a new order."""
        self._begins_order, self._written = is_new, ""
        self._show_release()
        self._number_again()

    def _number_again(self) -> None:
        """Make the pieces again where they carry the number of an order or a revision before."""
        if self._choice.relief is not None and self._choice.numbered:
            self._make()

    def edit_material(self, side: Side, material: str) -> None:
        """Set what a foot's insole is made of; another foot without a material gets it too."""
        foot = self._record.of_side(side)
        own = {**self._choice.own_materials, side: material}
        choice = replace(self._choice, own_materials=own)
        if foot is not None and foot.design.shell is None:
            choice = replace(choice, material=material)
        self.edit_choice(choice)

    def edit_deliver_on(self, text: str) -> None:
        """Set the delivery date; one that cannot be right is told, and keeps from exporting."""
        if self._is_case_left:
            return  # the field lets go of what was typed as its window closes
        today = date.today()
        try:
            day = read_day("visit", text, today)
            terms = replace(self._choice.terms, deliver_on=date.fromisoformat(day) if day else None)
            terms.check(today)
        except InsoleError as error:
            self._refused_day = str(error)
            self._panel.show_error(self._refused_day)
            self._show_buttons()
            return
        if self._refused_day:
            self._refused_day = ""
            self._panel.show_error(self._problem)
        self.edit_choice(replace(self._choice, terms=terms))
        self._show_buttons()

    def edit_blocks(self) -> None:
        """Let the user edit the clinic's own blocks; one that is new is chosen."""
        before = self._own_blocks
        blocks = self._asker.blocks(before, self._shop.blocks)
        if blocks is None or blocks == before:
            return
        try:
            self._block_store.save(blocks)
        except InsoleError as error:
            self._asker.tell(error)
            return
        self._own_blocks = blocks
        self._panel.show_blocks(self._blocks)
        self.edit_choice(replace(self._choice, block=self._block_after(before)))

    def edit_cutter(self, diameter_mm: float) -> None:
        """Set the diameter of the cutter."""
        self._keep_rules(self._rules.with_cutter(diameter_mm))

    def edit_rule(self, name: CheckName, policy: Policy, limit: float) -> None:
        """Set policy and limit of a check.

        Parameters
        ----------
        name
            The check.
        policy
            How strictly it is applied.
        limit
            In the unit of the check; ignored by checks without a limit.
        """
        has_limit = name in self._rules.limits
        self._keep_rules(self._rules.with_rule(name, policy, limit if has_limit else None))

    def edit_reason(self, reason: str) -> None:
        """Set the reason for exporting despite a blocking check."""
        self._reason = reason.strip()
        self._show_buttons()

    def _show_drawn(self, mesh: TriangleMesh | None) -> None:
        """Show the insole as it is designed, as long as there is no piece to be seen."""
        is_made = self._record.current in feet_of(self._record, self._choice)
        if mesh is not None and self._choice.kind == "insole" and is_made:
            self._panel.show_part(mesh, self._case.foot, self._case.side, False)
            self._panel.show_summary(tr("As it is designed; the piece is being made."))

    def remake(self) -> None:
        """Make and check the order, which has changed, in the background."""
        self._written = ""
        self._make()

    def _make(self) -> None:
        self._record, self._problem = self._case.record, ""
        self._panel.show_patient(patient_text(self._record.patient))
        self._show_order()
        cutter_mm = _cutter_mm(self._choice)
        self._panel.form.show_cutter(
            cutter_mm or self._rules.cutter_diameter_mm, is_of_router=cutter_mm is not None
        )
        if self._record.current is None:
            self._take(())
            return
        record, choice, rules = self._record, self._order, self._rules
        materials = self._materials
        rules = rules.for_maker(cutter_mm, is_printed=choice.printing is not None)
        self._machine.forget()

        told = self._told(record)

        def make(progress: Progress) -> tuple[Part, ...]:
            parts = make_parts(record, choice, rules, progress, materials=materials)
            return tuple(replace(part, told=told.get(part.side, ())) for part in parts)

        self._panel.show_error(self._complaint)
        self._jobs.start(MAKING, make, self._take, self._show_nothing)
        self._show_checks()
        self._show_buttons()

    def choose_part(self, key: str) -> None:
        """Show another part, and what it is."""
        self._written = ""
        self.show_part(key)

    def show_part(self, key: str) -> None:
        """Show the left part, the right part, or both in their block."""
        again, self._shown = (key, self._choice.kind) == self._framed, key
        self._framed = (key, self._choice.kind) if self.parts else ("", "")
        block, nest = self._choice.block, self._nest
        if key == _NEST and block is not None and nest is not None:
            placed = self._machine.placed_in_block(self.parts, nest.insole2block)
            colors = self._machine.colors_together(
                {part.side: where for part, where in zip(self.parts, placed, strict=True)}
            )
            both = merged(nest.meshes) if colors is None else colors.mesh
            self._panel.show_part(both, None, None, again, colors)
            self._panel.show_block(block_edges(block), again)
            self._panel.show_summary(self._written or summary_of_nest(nest))
        else:
            part = self._part
            solid, side = (None, None) if part is None else (part.solid, part.side)
            turned = side is not None and self._choice.kind == "positive"
            words = side.other if side is not None and turned else side
            self._panel.show_block([], True)
            colors = None if side is None else self._machine.colors(side)
            mesh = solid if colors is None else colors.mesh
            record = None if side is None else self._record.of_side(side)
            foot = None if record is None else record.foot
            self._panel.show_part(mesh, foot, words, again, colors)
            self._panel.show_summary(self._written or ("" if part is None else summary_of(part)))
        self._show_spots()
        self._show_checks()

    def lead_to(self, name: CheckName) -> None:
        """Show the location where a check is violated most."""
        finding = self._findings.get(name)
        if finding is not None and finding.place_mm is not None:
            self._chosen = name
            self._show_spots()
            self._panel.look_at(np.array(finding.place_mm), sentence_of(finding))

    def ask_export(self) -> None:
        """Let the user choose a file, and export."""
        self._panel.read_day()
        if not self._refused_day:
            self._asker.when_newest(self._ask_export)

    def _ask_export(self) -> None:
        order = self._order
        try:
            order.terms.check(date.today())
        except InsoleError as error:
            self._asker.tell(error)
            return
        if order.package:
            self._ask_package(order.package)
            return
        if order.prescription and not self._asker.ask_missing():
            return
        path = self._asker.path(order.pseudonym, word_of(self.parts, order), order.suffix)
        if path is None:
            return
        try:
            require_no_other_programs(self.parts, order, path)
        except InsoleError as error:
            self._asker.tell(error)
            return
        files = files_of(self.parts, order, path, self._override() is not None)
        there = [file for file in files if is_there(file)]
        if not there or self._asker.may_replace(there):
            self.export_to(path)

    def _ask_package(self, package: Package) -> None:
        """Let the user choose where the order is written, and write it."""
        path = self._asker.package_path(self._release.number, package)
        if path is not None and (not is_there(path) or self._asker.may_replace([path])):
            self.export_package_to(path)

    def export_package_to(self, path: Path) -> None:
        """Write the order with all its files as one folder or archive, in the background."""
        record, choice, release = self._record, self._order, self._release
        item = PackedItem(
            self.parts, choice, record.patient, {}, self._override(), self._machine.made
        )
        clinic = self._asker.responsible().clinic

        def write(progress: Progress) -> ShopOrder:
            check_overwriting((path,), record.source_paths)
            return write_package(
                [item], path,
                number=release.number, revision=release.revision, released_by=release.by,
                shop=self._shop, now=datetime.now().astimezone(), clinic=clinic,
                translate=translate_core_message, progress=progress,
            )  # fmt: skip

        def done(order: ShopOrder) -> None:
            paths, state = files_of_package(path, order), order.release
            ordered = Ordered(paths, choice.terms, state.number, state.revision)
            self._tell_written(record, choice, (path,), ordered)

        self._panel.show_error("")
        self._jobs.start(WRITING, write, done, self._fail)
        self._show_buttons()

    def export_to(self, path: Path) -> None:
        """Write the file and its documents in the background."""
        record, parts, choice = self._record, self.parts, self._order
        override, responsible = self._override(), self._asker.responsible()
        made, release = self._machine.made, self._release

        files = files_of(parts, choice, path, override is not None)

        def write(progress: Progress) -> tuple[Path, ...]:
            check_overwriting(files, record.source_paths)
            return write_order(
                parts, choice, path,
                shop=self._shop, patient=record.patient, responsible=responsible,
                override=override, made=made, release=release, translate=translate_core_message,
                progress=progress,
            )  # fmt: skip

        def done(paths: tuple[Path, ...]) -> None:
            shown = (*paths, *programs_of(parts, choice, path))
            papers = tuple(file for file in files if file not in shown)
            number, revision = release.number, release.revision
            ordered = Ordered(shown, choice.terms, number, revision, papers)
            self._tell_written(record, choice, shown, ordered)

        self._panel.show_error("")
        self._jobs.start(WRITING, write, done, self._fail)
        self._show_buttons()

    def _tell_written(
        self, record: CaseRecord, choice: OrderChoice, shown: Sequence[Path], ordered: Ordered
    ) -> None:
        names = ", ".join(written.name for written in shown)
        self._written = tr("Exported {name}").format(name=names)
        self._panel.show_summary(self._written)
        self._remember(choice)
        exported = record if self._is_case_left else self._noted(record, choice.pseudonym, ordered)
        self._exported(exported, ordered)

    def _noted(self, record: CaseRecord, pseudonym: str, ordered: Ordered) -> CaseRecord:
        """Keep in the case what the workshop knows it by; return the record that was exported."""
        is_current = self._case.record.holds_the_same(record)
        terms = self._case.record.order.terms  # perhaps edited while the files were written
        self._case.note_order(OrderNote(ordered.number, ordered.revision, terms))
        self._number_order()
        patient = replace(self._case.record.patient, pseudonym=pseudonym)
        if patient != self._case.record.patient:
            self._case.apply(patient, tr("Note the order number"))
            self._choice = replace(self._choice, pseudonym=pseudonym)
            self._show_order()
        self._number_again()
        return self._case.record if is_current else record

    def _remember(self, choice: OrderChoice) -> None:
        try:
            self._memory.save(choice)
        except InsoleError as error:
            self._panel.show_error(str(error))

    def cancel(self) -> None:
        """Cancel the running job; nothing is written."""
        if self._jobs.is_running(MAKING):
            self._problem = tr("Stopped. Change the order to make it again.")
            self._panel.show_error(self._problem)
        self._machine.cancel()
        self._jobs.cancel(MAKING)
        self._jobs.cancel(WRITING)

    @property
    def _order(self) -> OrderChoice:
        """The choice with the order number in place of a pseudonym that is missing."""
        release = self._release
        known = self._choice.pseudonym or release.number
        return replace(self._choice, pseudonym=known, release=release)

    @property
    def _release(self) -> Release:
        """Number and revision that the next export has."""
        last = self._case.record.order
        if last.number and not self._begins_order:
            return last.revised(self._case.author)
        return Release(self._new_number, by=self._case.author)

    @property
    def _blocks(self) -> tuple[Block, ...]:
        """The blocks to choose from."""
        return (*self._shop.blocks, *self._own_blocks)

    def _block_after(self, before: Sequence[Block]) -> Block | None:
        """Return the block to choose after an edit: a new one, or as before by its name."""
        known = {block.name for block in before}
        new = [block for block in self._own_blocks if block.name not in known]
        chosen = self._choice.block
        if len(self._own_blocks) > len(before) and new:
            return new[-1]
        return next((b for b in self._blocks if chosen and b.name == chosen.name), None)

    def _begin_order(self) -> None:
        """Begin an order for the open case: nothing of the patient before is kept."""
        record = self._record = self._case.record
        alone = prescribed_alone(record, self._starting())
        self._number_order()
        self._reason, self._refused_day = "", ""
        self._panel.forget_day()
        self._choice = replace(
            self._choice,
            both=len(record.feet) == 2 and alone is None,
            alone=alone,
            pseudonym=record.patient.pseudonym,
            text="",
            own_materials={},
            printing=self._choice.printing and replace(self._choice.printing, weight_kg=None),
            terms=record.order.terms.from_day(date.today()),
        )

    def _number_order(self) -> None:
        """Draw a number for a new order; what is exported again is a revision of the last one."""
        self._new_number, self._begins_order = new_order_number(date.today()), False
        self._show_release()

    def _show_release(self) -> None:
        record = self._case.record
        revised = record.order.revised() if record.order.number else None
        self._panel.show_release(
            self._release, revised, self._new_number, is_sample=record.patient.is_sample
        )

    def _follow_foot(self) -> None:
        """Make the order again; of one foot the one that was switched to now."""
        if self._case.side is not self._record.at_hand:
            self._choice = replace(self._choice, alone=None)
        self.remake()

    def _follow(self) -> None:
        """Make the order again unless only what does not shape it has changed."""
        record, before = self._case.record, self._record
        if record.order.revised() != before.order.revised():
            self._show_release()
        if record.order.terms != before.order.terms:
            self._take_terms(record.order.terms)
        if record.feet is before.feet and record.at_hand is before.at_hand:
            self._record = record
            self._panel.show_patient(patient_text(record.patient))
            self._take_pseudonym(before.patient.pseudonym, record.patient.pseudonym)
            if record.order != before.order:
                self._number_again()
            return
        own = {
            side: material
            for side, material in self._choice.own_materials.items()
            if _prescribed_material(record, side) == _prescribed_material(before, side)
        }
        self._choice = replace(self._choice, own_materials=own)
        self.remake()

    def _take_pseudonym(self, before: str, now: str) -> None:
        """Order under the patient's other pseudonym, as after a merge, but for one typed here."""
        if now and now != before and self._choice.pseudonym == before:
            self.edit_choice(replace(self._choice, pseudonym=now))
            self._show_order()

    def _take_terms(self, terms: OrderTerms) -> None:
        """Show terms that were changed elsewhere; those that were edited here are shown already."""
        taken = terms.from_day(date.today())
        if taken != self._choice.terms:
            self._choice = replace(self._choice, terms=taken)
            self._show_order()

    def _show_notes(self) -> None:
        """Show what is unusual about the pieces, and what their papers cannot show."""
        left_out = self._left_out()
        letters = letters_told(self._order, self._record.patient, self._asker.responsible())
        notes = [] if letters is None else [translate_core_message(letters)]
        self._panel.show_notes([*left_out, *notes_of(self.parts), *notes])

    def _left_out(self) -> list[str]:
        """Say that one of two feet is not made: nobody would see it on its archive."""
        if not self._has_pair or self._choice.both:
            return []
        alone = {
            Side.LEFT: tr("The left foot alone is made; “Both feet” makes the right one too."),
            Side.RIGHT: tr("The right foot alone is made; “Both feet” makes the left one too."),
        }
        return [alone[foot.side] for foot in feet_of(self._record, self._choice)]

    def _show_order(self) -> None:
        self._panel.show_choice(self._choice, self._has_pair)
        self._show_notes()
        feet = feet_of(self._record, self._choice)
        self._panel.show_feet([ordered_foot(self._choice, foot.design) for foot in feet])
        self._panel.form.machine.show_prescribed_weight(_prescribed_weight(feet))

    def _prepare(self) -> None:
        """Make the zones or the tool paths of the parts."""
        parts = self.parts if self._misfit is None else ()
        self._machine.prepare(parts, self._order, feet_of(self._record, self._choice))
        self._show_prepared()

    def _show_prepared(self) -> None:
        self.show_part(self._shown)
        self._show_buttons()

    def _choose_machine(self, chosen: PrintChoice | MillingChoice | None) -> None:
        """Order for another printer or router; a printer's program gets a 3MF."""
        printing = chosen if isinstance(chosen, PrintChoice) else None
        milling = chosen if isinstance(chosen, MillingChoice) else None
        choice = replace(self._choice, printing=printing, milling=milling)
        if choice == self._choice:  # the file of that name may have changed
            self._prepare()
        else:
            self.edit_choice(choice)

    @property
    def _has_pair(self) -> bool:
        return len(self._record.feet) == 2

    @property
    def _part(self) -> Part | None:
        """The part being shown; for the block, the first."""
        named = (part for part in self.parts if str(part.side) == self._shown)
        return next(named, self.parts[0] if self.parts else None)

    @property
    def _findings(self) -> dict[CheckName, Finding]:
        """The findings of what is shown; for the block, the worse of both parts."""
        if self._part is None:
            return {}
        findings = self._part.findings
        if self._shown == _NEST and self._nest is not None:
            placed = self._machine.placed_in_block(self.parts, self._nest.insole2block)
            findings = worst_findings(
                finding.moved(insole2block)
                for part, insole2block in zip(self.parts, placed, strict=True)
                for finding in part.findings
            )
        return {finding.name: finding for finding in findings}

    @property
    def _misfit(self) -> Finding | None:
        """The finding that a pair does not fit its block, which no reason can release."""
        if self._nest is None:
            return None
        return next((f for f in self.parts[0].findings if f.name == "block" and f.blocks), None)

    def _load_rules(self) -> None:
        try:
            self._rules = self._store.load()
        except InsoleError as error:
            self._complaint = str(error)

    def _load_blocks(self) -> None:
        try:
            self._own_blocks = self._block_store.load()
        except InsoleError as error:
            self._complaint = str(error)
        self._panel.show_blocks(self._blocks)

    def _keep_rules(self, rules: ExportRules) -> None:
        if rules == self._rules:
            return
        self._rules, self._complaint = rules, ""
        try:
            self._store.save(rules)
        except InsoleError as error:
            self._complaint = str(error)
        self.remake()

    def _take(self, parts: tuple[Part, ...]) -> None:
        self.parts = parts
        block = self._choice.block
        is_nested = len(parts) == 2 and block is not None
        self._nest = None
        if is_nested and block is not None:
            self._nest = closest_nest(*(part.solid for part in parts)).in_middle_of(block.size_mm)
        names = {str(part.side): side_text(part) for part in parts}
        if is_nested:
            names[_NEST] = tr("In the block")
        if self._misfit is not None:
            names[_NEST] += "  ✗"
            self._panel.show_error(self._misfit.sentence)
        shown = self._shown if self._shown in names else next(iter(names), "")
        self._panel.show_parts(names, shown)
        self._show_notes()
        self._shown = shown
        self._prepare()

    def _show_spots(self) -> None:
        findings = self._findings
        bad = [f.spots_mm for f in findings.values() if not f.passed and f.name != self._chosen]
        chosen = findings.get(self._chosen) if self._chosen else None
        if chosen is None:
            self._panel.forget_label()
        self._panel.show_spots(
            np.concatenate([_NO_SPOTS, *bad]), _NO_SPOTS if chosen is None else chosen.spots_mm
        )

    def _show_checks(self) -> None:
        waiting = self._jobs.is_running(MAKING)
        self._panel.show_checks(
            [
                check_row(
                    name,
                    self._rules,
                    self._choice.kind,
                    None if waiting else self._findings.get(name),
                    waiting=waiting,
                    has_block=self._choice.block is not None,
                )
                for name in TITLES
            ]
        )

    def _override(self) -> Override | None:
        if not self._blocked or not self._reason:
            return None
        now = datetime.now(UTC).isoformat(timespec="seconds")
        return Override(self._case.author or tr("unknown"), self._reason, now)

    @property
    def _blocked(self) -> bool:
        """Whether a rule stops the export until somebody gives a reason."""
        return any(
            finding.blocks and not (finding.name == "block" and self._nest is not None)
            for part in self.parts
            for finding in part.findings
        )

    def _show_nothing(self, error: Exception) -> None:
        """Show why the order cannot be made."""
        self._problem = str(error)
        self._take(())
        sentence = tr("Something unexpected happened; nothing was written. Please report it.")
        self._panel.show_error(str(error) if isinstance(error, InsoleError) else sentence)
        self._show_buttons()

    def _fail(self, error: Exception) -> None:
        """Tell once why nothing was written, where it cannot be overlooked."""
        self._asker.tell(error)
        self._show_buttons()

    def _show_progress(self, news: JobProgress) -> None:
        self._panel.show_progress(news.fraction, news.text)

    def _show_buttons(self, _channel: str = MAKING) -> None:
        busy = self._jobs.is_running()
        if not busy:
            self._panel.show_progress(0.0, "")
        complaint = self._problem or self._refused_day
        may = (not self._blocked or bool(self._reason)) and self._misfit is None
        self._panel.show_buttons(
            Buttons(
                export=not busy and self._machine.made is not None and may and not complaint,
                cancel=busy,
                reason=self._blocked,
            )
        )


def _maker(choice: OrderChoice) -> tuple[bool, float | None]:
    """Return on what the checks of an order depend."""
    return choice.printing is not None, _cutter_mm(choice)


def _cutter_mm(choice: OrderChoice) -> float | None:
    """Return the diameter of the router's cutter that reaches into hollows; None without one."""
    return None if choice.milling is None else choice.milling.machine.finishing.cutter.diameter_mm


def _prescribed_weight(feet: Sequence[FootRecord]) -> float | None:
    """Return the first body weight that a prescription states."""
    shells = [foot.design.shell for foot in feet if foot.design.shell is not None]
    return next((s.body_weight_kg for s in shells if s.body_weight_kg is not None), None)


def _prescribed_material(record: CaseRecord, side: Side) -> str:
    foot = record.of_side(side)
    shell = None if foot is None else foot.design.shell
    return "" if shell is None else shell.material
