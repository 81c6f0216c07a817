"""Versions side by side: of a foot or a field that two have changed, and all those of a visit."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum, auto
from typing import Any, Final, TypeAlias

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QButtonGroup,
    QDialog,
    QDialogButtonBox,
    QGridLayout,
    QLabel,
    QPushButton,
    QRadioButton,
    QVBoxLayout,
    QWidget,
)

from insole_core.cases.case_record import FootRecord, Variant
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design_differences import design_differences
from insole_core.records.prescription import VersionSummary
from insole_core.records.record_field import FieldChoice, Lines, Typed
from insole_studio.features.records.rows import shown_message
from insole_studio.texts import moment_text, tr, translate_core_message
from insole_studio.widgets.form_parts import allow
from insole_studio.widgets.layouts import VerticalScroll
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.row_table import RowTable, TableRow

_FEET_SIZE: Final = (760, 460)
_FIELDS_SIZE: Final = (760, 360)
_HISTORY_SIZE: Final = (860, 480)


class Choice(Enum):
    """Which version becomes the newest one; the other stays in the history."""

    MINE = auto()
    THEIRS = auto()
    BOTH = auto()
    """Theirs as a further variant of mine."""


@dataclass(frozen=True)
class ComparedVersion:
    """One of the two versions: whose it is, from when, and its prescription."""

    title: str
    details: str
    foot: FootRecord


class ConflictDialog(QDialog):
    """Shows both versions and their differences; closed without a choice, nothing is decided."""

    def __init__(
        self, mine: ComparedVersion, theirs: ComparedVersion, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.choice: Choice | None = None
        self.setWindowTitle(tr("Two versions of the same foot"))
        self.resize(*_FEET_SIZE)
        whose = {
            Side.LEFT: tr(
                "Somebody else has changed the left foot of this visit while you worked on it."
            ),
            Side.RIGHT: tr(
                "Somebody else has changed the right foot of this visit while you worked on it."
            ),
        }[mine.foot.side]
        then = tr("Choose what goes on; the other version stays in the history.")
        sentence = QLabel(f"{whose} {then}")
        sentence.setWordWrap(True)
        columns = QGridLayout()
        columns.setHorizontalSpacing(24)
        for number, version in enumerate((mine, theirs)):
            _add_column(columns, number, version)
        changes = VerticalScroll()
        changes.setWidget(_list_of(_differences(mine.foot, theirs.foot)))
        buttons = QDialogButtonBox()
        self.buttons: dict[Choice, QPushButton] = {}
        for choice, text in (
            (Choice.MINE, tr("Go on with mine")),
            (Choice.THEIRS, tr("Go on with theirs")),
            (Choice.BOTH, tr("Keep both as variants")),
        ):
            button = buttons.addButton(text, QDialogButtonBox.ButtonRole.ActionRole)
            button.setAutoDefault(False)
            button.setProperty("choice", choice)
            button.clicked.connect(self._choose)
            self.buttons[choice] = button
        later = buttons.addButton(tr("Decide later"), QDialogButtonBox.ButtonRole.RejectRole)
        later.setDefault(True)
        buttons.rejected.connect(self.reject)
        heading = QLabel(tr("From theirs to mine"))
        heading.setObjectName("heading")
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        for part in (sentence, heading, changes, buttons):
            layout.addWidget(part, 1 if part is changes else 0)
        layout.insertLayout(1, columns)

    def _choose(self) -> None:
        self.choice = self.sender().property("choice")
        self.accept()


def chosen_foot(choice: Choice, mine: FootRecord, theirs: FootRecord, author: str) -> FootRecord:
    """Return the foot that a choice stands for.

    Parameters
    ----------
    author
        Of theirs; names its variant where both are kept.
    """
    if choice is Choice.MINE:
        return mine
    if choice is Choice.THEIRS:
        return theirs
    name, number = author, 2
    taken = {variant.name for variant in mine.variants}
    while name in taken:
        name, number = f"{author} {number}", number + 1
    return mine.with_variant(Variant(name, theirs.design)).with_chosen(mine.chosen)


def _differences(mine: FootRecord, theirs: FootRecord) -> list[str]:
    changes = design_differences(theirs.design, mine.design)
    lines = [translate_core_message(line) for line in changes]
    if mine.source.sha256 != theirs.source.sha256:
        lines.insert(0, tr("Another scan"))
    if [v.name for v in mine.variants] != [v.name for v in theirs.variants]:
        lines.append(tr("Other variants"))
    if mine.annotations != theirs.annotations:
        lines.append(tr("Other marks on the foot"))
    return lines or [tr("No difference that can be seen")]


def _add_column(columns: QGridLayout, number: int, version: ComparedVersion) -> None:
    title, details = QLabel(version.title), QLabel(version.details)
    title.setObjectName("numbers")
    details.setObjectName("quiet")
    for row, label in enumerate((title, details)):
        label.setWordWrap(True)
        columns.addWidget(label, row, number, Qt.AlignmentFlag.AlignTop)
    columns.setColumnStretch(number, 1)


def _list_of(lines: Sequence[str]) -> QWidget:
    content = QWidget()
    layout = QVBoxLayout(content)
    layout.setSpacing(4)
    for line in lines:
        label = QLabel(f"•  {line}")
        label.setWordWrap(True)
        layout.addWidget(label)
    layout.addStretch(1)
    return content


@dataclass(frozen=True)
class CollidedField:
    """A field with two values.

    Parameters
    ----------
    label
        What it is called.
    is_joinable
        Whether both values can be kept, one below the other.
    """

    name: str
    label: str
    mine: str
    theirs: str
    is_joinable: bool = False


AskFields: TypeAlias = Callable[
    [Sequence[CollidedField], Callable[[Mapping[str, FieldChoice]], None]], None
]
"""Asks about fields, and calls a function with the choice for each."""


def collided_fields(
    mine: Any, theirs: Any, names: Sequence[str], fields: Mapping[str, Typed]
) -> list[CollidedField]:
    """Return some fields of two persons, visits or patients as they are shown."""
    return [
        CollidedField(
            name,
            translate_core_message(fields[name].label),
            shown_message(fields[name].said(getattr(mine, name))),
            shown_message(fields[name].said(getattr(theirs, name))),
            isinstance(fields[name], Lines),
        )
        for name in names
    ]


class FieldConflictDialog(QDialog):
    """Shows both values of each field; closed without a choice, theirs stay as they are."""

    def __init__(self, fields: Sequence[CollidedField], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Two versions of the same fields"))
        self.resize(*_FIELDS_SIZE)
        self._fields = fields
        self._groups: dict[str, QButtonGroup] = {}
        self.choice_buttons: dict[tuple[str, FieldChoice], QRadioButton] = {}
        sentence = QLabel(
            tr(
                "Somebody else has changed the same fields while you worked on them. Choose which "
                "value counts; all others of your changes are stored."
            )
        )
        sentence.setWordWrap(True)
        content = QWidget()
        grid = QGridLayout(content)
        grid.setHorizontalSpacing(24)
        grid.setVerticalSpacing(12)
        for column in (1, 2):
            grid.setColumnStretch(column, 1)
        for number, field in enumerate(fields):
            self._add(grid, 2 * number, field)
        grid.setRowStretch(grid.rowCount(), 1)
        scroll = VerticalScroll()
        scroll.setWidget(content)
        buttons = QDialogButtonBox()
        self.store = buttons.addButton(tr("Store"), QDialogButtonBox.ButtonRole.AcceptRole)
        buttons.addButton(tr("Keep theirs"), QDialogButtonBox.ButtonRole.RejectRole)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        for part in (sentence, scroll, buttons):
            layout.addWidget(part, 1 if part is scroll else 0)

    @property
    def choices(self) -> dict[str, FieldChoice]:
        """What was chosen for each field."""
        if self.result() != QDialog.DialogCode.Accepted:
            return {field.name: FieldChoice.THEIRS for field in self._fields}
        return {
            name: choice for (name, choice), radio in self.choice_buttons.items()
            if radio.isChecked()
        }  # fmt: skip

    def _add(self, grid: QGridLayout, row: int, field: CollidedField) -> None:
        name = QLabel(field.label)
        name.setObjectName("numbers")
        grid.addWidget(name, row, 0, Qt.AlignmentFlag.AlignTop)
        group = self._groups[field.name] = QButtonGroup(self)
        for column, choice, value in (
            (1, FieldChoice.MINE, field.mine),
            (2, FieldChoice.THEIRS, field.theirs),
        ):
            cell = QVBoxLayout()
            cell.setSpacing(4)
            text = tr("My value") if choice is FieldChoice.MINE else tr("Their value")
            cell.addWidget(self._radio(group, field, choice, text))
            cell.addWidget(_value_label(value))
            grid.addLayout(cell, row, column, Qt.AlignmentFlag.AlignTop)
        if field.is_joinable:
            both = self._radio(group, field, FieldChoice.BOTH, tr("Both, one below the other"))
            grid.addWidget(both, row + 1, 1, 1, 2)
        preselected = FieldChoice.BOTH if field.is_joinable else FieldChoice.MINE
        self.choice_buttons[field.name, preselected].setChecked(True)

    def _radio(
        self, group: QButtonGroup, field: CollidedField, choice: FieldChoice, text: str
    ) -> QRadioButton:
        radio = QRadioButton(text)
        radio.setAccessibleName(f"{field.label}: {text}")
        group.addButton(radio)
        self.choice_buttons[field.name, choice] = radio
        return radio


def _value_label(value: str) -> QLabel:
    label = QLabel(value or "–")
    label.setTextFormat(Qt.TextFormat.PlainText)
    label.setWordWrap(True)
    label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    return label


class HistoryDialog(QDialog):
    """A table of versions, the newest first, and the changes of the chosen one below it."""

    version_chosen = Signal(str)
    sign_requested = Signal(str)

    def __init__(
        self, title: str, versions: Sequence[VersionSummary], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.resize(*_HISTORY_SIZE)
        self._versions = {version.id: version for version in versions}
        headings = (tr("Foot"), tr("Version"), tr("By"), tr("Changed"), tr("Reason"), tr("Signed"))
        self.table = RowTable(headings, stretched=4)
        self.table.setAccessibleName(tr("Versions"))
        self.table.current_changed.connect(self._choose)
        self.changes = MessageLabel()
        buttons = QDialogButtonBox()
        role = QDialogButtonBox.ButtonRole
        self.sign = buttons.addButton(tr("Sign this version"), role.ActionRole)
        self.sign.setAutoDefault(False)
        self.sign.clicked.connect(self._sign)
        buttons.addButton(tr("Close"), role.RejectRole)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        layout.addWidget(self.table, 1)
        layout.addWidget(self.changes)
        layout.addWidget(buttons)
        self.table.show_rows([_row(version) for version in versions])
        self.table.take_first()

    def show_changes(self, version_id: str, lines: Sequence[str]) -> None:
        """Say what a version changed in the one before it, if it is still the chosen one."""
        if version_id == self.table.current_key:
            self.changes.say_all(lines)

    def _choose(self, version_id: str) -> None:
        version = self._versions.get(version_id)
        why_not = tr("Choose a version first.") if version is None else ""
        if version is not None and version.signed_by is not None:
            why_not = tr("This version is signed already.")
        allow(self.sign, why_not)
        self.changes.say("")
        if version is not None:
            self.version_chosen.emit(version_id)

    def _sign(self) -> None:
        self.sign_requested.emit(self.table.current_key)
        self.accept()


def _row(version: VersionSummary) -> TableRow:
    left = version.side is Side.LEFT
    signed = ""
    if version.signed_by is not None:
        signed = f"{version.signed_by}, {moment_text(version.signed_at or '')}"
    return TableRow(
        version.id,
        (
            tr("LEFT") if left else tr("RIGHT"),
            str(version.number),
            f"{version.author}, {version.station}",
            moment_text(version.changed_at),
            version.reason,
            signed,
        ),
    )
