"""Orders made of what is exported, and their shop and due date."""

from __future__ import annotations

from datetime import date
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from insole_core.cases.case_record import CaseRecord
from insole_core.cases.order_note import OrderNote
from insole_core.export.shop_order import OrderTerms
from insole_core.records.order import Order, OrderState, OrderSummary
from insole_core.workflows.order_package import Ordered
from insole_studio.features.records.order_dialog import OrderDialog
from insole_studio.features.records.order_rows import state_text
from insole_studio.features.records.record_texts import day_text
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_core.records.records import Records

NOTICE = "record-order"


class OrderActions(QObject):
    """Adds an order for each export of a visit, with the files as they were written."""

    def __init__(self, services: AppServices) -> None:
        super().__init__(services.window)
        self._services = services
        self._clinic = services.clinic
        self._tell = services.messages.show_error
        self._terms: dict[str, OrderTerms] = {}
        """By visit, those of the last export, or as it was opened."""
        self._clinic.changed.connect(self._refresh_note)
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
        sides = [foot.side for foot in exported.feet]
        before = self._terms.get(visit_id, ordered.terms)
        self._terms[visit_id] = ordered.terms

        def add(records: Records) -> Order:
            newest = [records.prescriptions.versions(visit_id, side)[0].id for side in sides]
            terms, files, place = ordered.terms, ordered.files, str(ordered.place)
            known = records.orders.with_number(ordered.number) if ordered.revision > 1 else None
            if known is not None and known.visit_id == visit_id:
                stored = records.orders.get(known.id)
                is_moved = terms.deliver_on is not None and terms.deliver_on != before.deliver_on
                return records.orders.revise(
                    known.id, newest,
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

        def store() -> None:
            self._clinic.write(add, self._offer, self._tell)

        if visit_id == self._services.keeper.visit_id:
            self._services.keeper.leave(store)
        else:  # the visit was saved when it was left
            store()

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
            if self._services.keeper.visit_id == visit_id:
                self._services.case.note_stored_order(note)

        # Whatever goes wrong, the next change asks again; saving tells of it.
        self._clinic.ask(
            "records-order-note", lambda r: r.orders.note_of(visit_id), take, lambda _error: None
        )

    def _offer(self, order: Order) -> None:
        number = tr("Order {number}").format(number=order.number)
        if order.release > 1:
            revision = tr("{number}, revision {revision}")
            number = revision.format(number=number, revision=order.release)
        sentence = tr("{order} is in the record, with its files.")
        if order.due_on is not None:
            sentence = tr("{order} is in the record, with its files; it is due {day}.")
        self._services.notices.put(
            NOTICE,
            sentence.format(order=number, day=day_text(order.due_on)),
            (tr("Shop and due date…"), lambda: self.ask(order.id)),
        )

    def _ask(self, order: Order) -> None:
        dialog = OrderDialog(order, self._services.window)
        dialog.finished.connect(dialog.deleteLater)
        dialog.accepted.connect(lambda: self._change(order, dialog))
        dialog.open()

    def _change(self, order: Order, dialog: OrderDialog) -> None:
        shop, due_on = dialog.shop.text(), dialog.due_on
        remarks = dialog.remarks.toPlainText()
        self._clinic.write(
            lambda r: r.orders.change(order.id, shop, due_on, remarks, order.revision),
            lambda _order: None,
            self._tell,
        )


def _merged(stored: str, before: str, now: str) -> str:
    """Return an order's remarks with a change of the visit's; what was written there stays."""
    if now == before:
        return stored
    if before and before in stored:
        return stored.replace(before, now, 1).strip()
    return "\n".join(text for text in (stored, now) if text)
