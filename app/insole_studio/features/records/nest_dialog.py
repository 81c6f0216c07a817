"""Asks which orders are nested, and on which block."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QHBoxLayout,
    QListWidget,
    QListWidgetItem,
    QVBoxLayout,
    QWidget,
)

from insole_core.milling.machine import Machine
from insole_core.records.order import OrderState, OrderSummary
from insole_core.solids.shop import Block
from insole_core.workflows.mill import MillingChoice
from insole_core.workflows.nest_orders import GAP_MM, MARGIN_MM, MOST_GAP_MM, MOST_SIDE_MM
from insole_studio.features.records.rows import name_of, state_text
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.form_parts import ComboBox, allow, mark_labels
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.number_field import NumberField

_NOT_MADE_YET = (OrderState.DESIGNED, OrderState.CHECKED, OrderState.SENT)
_SIZE_PX = (560, 620)
_SHEET_MM = (1000.0, 600.0, 40.0)


@dataclass(frozen=True)
class NestChoice:
    """What is nested, and how.

    Parameters
    ----------
    orders
        Their ids.
    marked
        Whether order and side are engraved into the undersides.
    """

    orders: tuple[str, ...]
    block: Block
    gap_mm: float
    margin_mm: float
    milling: MillingChoice | None
    marked: bool


class NestDialog(QDialog):
    """Orders to tick, the block, the gap, and the router.

    Parameters
    ----------
    orders
        Of the page; those that are not being made yet are ticked.
    machines
        By their keys.
    """

    def __init__(
        self,
        orders: Sequence[OrderSummary],
        blocks: Sequence[Block],
        machines: Mapping[str, Machine],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Nest the orders"))
        self.resize(*_SIZE_PX)
        self._blocks = {block.name: block for block in blocks}
        self._machines = machines
        self.orders = QListWidget()
        self.orders.setAccessibleName(tr("Orders"))
        for order in orders:
            self._add(order)
        self.orders.itemChanged.connect(self._fit)
        self.block = ComboBox(
            [(block.name, translate_core_message(block.words)) for block in blocks]
            + [("", tr("Another size"))]
        )
        self.block.edited.connect(self._fit)
        self.sides = [
            NumberField("mm", least=10, greatest=MOST_SIDE_MM, step=10, decimals=0)
            for _ in _SHEET_MM
        ]
        names = (tr("Length"), tr("Width"), tr("Height"))
        for field, name, side in zip(self.sides, names, _SHEET_MM, strict=True):
            field.setAccessibleName(name)
            field.setToolTip(name)
            field.show_value(side)
        self.gap = NumberField("mm", least=0, greatest=MOST_GAP_MM, step=1)
        self.gap.setToolTip(tr("Between two pieces: for a router more than its cutter"))
        self.gap.show_value(GAP_MM)
        self.margin = NumberField("mm", least=0, greatest=MOST_GAP_MM, step=1)
        self.margin.setToolTip(tr("From the pieces to the sides of the block"))
        self.margin.show_value(MARGIN_MM)
        self.machine = ComboBox(
            [("", tr("No router"))] + [(key, machine.name) for key, machine in machines.items()]
        )
        self.machine.setToolTip(tr("Its program is written beside the solids"))
        self.machine.edited.connect(self._fit)
        self.both_sides = QCheckBox(tr("Mill both sides"))
        self.marked = QCheckBox(tr("Engrave order and side into the undersides"))
        self.refusal = MessageLabel("warning")
        self._lay_out()
        self._fit()

    def show_means(self, last: NestChoice) -> None:
        """Show block, gaps and router as they were chosen before, where they are still there."""
        is_known = self._blocks.get(last.block.name) == last.block
        self.block.show_value(last.block.name if is_known else "")
        if not is_known:
            for field, side in zip(self.sides, last.block.size_mm, strict=True):
                field.show_value(side)
        self.gap.show_value(last.gap_mm)
        self.margin.show_value(last.margin_mm)
        if last.milling is not None:
            keys = [key for key, one in self._machines.items() if one == last.milling.machine]
            self.machine.show_value(next(iter(keys), ""))
            self.both_sides.setChecked(last.milling.both_sides)
        self.marked.setChecked(last.marked)
        self._fit()

    @property
    def choice(self) -> NestChoice:
        """What is chosen."""
        block = self._blocks.get(self.block.currentData())
        if block is None:
            length, width, height = (field.value() for field in self.sides)
            block = Block(tr("Sheet"), (length, width, height))
        machine = self._machines.get(self.machine.currentData())
        milling = None if machine is None else MillingChoice(machine, self.both_sides.isChecked())
        return NestChoice(
            tuple(self._ticked), block, self.gap.value(), self.margin.value(),
            milling, self.marked.isChecked(),
        )  # fmt: skip

    @property
    def _ticked(self) -> list[str]:
        items = (self.orders.item(row) for row in range(self.orders.count()))
        return [
            str(item.data(Qt.ItemDataRole.UserRole))
            for item in items
            if item.checkState() is Qt.CheckState.Checked
        ]

    def _add(self, order: OrderSummary) -> None:
        text = f"{order.person_name}  ·  {name_of(order)}  ·  {state_text(order.state)}"
        item = QListWidgetItem(text, self.orders)
        item.setData(Qt.ItemDataRole.UserRole, order.id)
        is_open = order.state in _NOT_MADE_YET
        item.setCheckState(Qt.CheckState.Checked if is_open else Qt.CheckState.Unchecked)

    def _fit(self) -> None:
        """Show the fields that the choice needs."""
        self._form.setRowVisible(self._sides, not self.block.currentData())
        self._form.setRowVisible(self.both_sides, bool(self.machine.currentData()))
        count = len(self._ticked)
        why_not = "" if count else tr("Tick at least one order.")
        allow(self.nest, why_not)
        self.refusal.say(why_not)

    def _lay_out(self) -> None:
        self._sides = QWidget()
        sides = QHBoxLayout(self._sides)
        sides.setContentsMargins(0, 0, 0, 0)
        for field in self.sides:
            sides.addWidget(field)
        self._form = QFormLayout()
        self._form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        self._form.addRow(tr("Block"), self.block)
        self._form.addRow(tr("Length × width × height"), self._sides)
        self._form.addRow(tr("Gap"), self.gap)
        self._form.addRow(tr("To the sides"), self.margin)
        self._form.addRow(tr("Router"), self.machine)
        self._form.addRow("", self.both_sides)
        self._form.addRow("", self.marked)
        mark_labels(self._form)
        buttons = QDialogButtonBox()
        role = QDialogButtonBox.ButtonRole
        self.nest = buttons.addButton(tr("Nest…"), role.AcceptRole)
        buttons.addButton(tr("Cancel"), role.RejectRole)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.addWidget(self.orders, 1)
        layout.addLayout(self._form)
        layout.addWidget(self.refusal)
        layout.addWidget(buttons)
