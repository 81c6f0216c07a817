"""Persons are found, changed and merged; nothing of them is lost."""

from __future__ import annotations

import json
from dataclasses import replace
from datetime import date, timedelta

import pytest
from stations import ANNA

from insole_core.errors import Conflict, InputError, RecordsError
from insole_core.records.merging import MergePreview, NamedMerge
from insole_core.records.person import Person, PersonSummary
from insole_core.records.person_matching import Likeness, find_duplicates, summary_of
from insole_core.records.records import Records
from insole_core.records.visit import FollowUp, Visit

TODAY = date.today()


def names(records: Records, typed: str) -> list[str]:
    return [person.name for person in records.persons.search(typed)]


def test_a_person_is_read_as_it_was_added(records: Records) -> None:
    person = Person(
        "  Åsa Ångström ",
        date(1970, 2, 28),
        "19811228-9874",
        "se",
        contact="Storgatan 1\n08-123",
        notes="allergic to nickel",
        consent_on=TODAY,
    )
    added = records.persons.add(person)
    assert added.name == "Åsa Ångström"
    assert added.revision == 1
    assert records.persons.get(added.id) == added


@pytest.mark.parametrize(
    "name",
    ["李小龍", "محمد علي", "Ольга Иванова", "'; DROP TABLE persons; --", "a%b_c\\d", "O’Brien"],
)
def test_names_of_any_script_are_kept_and_found(records: Records, name: str) -> None:
    records.persons.add(Person("Somebody Else"))
    records.persons.add(Person(name))
    assert names(records, name) == [name]
    assert len(names(records, "")) == 2


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("", "missing"),
        ("   ", "missing"),
        ("x" * 10_000, "10000 characters, and may have 200"),
        ("Anna\x00", "cannot be seen"),
        ("Anna\nBerg", "cannot be seen"),
        ("Anna \u202egreB", "U\\+202E"),
        ("Anna \ud800", "cannot be seen"),
    ],
)
def test_what_is_no_name_is_refused(records: Records, name: str, reason: str) -> None:
    with pytest.raises(InputError, match=reason):
        records.persons.add(Person(name))
    assert names(records, "") == []


def test_a_pseudonym_fits_on_a_label(records: Records) -> None:
    assert records.persons.add(Person("Anna", pseudonym="K" * 60)).pseudonym == "K" * 60
    with pytest.raises(InputError, match="The pseudonym has 61 characters, and may have 60"):
        records.persons.add(Person("Ben", pseudonym="K" * 61))


@pytest.mark.parametrize("born", [date(1899, 12, 31), TODAY + timedelta(days=1)])
def test_an_impossible_birth_date_is_refused(records: Records, born: date) -> None:
    with pytest.raises(InputError, match="birth date"):
        records.persons.add(Person("Anna Berg", born))


def test_search_goes_by_words_of_all_that_is_known(records: Records) -> None:
    person = records.persons.add(
        Person("Åsa Maria Ångström", date(1970, 2, 8), "19811228-9874", "se")
    )
    records.persons.add(Person("Asaro Bengtsson", date(1971, 3, 9)))
    for typed in (
        "asa ang",
        "ÅNGSTRÖM åsa",
        "1970-02-08",
        "19700208",
        "08.02.1970",
        "08/02/1970",
        "811228-98",
        "198112289874",
        "8.2.1970",
        "700208",
        "8112289874",
        "-9874",
        person.pseudonym.lower(),
        person.pseudonym.removeprefix("P-"),
    ):
        assert names(records, typed) == ["Åsa Maria Ångström"], typed
    assert names(records, "asa bengt") == ["Asaro Bengtsson"]
    assert names(records, "asa xyz") == []
    assert names(records, "strom") == []


@pytest.mark.parametrize(
    ("name", "typed"),
    [
        ("Lena Berg-Lund", "lund"),
        ("Lena Berg-Lund", "berg-l"),
        ("Lena Berg-Lund", "berg, lena"),
        ("Lind, Lena", "lena lind"),
        ("O’Brien", "o'br"),
        ("O’Brien", "brien"),
        ("李小龍", "小龍"),
        ("العلي", "علي"),
        ("x" * 200, "x" * 200),
    ],
)
def test_a_name_is_found_by_each_beginning(records: Records, name: str, typed: str) -> None:
    records.persons.add(Person(name))
    assert names(records, typed) == [name]


def test_numbers_in_parts_are_found_by_each_part(records: Records) -> None:
    records.persons.add(Person("Anna", None, "AB 943-476 5919"))
    for typed in ("ab 943", "476 5919", "ab9434765919", "943-476"):
        assert names(records, typed) == ["Anna"], typed


def test_what_many_have_is_found_in_order(
    records: Records, monkeypatch: pytest.MonkeyPatch
) -> None:
    people = (
        ("Maria Ek", 1970), ("Ali Maria", 1971), ("Maria Al", 1971), ("Eva Mar", 1971),
    )  # fmt: skip
    for name, year in people:
        records.persons.add(Person(name, date(year, 2, 3)))
    expected = {
        "mar": ["Maria Al", "Maria Ek", "Ali Maria", "Eva Mar"],
        "mar 1971": ["Maria Al", "Ali Maria", "Eva Mar"],
        "1971 mar": ["Ali Maria", "Eva Mar", "Maria Al"],
    }
    for few, many in ((500, 2000), (1, 2000), (1, 1)):
        monkeypatch.setattr("insole_core.records.persons._FEW", few)
        monkeypatch.setattr("insole_core.records.persons._MANY", many)
        assert {typed: names(records, typed) for typed in expected} == expected
    assert [p.name for p in records.persons.search("mar", limit=3)] == expected["mar"][:3]


def test_who_begins_with_what_was_typed_comes_first(records: Records) -> None:
    for name in ("Maria Bergman", "Isberg Nils", "Bergman Ola"):
        records.persons.add(Person(name))
    assert names(records, "berg") == ["Bergman Ola", "Maria Bergman"]


def test_not_more_are_found_than_asked_for(records: Records) -> None:
    for number in range(4):
        records.persons.add(Person(f"Anna {number}"))
    assert [p.name for p in records.persons.search("anna", limit=2)] == ["Anna 0", "Anna 1"]


def test_recent_are_those_worked_on_last(records: Records) -> None:
    first, second, third = (records.persons.add(Person(name)) for name in "ABC")
    records.visits.add(Visit(first.id, TODAY))
    records.persons.open(second.id)
    assert [p.name for p in records.persons.recent()] == ["B", "A", "C"]
    assert records.persons.recent()[1].last_visit == TODAY
    assert third.id == records.persons.recent()[2].id


def test_a_change_is_found_and_told(records: Records) -> None:
    person = records.persons.add(Person("Anna Berg"))
    changed = records.persons.change(replace(person, name="Anna Lind"), person.revision)
    assert (changed.name, changed.revision) == ("Anna Lind", 2)
    assert names(records, "lind") == ["Anna Lind"]
    assert names(records, "berg") == []
    line = records.audit.lines(subject_id=person.id)[0]
    assert (line.action, line.author) == ("changed", "anna")
    assert json.loads(line.details)["fields"] == "name"


def test_what_is_unchanged_is_not_written(records: Records) -> None:
    person = records.persons.add(Person("Anna Berg"))
    mark = records.mark()
    assert records.persons.change(person, person.revision) == person
    assert records.mark() == mark


def test_who_saves_second_sees_both(records: Records) -> None:
    person = records.persons.add(Person("Anna Berg"))
    records.persons.change(replace(person, contact="08-123"), person.revision)
    mine = replace(person, contact="031-456")
    with pytest.raises(Conflict) as caught:
        records.persons.change(mine, person.revision)
    assert caught.value.mine == mine
    assert caught.value.theirs.contact == "08-123"
    assert records.persons.get(person.id).contact == "08-123"
    theirs = caught.value.theirs
    assert records.persons.change(mine, theirs.revision).contact == "031-456"


def test_looking_at_a_person_is_in_the_log(records: Records) -> None:
    person = records.persons.add(Person("Anna Berg"))
    records.persons.open(person.id)
    line = records.audit.lines(subject_id=person.id)[0]
    assert (line.action, line.author, line.station) == ("seen", ANNA.name, ANNA.station)


def test_a_person_who_is_not_there_is_told(records: Records) -> None:
    with pytest.raises(RecordsError, match="no longer in the record"):
        records.persons.get("nobody")


def test_a_pseudonym_is_of_one_person(records: Records) -> None:
    records.persons.add(Person("Anna", pseudonym="K-1"))
    with pytest.raises(InputError, match="K-1"):
        records.persons.add(Person("Ben", pseudonym="K-1"))
    drawn = records.persons.add(Person("Carl"))
    again = records.persons.add(Person("Dora", pseudonym=drawn.pseudonym))
    assert again.pseudonym != drawn.pseudonym


def test_a_personal_number_finds_its_person(records: Records) -> None:
    person = records.persons.add(Person("Anna", None, "811228-9874", "se"))
    assert person.personal_number == "19811228-9874"
    assert [p.id for p in records.persons.with_number("19811228-9874")] == [person.id]


def merged_pair(records: Records) -> tuple[Person, Person]:
    """Return two persons, each with a visit and a follow-up."""
    kept = records.persons.add(Person("Anna Berg", contact="08-123"))
    other = records.persons.add(Person("Anna Bergh", date(1970, 2, 28), contact="031-456"))
    for person in (kept, other):
        visit = records.visits.add(Visit(person.id, TODAY, reason=person.name))
        records.follow_ups.add(FollowUp(person.id, TODAY, "better", visit_id=visit.id))
    return kept, other


def test_a_merge_moves_everything(records: Records) -> None:
    kept, other = merged_pair(records)
    records.persons.merge(kept.id, other.id)
    assert names(records, "anna") == ["Anna Berg"]
    assert len(records.visits.of_person(kept.id)) == 2
    assert len(records.follow_ups.of_person(kept.id)) == 2
    person = records.persons.get(other.id)
    assert person.id == kept.id
    assert (person.birth_date, person.contact) == (date(1970, 2, 28), "08-123")
    assert names(records, "1970-02-28") == ["Anna Berg"]


def test_a_merge_is_undone(records: Records) -> None:
    kept, other = merged_pair(records)
    merge = records.persons.merge(kept.id, other.id)
    later = records.visits.add(Visit(kept.id, TODAY, reason="later"))
    assert [named.merge for named in records.persons.latest_merges()] == [merge]
    records.persons.undo_merge(merge)
    assert {v.reason for v in records.visits.of_person(kept.id)} == {"Anna Berg", later.reason}
    assert {v.reason for v in records.visits.of_person(other.id)} == {"Anna Bergh"}
    assert records.persons.get(kept.id).birth_date is None
    assert records.persons.get(other.id).birth_date == date(1970, 2, 28)
    assert sorted(names(records, "anna")) == ["Anna Berg", "Anna Bergh"]
    assert records.persons.latest_merges() == []
    with pytest.raises(RecordsError, match="undone already"):
        records.persons.undo_merge(merge)


def test_merges_are_undone_in_their_order(records: Records) -> None:
    kept, other = merged_pair(records)
    third = records.persons.add(Person("Carl"))
    first = records.persons.merge(kept.id, other.id)
    second = records.persons.merge(third.id, kept.id)
    assert records.persons.get(other.id).id == third.id
    with pytest.raises(RecordsError, match="later merge first"):
        records.persons.undo_merge(first)
    records.persons.undo_merge(second)
    records.persons.undo_merge(first)
    assert [v.reason for v in records.visits.of_person(other.id)] == ["Anna Bergh"]


def test_a_merged_person_takes_nothing_more(records: Records) -> None:
    kept, other = merged_pair(records)
    records.persons.merge(kept.id, other.id)
    with pytest.raises(RecordsError, match="merged"):
        records.visits.add(Visit(other.id, TODAY))
    with pytest.raises(RecordsError, match="merged"):
        records.persons.merge(kept.id, other.id)
    with pytest.raises(RecordsError, match="same person twice"):
        records.persons.merge(kept.id, kept.id)


def test_a_merge_is_told_before_it_is_done_and_named_until_it_is_undone(records: Records) -> None:
    kept = records.persons.add(Person("Anna Berg", date(1970, 2, 28)))
    other = records.persons.add(Person("Anna Berg", contact="Storgatan 1"))
    visit = records.visits.add(Visit(other.id, TODAY))
    records.follow_ups.add(FollowUp(other.id, TODAY, "better", visit_id=visit.id))
    preview = records.persons.preview_merge(kept.id, other.id)
    assert preview == MergePreview(visits=1, orders=0, follow_ups=1, filled=("contact",))
    assert records.visits.of_person(kept.id) == []
    merge = records.persons.merge(kept.id, other.id)
    (named,) = records.persons.latest_merges()
    assert named == NamedMerge(merge, summary_of(kept), summary_of(other))
    records.persons.undo_merge(named.merge)
    assert records.persons.latest_merges() == []
    assert len(records.visits.of_person(other.id)) == 1


def test_duplicates_are_proposed_by_number_and_by_name_with_birth_date(records: Records) -> None:
    born = date(1970, 2, 28)
    first = records.persons.add(Person("Åsa Berg", born, "1234", ""))
    last = records.persons.add(Person("Asa Lund", None, "1234", ""))
    records.visits.add(Visit(last.id, TODAY))
    third = records.persons.add(Person("BERG, ASA", born))
    records.persons.add(Person("Åsa Berg", date(1971, 2, 28)))
    records.persons.add(Person("Åsa Berg"))
    records.persons.add(Person("Ben Ek", born))
    found = find_duplicates(records.persons.alike())
    assert len(records.persons.alike()) == 3
    pairs = [({d.kept.id, d.other.id}, d.likeness) for d in found]
    assert pairs == [
        ({first.id, last.id}, Likeness.NUMBER),
        ({first.id, third.id}, Likeness.NAME),
    ]
    assert found[0].kept.id == last.id  # who was seen last


def test_nobody_is_a_duplicate_twice_or_of_themselves() -> None:
    born = date(1970, 2, 28)
    both = [PersonSummary(str(i), "Anna Berg", born, "7", f"P-{i}") for i in range(3)]
    found = find_duplicates(both)
    assert len(found) == 2
    assert all(d.kept.id != d.other.id for d in found)
