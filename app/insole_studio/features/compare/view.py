"""View of the compare stage: sources left, surfaces in the middle, statistics right."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QFormLayout,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from insole_core.geometry.arrays import ByteArray
from insole_core.geometry.mesh import TriangleMesh
from insole_studio.features.compare.rows import MAPS, RESULT, CompareButtons, FigureRow
from insole_studio.scene.coloring import Coloring
from insole_studio.scene.point_picker import PointPicker
from insole_studio.scene.pointer import MarkedPoint
from insole_studio.scene.view_camera import Subject
from insole_studio.texts import tr
from insole_studio.widgets.form_parts import ComboBox, mark_labels
from insole_studio.widgets.layouts import keep_room, remove_widgets
from insole_studio.widgets.message_label import MessageLabel, ProgressBar
from insole_studio.widgets.model_view import ModelView
from insole_studio.widgets.number_field import NumberField
from insole_studio.widgets.picture_view import PictureView

_LEFT_PX, _RIGHT_PX = 300, 300


class CompareView(QWidget):
    """The compare panel; emits the user's intents. The two surfaces are "a" and "b"."""

    source_chosen = Signal(str, str)
    alignment_chosen = Signal(str)
    median_edited = Signal(float)
    point_picked = Signal(str, object)
    take_back_requested = Signal()
    save_requested = Signal()
    cancel_requested = Signal()
    close_requested = Signal()
    tab_shown = Signal(int)

    def __init__(self, dark: bool, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.sources = {which: ComboBox([]) for which in "ab"}
        self.models = {
            which: ModelView(Subject.INSOLE, name, dark)
            for which, name in (("a", tr("First, A")), ("b", tr("Second, B")))
        }
        self.pickers = {
            "a": PointPicker(lambda place: self.point_picked.emit("a", place)),
            "b": PointPicker(lambda place: self.point_picked.emit("b", place)),
        }
        for which, model in self.models.items():
            model.scene.sink = self.pickers[which]
        self.sources["a"].edited.connect(self._choose_a)
        self.sources["b"].edited.connect(self._choose_b)
        self.result = ModelView(Subject.INSOLE, "", dark)
        for model in (*self.models.values(), self.result):
            model.preset_requested.connect(model.look_from)
        self.map_picture = PictureView()
        self.alignment = ComboBox(
            [
                ("best", tr("Best fit")), ("picked", tr("Picked points")),
                ("dots", tr("Four black dots")), ("none", tr("As they lie")),
            ]
        )  # fmt: skip
        self.alignment.edited.connect(self.alignment_chosen)
        self.median = NumberField("mm", least=1, greatest=25, step=1, decimals=0)
        self.median.setToolTip(
            tr("Both surfaces are evened out over this width before they are compared; 1 for none")
        )
        self.median.edited.connect(self.median_edited)
        self.hint = QLabel()
        self.hint.setObjectName("quiet")
        self.hint.setWordWrap(True)
        self._notes, self.error = MessageLabel("quiet"), MessageLabel("warning")
        self.figures = QGridLayout()
        self.figures.setColumnStretch(0, 1)
        self.figures.setHorizontalSpacing(12)
        self._progress = ProgressBar()
        self.take_back = _button(tr("Take the last point back"), self.take_back_requested.emit)
        self.cancel = _button(tr("Cancel"), self.cancel_requested.emit)
        keep_room(self.cancel)
        self.leave = _button(tr("Close"), self.close_requested.emit)
        self.leave.setToolTip("Esc")
        self.save = _button(tr("Save report…"), self.save_requested.emit)
        self.tabs = QTabWidget()
        self._lay_out()

    def show_sources(self, options: Sequence[tuple[str, str]], chosen: dict[str, str]) -> None:
        """List the surfaces that can be compared.

        Parameters
        ----------
        options
            Pairs of key and text.
        chosen
            The chosen key, by surface.
        """
        for which, field in self.sources.items():
            field.clear()
            for word, text in options:
                field.addItem(text, word)
            field.show_value(chosen.get(which, ""))

    def show_source(self, which: str, mesh: TriangleMesh | None, from_above: bool) -> None:
        """Show a surface.

        Parameters
        ----------
        which
            "a" or "b".
        mesh
            The surface; None shows a hint instead.
        from_above
            Whether the compared side faces up (+z).
        """
        model = self.models[which]
        if mesh is None:
            model.show_empty(tr("Choose what is compared, at the left."), {})
            return
        model.scene.subject = Subject.INSOLE if from_above else Subject.FOOT
        model.show_mesh(mesh)
        model.look_at_whole(mesh.bounds_mm)

    def show_points(self, which: str, points: Sequence[MarkedPoint]) -> None:
        """Show the picked points of a surface."""
        self.models[which].show_key_points(points)

    def show_result(self, mesh: TriangleMesh, coloring: Coloring, from_above: bool) -> None:
        """Show the difference as colours on the first surface.

        Parameters
        ----------
        mesh
            The first surface.
        coloring
            The difference, per vertex.
        from_above
            Whether the compared side faces up (+z).
        """
        self.result.scene.subject = Subject.INSOLE if from_above else Subject.FOOT
        self.result.show_mesh(mesh, coloring)
        self.result.look_at_whole(mesh.bounds_mm)

    def show_picture(self, picture: ByteArray) -> None:
        """Show the difference maps, (height, width, 3) uint8, RGB."""
        self.map_picture.show_picture(picture)

    def show_no_picture(self) -> None:
        """Show no difference maps."""
        self.map_picture.show_sentence("")

    def show_figures(self, rows: Sequence[FigureRow]) -> None:
        """Show the statistics; rows without numbers are headings."""
        remove_widgets(self.figures)
        for number, row in enumerate(rows):
            if row.is_quiet:
                self._add_remark(number, row.text)
                continue
            heading = not row.first or row.first == "A"
            for column, text in enumerate((row.text, row.first, row.second)):
                label = QLabel(text)
                label.setObjectName("heading" if heading else "")
                if column:
                    label.setAlignment(Qt.AlignmentFlag.AlignRight)
                self.figures.addWidget(label, number, column)

    def _add_remark(self, number: int, text: str) -> None:
        remark = QLabel(text)
        remark.setObjectName("quiet")
        remark.setWordWrap(True)
        self.figures.addWidget(remark, number, 0, 1, 3)

    def show_picking(self, on: bool, hint: str) -> None:
        """Enable or disable picking points, and show a hint."""
        for picker in self.pickers.values():
            picker.is_on = on
        self.hint.setText(hint)
        self.take_back.setVisible(on)

    def show_tab(self, number: int) -> None:
        """Show the tab of the surfaces, the difference in 3-D, or the maps."""
        self.tabs.setCurrentIndex(number)

    def show_has_result(self, there: bool) -> None:
        """Enable or disable the tabs of the result."""
        for number in (RESULT, MAPS):
            self.tabs.setTabEnabled(number, there)

    def show_notes(self, sentences: Sequence[str]) -> None:
        """Show the assumptions of the comparison."""
        self._notes.say_all(sentences)

    def show_error(self, sentence: str) -> None:
        """Show an error; an empty sentence hides it."""
        self.error.say(sentence)

    def show_progress(self, fraction: float, text: str) -> None:
        """Show the progress of a job (`fraction` 0 to 1); an empty text hides it."""
        self._progress.show_work(fraction, text)

    def show_buttons(self, buttons: CompareButtons) -> None:
        """Enable and disable the buttons."""
        self.save.setEnabled(buttons.save)
        self.cancel.setVisible(buttons.cancel)
        self.leave.setHidden(buttons.cancel)
        self.take_back.setEnabled(buttons.take_back)

    def close_scenes(self) -> None:
        """Free the renderers."""
        for model in (*self.models.values(), self.result):
            model.scene.close_scene()

    def _lay_out(self) -> None:
        left, right = QVBoxLayout(), QVBoxLayout()
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(tr("First, A"), self.sources["a"])
        form.addRow(tr("Second, B"), self.sources["b"])
        form.addRow(tr("B is laid on A by"), self.alignment)
        form.addRow(tr("Smoothing"), self.median)
        mark_labels(form)
        left.addLayout(form)
        for widget in (self.hint, self.take_back, self._notes):
            left.addWidget(widget)
        left.addStretch(1)
        pair = QWidget()
        row = QHBoxLayout(pair)
        row.setContentsMargins(0, 0, 0, 0)
        for model in self.models.values():
            row.addWidget(model, 1)
        self.tabs.addTab(pair, tr("Surfaces"))
        self.tabs.addTab(self.result, tr("Difference in 3-D"))
        self.tabs.addTab(self.map_picture, tr("Difference maps"))
        self.tabs.setDocumentMode(True)
        self.tabs.currentChanged.connect(self.tab_shown)
        right.addLayout(self.figures)
        right.addStretch(1)
        right.addWidget(self.error)
        right.addWidget(self._progress)
        buttons = QHBoxLayout()
        buttons.addWidget(self.leave)
        buttons.addWidget(self.cancel)
        buttons.addWidget(self.save, 1)
        right.addLayout(buttons)
        layout = QHBoxLayout(self)
        for column, width in ((left, _LEFT_PX), (right, _RIGHT_PX)):
            part = QWidget()
            part.setFixedWidth(width)
            column.setContentsMargins(0, 0, 0, 0)
            column.setSpacing(8)
            part.setLayout(column)
            layout.addWidget(part)
        layout.insertWidget(1, self.tabs, 1)

    def _choose_a(self, word: str) -> None:
        self.source_chosen.emit("a", word)

    def _choose_b(self, word: str) -> None:
        self.source_chosen.emit("b", word)


def _button(text: str, clicked: object) -> QPushButton:
    button = QPushButton(text)
    button.clicked.connect(clicked)
    return button
