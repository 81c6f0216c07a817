"""Prepares an order for its printer or router, and keeps the clinic's routers."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import numpy as np

from insole_core.cases.case_record import FootRecord
from insole_core.errors import InsoleError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid, transform
from insole_core.insole.elements.words import duration_message
from insole_core.insole.prescription.item_name import key_of
from insole_core.milling.machine import Machine
from insole_core.milling.plan import MillingPlan
from insole_core.progress import Progress
from insole_core.solids.export_job import Printing
from insole_core.solids.order import Part
from insole_core.solids.shop import Shop
from insole_core.workflows.make_order import MadeFor, OrderChoice, prepare
from insole_core.workflows.mill import MillingChoice
from insole_core.workflows.named_files import NamedFiles
from insole_core.workflows.print_order import PrintChoice, pressure_maps
from insole_studio.features.export.machine_fields import Machines
from insole_studio.features.export.part_colors import PartColors, colors_of, placed_together
from insole_studio.jobs import Jobs
from insole_studio.texts import fill, tr, translate_core_message

if TYPE_CHECKING:
    from insole_studio.features.export.order_form import OrderForm

PREPARING = "prepare"


class MachineAsker(Protocol):
    """Asks the user for files of machines and zones, and tells of a failure."""

    def machine_file(self) -> Path | None:
        """Let the user choose the file of a router; None if cancelled."""

    def machine_file_to_write(self, name: str) -> Path | None:
        """Let the user choose where to save the file of a router; None if cancelled."""

    def zones_file(self) -> Path | None:
        """Let the user choose a file of zones; None if cancelled."""

    def tell(self, error: Exception) -> None:
        """Tell that something has failed."""


class MachinePresenter:
    """Makes zones or tool paths of the parts whenever they change, and tells what comes of it.

    Parameters
    ----------
    form
        Of the order, with the fields of the machine.
    jobs
        Runs long computations.
    machines
        Storage of the routers.
    choose
        Called with a print or a router that takes the place of what is chosen.
    changed
        Called when something is prepared, or has failed.
    """

    def __init__(
        self,
        form: OrderForm,
        *,
        jobs: Jobs,
        machines: NamedFiles[Machine],
        shop: Shop,
        asker: MachineAsker,
        choose: Callable[[PrintChoice | MillingChoice | None], None],
        changed: Callable[[], None],
    ) -> None:
        self._form, self._fields, self._jobs, self._shop = form, form.machine, jobs, shop
        self._store, self._asker = machines, asker
        self._choose, self._changed = choose, changed
        self._colors: dict[Side, PartColors] = {}
        self.made: MadeFor | None = None
        """What is prepared of the parts made last; None until it is."""
        self._unreadable: tuple[str, ...] = ()
        fields = self._fields
        fields.zones_file_requested.connect(self.ask_zones_file)
        fields.machine_file_requested.connect(self.add_machine)
        fields.machine_export_requested.connect(self.export_machine)
        fields.machine_removal_requested.connect(self.remove_machine)
        self._load()

    def forget(self) -> None:
        """Stop, and forget what was prepared."""
        self._jobs.cancel(PREPARING)
        self.made, self._colors = None, {}
        self._form.show_outcome([], self._unreadable)

    def prepare(
        self, parts: Sequence[Part], choice: OrderChoice, feet: Sequence[FootRecord]
    ) -> None:
        """Make the zones or the tool paths of parts in the background."""
        self.forget()
        if not parts:
            return
        if choice.printing is None and choice.milling is None:
            self.made = MadeFor()
            return
        shop, maps = self._shop, pressure_maps(feet)

        def task(progress: Progress) -> tuple[MadeFor, dict[Side, PartColors]]:
            made = prepare(parts, choice, shop, maps, progress.part(0.0, 0.9))
            progress.step(0.9, "Drawing the piece")
            return made, colors_of(parts, made)

        self._jobs.start(PREPARING, task, self._take, self._fail)

    def cancel(self) -> None:
        """Stop; the order cannot be exported until something is changed."""
        if self._jobs.is_running(PREPARING):
            self._jobs.cancel(PREPARING)
            self._form.show_outcome([], [tr("Stopped. Change the order to make it again.")])
            self._changed()

    def colors(self, side: Side) -> PartColors | None:
        """Return the colours of a part; None while it has none."""
        return self._colors.get(side)

    def placed_in_block(
        self, parts: Sequence[Part], insole2block: Sequence[FloatArray]
    ) -> Sequence[FloatArray]:
        """Return where the parts lie in the block: as they are milled, else as they are nested."""
        plan = None if self.made is None else self.made.milling
        if plan is None:
            return insole2block
        return [
            rigid(np.eye(3), milled.vertices[0] - transform(nested, part.solid.vertices[0]))
            @ nested
            for part, milled, nested in zip(parts, plan.solids, insole2block, strict=True)
        ]

    def colors_together(self, insole2block: Mapping[Side, FloatArray]) -> PartColors | None:
        """Return the parts in their colours where they lie in a block."""
        return placed_together(self._colors, insole2block)

    def ask_zones_file(self) -> None:
        """Let the user choose a file of zones."""
        path, chosen = self._asker.zones_file(), self._fields.printing()
        if path is not None and chosen is not None:
            self._choose(replace(chosen, file=str(path)))

    def add_machine(self) -> None:
        """Let the user choose a machine file, keep it, and choose the machine."""
        path = self._asker.machine_file()
        if path is None:
            return
        try:
            machine = self._store.read(path)
            self._store.save(machine)
        except InsoleError as error:
            self._form.show_outcome([], [str(error)])
            return
        self._load()
        self._choose(MillingChoice(machine, self._fields.both_sides.isChecked()))

    def export_machine(self, machine: Machine) -> None:
        """Let the user save the file of a machine, to edit it."""
        path = self._asker.machine_file_to_write(machine.name)
        if path is None:
            return
        try:
            self._store.export(machine, path)
        except InsoleError as error:
            self._asker.tell(error)

    def remove_machine(self, machine: Machine) -> None:
        """Remove a machine of the clinic; that of the product of its name comes back."""
        try:
            self._store.remove(machine.name)
        except InsoleError as error:
            self._asker.tell(error)
            return
        left = self._load().items.get(key_of(machine.name))
        both = self._fields.both_sides.isChecked()
        self._choose(None if left is None else MillingChoice(left, both))

    def _load(self) -> Machines:
        listed = self._store.load()
        self._unreadable = listed.unreadable
        machines = Machines(listed.items, listed.own)
        self._fields.show_machines(machines)
        self._form.show_outcome([], self._unreadable)
        return machines

    def _take(self, prepared: tuple[MadeFor, dict[Side, PartColors]]) -> None:
        self.made, self._colors = prepared
        facts: list[str] = []
        notes: tuple[str, ...] = ()
        if self.made.milling is not None:
            facts, notes = _facts_of_program(self.made.milling), self.made.milling.notes
        elif self.made.printing is not None:
            facts, notes = _facts_of_print(self.made.printing), self.made.printing.notes
        self._form.show_outcome(facts, [*notes, *self._unreadable])
        self._changed()

    def _fail(self, error: Exception) -> None:
        """Tell beside the fields what is wrong; a fault is told by the dialog."""
        if isinstance(error, InsoleError):
            self._form.show_outcome([], [str(error), *self._unreadable])
        else:
            self._asker.tell(error)
        self._changed()


def _facts_of_print(printing: Printing) -> list[str]:
    """Return the shell of a print, and how dense and heavy its zones become."""
    made = next(iter(printing.zoned.values())).printed
    text = tr("{walls} walls, {top} layers above and {bottom} below")
    said = [fill(text, walls=made.walls, top=made.top_layers, bottom=made.bottom_layers)]
    for side, densities in printing.densities.items():
        if len(printing.densities) > 1:
            said.append(tr("Left") if side is Side.LEFT else tr("Right"))
        for name, density in densities.facts.items():
            said.append(f"{translate_core_message(name)}: {translate_core_message(density)}")
    return said


def _facts_of_program(plan: MillingPlan) -> list[str]:
    """Return what is told before a program is used."""
    way = tr("{time} without changes of cutters, {length:.0f} m of path")
    left = tr("At most {left:.2f} mm of material stay in hollows")
    return [
        fill(
            way, time=translate_core_message(duration_message(plan.minutes)), length=plan.length_m
        ),
        fill(left, left=plan.most_left_mm),
    ]
