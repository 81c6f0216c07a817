"""The card of one sensor: depth image, colour image below or beside it, and its controls."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QMimeData, Qt, Signal
from PySide6.QtGui import (
    QDrag,
    QDragEnterEvent,
    QDropEvent,
    QMouseEvent,
)
from PySide6.QtWidgets import (
    QApplication,
    QBoxLayout,
    QFrame,
    QHBoxLayout,
    QLabel,
    QMenu,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from insole_core.geometry.arrays import ByteArray
from insole_studio.acquisition.messages import Capability
from insole_studio.features.capture.rows import USUAL_VIEWS, VIEWS_OF_BOTH, SensorRow
from insole_studio.features.capture.sensor_settings import SensorSettings
from insole_studio.texts import tr, translate_core_message
from insole_studio.view_names import view_text
from insole_studio.widgets.form_parts import ComboBox
from insole_studio.widgets.picture_view import PictureView

_LEAST_PX, _SMALL_PX = (160, 120), (144, 108)
MIME = "application/x-insole-studio-sensor"
VIEWS = (*dict.fromkeys(USUAL_VIEWS + VIEWS_OF_BOTH), *(f"view_{n}" for n in range(4, 9)))


class SensorCard(QFrame):
    """The card of one sensor; dropping it onto another card swaps their views."""

    view_chosen = Signal(str, str)
    dropped = Signal(str, str)
    tilt_requested = Signal(str, float)
    level_requested = Signal(str)
    identify_requested = Signal(str, bool)
    tuning_edited = Signal(str, object)
    retake_requested = Signal(str)

    def __init__(self, serial: str, tilt_step_deg: float, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.serial = serial
        self._tilt_step_deg = tilt_step_deg
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self.setAcceptDrops(True)
        self._title = _Grip(serial)
        self._depth, self._color = PictureView(), PictureView()
        self._pictures = QBoxLayout(QBoxLayout.Direction.TopToBottom)
        self._pictures.addWidget(self._depth, 1)
        self._pictures.addWidget(self._color, 1)
        self._facts, self._hints = QLabel(), QLabel()
        self._facts.setWordWrap(True)  # its length decides no width: the buttons of all cards fit
        self._facts.setObjectName("quiet")
        self._hints.setWordWrap(True)
        self._view = ComboBox([(view, view_text(view)) for view in VIEWS])
        self._view.setAccessibleName(tr("View of sensor {serial}").format(serial=serial))
        self._view.edited.connect(self._choose_view)
        self._settings = SensorSettings(serial)
        self._settings.edited.connect(lambda tuning: self.tuning_edited.emit(self.serial, tuning))
        self._retake = QToolButton()
        self._retake.setText(tr("Capture again"))
        self._retake.clicked.connect(self._retake_view)
        self._retakes: tuple[str, ...] = ()
        self._asking: dict[Capability, list[QToolButton]] = {}
        self._lay_out()

    def show_row(self, row: SensorRow) -> None:
        """Show everything except the images."""
        self._title.setText(f"{row.title}   {row.progress}".rstrip())
        self._facts.setText(row.facts)
        hint = translate_core_message(row.problem or "") or " · ".join(row.hints)
        self._hints.setText(hint)
        self._hints.setObjectName("warning" if hint else "")
        self._hints.setStyle(self._hints.style())
        if self._view.findData(row.view) < 0:
            self._view.addItem(view_text(row.view), row.view)
        self._view.show_value(row.view)
        self._retakes = row.retakes
        self._retake.setEnabled(bool(row.retakes))
        for capability, buttons in self._asking.items():
            for button in buttons:
                button.setEnabled(capability in row.capabilities)
        self._settings.show_row(row)

    def show_pictures(self, depth: ByteArray | None, color: ByteArray | None) -> None:
        """Show new images (height, width, 3) uint8, RGB; None keeps the current one."""
        if depth is not None:
            self._depth.show_picture(depth)
        if color is not None:
            self._color.show_picture(color)

    def lay_pictures(self, beside: bool) -> None:
        """Lay the colour picture beside the depth, or below it; the card grows no wider."""
        direction = QBoxLayout.Direction
        self._pictures.setDirection(direction.LeftToRight if beside else direction.TopToBottom)
        for picture in (self._depth, self._color):
            picture.setMinimumSize(*(_SMALL_PX if beside else _LEAST_PX))

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Accept other cards."""
        if event.mimeData().hasFormat(MIME):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        """Swap views with the dropped card."""
        other = bytes(event.mimeData().data(MIME).data()).decode()
        event.acceptProposedAction()
        self.dropped.emit(other, self.serial)

    def _lay_out(self) -> None:
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 8)
        layout.setSpacing(8)
        head = QHBoxLayout()
        head.addWidget(self._title, 1)
        head.addWidget(self._view)
        layout.addLayout(head)
        layout.addLayout(self._pictures, 1)
        layout.addWidget(self._facts)
        layout.addWidget(self._hints)
        layout.addWidget(self._settings)
        layout.addLayout(self._buttons())

    def _buttons(self) -> QHBoxLayout:
        row = QHBoxLayout()
        row.setSpacing(4)
        tilting: list[QToolButton] = []
        for text, tip, turn in (
            (tr("Tilt −"), tr("Tilt the sensor down"), -self._tilt_step_deg),
            (tr("Tilt +"), tr("Tilt the sensor up"), self._tilt_step_deg),
        ):
            button = _button(text, tip)
            button.clicked.connect(lambda _on, by=turn: self.tilt_requested.emit(self.serial, by))
            row.addWidget(button)
            tilting.append(button)
        level = _button(tr("Level"), tr("Level the sensor by its accelerometer"))
        level.clicked.connect(lambda: self.level_requested.emit(self.serial))
        row.addWidget(level)
        identify = _button(tr("Identify"), tr("Let the light of this sensor blink"))
        identify.setCheckable(True)
        identify.toggled.connect(lambda on: self.identify_requested.emit(self.serial, on))
        row.addWidget(identify)
        self._asking = {Capability.TILT: [*tilting, level], Capability.BLINK: [identify]}
        row.addStretch(1)
        row.addWidget(self._retake)
        return row

    def _retake_view(self) -> None:
        """Request a new capture of a view; if the sensor has several, offer a menu."""
        if len(self._retakes) == 1:
            self._emit_retake(self._retakes[0])
            return
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        for view in self._retakes:
            menu.addAction(view_text(view)).triggered.connect(partial(self._emit_retake, view))
        menu.popup(self._retake.mapToGlobal(self._retake.rect().bottomLeft()))

    def _emit_retake(self, view: str, _on: bool = False) -> None:
        self.retake_requested.emit(view)

    def _choose_view(self, view: str) -> None:
        self.view_chosen.emit(self.serial, view)


class _Grip(QLabel):
    """The title of a card, by which it is dragged."""

    def __init__(self, serial: str) -> None:
        super().__init__()
        self._serial = serial
        self.setObjectName("heading")
        self.setCursor(Qt.CursorShape.OpenHandCursor)
        self.setToolTip(
            tr("Sensor {serial}. Drag onto another to exchange views.").format(serial=serial)
        )

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Start dragging."""
        if not event.buttons() & Qt.MouseButton.LeftButton or QApplication.activeModalWidget():
            return
        data = QMimeData()
        data.setData(MIME, self._serial.encode())
        drag = QDrag(self)
        drag.setMimeData(data)
        drag.exec(Qt.DropAction.MoveAction)


def _button(text: str, tip: str) -> QToolButton:
    button = QToolButton()
    button.setText(text)
    button.setToolTip(tip)
    return button
