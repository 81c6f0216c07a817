"""The form of an order: part, manufacturing, engraving and documents."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import cast

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QFormLayout,
    QLabel,
    QLineEdit,
    QPlainTextEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from insole_core.export.shop_order import Release
from insole_core.formats.file_formats import SOLID_FORMATS, can_carry, carriers
from insole_core.geometry.side import Side
from insole_core.solids.marking import Relief
from insole_core.solids.print_presets import PrintPreset, read_print_presets
from insole_core.solids.shop import Block
from insole_core.solids.solid import Kind
from insole_core.workflows.make_order import OrderChoice
from insole_studio.features.export.machine_fields import MachineFields
from insole_studio.features.export.rows import OrderedFoot
from insole_studio.features.export.terms_fields import TermsFields
from insole_studio.texts import tr, translate_core_message, with_capital
from insole_studio.widgets.form_parts import ComboBox, Fold, mark_labels
from insole_studio.widgets.number_field import NumberField

_AS_TEXT = " text"
"""Behind the suffix of a format that is written in text."""
_PRINTED = carriers("print settings")[0].ending
_REVISED, _NEW = "revised", "new"
_LINES_PX = 52
_BLOCK_LETTERS = 24
"""Of a block that are seen on the smallest screen; its list shows all."""


@dataclass(frozen=True)
class Stock:
    """The options the form offers."""

    blocks: Sequence[Block]
    materials: Sequence[str]
    presets: Sequence[PrintPreset] = dataclasses.field(default_factory=read_print_presets)


class MaterialField(QComboBox):
    """A material: one that the shop has, in the language of the window, or what is typed."""

    edited = Signal(str)

    def __init__(self, materials: Sequence[str]) -> None:
        super().__init__()
        self.setEditable(True)
        for material in ("", *materials):
            self.addItem(with_capital(translate_core_message(material)), material)
        self.currentTextChanged.connect(self._pass_on)

    def show_material(self, material: str) -> None:
        """Show a material; what is being typed is kept."""
        if material != self.material():
            with QSignalBlocker(self):
                if self.findData(material) < 0:
                    self.addItem(with_capital(translate_core_message(material)), material)
                self.setCurrentText(self.itemText(self.findData(material)))

    def material(self) -> str:
        """Return the material: the shop's own word for one that it has, or what is typed."""
        text = self.currentText().strip()
        index = self.findText(text)
        return text if index < 0 else str(self.itemData(index))

    def _pass_on(self) -> None:
        self.edited.emit(self.material())


class OrderForm(QWidget):
    """Shows an `OrderChoice`, and emits a new one when a field is edited."""

    edited = Signal(object)
    order_chosen = Signal(bool)
    """Emitted with whether a new order is to be begun in place of a revision."""
    material_edited = Signal(object, str)
    """Emitted with a side, and the material that its insole is to be made of."""
    blocks_requested = Signal()
    responsible_requested = Signal()

    def __init__(self, stock: Stock, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._blocks: dict[str, Block] = {}
        self.order = ComboBox([])
        self.order.edited.connect(self._choose_order)
        self.kind = ComboBox(
            [
                ("insole", tr("Insole, trimmed")),
                ("block", tr("Contact surface in a block")),
                ("positive", tr("Foot as a mould")),
            ]
        )
        self.both = QCheckBox(tr("Both feet"))
        self.block = ComboBox([])
        self.block.setSizeAdjustPolicy(
            ComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        )
        self.block.setMinimumContentsLength(_BLOCK_LETTERS)
        self.own_blocks = QPushButton(tr("Own blocks…"))
        self.own_blocks.clicked.connect(self.blocks_requested)
        self.show_blocks(stock.blocks)
        self.draft = NumberField("°", least=-15, greatest=30, step=0.5)
        self.chamfer = NumberField("mm", least=0, greatest=10, step=0.5)
        self.cutter = NumberField("mm", least=1, greatest=40, step=0.5)
        self.walls = QLabel()
        self.walls.setObjectName("quiet")
        self.walls.setWordWrap(True)
        self.walls.setToolTip(tr("Draft and chamfer as the shell of the prescription has them"))
        self.materials = {side: MaterialField(stock.materials) for side in Side}
        self.machine = MachineFields(stock.presets, self)
        self.format = ComboBox(list(_formats()))
        self.layered = QCheckBox(tr("Layers as objects"))
        self.limited = QCheckBox(tr("Fewer triangles"))
        self.triangles = NumberField("", least=2000, greatest=2_000_000, step=5000, decimals=0)
        self.deviation = NumberField("mm", least=0.005, greatest=2, step=0.01, decimals=3)
        self.relief = ComboBox(
            [("", tr("Nothing")), ("engraved", tr("Engraved")), ("raised", tr("Raised"))]
        )
        self.pseudonym = QLineEdit()
        self.text = QPlainTextEdit()
        self.text.setTabChangesFocus(True)
        self.text.setFixedHeight(_LINES_PX)
        self.text.setPlaceholderText(tr("Pseudonym, side and date"))
        self.numbered = QCheckBox(tr("With serial number and lot"))
        self.job_sheet = QCheckBox(tr("Job sheet for the shop (PDF)"))
        self.prescription = QCheckBox(tr("Prescription for the record (PDF)"))
        self.responsible = QPushButton(tr("Prescriber and maker…"))
        self.responsible.setToolTip(tr("Who stands on the prescription"))
        self.responsible.clicked.connect(self.responsible_requested)
        self.checks = QCheckBox(tr("Outcome of the checks (JSON)"))
        self.outlines = QCheckBox(tr("Outlines for a cutting machine (DXF)"))
        self.terms = TermsFields(self)
        self.more = Fold(tr("Size of the file"))
        self._tips()
        self._choice = OrderChoice()
        self._own_format = self._choice.suffix
        """What is chosen while it is for no printer."""
        self._lay_out()
        self._connect()

    def show_blocks(self, blocks: Sequence[Block]) -> None:
        """Offer blocks; `show_choice` then selects one."""
        self._blocks = {block.name: block for block in blocks}
        with QSignalBlocker(self.block):
            self.block.clear()
            self.block.addItem(tr("None"), "")
            for name, block in self._blocks.items():
                self.block.addItem(_text(block), name)

    def show_release(
        self, chosen: Release, revised: Release | None, new_number: str, *, is_sample: bool
    ) -> None:
        """Show which order is exported, and what it is called without a pseudonym.

        Parameters
        ----------
        chosen
            Number and revision of what is exported next.
        revised
            The revision that can be exported; None where there is no order to revise.
        new_number
            Of the order that can be begun.
        is_sample
            Whether the patient is the sample, which is always called one.
        """
        with QSignalBlocker(self.order):
            self.order.clear()
            if revised is not None:
                text = tr("{number}, revision {revision}")
                revision = text.format(number=revised.number, revision=revised.revision)
                self.order.addItem(revision, _REVISED)
            self.order.addItem(tr("New: {number}").format(number=new_number), _NEW)
            self.order.show_value(_NEW if chosen.number == new_number else _REVISED)
        self.order.setEnabled(revised is not None)
        self.order.setToolTip(
            tr("The shop makes the newest revision of an order; a new order is made beside it")
        )
        self.pseudonym.setReadOnly(is_sample)
        self.pseudonym.setPlaceholderText(chosen.number)
        self.pseudonym.setToolTip(
            tr("What the shop knows the patient by; without one, the order number {number}").format(
                number=chosen.number
            )
        )

    def show_choice(self, choice: OrderChoice, has_pair: bool) -> None:
        """Show an order; `has_pair` tells whether both feet can be made."""
        self._choice = choice
        with QSignalBlocker(self):
            self.kind.show_value(choice.kind)
            self.block.show_value("" if choice.block is None else choice.block.name)
            self.format.show_value(choice.suffix + _AS_TEXT * choice.ascii_stl)
            if choice.printing is None:
                self._own_format = self.format.currentData()
            self.relief.show_value(choice.relief or "")
            for box, on in self._boxes(choice):
                box.setChecked(on)
            for field, value in self._numbers(choice):
                field.show_value(value)
            for line, text in ((self.pseudonym, choice.pseudonym),):
                if line.text() != text:
                    line.setText(text)
            if self.text.toPlainText() != choice.text:
                self.text.setPlainText(choice.text)
            self.machine.show_choice(choice.printing, choice.milling)
        self.terms.show_terms(choice.terms, choice.package)
        self.terms.name_quantity(self._form, is_pair=has_pair and choice.both)
        self.prescription.setEnabled(not choice.package)
        self.prescription.setToolTip(
            tr("It names the patient and never goes into an order; write it with single files")
            if choice.package
            else tr("All that is prescribed, with the patient's name, for the clinic itself")
        )
        self.both.setVisible(has_pair)
        is_print = choice.printing is not None
        self.format.setEnabled(not is_print)
        self.format.setToolTip(
            tr("A printer's program gets a 3MF")
            if is_print
            else tr("STL is read everywhere; unit, names and layers are in {formats}").format(
                formats=", ".join(form.name for form in carriers("bodies"))
            )
        )
        self.layered.setVisible(
            can_carry(choice.suffix, "bodies") and choice.kind == "insole" and not is_print
        )
        self.machine.fit_rows(self._form)
        for lettering in (self.text, self.numbered):
            self._form.setRowVisible(lettering, choice.relief is not None)
        self._fit_more()

    def show_feet(self, feet: Sequence[OrderedFoot]) -> None:
        """Show the material of each foot that is made, and whose shell sets the walls."""
        by_side = {foot.side: foot for foot in feet}
        for side, field in self.materials.items():
            self._form.setRowVisible(field, side in by_side)
            if side in by_side:
                field.show_material(by_side[side].material)
            label = self._form.labelForField(field)
            assert isinstance(label, QLabel)
            label.setText(_MATERIAL_OF[side]() if len(feet) > 1 else tr("Material"))
        shells = [foot for foot in feet if foot.walls]
        self.walls.setText(
            "\n".join(_of_side(foot.walls, foot.side) for foot in shells)
            if len(feet) > 1
            else "".join(foot.walls for foot in shells)
        )
        own = not feet or len(shells) < len(feet)  # else nothing is left that the order sets
        kind = self._choice.kind
        self._form.setRowVisible(self.walls, bool(shells))
        self._form.setRowVisible(self.draft, own and kind != "block")
        self._form.setRowVisible(self.chamfer, own and kind == "insole")

    def show_outcome(self, facts: Sequence[str], problems: Sequence[str]) -> None:
        """Show what is known of the print or the program, and what is wrong or doubtful."""
        self.machine.show_outcome(facts, problems)
        self.machine.fit_rows(self._form)

    def show_cutter(self, diameter_mm: float, *, is_of_router: bool = False) -> None:
        """Show the diameter of the cutter whose reach into hollows is checked."""
        self.cutter.show_value(diameter_mm)
        self.cutter.setEnabled(not is_of_router)
        self.cutter.setToolTip(
            tr("That of the chosen router")
            if is_of_router
            else tr("Diameter of the cutter, which does not reach into narrower hollows")
        )

    def choice(self) -> OrderChoice:
        """Return the order entered in the fields."""
        printing = self.machine.printing()
        form = self._own_format if self._choice.printing else self.format.currentData()
        form = form if printing is None else _PRINTED
        return OrderChoice(
            kind=cast(Kind, self.kind.currentData()),
            both=self.both.isChecked(),
            alone=self._choice.alone,
            suffix=form.removesuffix(_AS_TEXT),
            ascii_stl=form.endswith(_AS_TEXT),
            layered=self.layered.isChecked(),
            draft_deg=self.draft.value(),
            chamfer_mm=self.chamfer.value(),
            most_triangles=int(self.triangles.value()) if self.limited.isChecked() else None,
            most_deviation_mm=self.deviation.value(),
            relief=cast("Relief | None", self.relief.currentData() or None),
            pseudonym=self.pseudonym.text().strip(),
            text=self.text.toPlainText(),
            numbered=self.numbered.isChecked(),
            material=self._choice.material,
            own_materials=self._choice.own_materials,
            block=self._blocks.get(self.block.currentData()),
            printing=printing,
            milling=self.machine.milling(),
            job_sheet=self.job_sheet.isChecked(),
            prescription=self._wants_prescription,
            checks=self.checks.isChecked(),
            outlines=self.outlines.isChecked(),
            terms=self.terms.terms(),
            package=self.terms.chosen_package(),
        )

    @property
    def _wants_prescription(self) -> bool:
        """What is ticked; beside an order, into which it never goes, what was ticked before."""
        before = self._choice
        return before.prescription if before.package else self.prescription.isChecked()

    def _boxes(self, choice: OrderChoice) -> list[tuple[QCheckBox, bool]]:
        return [
            (self.both, choice.both),
            (self.layered, choice.layered),
            (self.numbered, choice.numbered),
            (self.limited, choice.most_triangles is not None),
            (self.job_sheet, choice.job_sheet),
            (self.prescription, choice.prescription and not choice.package),
            (self.checks, choice.checks),
            (self.outlines, choice.outlines),
        ]

    def _numbers(self, choice: OrderChoice) -> list[tuple[NumberField, float]]:
        triangles = choice.most_triangles or self.triangles.value()
        return [
            (self.draft, choice.draft_deg),
            (self.chamfer, choice.chamfer_mm),
            (self.triangles, triangles),
            (self.deviation, choice.most_deviation_mm),
        ]

    def _lay_out(self) -> None:
        self._form = QFormLayout()
        self._form.setVerticalSpacing(6)
        self._form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        rows: list[tuple[str, QWidget]] = [
            (tr("Order"), self.order),
            (tr("Piece"), self.kind), ("", self.both), (tr("Block"), self.block),
            ("", self.own_blocks),
            (tr("Cutter ⌀"), self.cutter), (tr("Draft"), self.draft),
            (tr("Chamfer"), self.chamfer), (tr("Walls"), self.walls),
            *((tr("Material"), field) for field in self.materials.values()),
            *self.machine.rows,
            (tr("Format"), self.format), ("", self.layered), ("", self.more), ("", self.limited),
            (tr("Triangles"), self.triangles), (tr("May differ by"), self.deviation),
            (tr("Pseudonym"), self.pseudonym), (tr("On the bottom"), self.relief),
            (tr("Text"), self.text), ("", self.numbered),
            *self.terms.rows,
        ]  # fmt: skip
        for name, field in rows:
            self._form.addRow(name, field)
        mark_labels(self._form)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 8, 0)
        layout.addLayout(self._form)
        papers = QLabel(tr("Papers"))
        papers.setObjectName("heading")
        for widget in (
            papers, self.job_sheet, self.checks, self.outlines, self.prescription,
            self.responsible,
        ):  # fmt: skip
            layout.addWidget(widget)
        layout.addStretch(1)

    def _connect(self) -> None:
        for choice in (self.kind, self.block, self.format, self.relief):
            choice.edited.connect(self._pass_on)
        for field in (self.draft, self.chamfer, self.triangles, self.deviation):
            field.edited.connect(self._pass_on)
        self.machine.edited.connect(self._pass_on)
        self.more.toggled.connect(self._fit_more)
        for box, _ in self._boxes(self._choice):
            box.toggled.connect(self._pass_on)
        for side, material in self.materials.items():
            material.edited.connect(partial(self.material_edited.emit, side))
        self.terms.edited.connect(self._pass_on)
        self.pseudonym.textEdited.connect(self._pass_on)
        self.text.textChanged.connect(self._pass_on)

    def _tips(self) -> None:
        """Say of each field in a sentence what it does."""
        for field, tip in (
            (self.kind, tr("What is made: the insole, its surface in a block, or the foot")),
            (self.both, tr("The insoles of both feet in one order")),
            (
                self.block,
                tr("The piece of material that it is cut from, which must be large enough"),
            ),
            (self.draft, tr("Slope of the side walls; > 0 is wider at the bottom")),
            (self.chamfer, tr("Width of the bevel along the upper edge")),
            (self.layered, tr("Each layer of the insole as an object of its own")),
            (self.limited, tr("A smaller file: larger triangles where the surface is flat")),
            (self.triangles, tr("How many triangles the file has at most")),
            (self.deviation, tr("How far the surface may move where triangles are left out")),
            (self.relief, tr("Whether a text is cut into the underside, or stands out of it")),
            (self.text, tr("The text on the underside")),
            (self.numbered, tr("Both stand on the papers; here also on the piece itself")),
            (self.job_sheet, tr("A drawing with sections and all values, without the name")),
            (self.checks, tr("What was checked and with which outcome, for other programs")),
            (self.outlines, tr("Insole, cover, block and shoe from above, in millimetres")),
            *((field, tr("Of what the insole is made")) for field in self.materials.values()),
        ):
            field.setToolTip(tip)

    def _fit_more(self) -> None:
        """Show what decides the size of the file only where it is asked for."""
        is_open = self.more.isChecked()
        self._form.setRowVisible(self.limited, is_open)
        for field in (self.triangles, self.deviation):
            self._form.setRowVisible(field, is_open and self._choice.most_triangles is not None)

    def _choose_order(self, word: str) -> None:
        self.order_chosen.emit(word == _NEW)

    def _pass_on(self) -> None:
        if self.signalsBlocked():
            return
        choice = self.choice()
        if choice != self._choice:
            self._choice = choice
            self.edited.emit(choice)


def _text(block: Block) -> str:
    return translate_core_message(block.words)


_MATERIAL_OF = {
    Side.LEFT: lambda: tr("Material, left"),
    Side.RIGHT: lambda: tr("Material, right"),
}


def _of_side(text: str, side: Side) -> str:
    return (tr("Left: {text}") if side is Side.LEFT else tr("Right: {text}")).format(text=text)


def _formats() -> Iterator[tuple[str, str]]:
    """Yield what is chosen and what it is called, for every format of solids."""
    for form in SOLID_FORMATS:
        yield form.ending, form.name
        if form.text_writer:
            yield form.ending + _AS_TEXT, tr("{format} as text").format(format=form.name)
