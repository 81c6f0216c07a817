"""Orders made of what is exported, and their shop and due date."""

from __future__ import annotations

import logging
import time
import uuid
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject

from insole_core.cases.case_record import CaseRecord
from insole_core.cases.order_note import OrderNote
from insole_core.errors import Conflict, InputError, PersonErased, Unreachable
from insole_core.export.shop_order import MOST_REVISIONS, OrderTerms, terms_from_json, terms_to_json
from insole_core.geometry.side import Side
from insole_core.given_file import sha256_of
from insole_core.records.order import Order, OrderState, OrderSummary
from insole_core.workflows.order_package import Ordered
from insole_studio.document.clinic_record import RecordState
from insole_studio.document.journal import Recovered
from insole_studio.document.waiting_work import LeftWork, WaitingWork
from insole_studio.features.records.record_dialogs import OrderDialog
from insole_studio.features.records.rows import day_text, name_of, state_text
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_core.records.records import Records

log = logging.getLogger(__name__)

NOTICE = "record-order"


@dataclass(frozen=True)
class _Export:
    """An order that is not in the record yet.

    Parameters
    ----------
    before
        The terms from which those of the order were changed.
    key
        By which it waits on the disk; earlier exports have lower ones.
    may_be_stored
        Whether it was given to the record before, which may have stored it without an answer.
    """

    visit_id: str
    sides: tuple[Side, ...]
    ordered: Ordered
    before: OrderTerms
    key: str = field(default_factory=lambda: f"{time.time_ns()}-{uuid.uuid4().hex}")
    may_be_stored: bool = False

    def to_json(self) -> dict[str, Any]:
        """Return it as values for `json.dumps`."""
        ordered = self.ordered
        return {
            "sides": [str(side) for side in self.sides],
            "paths": [str(path) for path in ordered.paths],
            "papers": [str(path) for path in ordered.papers],
            "number": ordered.number,
            "release": ordered.revision,
            "terms": terms_to_json(ordered.terms),
            "before": terms_to_json(self.before),
        }

    @classmethod
    def of_left(cls, left: LeftWork) -> _Export:
        """Return what a window has left; the inverse of `to_json`.

        Raises
        ------
        InputError
            When it is none.
        """
        of = left.content
        ordered = Ordered(
            tuple(map(Path, of.texts("paths"))),
            terms_from_json(of.object("terms")),
            of.text("number"),
            of.integer("release", 1, MOST_REVISIONS),
            tuple(map(Path, of.texts("papers"))),
        )
        sides = tuple(side for side in Side if side in of.texts("sides"))
        before = terms_from_json(of.object("before"))
        return cls(left.visit_id, sides, ordered, before, left.key, may_be_stored=True)


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
        self._kept = WaitingWork(
            services.paths.waiting_orders_folder, services.messages.show_sentence
        )
        self._left: list[_Export] = []
        """Whose visit has work on this computer that is still to come into the record."""
        self._under_way: _Export | None = None
        self._clinic.changed.connect(self._refresh_note)
        self._clinic.changed.connect(self._go_on)
        self._clinic.state_changed.connect(self._go_on)
        services.case.opened.connect(self._note_terms)
        services.keeper.moved.connect(self._move)

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
        before = self._terms.get(visit_id, ordered.terms)
        sides = tuple(foot.side for foot in exported.feet)
        # Files that were written over are none of what they were exported for.
        for export in [one for one in self._waiting if not files.isdisjoint(one.ordered.files)]:
            self._waiting.remove(export)
            self._kept.drop(export.key)
        export = _Export(visit_id, sides, ordered, before)
        self._waiting.append(export)
        self._kept.keep(export.key, visit_id, export.to_json())
        self._terms[visit_id] = ordered.terms
        self._store_when_saved()

    def take_left(self, stuck: Sequence[Recovered]) -> None:
        """Store what windows have left that ended, once their prescriptions are in the record.

        Parameters
        ----------
        stuck
            Unsaved work that the record does not take; the orders of its visits wait for it.
        """
        clinic = self._clinic
        if not clinic.is_writable or not clinic.may_show_patients:
            return
        for left in self._kept.take_over():
            try:
                self._left.append(_Export.of_left(left))
            except InputError as error:
                self._kept.set_aside(left.key, error)
        visits = {one.visit.visit_id for one in stuck if one.visit is not None}
        self._waiting += [export for export in self._left if export.visit_id not in visits]
        self._left = [export for export in self._left if export.visit_id in visits]
        if self._waiting:
            self._store_when_saved()

    def _move(self, before: str, visit_id: str) -> None:
        """Let orders of a lost visit wait for the one that has taken its place."""
        if before in self._terms:
            self._terms[visit_id] = self._terms.pop(before)
        for number, export in enumerate(self._waiting):
            if export.visit_id == before:
                moved = self._waiting[number] = replace(export, visit_id=visit_id)
                self._kept.keep(moved.key, visit_id, moved.to_json())

    def close(self) -> None:
        """Leave what is not stored to the next window that starts."""
        self._kept.close()

    def _go_on(self) -> None:
        """Store what could not be stored before, once the record can be asked."""
        if self._clinic.state is RecordState.CLOSED and self._under_way is not None:
            # Its answer does not arrive any more.
            self._waiting.insert(0, replace(self._under_way, may_be_stored=True))
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
            self._kept.drop(export.key)
            self._offer(order)
            self._store_next()

        def missed(error: Exception) -> None:
            self._under_way = None
            if isinstance(error, Unreachable | Conflict):
                may_be_stored = export.may_be_stored or isinstance(error, Unreachable)
                self._waiting.insert(0, replace(export, may_be_stored=may_be_stored))
            elif isinstance(error, InputError | PersonErased):  # for good; all else is tried again
                self._kept.drop(export.key)
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
    records.visits.get(visit_id)  # which says so where it is gone
    newest = [records.prescriptions.versions(visit_id, side)[0].id for side in export.sides]
    terms, files, place = ordered.terms, ordered.files, str(ordered.place)
    known = records.orders.with_number(ordered.number)
    if known is not None and known.visit_id != visit_id:
        known = None
    stored = None if known is None else records.orders.get(known.id)
    if stored is not None and export.may_be_stored and _is_stored(stored, ordered):
        return stored
    if stored is not None and ordered.revision > 1:
        is_moved = terms.deliver_on is not None and terms.deliver_on != before.deliver_on
        return records.orders.revise(
            stored.id, newest, stored.revision,
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


def _is_stored(stored: Order, ordered: Ordered) -> bool:
    """Return whether an order has exactly these files in this revision."""
    if not all(path.is_file() for path in ordered.files):
        return False
    files = {(path.name, sha256_of(path)) for path in ordered.files}
    of_release = (file for file in stored.files if file.release == ordered.revision)
    return files == {(file.name, file.content_sha256) for file in of_release}


def _merged(stored: str, before: str, now: str) -> str:
    """Return an order's remarks with a change of the visit's; what was written there stays."""
    if now == before:
        return stored
    if before and before in stored:
        return stored.replace(before, now, 1).strip()
    return "\n".join(text for text in (stored, now) if text)
