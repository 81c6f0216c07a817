"""The orders of the record."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import date, timedelta
from pathlib import Path
from typing import Any, Final

from sqlalchemy import Connection, Row, Select, func, insert, select, update

from insole_core.errors import Conflict, InputError, RecordsError
from insole_core.records.clinic import setting_of, write_setting
from insole_core.records.context import RecordsContext
from insole_core.records.field_checks import (
    check_day,
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
    OrderEvent,
    OrderFile,
    OrderState,
    OrderSummary,
)
from insole_core.records.person import new_id
from insole_core.records.person_rows import locked_person, touch_person, write_search_text
from insole_core.records.rights import Right
from insole_core.records.schema import (
    order_events,
    order_feet,
    order_files,
    orders,
    persons,
    prescription_versions,
)
from insole_core.records.stored_contents import put_file, refer_to
from insole_core.records.times import utc_now
from insole_core.solids.order_number import new_order_number

_DAYS_UNTIL_DUE: Final = "days_until_due"


class Orders:
    """Adds, moves and finds orders."""

    def __init__(self, context: RecordsContext) -> None:
        self._context = context

    def open(self, state: OrderState | None = None) -> list[OrderSummary]:
        """Return the orders with which somebody still has something to do, the first due first.

        Parameters
        ----------
        state
            Only those in this state, which may also be a final one.
        """
        states = OPEN_STATES if state is None else (state,)
        return self._summaries(_listed().where(orders.c.state.in_(states)))

    def of_person(self, person_id: str) -> list[OrderSummary]:
        """Return all orders of a person, the first due first."""
        return self._summaries(_listed().where(orders.c.person_id == person_id))

    def get(self, order_id: str) -> Order:
        """Return an order with its files and events.

        Raises
        ------
        RecordsError
            When there is none.
        """
        with self._context.reading() as connection:
            return _order(connection, order_id)

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
    ) -> Order:
        """Order what versions of a visit's prescriptions say; they are closed by that.

        Parameters
        ----------
        files
            What was made for the shop; stored with the order.
        number
            The order's number if papers have it already; otherwise one is drawn.

        Raises
        ------
        InputError
            When a field cannot be right, a file cannot be read, or the number is taken.
        RecordsError, OutputError
            When it cannot be stored.
        """
        today = date.today()
        values: dict[str, Any] = {
            "shop": check_line(shop, "name of the shop"),
            "due_on": check_day(due_on, "date that it is due", today),
            "remarks": check_text(remarks, "remarks"),
        }
        number = check_line(number, "number of the order", 60)
        stored = self._stored(files)
        order_id, now = new_id(), utc_now()
        with self._context.writing_visit(Right.ORDER, visit_id) as (connection, visit):
            locked_person(connection, visit.person_id)
            _close_versions(connection, visit_id, version_ids)
            values |= {
                "id": order_id,
                "number": _free_number(connection, number, today),
                "visit_id": visit_id,
                "person_id": visit.person_id,
                "state": str(OrderState.DESIGNED),
                "created_at": now,
                "changed_at": now,
                "revision": 1,
            }
            connection.execute(insert(orders).values(values))
            for version_id in version_ids:
                row = {"order_id": order_id, "prescription_version_id": version_id}
                connection.execute(insert(order_feet).values(row))
            for file in stored:
                refer_to(connection, file.content_sha256, file.size, "order")
                connection.execute(insert(order_files).values(order_id=order_id, **vars(file)))
            self._add_event(connection, order_id, None, OrderState.DESIGNED, "")
            write_search_text(connection, visit.person_id)
            self._context.log(connection, "added", "order", order_id, visit=visit_id)
            return _order(connection, order_id)

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
            self._add_event(connection, order_id, OrderState(stored.state), state, remarks)
            self._context.log(connection, "moved", "order", order_id, state=str(state))
            return _order(connection, order_id)

    def change(
        self, order_id: str, shop: str, due_on: date | None, remarks: str, revision: int
    ) -> Order:
        """Change shop, due date and remarks of an order.

        Raises
        ------
        InputError
            When a field cannot be right.
        Conflict
            When somebody else has changed the order meanwhile.
        """
        values = {
            "shop": check_line(shop, "name of the shop"),
            "due_on": check_day(due_on, "date that it is due", date.today()),
            "remarks": check_text(remarks, "remarks"),
        }
        with self._changing(order_id, revision, values) as (connection, stored):
            _write(connection, stored, values)
            self._context.log(connection, "changed", "order", order_id)
            return _order(connection, order_id)

    def add_files(self, order_id: str, files: Sequence[Path]) -> Order:
        """Store further files with an order.

        Raises
        ------
        InputError
            When a file cannot be read, or the order has another one of its name.
        RecordsError, OutputError
            When they cannot be stored.
        """
        stored = self._stored(files)
        with self._context.reading() as connection:
            person_id = _order(connection, order_id).person_id
        with self._context.writing(Right.ORDER, person_id) as connection:
            taken = {file.name for file in _order(connection, order_id).files}
            for file in stored:
                if file.name in taken:
                    raise InputError(
                        "The order has a file {name} already; give this one another name.",
                        name=file.name,
                    )
                refer_to(connection, file.content_sha256, file.size, "order")
                connection.execute(insert(order_files).values(order_id=order_id, **vars(file)))
            self._context.log(connection, "added files", "order", order_id, count=len(stored))
            return _order(connection, order_id)

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
                raise _gone()
            touch_person(connection, person_id)
            query = select(orders).where(orders.c.id == order_id).with_for_update()
            stored = connection.execute(query).one()
            if stored.revision != revision:
                raise Conflict(
                    mine,
                    _order(connection, order_id),
                    "Somebody else has changed the order {number} meanwhile; look at it again.",
                    number=stored.number,
                )
            yield connection, stored

    def _stored(self, files: Sequence[Path]) -> list[OrderFile]:
        names = [check_name(path.name, "name of the file") for path in files]
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:
            raise InputError(
                "Two files of the order have the name {name}; give one another name.", name=twice
            )
        stored = (put_file(self._context.contents, path) for path in files)
        return [OrderFile(name, *file) for name, file in zip(names, stored, strict=True)]

    def _add_event(
        self,
        connection: Connection,
        order_id: str,
        before: OrderState | None,
        after: OrderState,
        remarks: str,
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
        }
        connection.execute(insert(order_events).values(values))

    def _summaries(self, query: Select[Any]) -> list[OrderSummary]:
        query = query.order_by(orders.c.due_on.is_(None), orders.c.due_on, orders.c.number)
        with self._context.reading() as connection:
            rows = connection.execute(query).all()
        return [OrderSummary(**{**row._mapping, "state": OrderState(row.state)}) for row in rows]


def _listed() -> Select[Any]:
    return select(
        orders.c.id,
        orders.c.number,
        orders.c.person_id,
        persons.c.name.label("person_name"),
        orders.c.visit_id,
        orders.c.state,
        orders.c.shop,
        orders.c.due_on,
        orders.c.revision,
    ).join(persons, persons.c.id == orders.c.person_id)


def _order(connection: Connection, order_id: str) -> Order:
    row = connection.execute(select(orders).where(orders.c.id == order_id)).one_or_none()
    if row is None:
        raise _gone()
    feet = select(order_feet.c.prescription_version_id).where(order_feet.c.order_id == order_id)
    files = select(order_files.c.name, order_files.c.content_sha256, order_files.c.size)
    files = files.where(order_files.c.order_id == order_id).order_by(order_files.c.name)
    events = select(order_events).where(order_events.c.order_id == order_id)
    events = events.order_by(order_events.c.seq)
    values: dict[str, Any] = {**row._mapping, "state": OrderState(row.state)}
    return Order(
        **values,
        version_ids=tuple(connection.execute(feet).scalars()),
        files=tuple(OrderFile(*file) for file in connection.execute(files)),
        events=tuple(_event(event) for event in connection.execute(events)),
    )


def _event(row: Row[Any]) -> OrderEvent:
    before = None if row.from_state is None else OrderState(row.from_state)
    return OrderEvent(row.seq, row.at, row.author, before, OrderState(row.to_state), row.remarks)


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


def _gone() -> RecordsError:
    return RecordsError("This order is no longer in the record; look at the list again.")
