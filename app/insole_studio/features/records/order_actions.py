"""Orders made of what is exported, and their shop and due date."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from insole_core.cases.case_record import CaseRecord
from insole_core.cases.order_note import OrderNote
from insole_core.errors import Conflict, Unreachable
from insole_core.export.shop_order import OrderTerms
from insole_core.geometry.side import Side
from insole_core.records.order import Order, OrderState, OrderSummary
from insole_core.workflows.order_package import Ordered
from insole_studio.document.clinic_record import RecordState
from insole_studio.features.records.order_dialog import OrderDialog
from insole_studio.features.records.order_rows import name_of, state_text
from insole_studio.features.records.record_texts import day_text
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_core.records.records import Records

NOTICE = "record-order"


@dataclass(frozen=True)
class _Export:
    """An order that is not in the record yet.

    Parameters
    ----------
    before
        The terms from which those of the order were changed.
    """

    visit_id: str
    sides: tuple[Side, ...]
    ordered: Ordered
    before: OrderTerms


class OrderActions(QObject):
    """Adds an order for each export of a visit, with the files as they were written."""

    def __init__(self, services: AppServices) -> None:
        super().__init__(services.window)
        self._services = services
        self._clinic = services.clinic
        self._tell = services.messages.show_error
        self._terms: dict[str, OrderTerms] = {}
        """By visit, those of the last export, or as it was opened."""
        self._waiting: list[_Export] = []
        self._under_way: _Export | None = None
        self._clinic.changed.connect(self._refresh_note)
        self._clinic.changed.connect(self._go_on)
        self._clinic.state_changed.connect(self._go_on)
        services.case.opened.connect(self._note_terms)

    def note_export(self, exported: CaseRecord, ordered: Ordered, visit_id: str) -> None:
        """Store the order of the exported feet, once these are in the record as they were exported.

        A later revision is that of the order of its number; any other export is a new order.

        Parameters
        ----------
        visit_id
            That the case is of, or was before it was left; empty for a case of a file.
        """
        if not visit_id:
            return
        files = set(ordered.files)
        waiting = (export for export in self._waiting if files.isdisjoint(export.ordered.files))
        before = self._terms.get(visit_id, ordered.terms)
        sides = tuple(foot.side for foot in exported.feet)
        # Files that were written over are none of what they were exported for.
        self._waiting = [*waiting, _Export(visit_id, sides, ordered, before)]
        self._terms[visit_id] = ordered.terms
        self._store_when_saved()

    def _go_on(self) -> None:
        """Store what could not be stored before, once the record can be asked."""
        if self._clinic.state is RecordState.CLOSED and self._under_way is not None:
            self._waiting.insert(0, self._under_way)  # its answer does not arrive any more
            self._under_way = None
        if self._waiting and self._clinic.state is RecordState.OPEN:
            self._store_when_saved()

    def _store_when_saved(self) -> None:
        keeper = self._services.keeper
        if any(export.visit_id == keeper.visit_id for export in self._waiting):
            keeper.leave(self._store_next)
        else:  # the visits were saved when they were left
            self._store_next()

    def _store_next(self) -> None:
        """Store one order after the other, for a later one may be its revision."""
        if self._under_way is not None or not self._waiting:
            return
        export = self._under_way = self._waiting.pop(0)

        def stored(order: Order) -> None:
            self._under_way = None
            self._offer(order)
            self._store_next()

        def missed(error: Exception) -> None:
            self._under_way = None
            if isinstance(error, Unreachable | Conflict):
                self._waiting.insert(0, export)
            if not isinstance(error, Conflict):  # of a change between reading and writing
                self._tell(error)
            if not isinstance(error, Unreachable):
                self._store_next()

        self._clinic.write(lambda records: _store(records, export), stored, missed)

    def ask(self, order_id: str) -> None:
        """Ask for shop and due date of an order."""
        self._clinic.ask(
            "records-order", lambda records: records.orders.get(order_id), self._ask, self._tell
        )

    def move(self, order: OrderSummary, state: OrderState) -> None:
        """Bring an order to another state, and offer to take that back."""

        def moved(after: Order) -> None:
            sentence = tr("Order {number}: {state}.")
            self._services.notices.put(
                NOTICE,
                sentence.format(number=after.number, state=state_text(after.state)),
                (tr("Undo"), lambda: self._move_back(after, order.state)),
                on_pages=True,
            )

        self._clinic.write(
            lambda r: r.orders.move(order.id, state, "", order.revision), moved, self._tell
        )

    def _move_back(self, order: Order, state: OrderState) -> None:
        self._clinic.write(
            lambda r: r.orders.move(order.id, state, "", order.revision),
            lambda _order: None,
            self._tell,
        )

    def _note_terms(self) -> None:
        """Note from where the terms of the opened visit are changed."""
        case = self._services.case
        if case.kept is not None:
            self._terms[case.kept.visit.id] = case.record.order.terms

    def _refresh_note(self) -> None:
        """Let the open case know what has become of its order, here or at another station."""
        visit_id = self._services.keeper.visit_id
        if not visit_id or not self._clinic.is_open:
            return

        def take(note: OrderNote) -> None:
            if self._services.keeper.visit_id == visit_id and not self._waiting:
                self._services.case.note_stored_order(note)

        # Whatever goes wrong, the next change asks again; saving tells of it.
        self._clinic.ask(
            "records-order-note", lambda r: r.orders.note_of(visit_id), take, lambda _error: None
        )

    def _offer(self, order: Order) -> None:
        sentence = tr("{order} is in the record, with its files.")
        if order.due_on is not None:
            sentence = tr("{order} is in the record, with its files; it is due {day}.")
        self._services.notices.put(
            NOTICE,
            sentence.format(order=name_of(order), day=day_text(order.due_on)),
            (tr("Shop and due date…"), lambda: self.ask(order.id)),
            on_pages=True,
        )

    def _ask(self, order: Order) -> None:
        dialog = OrderDialog(order, self._services.window)
        dialog.finished.connect(dialog.deleteLater)
        dialog.accepted.connect(lambda: self._change(order, dialog))
        dialog.open()

    def _change(self, order: Order, dialog: OrderDialog) -> None:
        self._clinic.write(
            lambda records: records.orders.change(order.id, dialog.typed, order.revision),
            lambda _order: None,
            self._tell,
        )


def _store(records: Records, export: _Export) -> Order:
    """Store an order, or a revision of the order of its number."""
    visit_id, ordered, before = export.visit_id, export.ordered, export.before
    newest = [records.prescriptions.versions(visit_id, side)[0].id for side in export.sides]
    terms, files, place = ordered.terms, ordered.files, str(ordered.place)
    known = records.orders.with_number(ordered.number) if ordered.revision > 1 else None
    if known is not None and known.visit_id == visit_id:
        stored = records.orders.get(known.id)
        is_moved = terms.deliver_on is not None and terms.deliver_on != before.deliver_on
        return records.orders.revise(
            known.id, newest, stored.revision,
            release=ordered.revision,
            due_on=terms.deliver_on if is_moved else stored.due_on,
            remarks=_merged(stored.remarks, before.remarks, terms.remarks),
            files=files, place=place,
        )  # fmt: skip
    return records.orders.add(
        visit_id, newest,
        due_on=terms.deliver_on or records.orders.usual_due_on(date.today()),
        remarks=terms.remarks, files=files, number=ordered.number,
        release=ordered.revision, place=place,
    )  # fmt: skip


def _merged(stored: str, before: str, now: str) -> str:
    """Return an order's remarks with a change of the visit's; what was written there stays."""
    if now == before:
        return stored
    if before and before in stored:
        return stored.replace(before, now, 1).strip()
    return "\n".join(text for text in (stored, now) if text)
