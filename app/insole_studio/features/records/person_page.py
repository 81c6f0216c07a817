"""The page of a person: fields, the time line of visits, and measures over time."""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QHideEvent, QImage
from PySide6.QtWidgets import (
    QFormLayout,
    QFrame,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from insole_core.records.person import Person
from insole_core.records.record_field import typed_fields
from insole_studio.features.records.record_form import new_editor
from insole_studio.features.records.rows import PictureKey, Trend, VisitRow
from insole_studio.features.records.trend_chart import TrendChart
from insole_studio.features.records.visit_card import VisitCard
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.elided_label import ElidedLabel
from insole_studio.widgets.form_parts import ComboBox, allow, mark_labels
from insole_studio.widgets.layouts import FlowRow, VerticalScroll
from insole_studio.widgets.text_fields import (
    NotesField,
    ValidationBubble,
    forget_typed,
    show_unless_typing,
)

FIELDS_PX = 320
PERSON = typed_fields(Person)


class PersonPage(QWidget):
    """A person and their visits."""

    field_edited = Signal(str, str)
    visit_action_requested = Signal(str, str)
    """The key of an action, and the id of a visit."""
    action_requested = Signal(str)
    compare_requested = Signal(str, str)
    named = Signal()
    """Whose page it is, is shown anew."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._name = ElidedLabel("")
        self._name.setObjectName("title")
        self._pseudonym = QLabel()
        self._pseudonym.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._fields = {key: new_editor(f) for key, f in PERSON.items() if key != "pseudonym"}
        self._refusals = {key: ValidationBubble(field) for key, field in self._fields.items()}
        for key, field in self._fields.items():
            field.setProperty("key", key)
            if isinstance(field, ComboBox):
                field.edited.connect(self._chosen)
            elif isinstance(field, NotesField):
                field.left.connect(self._text_edited)
            elif isinstance(field, QLineEdit):
                field.editingFinished.connect(self._line_edited)
        self.chart = TrendChart()
        self.cards: dict[str, VisitCard] = {}
        self._cards = QVBoxLayout()
        self._cards.setContentsMargins(0, 0, 8, 0)
        self._cards.setSpacing(8)
        self._none = QLabel(tr("No visit yet. Begin with “New visit”."))
        self._none.setObjectName("quiet")
        self._buttons: dict[str, QPushButton] = {}
        self._is_sample, self._is_editable = False, True
        self._sample = QFrame()
        self._sample.setObjectName("notice")
        self._compare = QPushButton(tr("Compare two visits…"))
        self._compare.clicked.connect(self._request_compare)
        self._lay_out()

    def show_sample(self, is_sample: bool) -> None:
        """Say that this is the sample patient, which keeps its name, and offer to remove it."""
        self._sample.setVisible(is_sample)
        self._is_sample = is_sample
        self._allow_typing()

    def show_person(self, values: Mapping[str, str]) -> None:
        """Show the fields; text being typed stays until it is entered or forgotten."""
        self._name.setText(values["name"])
        self._pseudonym.setText(values["pseudonym"])
        self._name.updateGeometry()
        for key, field in self._fields.items():
            if isinstance(field, ComboBox):
                field.show_value(values[key])
                continue
            show_unless_typing(field, values[key])
            if isinstance(field, QLineEdit) and not field.hasFocus():
                field.setCursorPosition(0)  # else a long address shows its end
                field.setToolTip(html.escape(values[key]).replace("\n", "<br>"))
        self.named.emit()

    def forget_typed(self) -> None:
        """Let the next values replace text being typed: it belongs to another person."""
        for field in self._fields.values():
            if not isinstance(field, ComboBox):
                forget_typed(field)

    def hideEvent(self, event: QHideEvent) -> None:
        """Hide what was refused as well: its bubbles are windows of their own."""
        super().hideEvent(event)
        for refusal in self._refusals.values():
            refusal.hide()

    def show_refusal(self, key: str, sentence: str) -> None:
        """Say beside a field why what was typed is not taken."""
        self._refusals["personal_number" if key == "number_kind" else key].say(sentence)

    def show_visits(self, rows: Sequence[VisitRow]) -> None:
        """Show the visits, the newest first; those that have not changed stay as they are."""
        before, self.cards = self.cards, {}
        while (item := self._cards.takeAt(0)) is not None:
            del item
        for row in rows:
            card = before.pop(row.id, None)
            if card is None or card.row != row:
                self._discard(card)
                card = self._new_card(row)
            self.cards[row.id] = card
            self._cards.addWidget(card)
        for card in before.values():
            self._discard(card)
        self._cards.addStretch(1)
        self._none.setVisible(not rows)
        self._show_compare()

    def show_picture(self, key: PictureKey, image: QImage) -> None:
        """Show a small picture on its card."""
        if key.visit in self.cards:
            self.cards[key.visit].show_picture(key, image)

    def show_trends(self, trends: Sequence[Trend]) -> None:
        """Show measures over time; nothing where there are none."""
        self.chart.show_trends(trends)
        self.chart.setVisible(bool(trends))

    def show_why_not_change(self, why_not: str) -> None:
        """Show why no field can be changed and no visit added; empty where they can."""
        self._is_editable = not why_not
        self._allow_typing()
        for key in ("new_visit", "follow_up"):
            allow(self._buttons[key], why_not)

    def show_why_not_same(self, why_not: str) -> None:
        """Show why no new visit can take the last prescription; empty where one can."""
        allow(self._buttons["new_visit_same"], why_not)

    def _allow_typing(self) -> None:
        for key, field in self._fields.items():
            if isinstance(field, ComboBox):
                field.setEnabled(self._is_editable)
            else:
                field.setReadOnly(not self._is_editable or (key == "name" and self._is_sample))

    def _lay_out(self) -> None:
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.setVerticalSpacing(8)
        shown = {**self._fields, "pseudonym": self._pseudonym}
        for key, declared in PERSON.items():
            label = translate_core_message(declared.label) if declared.is_told else ""
            form.addRow(label, shown[key])
        mark_labels(form)
        left = QWidget()
        left.setFixedWidth(FIELDS_PX)
        column = QVBoxLayout(left)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(8)
        column.addLayout(form)
        column.addWidget(self.chart)
        column.addStretch(1)
        top = QHBoxLayout()
        top.setSpacing(8)
        top.addWidget(self._button("patients", tr("Patients")))
        top.addWidget(self._name, 1)
        top.addWidget(self._button("new_visit_same", tr("New visit, same prescription")))
        top.addWidget(self._button("new_visit", tr("New visit")))
        self._buttons["new_visit"].setObjectName("primary")
        more = FlowRow(
            self._button("follow_up", tr("Follow-up…")),
            self._button("person_orders", tr("Orders")),
            self._button("export_patient", tr("Export…")),
            self._compare,
        )
        visits = VerticalScroll()
        content = QWidget()
        inside = QVBoxLayout(content)
        inside.setContentsMargins(0, 0, 0, 0)
        inside.addWidget(self._none)
        inside.addLayout(self._cards, 1)
        visits.setWidget(content)
        lower = QHBoxLayout()
        lower.setSpacing(24)
        lower.addWidget(left, 0, Qt.AlignmentFlag.AlignTop)
        right = QVBoxLayout()
        right.addWidget(more)
        right.addWidget(visits, 1)
        lower.addLayout(right, 1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(24, 16, 24, 16)
        layout.setSpacing(16)
        layout.addLayout(top)
        layout.addWidget(self._sample)
        layout.addLayout(lower, 1)
        self._lay_out_sample()

    def _lay_out_sample(self) -> None:
        row = QHBoxLayout(self._sample)
        row.setContentsMargins(8, 2, 4, 2)
        row.addWidget(
            ElidedLabel(tr("Sample: an invented patient to try things on; nothing here is real.")),
            1,
        )
        row.addWidget(self._button("remove_sample", tr("Remove the sample patient…")))
        self._sample.hide()

    def _new_card(self, row: VisitRow) -> VisitCard:
        card = VisitCard(row)
        card.action_requested.connect(self.visit_action_requested)
        card.compare_toggled.connect(self._show_compare)
        return card

    def _discard(self, card: VisitCard | None) -> None:
        if card is not None:
            card.hide()
            card.deleteLater()

    def _compared(self) -> list[str]:
        return [key for key, card in self.cards.items() if card.compare.isChecked()]

    def _show_compare(self) -> None:
        is_pair = len(self._compared()) == 2
        allow(self._compare, "" if is_pair else tr("Choose two visits to compare them"))

    def _request_compare(self) -> None:
        newer, older = self._compared()
        self.compare_requested.emit(newer, older)

    def _button(self, key: str, text: str) -> QPushButton:
        button = QPushButton(text)
        button.setProperty("action", key)
        button.clicked.connect(self._request)
        self._buttons[key] = button
        return button

    def _request(self) -> None:
        self.action_requested.emit(self.sender().property("action"))

    def _line_edited(self) -> None:
        field = self.sender()
        assert isinstance(field, QLineEdit)
        if field.isModified():
            field.setModified(False)
            self.field_edited.emit(field.property("key"), field.text())

    def _chosen(self, word: str) -> None:
        self.field_edited.emit(self.sender().property("key"), word)

    def _text_edited(self) -> None:
        field = self.sender()
        assert isinstance(field, NotesField)
        if field.document().isModified():
            field.document().setModified(False)
            self.field_edited.emit(field.property("key"), field.toPlainText())
