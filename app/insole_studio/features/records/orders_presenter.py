"""Presenter of the orders page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from datetime import date
from typing import TYPE_CHECKING

from insole_core.records.order import OPEN_STATES, OrderSearch, OrderState, OrderSummary
from insole_core.records.person import Person
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.features.records.nest_actions import NestActions
from insole_studio.features.records.order_actions import OrderActions
from insole_studio.features.records.orders_page import ALL, OPEN, OrdersPage
from insole_studio.features.records.rows import COLUMNS, order_rows, sorted_as
from insole_studio.texts import tr
from insole_studio.widgets.row_table import Sorting

if TYPE_CHECKING:
    from insole_core.records.records import Records

READ = "records-orders"
FIRST_ROWS = 200
"""That are shown at first; each time the end is in sight, twice as many."""


@dataclass(frozen=True)
class _Found:
    orders: Sequence[OrderSummary]
    count: int
    days: int


class OrdersPresenter:
    """Shows orders, and brings them to other states.

    Parameters
    ----------
    actions
        On one order.
    nest
        On all that are listed.
    tell
        Shows an error.
    """

    def __init__(
        self,
        page: OrdersPage,
        clinic: ClinicRecord,
        actions: OrderActions,
        nest: NestActions,
        tell: Callable[[Exception], None],
    ) -> None:
        self._page = page
        self._clinic = clinic
        self._actions = actions
        self._tell = tell
        self._search = OrderSearch(OPEN_STATES)
        self._person: Person | None = None
        self._wanted = FIRST_ROWS
        self._count = 0
        self.orders: dict[str, OrderSummary] = {}
        page.state_chosen.connect(self._choose_state)
        page.search_edited.connect(self._choose_words)
        page.table.sort_chosen.connect(self._choose_sorting)
        page.table.end_reached.connect(self._show_more)
        page.move_requested.connect(self._move)
        page.days_edited.connect(self._set_days)
        page.nest_requested.connect(lambda: nest.ask(tuple(self.orders.values())))
        clinic.changed.connect(self._refresh)

    def show(self, person: Person | None) -> None:
        """Show the orders of a person; those of the clinic for None."""
        self._person = person
        self._show((), 0)  # not those of before, while the record answers
        self._begin()

    def _choose_state(self, word: str) -> None:
        states = {OPEN: OPEN_STATES, ALL: ()}
        chosen = states[word] if word in states else (OrderState(word),)
        self._search = replace(self._search, states=chosen)
        self._begin()

    def _choose_words(self, typed: str) -> None:
        self._search = replace(self._search, typed=typed)
        self._begin()

    def _choose_sorting(self, sorting: Sorting | None) -> None:
        self._search = sorted_as(self._search, COLUMNS, sorting)
        self._begin()

    def _show_more(self) -> None:
        if self._wanted <= len(self.orders) < self._count:
            self._wanted *= 2
            self._read()

    def _refresh(self) -> None:
        if self._page.isVisible() and self._clinic.is_open:
            self._read()

    def _begin(self) -> None:
        """Show the first of what is searched for."""
        self._wanted = FIRST_ROWS
        self._page.table.scrollToTop()
        self._read()

    def _read(self) -> None:
        search, wanted = self._search, self._wanted
        if self._person is not None:
            search = replace(search, states=(), typed="", person_id=self._person.id)

        def read(records: Records) -> _Found:
            with records.snapshot():
                found = records.orders.find(search, wanted)
                count = records.orders.count(search) if len(found) == wanted else len(found)
                return _Found(found, count, records.orders.days_until_due())

        self._clinic.ask(READ, read, self._take, self._tell)

    def _take(self, found: _Found) -> None:
        self._show(found.orders, found.count)
        self._page.show_days(found.days)

    def _set_days(self, days: int) -> None:
        self._clinic.write(
            lambda records: records.orders.set_days_until_due(days),
            lambda _nothing: None,
            self._tell,
        )

    def _show(self, orders: Sequence[OrderSummary], count: int) -> None:
        self.orders = {order.id: order for order in orders}
        self._count = count
        person = self._person
        title = tr("Orders") if person is None else tr("Orders of {name}").format(name=person.name)
        self._page.show_orders(
            title, order_rows(orders, date.today()), count, of_person=person is not None
        )

    def _move(self, order_id: str, word: str) -> None:
        self._actions.move(self.orders[order_id], OrderState(word))
