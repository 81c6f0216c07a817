"""Presenter of the start page: searches as it is typed, and keeps the lists up to date."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date
from typing import TYPE_CHECKING, Final

from insole_core.errors import NotAllowed
from insole_core.records.order import OPEN_STATES, OrderKey, OrderSearch
from insole_core.records.person import PersonSummary
from insole_core.records.visit import VisitSummary
from insole_studio.document.clinic_record import ClinicRecord, RecordState
from insole_studio.features.records.rows import order_rows, sorted_as, visit_rows
from insole_studio.features.records.start_page import StartPage
from insole_studio.services.person_list import COLUMNS as PERSON_COLUMNS
from insole_studio.services.person_list import person_rows
from insole_studio.texts import tr
from insole_studio.widgets.row_table import Sorting

if TYPE_CHECKING:
    from insole_core.records.order import OrderSummary
    from insole_core.records.records import Records

SEARCH, LISTS = "records-search", "records-lists"
MOST_FOUND, MOST_RECENT, MOST_ORDERS = 50, 20, 100
_ORDER_COLUMNS: Final[tuple[OrderKey, ...]] = ("person_name", "number", "state", "due_on")


@dataclass(frozen=True)
class _Lists:
    today: list[VisitSummary]
    orders: list[OrderSummary]


class StartPresenter:
    """Shows persons, visits and orders of the record on the start page."""

    def __init__(self, page: StartPage, clinic: ClinicRecord) -> None:
        self._page = page
        self._clinic = clinic
        self._typed = ""
        self._sorting: Sorting | None = None
        """How patients are sorted; None for the best found, or the latest, on top."""
        self._pages = 1
        self._has_more = False
        self._orders = OrderSearch(OPEN_STATES)
        self._wanted_orders = MOST_ORDERS
        page.more_requested.connect(self.show_more)
        page.search_edited.connect(self.search)
        page.found.sort_chosen.connect(self._sort_persons)
        page.orders.sort_chosen.connect(self._sort_orders)
        page.orders.end_reached.connect(self._show_more_orders)
        clinic.state_changed.connect(self.show_state)
        clinic.changed.connect(self.refresh)
        self.show_state()

    def search(self, typed: str) -> None:
        """Find persons; the answer to what was typed last is the one that is shown."""
        self._typed = typed.strip()
        self._pages = 1
        self._search()

    def show_more(self) -> None:
        """Show twice as many patients, where there are more."""
        if self._has_more:
            self._has_more = False  # until it is known what comes after these
            self._pages *= 2
            self._search()

    def refresh(self) -> None:
        """Show what has changed in the record."""
        is_shown = self._clinic.is_open and self._page.isVisible()
        if is_shown and self._clinic.may_show_patients:
            self._search()
            self._ask_lists()

    def show_state(self) -> None:
        """Show whether the record can be asked."""
        state = self._clinic.state
        is_usable = state in (RecordState.OPEN, RecordState.AWAY)
        self._page.show_usable(
            is_usable and self._clinic.may_show_patients,
            why_not_add=self._clinic.why_read_only,
        )
        warns = bool(self._clinic.trouble) or self._clinic.problem is not None
        self._page.show_message(self._sentences(state), _remedies(self._clinic), warns=warns)
        if state is RecordState.SIGNED_OUT or not self._clinic.may_show_patients:
            self._forget()
        elif state is RecordState.OPEN:
            self.refresh()
            if self._page.isVisible() and not self._page.search.hasFocus():
                self._page.search.setFocus()

    def _sentences(self, state: RecordState) -> list[str]:
        """Return what is wrong with the record, and what is to be done."""
        trouble = self._clinic.trouble
        if state is RecordState.REFUSED:
            return [trouble, tr("Cases in files can be opened as before.")]
        if state is RecordState.AWAY:
            return [trouble]
        problem = self._clinic.problem
        sentences: list[str] = [] if problem is None else [problem]
        if state is RecordState.SIGNED_OUT:
            sentences.append(
                tr("Sign in to see the clinic's patients; files can be opened without.")
            )
        elif not self._clinic.may_show_patients:
            sentences.append(
                tr(
                    "An administrator looks after accounts, backups and the audit log, and sees no "
                    "patients; whoever treats patients signs in with an account of their own."
                )
            )
        return sentences

    def _sort_persons(self, sorting: Sorting | None) -> None:
        self._sorting, self._pages = sorting, 1
        self._search()

    def _sort_orders(self, sorting: Sorting | None) -> None:
        self._orders = sorted_as(self._orders, _ORDER_COLUMNS, sorting)
        self._wanted_orders = MOST_ORDERS
        self._ask_lists()

    def _show_more_orders(self) -> None:
        if len(self._page.orders.rows) == self._wanted_orders:
            self._wanted_orders *= 2
            self._ask_lists()

    def _ask_lists(self) -> None:
        search, wanted = self._orders, self._wanted_orders

        def lists(records: Records) -> _Lists:
            return _Lists(records.visits.on(date.today()), records.orders.find(search, wanted))

        if self._clinic.is_open:
            self._clinic.ask(LISTS, lists, self._show_lists, self._show_failure)

    def _search(self) -> None:
        typed, sorting = self._typed, self._sorting
        most = self._pages * (MOST_FOUND if typed or sorting else MOST_RECENT)

        def find(records: Records) -> list[PersonSummary]:
            # one more than are shown tells whether there are more
            if sorting is not None:
                key = PERSON_COLUMNS[sorting.column]
                return records.persons.listed(
                    typed, key, most + 1, is_descending=sorting.is_descending
                )
            if typed:
                return records.persons.search(typed, most + 1)
            return records.persons.recent(most + 1)

        if self._clinic.is_open:
            self._clinic.ask(
                SEARCH, find, lambda found: self._show_found(found, most), self._show_failure
            )

    def _show_found(self, found: list[PersonSummary], most: int) -> None:
        if not self._clinic.may_show_patients:  # what somebody asked who has left meanwhile
            return
        everybody = tr("Recent patients") if self._sorting is None else tr("Patients")
        title = tr("Found patients") if self._typed else everybody
        nothing = (
            tr("Nobody is found. Check the spelling, or add a new patient.")
            if self._typed
            else tr("No patient yet. Begin with “New patient”, or open a file.")
        )
        self._page.show_found(title, person_rows(found[:most]), nothing)
        self._has_more = len(found) > most
        self._page.show_more(self._has_more)

    def _show_lists(self, lists: _Lists) -> None:
        if not self._clinic.may_show_patients:
            return
        today = date.today()
        orders = order_rows(lists.orders, today, _ORDER_COLUMNS)
        self._page.show_day(visit_rows(lists.today), orders)

    def _forget(self) -> None:
        """Show no names to somebody who may not see them."""
        self._page.show_found(tr("Recent patients"), [], "")
        self._page.show_day([], [])

    def _show_failure(self, error: Exception) -> None:
        if isinstance(error, NotAllowed):
            self._forget()
        told = [*self._sentences(self._clinic.state), str(error)]
        self._page.show_message(told, _remedies(self._clinic))


def _remedies(clinic: ClinicRecord) -> tuple[str, ...]:
    """Return the actions that may help where the record cannot be used."""
    if clinic.state is RecordState.REFUSED:
        return ("retry_record", "restore_record", "record_place")
    sign_in = ("lock",) if clinic.state is RecordState.SIGNED_OUT else ()
    restore = ("restore_record",) if clinic.is_read_only else ()
    administer = () if clinic.may_show_patients else ("accounts", "audit_log")
    return (*sign_in, *administer, *restore)
