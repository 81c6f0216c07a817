"""View of the calibrate stage: steps left, the open step in the middle, its images right."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QItemSelectionModel, QSignalBlocker, Qt, Signal, SignalInstance
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QPushButton,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from insole_core.geometry.arrays import ByteArray
from insole_studio.features.calibrate.rows import (
    BoardSize,
    CalibrateButtons,
    LiveRow,
    LookRow,
    StepRow,
)
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.form_parts import allow
from insole_studio.widgets.message_label import MessageLabel, ProgressBar
from insole_studio.widgets.number_field import NumberField
from insole_studio.widgets.picture_view import PictureView

_KEY = Qt.ItemDataRole.UserRole
_LEFT_PX, _MIDDLE_PX = 240, 360


class CalibrateView(QWidget):
    """The calibrate panel; emits the user's intents."""

    serial_edited = Signal(str)
    step_chosen = Signal(str)
    board_edited = Signal(object)
    folder_requested = Signal()
    look_chosen = Signal(int)
    calibrate_requested = Signal()
    check_requested = Signal()
    save_requested = Signal()
    undo_requested = Signal()
    live_toggled = Signal(bool)
    automatic_toggled = Signal(bool)
    take_requested = Signal()
    print_requested = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.serial = QComboBox()
        self.serial.setEditable(True)
        self.serial.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)
        self.serial.setAccessibleName(tr("Serial number"))
        self.serial_line = QLineEdit()
        self.serial.setLineEdit(self.serial_line)
        self.serial_line.setPlaceholderText(tr("Serial number"))
        self.serial_line.editingFinished.connect(self._serial_typed)
        self.serial.textActivated.connect(self.serial_edited)
        self.steps = QListWidget()
        self.steps.currentItemChanged.connect(self._step_chosen)
        self.steps.itemSelectionChanged.connect(self._mark_current)
        self._title, self._instruction, self.next_steps = QLabel(), QLabel(), QLabel()
        self._title.setObjectName("heading")
        self.error = MessageLabel("warning")
        for label in (self._instruction, self.next_steps):
            label.setWordWrap(True)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._columns, self._rows = _count_field(), _count_field()
        self._square = NumberField("mm", least=5, greatest=200, step=0.5, decimals=2)
        self._board = self._board_form()
        self._columns.valueChanged.connect(self._board_changed)
        self._rows.valueChanged.connect(self._board_changed)
        self._square.edited.connect(self._board_changed)
        self.choose = _button(tr("Choose folder…"), self.folder_requested)
        self.print_boards = _button(tr("Print boards…"), self.print_requested)
        self.print_boards.setToolTip(tr("Boards and marker templates at true size"))
        self.calibrate = _button(tr("Calibrate"), self.calibrate_requested)
        self.check = _button(tr("Check the pattern by the newest wall"), self.check_requested)
        self.save = _button(tr("Save to the device"), self.save_requested)
        self.undo = _button(tr("Undo the last step"), self.undo_requested)
        self.looks = QListWidget()
        self.looks.currentRowChanged.connect(self.look_chosen)
        self._picture = PictureView()
        self.live = QPushButton(tr("Live picture"))
        self.live.setCheckable(True)
        self.live.toggled.connect(self.live_toggled)
        self.automatic = QCheckBox(tr("Take by itself"))
        self.automatic.setToolTip(tr("When the board or the wall stands still in a new place"))
        self.automatic.setChecked(True)
        self.automatic.toggled.connect(self.automatic_toggled)
        self.take = _button(tr("Take picture"), self.take_requested)
        self.live_sentence = QLabel()
        self.live_sentence.setWordWrap(True)
        self._progress = ProgressBar()
        self._pressed: QPushButton | None = None
        """That was pressed and is grey while it works; it gets the focus back."""
        self._layout()

    def show_serials(self, serials: Sequence[str]) -> None:
        """List the known sensors; text being typed is kept."""
        typed = self.serial.currentText()
        with QSignalBlocker(self.serial):
            self.serial.clear()
            self.serial.addItems(list(serials))
            self.serial.setCurrentText(typed)

    def show_steps(self, rows: Sequence[StepRow]) -> None:
        """Show the steps, with the day on which each was done."""
        with QSignalBlocker(self.steps):
            self.steps.clear()
            for row in rows:
                done = tr("done on {day}").format(day=row.done) if row.done else tr("to do")
                item = QListWidgetItem(f"{'●' if row.done else '○'}  {row.title}\n     {done}")
                item.setData(_KEY, row.key)
                self.steps.addItem(item)
                if row.open:
                    self.steps.setCurrentItem(item)

    def show_step(self, title: str, instruction: str, uses_board: bool, checks: bool) -> None:
        """Show the open step.

        Parameters
        ----------
        title, instruction
            Translated texts.
        uses_board
            Whether to show the fields of the board.
        checks
            Whether to show the button that checks what the step has learnt.
        """
        self._title.setText(title)
        self._instruction.setText(instruction)
        self._board.setVisible(uses_board)
        self.check.setVisible(checks)

    def show_board(self, board: BoardSize) -> None:
        """Show the board in use."""
        for field, value in ((self._columns, board.columns), (self._rows, board.rows)):
            with QSignalBlocker(field):
                field.setValue(value)
        self._square.show_value(board.square_mm)

    def show_looks(self, rows: Sequence[LookRow]) -> None:
        """Show the result of inspecting each image."""
        with QSignalBlocker(self.looks):
            self.looks.clear()
            for row in rows:
                said = translate_core_message(row.sentence)
                told = said if said.startswith(row.name) else f"{row.name}: {said}"
                item = QListWidgetItem(f"{'✓' if row.usable else '✗'}  {told}")
                item.setToolTip(said)
                self.looks.addItem(item)
            self.looks.setCurrentRow(0)

    def show_picture(self, picture: ByteArray) -> None:
        """Show an image, (height, width, 3) uint8, RGB."""
        self._picture.show_picture(picture)

    def show_no_picture(self, sentence: str) -> None:
        """Show a sentence instead of the image."""
        self._picture.show_sentence(sentence)

    def show_serial(self, serial: str) -> None:
        """Show the chosen sensor."""
        with QSignalBlocker(self.serial):
            self.serial.setCurrentText(serial)

    def show_live(self, row: LiveRow) -> None:
        """Show the state of the live image."""
        with QSignalBlocker(self.live):
            self.live.setChecked(row.running)
        self.automatic.setVisible(row.running)
        self.take.setVisible(row.running)
        allow(self.take, row.why_not_take)
        self.live_sentence.setText(translate_core_message(row.sentence))

    def show_next(self, sentences: Sequence[str]) -> None:
        """Show what to do next, or the result."""
        self.next_steps.setText(
            "\n".join(f"• {translate_core_message(sentence)}" for sentence in sentences)
        )

    def show_error(self, sentence: str) -> None:
        """Show an error; an empty sentence hides it."""
        self.error.say(sentence)

    def show_progress(self, fraction: float, text: str) -> None:
        """Show the progress of a job (`fraction` 0 to 1); an empty text hides it."""
        self._progress.show_work(fraction, text)

    def show_buttons(self, buttons: CalibrateButtons) -> None:
        """Enable the buttons, or let them say why they are not."""
        tips = {
            self.check: tr("Whether the pattern that is kept has drifted; nothing is written"),
            self.undo: tr("The sensor as it was before a result was last saved; again, to redo it"),
        }
        why_not = {
            self.choose: buttons.choose,
            self.calibrate: buttons.calibrate,
            self.check: buttons.check,
            self.save: buttons.save,
            self.undo: buttons.undo,
        }
        focused = self.window().focusWidget()
        pressed = next((button for button in why_not if button is focused), None)
        for button, sentence in why_not.items():
            allow(button, translate_core_message(sentence), tips.get(button, ""))
        if pressed is not None and not pressed.isEnabled():
            # Qt gives the focus to the serial number, all of it selected: the next key replaces it.
            self._pressed = pressed
            self.steps.setFocus(Qt.FocusReason.OtherFocusReason)
        elif self._pressed is not None and self._pressed.isEnabled():
            if focused is self.steps:  # else the user has gone on elsewhere
                self._pressed.setFocus(Qt.FocusReason.OtherFocusReason)
            self._pressed = None

    def board(self) -> BoardSize:
        """Return the board entered in the fields."""
        return BoardSize(self._columns.value(), self._rows.value(), self._square.value())

    def _board_form(self) -> QWidget:
        corners = QHBoxLayout()
        corners.addWidget(self._columns, 1)
        corners.addWidget(QLabel("×"))
        corners.addWidget(self._rows, 1)
        widget = QWidget()
        form = QFormLayout(widget)
        form.setContentsMargins(0, 0, 0, 0)
        form.addRow(tr("Inner corners"), corners)
        form.addRow(tr("Side of a square"), self._square)
        return widget

    def _layout(self) -> None:
        left, middle, right = QVBoxLayout(), QVBoxLayout(), QVBoxLayout()
        _stack(left, QLabel(tr("Sensor")), self.serial, self.steps, self.undo)
        _stack(middle, self._title, self._instruction, self._board, self.print_boards)
        _stack(middle, self.choose)
        _stack(middle, self.next_steps, self.error)
        middle.addStretch(1)
        _stack(middle, self._progress, self.check, self.calibrate, self.save)
        controls = QHBoxLayout()
        for widget in (self.live, self.take, self.automatic):
            controls.addWidget(widget)
        controls.addWidget(self.live_sentence, 1)
        right.addLayout(controls)
        right.addWidget(self._picture, 2)
        right.addWidget(self.looks, 1)
        layout = QHBoxLayout(self)
        for column, width in ((left, _LEFT_PX), (middle, _MIDDLE_PX)):
            part = QWidget()
            part.setFixedWidth(width)
            column.setContentsMargins(0, 0, 0, 0)
            column.setSpacing(8)
            part.setLayout(column)
            layout.addWidget(part)
        layout.addLayout(right, 1)

    def _serial_typed(self) -> None:
        self.serial_edited.emit(self.serial_line.text())

    def _step_chosen(self, item: QListWidgetItem | None) -> None:
        if item is not None:
            self.step_chosen.emit(item.data(_KEY))

    def _mark_current(self) -> None:
        """Mark the step that is shown: a click marks its own, even if that was not to be left."""
        item = self.steps.currentItem()
        if item is not None and not item.isSelected():
            self.steps.setCurrentItem(item, QItemSelectionModel.SelectionFlag.ClearAndSelect)

    def _board_changed(self) -> None:
        self.board_edited.emit(self.board())


def _stack(column: QVBoxLayout, *widgets: QWidget) -> None:
    for widget in widgets:
        column.addWidget(widget)


def _count_field() -> QSpinBox:
    field = QSpinBox()
    field.setRange(3, 50)
    field.setKeyboardTracking(False)
    return field


def _button(text: str, signal: SignalInstance) -> QPushButton:
    button = QPushButton(text)
    button.clicked.connect(signal)
    return button
