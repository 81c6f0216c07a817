"""Dates as other programs write them; day and month are never guessed."""

from __future__ import annotations

from datetime import date

import pytest

from insole_core.cases.written_dates import (
    AmbiguousDate,
    DateOrder,
    needs_order,
    order_of,
    read_date,
)
from insole_core.errors import InputError

_DAY = date(1970, 2, 3)


@pytest.mark.parametrize(
    "text",
    [
        "1970-02-03", "1970/2/3", "1970.02.03", "19700203", "3.2.1970", "03.02.1970",
        "3 Feb 1970", "3. Februar 1970", "3 februari 1970", "February 3, 1970", "feb 3 1970",
        "1970-02-03 00:00:00", "1970-02-03T00:00:00.000Z", " 1970-02-03 ", "03-Feb-1970",
    ],
)  # fmt: skip
def test_usual_writings_are_read_without_an_order(text):
    assert read_date(text, None) == _DAY


@pytest.mark.parametrize("text", ["02/03/1970", "2-3-1970", "2 3 1970"])
def test_an_ambiguous_date_is_asked_for_and_read_in_the_order_that_is_said(text):
    with pytest.raises(AmbiguousDate, match=r"1970-02-03 or 1970-03-02"):
        read_date(text, None)
    assert read_date(text, DateOrder.MONTH_FIRST) == _DAY
    assert read_date(text, DateOrder.DAY_FIRST) == date(1970, 3, 2)


@pytest.mark.parametrize(
    "text",
    [
        "1970-02-30", "30/02/1970", "31.04.1970", "1970-13-01", "70-02-03", "03/02/70", "25601",
        "Anna", "3 Foo 1970", "0000-00-00", "1970-02-03 14:20", "12/31/1970/1", "٣/٢/١٩٧٠x",
    ],
)  # fmt: skip
def test_what_is_no_day_of_the_calendar_is_refused(text):
    for order in (None, *DateOrder):
        with pytest.raises(InputError, match="is no date"):
            read_date(text, order)


def test_an_order_that_a_date_cannot_have_is_refused():
    with pytest.raises(InputError, match="is no date"):
        read_date("12/31/1970", DateOrder.DAY_FIRST)


def test_one_date_of_a_column_can_tell_the_order_of_all():
    assert order_of(["02/03/1970", "31/01/1970", "1970-02-03"]) is DateOrder.DAY_FIRST
    assert order_of(["02/03/1970", "01/31/1970"]) is DateOrder.MONTH_FIRST
    assert order_of(["02/03/1970", "1970-02-03"]) is None
    assert order_of(["31/01/1970", "01/31/1970"]) is None


def test_only_dates_with_two_readings_need_an_order():
    assert needs_order(["31/01/1970", "02/03/1970"])
    assert not needs_order(["31/01/1970", "1970-02-03", "03/03/1970", "nonsense"])
