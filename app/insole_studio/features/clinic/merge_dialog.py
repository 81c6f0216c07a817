"""Merging persons who are in the record twice, chosen by a search, and taking a merge back."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QTabWidget, QVBoxLayout, QWidget
from shiboken6 import isValid

from insole_core.records.person import Person, PersonSummary
from insole_core.records.record_field import typed_fields
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.features.clinic.record_dialog import RecordDialog
from insole_studio.services.person_list import name_and_birth, person_headings, person_rows
from insole_studio.texts import fill, moment_text, tr, translate_core_message
from insole_studio.widgets.form_parts import allow
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.row_table import RowTable, TableRow

if TYPE_CHECKING:
    from insole_core.records.merging import Merge, MergePreview, NamedMerge
    from insole_core.records.person_matching import Duplicate
    from insole_core.records.records import Records

_MOST_FOUND = 20
_MOST_LETTERS = 200
_SIZE = (920, 640)
_MERGE_TAB = 0


class _PersonPicker(QWidget):
    """Finds persons as their name is typed; the row that the cursor is on is the chosen one."""

    person_changed = Signal()

    def __init__(
        self,
        title: str,
        clinic: ClinicRecord,
        refuse: Callable[[Exception], None],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._clinic = clinic
        self._channel = f"clinic-pick-{title}"
        self._refuse = refuse
        self._found: dict[str, PersonSummary] = {}
        heading = MessageLabel("heading")
        heading.say(title)
        self.search = QLineEdit()
        self.search.setMaxLength(_MOST_LETTERS)
        self.search.setPlaceholderText(tr("Name, birth date, personal number or order"))
        self.search.setAccessibleName(title)
        self.search.setClearButtonEnabled(True)
        self.search.textEdited.connect(self._search)
        self.search.installEventFilter(self)
        self.table = RowTable(person_headings())
        self.table.setAccessibleName(title)
        self.table.current_changed.connect(lambda _key: self.person_changed.emit())
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        layout.addWidget(heading)
        layout.addWidget(self.search)
        layout.addWidget(self.table, 1)

    @property
    def person(self) -> PersonSummary | None:
        """The chosen person."""
        return self._found.get(self.table.current_key)

    def show_person(self, person: PersonSummary) -> None:
        """Choose a person."""
        self.search.setText(person.name)
        self._show([person])

    def clear(self) -> None:
        """Choose nobody."""
        self.search.clear()
        self._show([])

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:
        """Let the arrow go from the search line to the list, and Enter press no button."""
        if event.type() != QEvent.Type.KeyPress:
            return False
        key = cast("QKeyEvent", event).key()
        if key == Qt.Key.Key_Down and self.table.take_first():
            self.table.setFocus(Qt.FocusReason.OtherFocusReason)
            return True
        return key in (Qt.Key.Key_Return, Qt.Key.Key_Enter)

    def _search(self, typed: str) -> None:
        if not typed.strip():
            self._show([])
            return

        def find(records: Records) -> list[PersonSummary]:
            return records.persons.search(typed, _MOST_FOUND)

        def show(found: list[PersonSummary]) -> None:
            if isValid(self):
                self._show(found)

        self._clinic.ask(self._channel, find, show, self._refuse)

    def _show(self, found: Sequence[PersonSummary]) -> None:
        self._found = {person.id: person for person in found}
        self.table.show_rows(person_rows(found))
        self.table.take_first()
        self.person_changed.emit()


@dataclass(frozen=True)
class _Shown:
    duplicates: list[Duplicate]
    merges: list[NamedMerge]


class MergeDialog(RecordDialog):
    """Proposals above, the two persons below; what moves is told before it does."""

    def __init__(self, clinic: ClinicRecord, parent: QWidget | None = None) -> None:
        super().__init__(tr("Merge duplicate patients"), clinic, parent)
        self.resize(*_SIZE)
        self._duplicates: dict[str, Duplicate] = {}
        self._merges: dict[str, Merge] = {}
        self.tabs = QTabWidget()
        self.tabs.addTab(self._make_choice(), tr("Merge"))
        self.tabs.addTab(self._make_merges(), tr("Merged before"))
        self.tabs.currentChanged.connect(lambda _index: self._allow())
        self.content.addWidget(self.tabs)
        self.swap = self.add_button(tr("Swap"), self._swap)
        self.merge = self.add_button(tr("Merge"), self._merge)
        self.make_primary(self.merge)
        self.undo = self.add_button(tr("Undo this merge"), self._undo)
        self._preview: MergePreview | None = None
        self._allow()
        self.read()

    def read(self) -> None:
        """Show the proposals and the merges as they are now."""
        self.ask(_read, self._show)

    def _make_choice(self) -> QWidget:
        headings = (tr("Kept"), tr("Merged into it"), tr("The same"))
        self.proposals = RowTable(headings)
        self.proposals.setAccessibleName(tr("Proposals"))
        self.proposals.current_changed.connect(self._take_proposal)
        self.proposals.chosen.connect(self._take_proposal)
        self._words = MessageLabel("quiet")
        self.kept = _PersonPicker(tr("This patient is kept"), self.clinic, self.refuse)
        self.other = _PersonPicker(tr("This one is merged into it"), self.clinic, self.refuse)
        for picker in (self.kept, self.other):
            picker.person_changed.connect(self._ask_preview)
        self.moves = MessageLabel()
        pickers = QHBoxLayout()
        pickers.setSpacing(16)
        pickers.addWidget(self.kept)
        pickers.addWidget(self.other)
        page = QWidget()
        layout = QVBoxLayout(page)
        layout.setSpacing(8)
        layout.addWidget(self._words)
        layout.addWidget(self.proposals, 2)
        layout.addLayout(pickers, 3)
        layout.addWidget(self.moves)
        return page

    def _make_merges(self) -> QWidget:
        headings = (tr("Kept"), tr("Merged into it"), tr("When"), tr("By"))
        self.merges = RowTable(headings)
        self.merges.setAccessibleName(tr("Merged before"))
        self.merges.current_changed.connect(lambda _key: self._allow())
        page = QWidget()
        layout = QVBoxLayout(page)
        layout.addWidget(self.merges)
        return page

    def _show(self, shown: _Shown) -> None:
        self._duplicates = {f"{d.kept.id} {d.other.id}": d for d in shown.duplicates}
        self._words.say(
            tr("These may be the same person. Two others are found by typing their names below.")
            if shown.duplicates
            else tr("Nobody seems to be in the record twice. Two persons are found by their names.")
        )
        self.proposals.show_rows([_proposal(key, d) for key, d in self._duplicates.items()])
        self._merges = {named.merge.id: named.merge for named in shown.merges}
        self.merges.show_rows([_merge_row(named) for named in shown.merges])
        if not self.proposals.take_first():
            self.kept.search.setFocus()
        self.merges.take_first()
        self._allow()

    def _take_proposal(self, key: str) -> None:
        duplicate = self._duplicates.get(key)
        if duplicate is not None:
            self.kept.show_person(duplicate.kept)
            self.other.show_person(duplicate.other)

    @property
    def _pair(self) -> tuple[PersonSummary, PersonSummary] | None:
        kept, other = self.kept.person, self.other.person
        return None if kept is None or other is None else (kept, other)

    def _ask_preview(self) -> None:
        """Say what would move from one person to the other."""
        self._preview = None
        self.moves.say("")
        self.say("")
        pair = self._pair
        if pair is not None and pair[0].id == pair[1].id:
            self.moves.say(tr("This is the same person twice; choose another one."))
        elif pair is not None:
            kept, other = pair
            self.ask(
                lambda records: records.persons.preview_merge(kept.id, other.id),
                lambda preview: self._show_preview(pair, preview),
            )
        self._allow()

    def _show_preview(
        self, pair: tuple[PersonSummary, PersonSummary], preview: MergePreview
    ) -> None:
        if pair != self._pair:
            return
        self._preview = preview
        kept, other = pair
        lines = [
            fill(
                tr(
                    "From {other} to {kept}, whose name and fields stay, move: visits {visits}, "
                    "orders {orders}, follow-ups {follow_ups}."
                ),
                visits=preview.visits,
                orders=preview.orders,
                follow_ups=preview.follow_ups,
                other=_named(other),
                kept=_named(kept),
            )
        ]
        fields = typed_fields(Person)
        told = (fields[name] for name in preview.filled if fields[name].is_told)
        filled = [translate_core_message(field.noun) for field in told]
        if filled:
            lines.append(
                tr("Filled in, as it is empty: {fields}.").format(fields=", ".join(filled))
            )
        lines.append(tr("This can be undone under “Merged before”."))
        self.moves.say_all(lines)
        self._allow()

    def _allow(self) -> None:
        merging = self.tabs.currentIndex() == _MERGE_TAB
        for button in (self.swap, self.merge):
            button.setVisible(merging)
        self.undo.setVisible(not merging)
        no_pair = tr("Choose two patients first.")
        allow(self.swap, "" if self._pair is not None else no_pair)
        allow(self.merge, "" if self._preview is not None else no_pair)
        no_merge = tr("Choose in the list what is to be undone first.")
        allow(self.undo, "" if self.merges.current_key else no_merge)

    def _swap(self) -> None:
        pair = self._pair
        if pair is not None:
            self.kept.show_person(pair[1])
            self.other.show_person(pair[0])

    def _merge(self) -> None:
        pair = self._pair
        if pair is None:
            return
        kept, other = pair

        def done(_merge: Merge) -> None:
            self.kept.clear()
            self.other.clear()
            self.say(
                tr("{other} is now part of {kept}.").format(other=_named(other), kept=_named(kept))
            )
            self.ask(_read, self._show)

        self.change(lambda records: records.persons.merge(kept.id, other.id), done)

    def _undo(self) -> None:
        merge = self._merges.get(self.merges.current_key)
        if merge is None:
            return

        def done(_none: None) -> None:
            self.say(tr("Both are persons of their own again."))
            self.read()

        self.change(lambda records: records.persons.undo_merge(merge), done)


def _read(records: Records) -> _Shown:
    from insole_core.records.person_matching import find_duplicates
    from insole_core.records.rights import Right, require

    with records.context.database.reading() as connection:
        require(connection, records.who, Right.MERGE)
    return _Shown(find_duplicates(records.persons.alike()), records.persons.latest_merges())


def _named(person: PersonSummary) -> str:
    return name_and_birth(person.name, person.birth_date)


def _proposal(key: str, duplicate: Duplicate) -> TableRow:
    cells = (
        _named(duplicate.kept),
        _named(duplicate.other),
        translate_core_message(duplicate.likeness),
    )
    return TableRow(key, cells)


def _merge_row(named: NamedMerge) -> TableRow:
    merge = named.merge
    persons = (f"{_named(person)}, {person.pseudonym}" for person in (named.kept, named.merged))
    cells = (*persons, moment_text(merge.at), merge.author)
    return TableRow(merge.id, cells)
