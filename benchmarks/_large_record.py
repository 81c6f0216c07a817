"""A record of many years, written past the program's own functions, which sync every change."""

from __future__ import annotations

import json
import random
from collections.abc import Iterator, Sequence
from datetime import UTC, date, datetime, timedelta
from typing import Any, Final

from sqlalchemy import Table, insert, update

from insole_core.records.audit import hash_of_line
from insole_core.records.author import TIME_FORMAT
from insole_core.records.database import Database
from insole_core.records.person import new_id, new_pseudonym
from insole_core.records.person_matching import MOST_KEY, name_key_of, search_text_of, sort_key_of
from insole_core.records.schema import FIRST_HASH, audit, audit_head, orders, persons, visits

FIRST_NAMES: Final = [
    "Anna",
    "Åsa",
    "Erik",
    "Karin",
    "Lars",
    "Maria",
    "Mikael",
    "Nils",
    "Olof",
    "Sara",
    "Ingrid",
    "Sven",
    "Björn",
    "Eva",
    "Per",
    "Fatima",
    "Ali",
    "Amina",
    "Omar",
    "Zeynep",
    "Mehmet",
    "Olga",
    "Ivan",
    "Chen",
    "Wei",
    "Yuki",
    "Haruto",
    "José",
    "Lucía",
    "Jürgen",
    "Zoë",
    "Łukasz",
    "Agnieszka",
]
LAST_NAMES: Final = [
    "Ångström",
    "Andersson",
    "Bergman",
    "Lindqvist",
    "Öberg",
    "Sjögren",
    "Karlsson",
    "Nyström",
    "Hassan",
    "Yılmaz",
    "Ivanova",
    "Petrov",
    "Nguyen",
    "Kowalski",
    "García",
    "Müller",
    "Çelik",
    "Haddad",
    "Virtanen",
    "Nielsen",
    "Østergaard",
    "Sørensen",
    "Dahl",
    "Lundgren",
    "Söderström",
    "Wikström",
    "Holm",
    "Ek",
    "Björk",
    "Åkesson",
    "Hedlund",
    "Falk",
]
TODAY: Final = date.today()
_WRITTEN: Final = "2026-11-20T10:00:00.000000Z"
BEGUN: Final = datetime(2021, 1, 1, tzinfo=UTC)
"""When the first line of the audit log was written."""
_KEPT_S: Final = 5 * 365 * 86_400
_BATCH: Final = 20_000


def fill_record(database: Database, count: int, audit_lines: int, seed: int = 1) -> list[str]:
    """Write persons, four visits and a tenth of an order for each, and lines of the audit log.

    Parameters
    ----------
    count
        Of persons.

    Returns
    -------
    list of str
        The ids of the persons.
    """
    rng = random.Random(seed)
    people = [_person(rng, number) for number in range(count)]
    ids = [str(person["id"]) for person in people]
    comings = [_visit(rng, person_id) for person_id in ids for _ in range(4)]
    _write(database, persons, people)
    _write(database, visits, comings)
    _write(database, orders, list(_orders(rng, comings[::40])))
    _write(database, audit, _lines(rng, ids, audit_lines))
    return ids


def _person(rng: random.Random, number: int) -> dict[str, Any]:
    name = f"{rng.choice(FIRST_NAMES)} {rng.choice(FIRST_NAMES)} {rng.choice(LAST_NAMES)}"
    if rng.random() < 0.3:
        name += f"-{rng.choice(LAST_NAMES)}"
    born = date(1930, 1, 1) + timedelta(days=rng.randrange(33_000))
    personal_number = f"{born:%Y%m%d}-{rng.randrange(10_000):04d}"
    pseudonym = new_pseudonym()
    return {
        "id": new_id(),
        "name": name,
        "search_text": search_text_of(name, born, personal_number, [pseudonym]),
        "sort_key": sort_key_of(name),
        "name_key": name_key_of(name)[:MOST_KEY],
        "birth_date": born,
        "personal_number": personal_number,
        "number_kind": "se",
        "pseudonym": pseudonym,
        "last_seq": number,
        "created_at": _WRITTEN,
        "changed_at": _WRITTEN,
        "revision": 1,
    }


def _visit(rng: random.Random, person_id: str) -> dict[str, Any]:
    return {
        "id": new_id(),
        "person_id": person_id,
        "visited_on": TODAY - timedelta(days=rng.randrange(3650)),
        "reason": "Pain below the heel in the morning",
        "findings": "Flat foot, tight calf; " * rng.randrange(1, 10),
        "weight_kg": round(rng.uniform(40, 120), 1),
        "measures": json.dumps({"left_length_mm": 250.0, "right_length_mm": 251.0}),
        "created_at": _WRITTEN,
        "changed_at": _WRITTEN,
        "revision": 1,
    }


def _orders(rng: random.Random, comings: Sequence[dict[str, Any]]) -> Iterator[dict[str, Any]]:
    for number, visit in enumerate(comings):
        yield {
            "id": new_id(),
            "number": f"26-{number:05d}",
            "visit_id": visit["id"],
            "person_id": visit["person_id"],
            "state": "sent" if number % 50 == 0 else "delivered",
            "shop": "CNC",
            "due_on": TODAY + timedelta(days=rng.randrange(-5, 15)),
            "created_at": _WRITTEN,
            "changed_at": _WRITTEN,
            "revision": 1,
        }


def _lines(rng: random.Random, ids: Sequence[str], count: int) -> Iterator[dict[str, Any]]:
    names = [column.name for column in audit.columns]
    previous = FIRST_HASH
    for seq in range(1, count + 1):
        action = rng.choice(("seen", "changed", "added"))
        at = (BEGUN + timedelta(seconds=seq * _KEPT_S / count)).strftime(TIME_FORMAT)
        author = "rare" if seq % 100_000 == 1 else rng.choice(("anna", "ben"))
        fields = (seq, at, author, "desk", action, "person", rng.choice(ids), "{}", previous)
        previous = hash_of_line(fields)
        yield dict(zip(names, (*fields, previous), strict=True))


def _write(database: Database, table: Table, rows: Any) -> None:
    batch: list[dict[str, Any]] = []
    with database.writing() as connection:
        for row in rows:
            batch.append(row)
            if len(batch) == _BATCH:
                connection.execute(insert(table), batch)
                batch.clear()
        if batch:
            connection.execute(insert(table), batch)
        if table is audit:
            last = row
            connection.execute(update(audit_head).values(seq=last["seq"], hash=last["hash"]))
