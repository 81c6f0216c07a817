"""The dialog in which a clinic keeps its own blocks."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from insole_core.errors import InputError
from insole_core.solids.shop import Block
from insole_core.workflows.clinic_tables import require_names
from insole_studio.texts import tr
from insole_studio.widgets.form_parts import plain_button
from insole_studio.widgets.icons import icon
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.number_field import NumberField

_WIDTH_PX = 620
_NAME_PX, _LENGTH_PX, _REMOVE_PX, _GAP_PX = 200, 96, 28, 6
_FIRST_MM = (340.0, 260.0, 40.0)
_LIMITS_MM = ((20.0, 1000.0), (20.0, 1000.0), (5.0, 300.0))


class BlocksDialog(QDialog):
    """Make, name, change and delete the clinic's own blocks.

    Parameters
    ----------
    own
        The clinic's blocks.
    stock
        The shop's blocks, whose names are taken.
    """

    def __init__(
        self, own: Sequence[Block], stock: Sequence[Block], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Own blocks"))
        self.setMinimumWidth(_WIDTH_PX)
        self._stock = tuple(stock)
        self.rows: list[BlockRow] = []
        self._empty = QLabel(tr("No blocks of your own yet."))
        self._empty.setObjectName("quiet")
        self._list = QVBoxLayout()
        self._list.setSpacing(4)
        self.problem = MessageLabel("warning")
        self.add = plain_button(tr("Add a block"), self._add_first)
        self.buttons = QDialogButtonBox()
        self.keep = self.buttons.addButton(
            tr("Save the blocks"), QDialogButtonBox.ButtonRole.AcceptRole
        )
        self.buttons.addButton(tr("Cancel"), QDialogButtonBox.ButtonRole.RejectRole)
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        self._lay_out()
        for block in own:
            self._add_row(block)
        self._show_problem()

    def blocks(self) -> tuple[Block, ...]:
        """Return the blocks as they are in the rows."""
        return tuple(row.block() for row in self.rows)

    def _lay_out(self) -> None:
        words = QLabel(
            tr("Blocks that your workshop has in stock, beside those that come with the product.")
        )
        words.setWordWrap(True)
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        layout.addWidget(words)
        layout.addLayout(_heads(BlockRow(Block("", _FIRST_MM))))
        layout.addWidget(self._empty)
        layout.addLayout(self._list)
        layout.addWidget(self.add, alignment=Qt.AlignmentFlag.AlignLeft)
        layout.addWidget(self.problem)
        layout.addStretch(1)
        layout.addWidget(self.buttons)

    def _add_first(self) -> None:
        names = {block.name for block in (*self._stock, *self.blocks())}
        number = next(n for n in range(1, 1000) if _numbered(n) not in names)
        self._add_row(Block(_numbered(number), _FIRST_MM))
        self.rows[-1].name.setFocus()
        self.rows[-1].name.selectAll()
        self._show_problem()

    def _add_row(self, block: Block) -> None:
        row = BlockRow(block)
        row.edited.connect(self._show_problem)
        row.removed.connect(self._remove)
        self.rows.append(row)
        self._list.addWidget(row)

    def _remove(self) -> None:
        row = self.sender()
        assert isinstance(row, BlockRow)
        self.rows.remove(row)
        self._list.removeWidget(row)
        row.hide()
        row.deleteLater()
        self._show_problem()

    def _show_problem(self) -> None:
        self._empty.setVisible(not self.rows)
        sentence = ""
        try:
            require_names(self.blocks(), self._stock)
        except InputError as error:
            sentence = error.message
        self.problem.say(sentence)
        self.keep.setEnabled(not sentence)


class BlockRow(QWidget):
    """One block: its name, three lengths, and a button that deletes it."""

    edited = Signal()
    removed = Signal()

    def __init__(self, block: Block) -> None:
        super().__init__()
        self.name = QLineEdit(block.name)
        self.name.setAccessibleName(tr("Name"))
        self.name.setMinimumWidth(_NAME_PX)
        self.name.textChanged.connect(self.edited)
        self.lengths = tuple(
            NumberField("mm", least=least, greatest=greatest, step=5.0)
            for least, greatest in _LIMITS_MM
        )
        self.remove = QToolButton()
        self.remove.setIcon(icon("remove"))
        self.remove.setAutoRaise(True)
        self.remove.setMinimumWidth(_REMOVE_PX)
        self.remove.setToolTip(tr("Delete this block"))
        self.remove.setAccessibleName(tr("Delete this block"))
        self.remove.clicked.connect(self.removed)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(_GAP_PX)
        layout.addWidget(self.name, 1)
        for field, length_mm, text in zip(
            self.lengths, block.size_mm, _length_names(), strict=True
        ):
            field.show_value(length_mm)
            field.setAccessibleName(text)
            field.set_room(_LENGTH_PX)
            layout.addWidget(field)
        layout.addWidget(self.remove)

    def block(self) -> Block:
        """Return the block; numbers still being typed are taken as they are."""
        for field in self.lengths:
            field.interpretText()
        length, width, height = (field.value() for field in self.lengths)
        return Block(self.name.text().strip(), (length, width, height))


def ask_blocks(
    own: Sequence[Block], stock: Sequence[Block], parent: QWidget
) -> tuple[Block, ...] | None:
    """Let the user edit the clinic's blocks; None if cancelled."""
    dialog = BlocksDialog(own, stock, parent)
    is_kept = dialog.exec() == QDialog.DialogCode.Accepted
    blocks = dialog.blocks()
    dialog.deleteLater()
    return blocks if is_kept else None


def _heads(row: BlockRow) -> QHBoxLayout:
    """Return headings as wide as the fields of a row, which touch mode widens."""
    heads = QHBoxLayout()
    heads.setSpacing(_GAP_PX)
    name = QLabel(tr("Name"))
    name.setObjectName("quiet")
    heads.addWidget(name, 1)
    for text, field in zip(_length_names(), row.lengths, strict=True):
        head = QLabel(text)
        head.setObjectName("quiet")
        head.setFixedWidth(field.maximumWidth())
        heads.addWidget(head)
    heads.addSpacing(_REMOVE_PX)
    return heads


def _length_names() -> tuple[str, str, str]:
    return tr("Length"), tr("Width"), tr("Height")


def _numbered(number: int) -> str:
    return tr("Own block {number}").format(number=number)
