"""Presenter of the orders page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from datetime import date
from typing import TYPE_CHECKING

from insole_core.records.order import OrderState, OrderSummary
from insole_core.records.person import Person
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.features.records.order_rows import due_text, state_text
from insole_studio.features.records.orders_page import OPEN, OrdersPage
from insole_studio.texts import tr
from insole_studio.widgets.row_table import TableRow

if TYPE_CHECKING:
    from insole_core.records.records import Records

READ = "records-orders"


class OrdersPresenter:
    """Shows orders, and brings them to other states.

    Parameters
    ----------
    tell
        Shows an error.
    """

    def __init__(
        self, page: OrdersPage, clinic: ClinicRecord, tell: Callable[[Exception], None]
    ) -> None:
        self._page = page
        self._clinic = clinic
        self._tell = tell
        self._state: OrderState | None = None
        self._person: Person | None = None
        self.orders: dict[str, OrderSummary] = {}
        page.state_chosen.connect(self._choose_state)
        page.move_requested.connect(self._move)
        page.days_edited.connect(self._set_days)
        clinic.changed.connect(self._refresh)

    def show(self, person: Person | None) -> None:
        """Show the orders of a person; those of the clinic for None."""
        self._person = person
        self._show(())  # not those of before, while the record answers
        self._read()

    def _choose_state(self, word: str) -> None:
        self._state = None if word == OPEN else OrderState(word)
        self._read()

    def _refresh(self) -> None:
        if self._page.isVisible() and self._clinic.is_open:
            self._read()

    def _read(self) -> None:
        person, state = self._person, self._state

        def read(records: Records) -> tuple[Sequence[OrderSummary], int]:
            days = records.orders.days_until_due()
            if person is not None:
                return records.orders.of_person(person.id), days
            return records.orders.open(state), days

        self._clinic.ask(READ, read, self._take, self._tell)

    def _take(self, answer: tuple[Sequence[OrderSummary], int]) -> None:
        orders, days = answer
        self._show(orders)
        self._page.show_days(days)

    def _set_days(self, days: int) -> None:
        self._clinic.write(
            lambda records: records.orders.set_days_until_due(days),
            lambda _nothing: None,
            self._tell,
        )

    def _show(self, orders: Sequence[OrderSummary]) -> None:
        self.orders = {order.id: order for order in orders}
        today = date.today()
        rows = [
            TableRow(
                order.id,
                (
                    order.person_name,
                    order.number,
                    state_text(order.state),
                    due_text(order, today),
                    order.shop,
                ),
                attention=order.is_overdue(today),
            )
            for order in orders
        ]
        person = self._person
        title = tr("Orders") if person is None else tr("Orders of {name}").format(name=person.name)
        self._page.show_orders(title, rows, of_person=person is not None)

    def _move(self, order_id: str, word: str) -> None:
        order = self.orders[order_id]

        def move(records: Records) -> None:
            records.orders.move(order_id, OrderState(word), "", order.revision)

        self._clinic.write(move, lambda _nothing: self._read(), self._tell)
