"""The rows of the order that say which printer or router it is for, and what that one needs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import cast

from PySide6.QtCore import QObject, QSignalBlocker, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QCheckBox, QFormLayout, QMenu, QPushButton, QWidget

from insole_core.formats.slicer_3mf import PRINTER_NAMES, PRINTERS, Printer
from insole_core.insole.prescription.item_name import key_of
from insole_core.insole.prescription.materials import WEIGHT
from insole_core.milling.machine import Machine
from insole_core.solids.print_presets import (
    LEAST_PERCENT,
    MOST_PERCENT,
    USUAL_WEIGHT_KG,
    PrintPreset,
)
from insole_core.visible_text import visible_line
from insole_core.workflows.mill import MillingChoice
from insole_core.workflows.print_order import PrintChoice, ZoneSource
from insole_studio.texts import fill, tr, translate_core_message
from insole_studio.widgets.form_parts import ComboBox
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.number_field import NumberField

_ROUTER = "router "


@dataclass(frozen=True)
class Machines:
    """The routers to choose from, by their keys.

    Parameters
    ----------
    own
        Keys of those of the clinic, which can be removed.
    """

    items: dict[str, Machine]
    own: frozenset[str]


class MachineFields(QObject):
    """Shows a `PrintChoice` or a `MillingChoice`, and tells when the user edits it."""

    edited = Signal()
    zones_file_requested = Signal()
    machine_file_requested = Signal()
    machine_export_requested = Signal(object)
    """Emitted with the chosen `Machine`, as the one below."""
    machine_removal_requested = Signal(object)

    def __init__(self, presets: Sequence[PrintPreset], parent: QWidget) -> None:
        super().__init__(parent)
        self._machines = Machines({}, frozenset())
        self._print = PrintChoice()
        self._prescribed_kg: float | None = None
        self.made_on = ComboBox([])
        self.made_on.setToolTip(tr("The printer's program or the router that gets the files"))
        self.preset = ComboBox([(each.name, translate_core_message(each.name)) for each in presets])
        walls = tr("How dense the print is, with {count} walls")
        self._walls = {each.name: walls.format(count=each.walls) for each in presets}
        self.zones = ComboBox(
            [
                ("table", tr("By material and body weight")),
                ("pressure", tr("From the map of pressures")),
                ("file", tr("From a file")),
            ]
        )
        self.zones.setToolTip(tr("What decides where the print is softer or firmer"))
        self.weight = NumberField("kg", least=WEIGHT.least, greatest=WEIGHT.greatest, step=1)
        usual = tr("That of the prescription; {usual:g} kg where it states none")
        self.weight.setToolTip(fill(usual, usual=USUAL_WEIGHT_KG))
        self.above = NumberField("kPa", least=1, greatest=5000, step=10, decimals=0)
        self.pressed = NumberField(
            "%", least=LEAST_PERCENT, greatest=MOST_PERCENT, step=1, decimals=0
        )
        self.above.setToolTip(tr("Pressure from which on a place gets a density of its own"))
        self.pressed.setToolTip(tr("How much of the print is filled at these places"))
        self.file = QPushButton()
        self.graded = QCheckBox(tr("Graded borders"))
        self.graded.setToolTip(
            tr("The density changes in three steps of 4 mm where two zones meet, not at once")
        )
        self.both_sides = QCheckBox(tr("Mill both sides"))
        self.both_sides.setToolTip(
            tr("The block is turned over onto dowels, and the underside is milled too")
        )
        self.files = QPushButton(tr("Routers…"))
        self.files.setToolTip(tr("Add the clinic's own router from its file, save or remove one"))
        self.facts = MessageLabel("quiet")
        self.error = MessageLabel("warning")
        self._menu()
        self.show_machines(self._machines)
        self._connect()

    @property
    def rows(self) -> list[tuple[str, QWidget]]:
        """The rows for a form, with their labels."""
        return [
            (tr("Made on"), self.made_on), ("", self.files), ("", self.both_sides),
            (tr("Print preset"), self.preset), (tr("Zones"), self.zones), ("", self.file),
            (tr("Body weight"), self.weight), (tr("Above"), self.above),
            (tr("Density there"), self.pressed), ("", self.graded), ("", self.facts),
            ("", self.error),
        ]  # fmt: skip

    def show_machines(self, machines: Machines) -> None:
        """Offer the printers and routers; `show_choice` then selects one."""
        self._machines = machines
        with QSignalBlocker(self.made_on):
            self.made_on.clear()
            self.made_on.addItem(tr("Any machine"), "")
            for printer in PRINTERS:
                name = PRINTER_NAMES[printer]
                self.made_on.addItem(tr("Printer: {name}").format(name=name), printer)
            for key, machine in machines.items.items():
                name = machine.name
                self.made_on.addItem(tr("Router: {name}").format(name=name), _ROUTER + key)

    def show_choice(self, printing: PrintChoice | None, milling: MillingChoice | None) -> None:
        """Show for what an order is made."""
        # The body weight is the patient's, and another one may come before the next print.
        self._print = printing or replace(self._print, weight_kg=None)
        how = self._print
        value: str = "" if printing is None else printing.printer
        if milling is not None:
            value = _ROUTER + key_of(milling.machine.name)
            with QSignalBlocker(self.both_sides):
                self.both_sides.setChecked(milling.both_sides)
        self.made_on.show_value(value)
        self.preset.show_value(how.preset)
        self.preset.setToolTip(self._walls.get(how.preset, ""))
        self.zones.show_value(how.zones)
        self.above.show_value(how.above_kpa)
        self.pressed.show_value(how.pressed_percent)
        with QSignalBlocker(self.graded):
            self.graded.setChecked(how.graded)
        self.file.setText(
            visible_line(Path(how.file).name) if how.file else tr("Choose a file of zones…")
        )
        self.file.setToolTip(how.file)
        self._show_weight()

    def show_prescribed_weight(self, weight_kg: float | None) -> None:
        """Show the body weight of the prescription, unless the order has another."""
        self._prescribed_kg = weight_kg
        self._show_weight()

    def fit_rows(self, form: QFormLayout) -> None:
        """Show the rows that the chosen machine needs."""
        is_print, zones = self.printing() is not None, self.zones.currentData()
        is_milled = self.milling() is not None
        shown = {
            self.files: not is_print,
            self.both_sides: is_milled,
            self.preset: is_print and zones != "file",
            self.zones: is_print,
            self.file: is_print and zones == "file",
            self.weight: is_print and zones != "file",
            self.above: is_print and zones == "pressure",
            self.pressed: is_print and zones == "pressure",
            self.graded: is_print,
            self.facts: bool(self.facts.text()),
            self.error: bool(self.error.text()),
        }
        for field, is_shown in shown.items():
            form.setRowVisible(field, is_shown)

    def printing(self) -> PrintChoice | None:
        """Return what is entered for a print; None if it is for no printer."""
        printer = self.made_on.currentData()
        if printer not in PRINTERS:
            return None
        return PrintChoice(
            printer=cast(Printer, printer),
            preset=self.preset.currentData(),
            zones=cast(ZoneSource, self.zones.currentData()),
            file=self._print.file,
            above_kpa=self.above.value(),
            pressed_percent=self.pressed.value(),
            weight_kg=self._print.weight_kg,
            graded=self.graded.isChecked(),
        )

    def milling(self) -> MillingChoice | None:
        """Return what is entered for a router; None if it is for none."""
        machine = self._machine()
        return None if machine is None else MillingChoice(machine, self.both_sides.isChecked())

    def show_outcome(self, facts: Sequence[str], problems: Sequence[str]) -> None:
        """Show what is known of the print or the program, and what is wrong or doubtful."""
        self.facts.say_all(facts)
        self.error.say_all(problems)

    def _machine(self) -> Machine | None:
        chosen = str(self.made_on.currentData() or "")
        if not chosen.startswith(_ROUTER):
            return None
        return self._machines.items.get(chosen.removeprefix(_ROUTER))

    def _show_weight(self) -> None:
        known = self._print.weight_kg or self._prescribed_kg
        self.weight.show_value(USUAL_WEIGHT_KG if known is None else known)

    def _menu(self) -> None:
        menu = QMenu(self.files)
        self._add = menu.addAction(tr("Add a router from its file…"))
        self._save, self._remove = QAction(menu), QAction(menu)
        menu.addActions([self._save, self._remove])
        self._add.triggered.connect(self.machine_file_requested)
        self._save.triggered.connect(self._request_export)
        self._remove.triggered.connect(self._request_removal)
        menu.aboutToShow.connect(self._fit_menu)
        self.files.setMenu(menu)

    def _fit_menu(self) -> None:
        machine = self._machine()
        name = "" if machine is None else machine.name
        self._save.setText(tr("Save the file of {name}…").format(name=name))
        self._remove.setText(tr("Remove {name}").format(name=name))
        self._save.setVisible(machine is not None)
        self._remove.setVisible(key_of(name) in self._machines.own)

    def _request_export(self) -> None:
        self.machine_export_requested.emit(self._machine())

    def _request_removal(self) -> None:
        self.machine_removal_requested.emit(self._machine())

    def _connect(self) -> None:
        for choice in (self.made_on, self.preset, self.zones):
            choice.edited.connect(self._pass_on)
        for field in (self.above, self.pressed):
            field.edited.connect(self._pass_on)
        self.weight.edited.connect(self._edit_weight)
        self.both_sides.toggled.connect(self._pass_on)
        self.graded.toggled.connect(self._pass_on)
        self.file.clicked.connect(self.zones_file_requested)

    def _edit_weight(self, weight_kg: float) -> None:
        self._print = replace(self._print, weight_kg=weight_kg)
        self.edited.emit()

    def _pass_on(self) -> None:
        self.edited.emit()
