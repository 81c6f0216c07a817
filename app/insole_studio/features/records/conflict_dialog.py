"""Two versions of one foot side by side: what was changed here, and what somebody else stored."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum, auto

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QGridLayout,
    QLabel,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from insole_core.cases.case_record import FootRecord, Variant
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design_differences import design_differences
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.vertical_scroll import VerticalScroll

_SIZE = (760, 460)


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
        self.resize(*_SIZE)
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
