"""The dialog in which a clinic edits its table of materials."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QListWidget,
    QMenu,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from insole_core.errors import InputError
from insole_core.insole.prescription.materials import (
    ANY_MATERIAL,
    MODULUS_MPA,
    SHORE_A,
    THICKNESS,
    WEIGHT,
    Material,
    ThicknessStep,
    check_materials,
)
from insole_core.messages import Message
from insole_studio.features.design.correction_names import capitalised
from insole_studio.texts import tr, translate_core_message, with_capital
from insole_studio.widgets.form_parts import allow, mark_labels, plain_button
from insole_studio.widgets.icons import icon
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.number_field import NumberField

SIZE_PX = QSize(760, 500)
_LIST_PX, _FIELD_PX, _REMOVE_PX, _GAP_PX = 220, 96, 28, 6
_FIRST = ThicknessStep(math.inf, 3.0)
_NEXT_KG = 20.0  # by which an added weight is above the heaviest one before


class MaterialsDialog(QDialog):
    """A list of materials on the left, the values of the chosen one on the right.

    Parameters
    ----------
    materials
        The rows to begin with.
    supplied
        Those that come with the product.
    """

    import_requested = Signal()
    export_requested = Signal()

    def __init__(
        self,
        materials: Sequence[Material],
        supplied: Sequence[Material],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Table of materials"))
        self._materials: list[Material] = []
        self._supplied = tuple(supplied)
        self.list = QListWidget()
        self.list.setAccessibleName(tr("Materials"))
        self.list.setFixedWidth(_LIST_PX)
        self.list.currentRowChanged.connect(self._show_chosen)
        self.add = plain_button(tr("Add a material"), self._add)
        self.remove = plain_button(tr("Remove"), self._remove)
        self.name = QLineEdit()
        self.least = _millimetres()
        self.least_edge = _millimetres()
        self.steps = StepsEditor()
        self.shore = _stiffness("", SHORE_A, 5.0)
        self.modulus = _stiffness("MPa", MODULUS_MPA, 100.0)
        self.source = QLineEdit()
        for line in (self.name, self.source):
            line.textEdited.connect(self._take_edit)
        for field in (self.least, self.least_edge, self.shore, self.modulus):
            field.edited.connect(self._take_edit)
        self.steps.edited.connect(self._take_edit)
        self.problem = MessageLabel("warning")
        self.more = plain_button(tr("More"))
        self.more.setMenu(self._menu())
        self.buttons = QDialogButtonBox()
        self.keep = self.buttons.addButton(
            tr("Save the table"), QDialogButtonBox.ButtonRole.AcceptRole
        )
        self.buttons.addButton(tr("Cancel"), QDialogButtonBox.ButtonRole.RejectRole)
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        self._lay_out()
        self.resize(SIZE_PX)
        self.show_materials(materials)

    @property
    def materials(self) -> tuple[Material, ...]:
        """The rows as they are edited."""
        return tuple(self._materials)

    def show_materials(self, materials: Sequence[Material], chosen: str = "") -> None:
        """Show other rows.

        Parameters
        ----------
        chosen
            Name of the material whose values are shown; by default the first.
        """
        self._materials = list(materials)
        self.list.blockSignals(True)
        self.list.clear()
        self.list.addItems([capitalised(material.name) for material in materials])
        names = [material.name for material in materials]
        self.list.setCurrentRow(names.index(chosen) if chosen in names else 0)
        self.list.blockSignals(False)
        self._show_chosen()

    def say(self, sentence: str) -> None:
        """Say what could not be done."""
        self.problem.say(sentence)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Let Return end what is typed, and not the dialog."""
        if event.key() not in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            super().keyPressEvent(event)

    def _lay_out(self) -> None:
        form = QFormLayout()
        form.setVerticalSpacing(6)
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(tr("Name"), self.name)
        form.addRow(tr("Least thickness"), self.least)
        form.addRow(tr("At the front edge"), self.least_edge)
        form.addRow(tr("Usual thickness"), self.steps)
        form.addRow(tr("Hardness, Shore A"), self.shore)
        form.addRow(tr("Young's modulus"), self.modulus)
        form.addRow(tr("Source"), self.source)
        mark_labels(form)
        rows = QHBoxLayout()
        rows.addWidget(self.add)
        rows.addWidget(self.remove)
        left = QVBoxLayout()
        left.setSpacing(8)
        left.addWidget(self.list, 1)
        left.addLayout(rows)
        upper = QHBoxLayout()
        upper.setSpacing(16)
        upper.addLayout(left)
        upper.addLayout(form, 1)
        lower = QHBoxLayout()
        lower.addWidget(self.more)
        lower.addWidget(self.buttons, 1)
        words = QLabel(
            tr(
                "From material and body weight a thickness is proposed; the least thickness is "
                "kept everywhere. By hardness or modulus the change of the pressure is computed."
            )
        )
        words.setWordWrap(True)
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        layout.addWidget(words)
        layout.addLayout(upper, 1)
        layout.addWidget(self.problem)
        layout.addLayout(lower)

    def _menu(self) -> QMenu:
        menu = QMenu(self)
        menu.addAction(tr("Import a table…")).triggered.connect(self.import_requested)
        menu.addAction(tr("Export this table…")).triggered.connect(self.export_requested)
        menu.addSeparator()
        menu.addAction(tr("Show the supplied materials")).triggered.connect(self._show_supplied)
        return menu

    def _show_supplied(self) -> None:
        self.show_materials(self._supplied)

    @property
    def _chosen(self) -> Material | None:
        row = self.list.currentRow()
        return self._materials[row] if 0 <= row < len(self._materials) else None

    def _show_chosen(self) -> None:
        """Show the values of the chosen material."""
        material = self._chosen
        for widget in (
            self.name, self.least, self.least_edge, self.steps, self.shore, self.modulus,
            self.source,
        ):  # fmt: skip
            widget.setEnabled(material is not None)
        allow(self.remove, "" if material is not None else tr("Choose a material first."))
        material = material or ANY_MATERIAL
        self.name.setText(capitalised(material.name))
        self.least.show_value(material.least_mm)
        self.least_edge.show_value(material.least_edge_mm)
        self.steps.show_steps(material.steps)
        self.shore.show_value(material.shore_a or 0.0)
        self.modulus.show_value(material.modulus_mpa or 0.0)
        self.source.setText(translate_core_message(material.source))
        self._show_problem()

    def _take_edit(self) -> None:
        """Take the values of the fields into the row."""
        before, row = self._chosen, self.list.currentRow()
        if before is None:
            return
        self._materials[row] = replace(
            before,
            name=_typed(self.name, before.name),
            least_mm=self.least.value(),
            least_edge_mm=self.least_edge.value(),
            steps=self.steps.steps(),
            shore_a=self.shore.value() or None,
            modulus_mpa=self.modulus.value() or None,
            source=_typed(self.source, before.source),
        )
        self.list.item(row).setText(self.name.text().strip())
        self._show_problem()

    def _add(self) -> None:
        names = {material.name.casefold() for material in self._materials}
        number = next(n for n in range(1, 1000) if _numbered(n).casefold() not in names)
        new = replace(ANY_MATERIAL, name=_numbered(number), steps=(_FIRST,))
        self.show_materials([*self._materials, new], new.name)
        self.name.setFocus()
        self.name.selectAll()

    def _remove(self) -> None:
        row = self.list.currentRow()
        rest = [*self._materials[:row], *self._materials[row + 1 :]]
        self.show_materials(rest, rest[min(row, len(rest) - 1)].name if rest else "")

    def _show_problem(self) -> None:
        sentence: str | Message = ""
        try:
            check_materials(self._materials)
        except InputError as error:
            sentence = error.message
        self.problem.say(sentence)
        allow(self.keep, with_capital(translate_core_message(sentence)))


class StepsEditor(QWidget):
    """Usual thicknesses, a row for each body weight; the last one is for all above."""

    edited = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.weights: list[NumberField] = []
        self.thicknesses: list[NumberField] = []
        self.removes: list[QToolButton] = []
        self.add = plain_button(tr("Add a body weight"), self._add)
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._rows = QWidget()
        self._column.addWidget(self._rows)
        self._column.addWidget(self.add, alignment=Qt.AlignmentFlag.AlignLeft)
        self._column.addStretch(1)

    def show_steps(self, steps: Sequence[ThicknessStep]) -> None:
        """Show other steps."""
        self.weights, self.thicknesses, self.removes = [], [], []
        fresh = QWidget()
        grid = QGridLayout(fresh)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setSpacing(_GAP_PX)
        for row, step in enumerate(steps):
            self._add_row(grid, row, step)
        if len(steps) == 1:
            grid.addWidget(QLabel(tr("for every body weight")), 0, 0, 1, 2)
        elif steps:
            grid.addWidget(QLabel(tr("above")), len(steps) - 1, 0)
        grid.setColumnStretch(4, 1)
        self._column.replaceWidget(self._rows, fresh)
        self._rows.hide()
        self._rows.deleteLater()
        self._rows = fresh
        fresh.show()  # at once, so that a field in it can get the focus

    def steps(self) -> tuple[ThicknessStep, ...]:
        """Return the steps of the fields."""
        weights = [*(field.value() for field in self.weights), math.inf]
        values = (field.value() for field in self.thicknesses)
        return tuple(ThicknessStep(*pair) for pair in zip(weights, values, strict=True))

    def _add_row(self, grid: QGridLayout, row: int, step: ThicknessStep) -> None:
        thickness = _millimetres()
        thickness.setAccessibleName(tr("Usual thickness"))
        thickness.show_value(step.thickness_mm)
        thickness.edited.connect(self.edited)
        self.thicknesses.append(thickness)
        grid.addWidget(thickness, row, 2)
        if math.isinf(step.up_to_kg):
            return
        weight = NumberField("kg", least=WEIGHT.least, greatest=WEIGHT.greatest, step=1.0)
        weight.setAccessibleName(tr("Body weight"))
        weight.show_value(step.up_to_kg)
        weight.set_room(_FIELD_PX)
        weight.edited.connect(self.edited)
        self.weights.append(weight)
        remove = QToolButton()
        remove.setIcon(icon("remove"))
        remove.setAutoRaise(True)
        remove.setMinimumWidth(_REMOVE_PX)
        remove.setToolTip(tr("Remove this body weight"))
        remove.setAccessibleName(tr("Remove this body weight"))
        remove.clicked.connect(self._remove)
        self.removes.append(remove)
        grid.addWidget(QLabel(tr("up to")), row, 0)
        grid.addWidget(weight, row, 1)
        grid.addWidget(remove, row, 3)

    def _add(self) -> None:
        steps = self.steps() or (_FIRST,)
        heaviest = steps[-2].up_to_kg if len(steps) > 1 else 75.0 - _NEXT_KG
        weight = min(heaviest + _NEXT_KG, WEIGHT.greatest)
        self.show_steps((*steps[:-1], ThicknessStep(weight, steps[-1].thickness_mm), steps[-1]))
        self.weights[-1].setFocus()
        self.weights[-1].selectAll()
        self.edited.emit()

    def _remove(self) -> None:
        button = self.sender()
        assert isinstance(button, QToolButton)
        row, steps = self.removes.index(button), self.steps()
        self.show_steps((*steps[:row], *steps[row + 1 :]))
        self.edited.emit()


def _millimetres() -> NumberField:
    field = NumberField("mm", least=THICKNESS.least, greatest=THICKNESS.greatest, step=0.2)
    field.set_room(_FIELD_PX)
    return field


def _stiffness(unit: str, limits: tuple[float, float], step: float) -> NumberField:
    """Return a field of a value that may be unknown, which it then shows."""
    least, greatest = limits
    field = NumberField(unit, least=0, greatest=greatest, step=step, decimals=2 if least < 1 else 1)
    field.allow_unknown(least)
    field.setToolTip(tr("0 if unknown"))
    field.set_room(_FIELD_PX)
    return field


def _typed(line: QLineEdit, before: str) -> str:
    """Return the text of a line; what it was before if only its translation is shown."""
    text = line.text().strip()
    return before if text in (capitalised(before), translate_core_message(before)) else text


def _numbered(number: int) -> str:
    return tr("Own material {number}").format(number=number)
