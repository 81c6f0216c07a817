"""Dates of a patient's record are days that the calendar has."""

from __future__ import annotations

from datetime import date
from pathlib import Path

import pytest

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import CaseRecord, Patient
from insole_core.cases.days import doubtful_days, read_day
from insole_core.errors import InputError

TODAY = date(2026, 11, 22)


@pytest.mark.parametrize(
    ("typed", "day"),
    [
        ("1970-02-28", "1970-02-28"),
        (" 1970-2-8 ", "1970-02-08"),
        ("1970/02/28", "1970-02-28"),
        ("1970 2 28", "1970-02-28"),
        ("19700228", "1970-02-28"),
        ("2024-02-29", "2024-02-29"),
        ("24.12.1970", "1970-12-24"),
        ("3.4.1970", "1970-04-03"),
        ("24/12/1970", "1970-12-24"),
        ("24-12-1970", "1970-12-24"),
        ("24 december 1970", "1970-12-24"),
        ("", ""),
        ("700228", "1970-02-28"),
        ("70-02-28", "1970-02-28"),
        ("28.02.70", "1970-02-28"),
        ("03.04.70", "1970-04-03"),
        ("320101", "1932-01-01"),
        ("000229", "2000-02-29"),
        ("990101", "1999-01-01"),
    ],
)
def test_days_are_stored_as_iso_8601(typed: str, day: str) -> None:
    assert read_day("born", typed, TODAY) == day


@pytest.mark.parametrize(
    "typed", ["1970-02-30", "1970-13-01", "2023-02-29", "30.2.1970", "1970", "soon", "1970-2/28"]
)
def test_what_is_no_day_is_refused_with_an_example(typed: str) -> None:
    with pytest.raises(InputError, match=r"is no date; write .* such as 1970-02-28"):
        read_day("born", typed, TODAY)


def test_a_day_of_two_readings_is_asked_for():
    with pytest.raises(InputError, match="can be 1970-03-04 or 1970-04-03; write the one"):
        read_day("born", "03/04/1970", TODAY)


@pytest.mark.parametrize(
    ("typed", "days"),
    [
        # a child, or somebody of over a hundred years; also as other countries write it
        ("130228", "2013-02-28, 1913-02-28, 1928-02-13"),
        ("300612", "1930-06-12, 2012-06-30, 1912-06-30"),
        ("03-04-70", "1970-04-03 or 1970-03-04"),
        ("12.03.15", "2015-03-12 or 1915-03-12"),  # the day is first where there are dots
        ("261122", "2026-11-22, 1926-11-22, 2022-11-26, 1922-11-26"),  # born today
        ("261123", "1926-11-23, 2023-11-26, 1923-11-26"),
        ("03-04-05", "2003-04-05, 1903-04-05, 2005-04-03, 1905-04-03, 2005-03-04, 1905-03-04"),
    ],
)
def test_a_year_of_two_digits_is_asked_for_where_several_days_are_possible(
    typed: str, days: str
) -> None:
    with pytest.raises(InputError, match=f"{typed} can be {days}; write the one"):
        read_day("born", typed, TODAY)


@pytest.mark.parametrize("typed", ["70.02.28", "702830", "70022", "7002281", "70-0228"])
def test_two_digits_of_a_year_and_no_day_of_the_calendar_are_no_birth_date(typed: str) -> None:
    with pytest.raises(InputError, match=r"is no date; write .* such as 1970-02-28"):
        read_day("born", typed, TODAY)


def test_a_visit_has_its_whole_year() -> None:
    """A planned visit of 2030 would else be one of 1930."""
    for typed in ("300101", "261128"):
        with pytest.raises(InputError, match="is no date"):
            read_day("visit", typed, TODAY)


@pytest.mark.parametrize(
    ("key", "typed"),
    [("born", "2026-11-23"), ("born", "1879-03-14"), ("visit", "2206-11-22")],
)
def test_days_that_cannot_be_meant_are_refused(key: str, typed: str) -> None:
    with pytest.raises(InputError, match="check the year"):
        read_day(key, typed, TODAY)
    assert read_day("visit", "2026-12-01", TODAY) == "2026-12-01"


def test_a_case_with_a_nonsense_birth_date_opens_and_says_so(tmp_path: Path) -> None:
    patient = Patient("Anna Berg", "1970-02-30", "2026-11-20")
    write_case(CaseRecord(patient), tmp_path / "a.insole")
    read = read_case(tmp_path / "a.insole").patient
    assert read == patient
    assert doubtful_days(read, TODAY) == (
        "The birth date cannot be right: 1970-02-30 is no date; write year, month and day, such as "
        "1970-02-28."
    )
    assert doubtful_days(Patient("Anna", "1970-02-28", ""), TODAY) == ""


def test_the_order_number_is_kept_in_the_case(tmp_path: Path) -> None:
    write_case(CaseRecord(Patient("Anna", pseudonym="26-7KQ4M")), tmp_path / "a.insole")
    assert read_case(tmp_path / "a.insole").patient.pseudonym == "26-7KQ4M"
