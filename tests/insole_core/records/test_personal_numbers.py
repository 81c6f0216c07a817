"""Swedish personal numbers, by examples of Skatteverket."""

from __future__ import annotations

from datetime import date

import pytest

from insole_core.errors import InputError
from insole_core.records import personal_numbers
from insole_core.records.personal_numbers import (
    KINDS,
    check_personal_number,
    check_swedish,
    swedish_birth_date,
)


@pytest.mark.parametrize(
    ("typed", "stored"),
    [
        ("19811228-9874", "19811228-9874"),
        ("198112289874", "19811228-9874"),
        ("811228-9874", "19811228-9874"),
        ("8112289874", "19811228-9874"),
        (" 811228 - 9874 ", "19811228-9874"),
        ("811228+9874", "18811228-9874"),
        ("701063-2391", "19701063-2391"),  # samordningsnummer: the day and 60
    ],
)
def test_every_usual_writing_is_understood(typed: str, stored: str) -> None:
    assert check_swedish(typed) == stored


@pytest.mark.parametrize(
    ("typed", "reason"),
    [
        ("811228-9873", "last digit"),
        ("811228-987", "write it as"),
        ("8112289874x", "write it as"),
        ("٨١١٢٢٨-٩٨٧٤", "write it as"),
        ("811328-9873", "calendar"),
        ("20990101-0000", "future"),
    ],
)
def test_what_is_no_number_is_refused(typed: str, reason: str) -> None:
    with pytest.raises(InputError, match=reason):
        check_swedish(typed)


def test_ten_digits_are_of_somebody_under_a_hundred(monkeypatch: pytest.MonkeyPatch) -> None:
    class Today(date):
        @classmethod
        def today(cls) -> date:
            return date(2026, 11, 22)

    monkeypatch.setattr(personal_numbers, "date", Today)
    assert check_swedish("261121-0002") == "20261121-0002"
    assert check_swedish("261231-0009") == "19261231-0009"


def test_a_number_holds_the_birth_date() -> None:
    assert swedish_birth_date("19811228-9874") == date(1981, 12, 28)
    assert swedish_birth_date("19701063-2391") == date(1970, 10, 3)
    assert KINDS[""].birth_date("x") is None


def test_numbers_of_other_countries_are_kept_as_they_are() -> None:
    assert check_personal_number(" 010170-123X ", "") == "010170-123X"
    assert check_personal_number("", "se") == ""
    with pytest.raises(InputError, match="no kind"):
        check_personal_number("1", "xx")
    with pytest.raises(InputError, match="may have 40"):
        check_personal_number("1" * 41, "")
