"""What is told of a change of the pressure: read first, then asked, then a table of regions."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QObject, QPoint, QRect, QSize, Qt, Signal
from PySide6.QtGui import QMoveEvent, QResizeEvent
from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from insole_core.contact.change import SENTENCE, WEIGHT_KG
from insole_core.contact.load_case import Posture
from insole_studio.document.case_names import variant_title
from insole_studio.document.load_view import LoadQuestion
from insole_studio.features.design.load.dose_chart import DoseChart
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.form_parts import ComboBox, mark_labels
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.number_field import NumberField
from insole_studio.widgets.row_table import RowTable, TableRow
from insole_studio.widgets.screen_room import Scrolled, bounded

_WIDTH_PX, _TABLE_PX = 430, 190
"""So narrow that on a screen of 1366 pixels both views have room beside it."""
_NAME_PX = 84
_FLAT = ""
_USUAL_TARGET = -20.0


class LoadDialog(QDialog):
    """Asks for weight and posture, and shows the table beside what a view shows.

    Parameters
    ----------
    is_read
        Whether the page was read before.
    """

    asked = Signal()
    """Another question is asked, or the page was read."""
    covered = Signal(int)
    """Emitted with the width of the strip at the left of a view that the window covers."""

    def __init__(self, *, is_read: bool, parent: QWidget | None) -> None:
        super().__init__(parent)
        self._view: QWidget | None = None
        self.setWindowTitle(tr("Change of pressure"))
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.resize(_WIDTH_PX, 0)  # else the words would be laid out in as few lines as can be
        self.weight = NumberField("kg", least=0, greatest=WEIGHT_KG.greatest, step=1)
        self.weight.allow_unknown(WEIGHT_KG.least)
        self.posture = ComboBox([(posture.value, text) for posture, text in _postures()])
        self.against = ComboBox([(_FLAT, tr("a flat shoe"))])
        self.both = QCheckBox(tr("Show both side by side, each against a flat shoe"))
        self.both.setToolTip(tr("Else the colours show the change from that variant to this one"))
        self.both.setEnabled(False)
        self.fit = QCheckBox(tr("Fit the tissue to the map under the foot"))
        self.fit.setToolTip(tr("A map of the bare foot on a plate, in this posture"))
        self.fit.setEnabled(False)
        self.fitted = MessageLabel("quiet")
        self.papers = QCheckBox(tr("Put it on the papers of the order and the prescription"))
        self.table = RowTable(["", "", ""], sorts=False)
        self._show_headings(())
        self.table.setMinimumHeight(_TABLE_PX)
        self.area = QLabel()
        self.region = ComboBox([(_FLAT, tr("no target"))])
        self.region.setAccessibleName(tr("Target in"))
        self.percent = NumberField("%", least=-100, greatest=100, step=5, decimals=0)
        self.percent.show_value(_USUAL_TARGET)
        self.chart = DoseChart()
        self.reasons = MessageLabel("quiet")
        self.dose = MessageLabel("quiet")
        self.problem = MessageLabel("warning")
        self.assumed = MessageLabel("quiet")
        self.was_read = QCheckBox(tr("I have read what this can tell and what it cannot"))
        self.go_on = QPushButton(tr("Show the change"))
        self._pages = QStackedWidget()
        self._pages.addWidget(self._page_to_read())
        self._told = self._answer()
        self._pages.addWidget(Scrolled(self._told))
        layout = QVBoxLayout(self)
        layout.addWidget(self._pages)
        self._pages.setCurrentIndex(int(is_read))
        self.was_read.toggled.connect(self.go_on.setEnabled)
        self.go_on.setEnabled(False)
        self.go_on.clicked.connect(self._begin)
        for field in (self.weight, self.posture, self.against, self.region, self.percent):
            field.edited.connect(self._ask)
        self.against.edited.connect(self._offer_both)
        for box in (self.fit, self.both):
            box.toggled.connect(self._ask)

    def show_beside(self, view: QWidget) -> None:
        """Open at the left edge of the window, and tell from now on what of a view it covers.

        It ends where the view does: it may cover a part of that, which makes room for it, but none
        of the panels below.
        """
        self.show()
        window = view.window()
        self._view = view
        room, frame_px = self._room(), self.frameGeometry().height() - self.height()
        self.resize(self.width(), min(self.height(), room.height() - frame_px))
        middle = window.mapToGlobal(QPoint(0, (window.height() - self.height()) // 2))
        lowest = room.bottom() + 1 - self.height() - frame_px
        self.move(middle.x(), max(room.top(), min(middle.y(), lowest)))
        for watched in (view, window):
            watched.installEventFilter(self)
        self._tell_covered()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Tell what is covered after the view or its window has moved or changed its size."""
        if event.type() in (QEvent.Type.Move, QEvent.Type.Resize):
            self._tell_covered()
        return super().eventFilter(watched, event)

    def moveEvent(self, event: QMoveEvent) -> None:
        """Tell what is covered now."""
        super().moveEvent(event)
        self._tell_covered()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Tell what is covered now."""
        super().resizeEvent(event)
        self._tell_covered()

    def _tell_covered(self) -> None:
        if self._view is None or not self.isVisible():
            return
        frame, at = self.frameGeometry(), self._view.mapToGlobal(QPoint(0, 0))
        view = QRect(at, self._view.size())
        is_at_left = frame.left() <= view.left() and frame.right() < view.right()
        is_over = is_at_left and frame.intersects(view)
        self.covered.emit(frame.right() + 1 - view.left() if is_over else 0)

    @property
    def is_read(self) -> bool:
        """Whether the page was read."""
        return self._pages.currentIndex() == 1

    @property
    def question(self) -> LoadQuestion | None:
        """What is asked; None until the page was read and a weight is given."""
        if not self.is_read or self.weight.value() not in WEIGHT_KG:
            return None
        posture = Posture(self.posture.currentData())
        variant, is_both = self.against.currentData(), self.both.isChecked()
        is_fitted = self.fit.isChecked()
        return LoadQuestion(self.weight.value(), posture, variant, is_fitted, is_both)

    def offer_fit(self, has_map: bool) -> None:
        """Offer to fit the tissue where a map lies under the foot."""
        if not has_map:
            self.fit.setChecked(False)
        self.fit.setEnabled(has_map)

    def show_variants(self, names: Sequence[str], instead: str = "") -> None:
        """Offer these variants to compare with, and the flat shoe.

        Parameters
        ----------
        instead
            Compared with where the one before is not among them; empty for the flat shoe.
        """
        before = self.against.currentData()
        self.against.clear()
        self.against.addItem(tr("a flat shoe"), _FLAT)
        for name in names:
            self.against.addItem(variant_title(name), name)
        self.against.show_value(before if before in names else instead)
        self._offer_both(self.against.currentData())

    def _offer_both(self, variant: object) -> None:
        if variant == _FLAT:
            self.both.setChecked(False)
        self.both.setEnabled(variant != _FLAT)

    def offer_regions(self, names: dict[str, str]) -> None:
        """Offer regions, by their names, in which a target can be."""
        for name, text in names.items():
            self.region.addItem(text, name)

    def show_rows(self, rows: Sequence[TableRow], area: str, pair: Sequence[str] = ()) -> None:
        """Show what is told of the regions, and the area of contact.

        Parameters
        ----------
        rows
            Of the insole, and of the one beside it.
        pair
            What both are called; none where there is one.
        """
        self._show_headings(pair)
        self.table.show_rows(rows)
        self.area.setText(area)
        self._make_room()

    def _show_headings(self, pair: Sequence[str]) -> None:
        limits, short = "(95 %)", self.shortened(pair)
        own, beside = short or (tr("Peak pressure"), "")
        headings = f"{own} {limits}", f"{beside} {limits}" if beside else ""
        self.table.show_headings([tr("Region"), *headings], ["", *pair] if pair else ())

    def shortened(self, names: Sequence[str]) -> list[str]:
        """Return names so short that two have room beside each other; they differ at the end."""
        words = self.fontMetrics()
        return [words.elidedText(name, Qt.TextElideMode.ElideMiddle, _NAME_PX) for name in names]

    def _make_room(self) -> None:
        """Grow with what is told, as far as the screen has room; beyond that it is scrolled."""
        own, told = self.layout(), self._told.layout()
        if own is None or told is None:
            return
        told.activate()
        margins = own.contentsMargins()
        inner_px = self.width() - margins.left() - margins.right()
        told_px = told.totalHeightForWidth(inner_px) + margins.top() + margins.bottom()
        room, frame_px = self._room(), self.frameGeometry().height() - self.height()
        wanted = max(self.height(), min(told_px, room.height() - frame_px))
        self.resize(bounded(self, QSize(self.width(), wanted)))
        below = self.frameGeometry().bottom() - room.bottom()
        if below > 0:
            self.move(self.x(), max(room.top(), self.y() - below))

    def _room(self) -> QRect:
        """Return where its frame may be: on the screen, above what is below the view."""
        room = self.screen().availableGeometry()
        if self._view is not None:
            below_view = self._view.mapToGlobal(QPoint(0, self._view.height()))
            room.setBottom(min(room.bottom(), below_view.y() - 1))
        return room

    def _ask(self, _value: object) -> None:
        self.asked.emit()

    def _begin(self) -> None:
        self._pages.setCurrentIndex(1)
        self.weight.setFocus()
        self.weight.selectAll()
        self.asked.emit()

    def _page_to_read(self) -> QWidget:
        page = QWidget()
        layout = QVBoxLayout(page)
        layout.setSpacing(12)
        for text in (
            tr("What it can tell: where an insole takes load off and where it puts it, in "
               "per cent, and which of two designs relieves a place more. Each figure has limits, "
               "between which the change should lie in 95 of 100 feet."),
            tr("What it cannot tell: pressures in kPa, pain, or whether an ulcer heals. The "
               "foot is one rigid bone with soft tissue: its arch does not sag and its toes do not "
               "bend, so that postings and total contact under the forefoot are judged wrongly. "
               "Where the model is not sure enough, it says so. A sole that weight has made "
               "flat is refused; less weight on the foot is only known of captures, and reliefs "
               "are then understated. Layers without a material are taken for that of the shell."),
            tr("It is no measurement. What the patient's foot does in the shoe, only a "
               "measurement in the shoe tells. F1 opens the whole page, with all it was checked "
               "against."),
        ):  # fmt: skip
            words = QLabel(text)
            words.setWordWrap(True)
            layout.addWidget(words)
        layout.addStretch(1)
        layout.addWidget(self.was_read)
        layout.addWidget(self.go_on)
        return page

    def _answer(self) -> QWidget:
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        for label, field in (
            (tr("Body weight"), self.weight),
            (tr("Posture"), self.posture),
            (tr("Compared with"), self.against),
        ):
            form.addRow(label, field)
        self.percent.setAccessibleName(tr("Change there"))
        self.percent.setToolTip(tr("Change there"))
        target = QHBoxLayout()  # in one row: the window has to fit on a screen of 768 lines
        target.addWidget(self.region, 1)
        target.addWidget(self.percent)
        form.addRow(tr("Target in"), target)
        form.addRow(self.both)
        form.addRow(self.fit)
        mark_labels(form)
        sentence = QLabel(translate_core_message(SENTENCE))
        sentence.setWordWrap(True)
        page = QWidget()
        layout = QVBoxLayout(page)
        layout.setSpacing(12)
        layout.addLayout(form)
        for part in (
            self.problem, self.fitted, self.table, self.reasons, self.area, self.dose, self.chart,
            self.assumed, sentence, self.papers,
        ):  # fmt: skip
            layout.addWidget(part)
        return page


def _postures() -> tuple[tuple[Posture, str], ...]:
    return (
        (Posture.STANDING, tr("standing on both feet")),
        (Posture.HEEL_STRIKE, tr("heel strike")),
        (Posture.PUSH_OFF, tr("push-off")),
    )
