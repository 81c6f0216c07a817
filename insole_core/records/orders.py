"""The orders of the record."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import date, timedelta
from pathlib import Path
from typing import Any, Final

from sqlalchemy import Connection, Row, func, insert, select, update

from insole_core.cases.order_note import OrderNote
from insole_core.errors import Conflict, InputError
from insole_core.records.author import utc_now
from insole_core.records.checked_values import word_of
from insole_core.records.clinic import setting_of, write_setting
from insole_core.records.context import RecordsContext, put_file, refer_to
from insole_core.records.field_checks import (
    check_line,
    check_name,
    check_number,
    check_text,
)
from insole_core.records.order import (
    MOST_DAYS_UNTIL_DUE,
    OPEN_STATES,
    USUAL_DAYS_UNTIL_DUE,
    Order,
    OrderFile,
    OrderSearch,
    OrderState,
    OrderSummary,
)
from insole_core.records.person import new_id
from insole_core.records.record_field import checked_values
from insole_core.records.rights import Right
from insole_core.records.rows import (
    listed_orders,
    locked_person,
    note_of_visit,
    order_is_gone,
    order_of,
    searched,
    summary_of_order,
    touch_person,
    visit_of,
    write_search_text,
)
from insole_core.records.schema import (
    order_events,
    order_feet,
    order_files,
    orders,
    prescription_versions,
)
from insole_core.solids.order_number import new_order_number

_DAYS_UNTIL_DUE: Final = "days_until_due"


class Orders:
    """Adds, moves and finds orders."""

    def __init__(self, context: RecordsContext) -> None:
        self._context = context

    def find(self, search: OrderSearch, limit: int | None = None) -> list[OrderSummary]:
        """Return the orders that are wanted, in the order that is wanted.

        Parameters
        ----------
        limit
            At most as many; None for all.
        """
        with self._context.reading() as connection:
            rows = connection.execute(searched(search).limit(limit)).all()
        return [summary_of_order(row) for row in rows]

    def count(self, search: OrderSearch) -> int:
        """Return how many orders `find` would find without a limit."""
        found = searched(search).order_by(None).subquery()
        with self._context.reading() as connection:
            return int(connection.execute(select(func.count()).select_from(found)).scalar_one())

    def open(self, state: OrderState | None = None) -> list[OrderSummary]:
        """Return the orders with which somebody still has something to do, the first due first.

        Parameters
        ----------
        state
            Only those in this state, which may also be a final one.
        """
        return self.find(OrderSearch(OPEN_STATES if state is None else (state,)))

    def of_person(self, person_id: str) -> list[OrderSummary]:
        """Return all orders of a person, the first due first."""
        return self.find(OrderSearch(person_id=person_id))

    def with_number(self, number: str) -> OrderSummary | None:
        """Return the order of a number; None where there is none."""
        query = listed_orders().where(orders.c.number == number)
        with self._context.reading() as connection:
            row = connection.execute(query).one_or_none()
        return None if row is None else summary_of_order(row)

    def note_of(self, visit_id: str) -> OrderNote:
        """Return the order that the next export of a visit revises, and the terms of the visit.

        Raises
        ------
        RecordsError
            When there is no such visit.
        """
        with self._context.reading() as connection:
            return note_of_visit(connection, visit_of(connection, visit_id))

    def get(self, order_id: str) -> Order:
        """Return an order with its files and events.

        Raises
        ------
        RecordsError
            When there is none.
        """
        with self._context.reading() as connection:
            return order_of(connection, order_id)

    def add(
        self,
        visit_id: str,
        version_ids: Sequence[str],
        *,
        shop: str = "",
        due_on: date | None = None,
        remarks: str = "",
        files: Sequence[Path] = (),
        number: str = "",
        release: int = 1,
        place: str = "",
    ) -> Order:
        """Order what versions of a visit's prescriptions say; they are closed by that.

        Parameters
        ----------
        files
            What was made for the shop; stored with the order.
        number
            The order's number if papers have it already; otherwise one is drawn.
        release
            Of the revision that the papers have.
        place
            Folder that the files were written to.

        Raises
        ------
        InputError
            When a field cannot be right, a file cannot be read, or the number is taken.
        RecordsError, OutputError
            When it cannot be stored.
        """
        today = date.today()
        given = {"shop": shop, "due_on": due_on, "remarks": remarks, "place": place}
        values = checked_values(Order, given, today)
        number = check_line(number, "number of the order", 60)
        stored = self._stored(files, release)
        order_id, now = new_id(), utc_now()
        with self._context.writing_visit(Right.ORDER, visit_id) as (connection, visit):
            locked_person(connection, visit.person_id)
            values |= {
                "id": order_id,
                "number": _free_number(connection, number, today),
                "visit_id": visit_id,
                "person_id": visit.person_id,
                "state": str(OrderState.DESIGNED),
                "release": release,
                "created_at": now,
                "changed_at": now,
                "revision": 1,
            }
            connection.execute(insert(orders).values(values))
            self._add_release(
                connection, order_id, visit_id, version_ids, files=stored, release=release
            )
            self._add_event(connection, order_id, None, OrderState.DESIGNED, release=release)
            write_search_text(connection, visit.person_id)
            self._context.log(connection, "added", "order", order_id, visit=visit_id)
            return order_of(connection, order_id)

    def revise(
        self,
        order_id: str,
        version_ids: Sequence[str],
        revision: int,
        *,
        release: int,
        due_on: date | None = None,
        remarks: str = "",
        files: Sequence[Path] = (),
        place: str = "",
    ) -> Order:
        """Order what other versions of the same visit say, under the same number.

        The files of earlier revisions stay. The order is designed again: the shop does not have
        this revision yet.

        Parameters
        ----------
        revision
            Of the order that the change is based on.
        release
            Number of the revision, which the papers have.
        files, place
            As for `add`.

        Raises
        ------
        InputError
            When a field cannot be right, a file cannot be read, the order has this revision, or it
            was delivered or cancelled.
        Conflict
            When somebody else has changed it meanwhile.
        RecordsError, OutputError
            When it cannot be stored.
        """
        given = {"due_on": due_on, "remarks": remarks, "place": place}
        values = {
            **checked_values(Order, given, date.today()),
            "state": str(OrderState.DESIGNED),
            "release": release,
        }
        stored_files = self._stored(files, release)
        with self._changing(order_id, revision, values) as (connection, stored):
            if stored.release >= release:
                raise InputError(
                    "The order {number} has a revision {release} already, of somebody else; export "
                    "once more, under the next number.",
                    number=stored.number,
                    release=stored.release,
                )
            if stored.state not in OPEN_STATES:
                raise InputError(
                    "The order {number} was {state} meanwhile; export once more, as a new order.",
                    number=stored.number,
                    state=stored.state,
                )
            locked_person(connection, stored.person_id)
            self._add_release(
                connection,
                order_id,
                stored.visit_id,
                version_ids,
                files=stored_files,
                release=release,
            )
            _write(connection, stored, values)
            before, after = word_of(OrderState, stored.state), OrderState.DESIGNED
            self._add_event(connection, order_id, before, after, release=release)
            self._context.log(connection, "revised", "order", order_id, release=release)
            return order_of(connection, order_id)

    def days_until_due(self) -> int:
        """Return after how many days a new order is due at this clinic; 0 for no due date."""
        with self._context.reading() as connection:
            return int(setting_of(connection, _DAYS_UNTIL_DUE, USUAL_DAYS_UNTIL_DUE))

    def set_days_until_due(self, days: int) -> None:
        """Set after how many days new orders are due; whoever may order may say so.

        Raises
        ------
        InputError
            When it is negative, or more than a year.
        """
        check_number(days, "number of days", 0, MOST_DAYS_UNTIL_DUE)
        with self._context.writing(Right.ORDER) as connection:
            write_setting(connection, _DAYS_UNTIL_DUE, days)
            self._context.log(connection, "changed", "clinic", _DAYS_UNTIL_DUE)

    def usual_due_on(self, today: date) -> date | None:
        """Return when an order of today is due; None where the clinic sets no due date."""
        days = self.days_until_due()
        return today + timedelta(days=days) if days else None

    def move(self, order_id: str, state: OrderState, remarks: str, revision: int) -> Order:
        """Bring an order to another state.

        Any state may follow any other: deliveries come back, and clicks go wrong. The events tell.

        Parameters
        ----------
        revision
            Of the order that the change is based on.

        Raises
        ------
        InputError
            When it is in that state already.
        Conflict
            When somebody else has moved the order meanwhile.
        """
        remarks = check_text(remarks, "remarks")
        with self._changing(order_id, revision, state) as (connection, stored):
            if stored.state == state:
                raise InputError(
                    "The order {number} is {state} already; choose another state.",
                    number=stored.number,
                    state=str(state),
                )
            _write(connection, stored, {"state": str(state)})
            before = word_of(OrderState, stored.state)
            self._add_event(
                connection, order_id, before, state, release=stored.release, remarks=remarks
            )
            self._context.log(connection, "moved", "order", order_id, state=str(state))
            return order_of(connection, order_id)

    def change(self, order_id: str, typed: Mapping[str, Any], revision: int) -> Order:
        """Change what somebody fills in of an order.

        Parameters
        ----------
        typed
            Values by the names of the fields, such as ``{"due_on": date(2026, 12, 1)}``.
        revision
            Of the order that the change is based on.

        Raises
        ------
        InputError
            When a field cannot be right.
        Conflict
            When somebody else has changed the order meanwhile.
        """
        values = checked_values(Order, typed, date.today())
        with self._changing(order_id, revision, values) as (connection, stored):
            _write(connection, stored, values)
            self._context.log(connection, "changed", "order", order_id)
            return order_of(connection, order_id)

    def copy_files(self, order_id: str, folder: Path) -> tuple[Path, ...]:
        """Copy the files of an order's newest revision into a folder that is there.

        Raises
        ------
        RecordsError
            When there is no such order, or a file is missing or was changed on the disk.
        OutputError
            When they cannot be written.
        """
        order = self.get(order_id)
        copies = []
        for file in order.newest_files:
            copies.append(folder / Path(file.name).name)
            self._context.contents.copy_to(file.content_sha256, copies[-1])
        return tuple(copies)

    def _add_release(
        self,
        connection: Connection,
        order_id: str,
        visit_id: str,
        version_ids: Sequence[str],
        *,
        files: Sequence[OrderFile],
        release: int,
    ) -> None:
        """Store what a revision of an order is made from, and its files."""
        _close_versions(connection, visit_id, version_ids)
        rows = [
            {"order_id": order_id, "prescription_version_id": id_, "release": release}
            for id_ in version_ids
        ]
        connection.execute(insert(order_feet), rows)
        _add_files(connection, order_id, files)

    @contextmanager
    def _changing(
        self, order_id: str, revision: int, mine: Any
    ) -> Iterator[tuple[Connection, Row[Any]]]:
        """Yield a connection and the locked row of an order.

        Raises
        ------
        Conflict
            When its revision is another one.
        """
        with self._context.writing(Right.ORDER) as connection:
            person_id = connection.execute(
                select(orders.c.person_id).where(orders.c.id == order_id)
            ).scalar()
            if person_id is None:
                raise order_is_gone()
            touch_person(connection, person_id)
            query = select(orders).where(orders.c.id == order_id).with_for_update()
            stored = connection.execute(query).one()
            if stored.revision != revision:
                raise Conflict(
                    mine,
                    order_of(connection, order_id),
                    "Somebody else has changed the order {number} meanwhile; look at it again.",
                    number=stored.number,
                )
            yield connection, stored

    def _stored(self, files: Sequence[Path], release: int) -> list[OrderFile]:
        names = [check_name(path.name, "name of the file") for path in files]
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:
            raise InputError(
                "Two files of the order have the name {name}; give one another name.", name=twice
            )
        stored = (put_file(self._context.contents, path) for path in files)
        return [OrderFile(name, *file, release) for name, file in zip(names, stored, strict=True)]

    def _add_event(
        self,
        connection: Connection,
        order_id: str,
        before: OrderState | None,
        after: OrderState,
        *,
        release: int,
        remarks: str = "",
    ) -> None:
        last = select(func.coalesce(func.max(order_events.c.seq), 0)).where(
            order_events.c.order_id == order_id
        )
        values = {
            "order_id": order_id,
            "seq": connection.execute(last).scalar_one() + 1,
            "at": utc_now(),
            "author": self._context.author.name,
            "from_state": before,
            "to_state": after,
            "remarks": remarks,
            "release": release,
        }
        connection.execute(insert(order_events).values(values))


def _add_files(connection: Connection, order_id: str, files: Sequence[OrderFile]) -> None:
    for file in files:
        refer_to(connection, file.content_sha256, file.size, "order")
        connection.execute(insert(order_files).values(order_id=order_id, **vars(file)))


def _write(connection: Connection, stored: Row[Any], values: Mapping[str, Any]) -> None:
    written = {**values, "changed_at": utc_now(), "revision": stored.revision + 1}
    connection.execute(update(orders).where(orders.c.id == stored.id).values(written))


def _close_versions(connection: Connection, visit_id: str, version_ids: Sequence[str]) -> None:
    """Close the versions of an order, which must be of its visit, one for a side."""
    versions = prescription_versions.c
    query = select(versions.id, versions.side).where(
        versions.id.in_(version_ids), versions.visit_id == visit_id
    )
    found = connection.execute(query.with_for_update()).all()
    sides = {row.side for row in found}
    if not found or len(found) != len(version_ids) or len(sides) != len(found):
        raise InputError(
            "An order needs one version of one or both feet of its visit; choose them again."
        )
    row = update(prescription_versions).where(
        versions.id.in_(version_ids), versions.is_closed.is_(False)
    )
    connection.execute(row.values(is_closed=True))


def _free_number(connection: Connection, number: str, today: date) -> str:
    """Return the number of an order, or draw one that no order has."""
    wanted = number or new_order_number(today)
    taken = select(orders.c.id).where(orders.c.number == wanted)
    if connection.execute(taken).first() is None:
        return wanted
    if not number:
        return _free_number(connection, "", today)
    raise InputError(
        "There is an order {number} already; give this one another number.", number=number
    )
