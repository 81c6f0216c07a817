"""Contents of a report on calibrations and evaluations, and the limits that it is judged by."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from insole_core.errors import InputError
from insole_core.json_object import JsonObject
from insole_core.memo import Memo
from insole_core.resources import resource_path

Limits = dict[str, dict[str, float]]
"""Largest absolute value by section key and number key."""


@dataclass(frozen=True)
class Number:
    """One measured number and, if it is judged, its limit.

    Parameters
    ----------
    key
        In the JSON.
    label
        For display.
    limit
        The largest absolute value that passes.
    """

    key: str
    label: str
    value: float
    unit: str = ""
    limit: float | None = None

    @property
    def passed(self) -> bool | None:
        """Whether the value keeps its limit; None without one."""
        return None if self.limit is None else bool(abs(self.value) <= self.limit)

    @property
    def text(self) -> str:
        """The number with its unit."""
        return self.said(self.value)

    @property
    def verdict(self) -> str:
        """The judgement in words; empty without a limit."""
        if self.limit is None:
            return ""
        return f"{'passed' if self.passed else 'failed'} (limit {self.said(self.limit)})"

    def said(self, value: float) -> str:
        """Format a value of this number with its unit."""
        space = "" if self.unit == "°" else " "
        return f"{value:.4g}{space}{self.unit}".strip()


@dataclass(frozen=True)
class Share(Number):
    """A share, displayed in percent."""

    def said(self, value: float) -> str:
        """Format a share in percent."""
        return f"{100 * value:.3g} %"


@dataclass(frozen=True)
class Table:
    """Rows of text under headings.

    Parameters
    ----------
    title
        For display, and the table's key in the JSON.
    headings
        For display, and the keys of a row in the JSON.
    unit
        Of the entries, for display.
    """

    title: str
    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    unit: str = ""

    @property
    def caption(self) -> str:
        """The title with its unit."""
        return f"{self.title}, {self.unit}" if self.unit else self.title

    @property
    def numeric(self) -> tuple[bool, ...]:
        """Which columns hold numbers only, to be aligned right."""
        columns = zip(*self.rows, strict=True) if self.rows else ((),) * len(self.headings)
        return tuple(bool(column) and all(map(_is_number, column)) for column in columns)


@dataclass(frozen=True)
class Plot:
    """A picture that is drawn when the report is written.

    Parameters
    ----------
    drawn
        The picture, once a file has needed it: each form of a report shows the same.
    """

    title: str
    draw: Callable[[Figure], None]
    drawn: Memo = field(default_factory=lambda: Memo(1), init=False, repr=False, compare=False)


@dataclass(frozen=True)
class ReportSection:
    """The report on one calibration or evaluation."""

    key: str
    title: str
    numbers: tuple[Number, ...] = ()
    sentences: tuple[str, ...] = ()
    tables: tuple[Table, ...] = ()
    plots: tuple[Plot, ...] = ()


@dataclass(frozen=True)
class Report:
    """All sections about one device.

    Parameters
    ----------
    serial
        Of the device; empty if there is none, or it is unknown.
    made_at
        ISO 8601.
    language
        Of its texts, such as "en".
    page_word
        Before the number of a page, in that language.
    """

    title: str
    serial: str
    made_at: str
    sections: tuple[ReportSection, ...] = field(default_factory=tuple)
    language: str = "en"
    page_word: str = "page"

    @property
    def failed(self) -> tuple[Number, ...]:
        """The numbers that exceed their limits."""
        return tuple(n for s in self.sections for n in s.numbers if n.passed is False)

    @property
    def passed(self) -> bool:
        """Whether every judged number keeps its limit."""
        return not self.failed


def with_limits(section: ReportSection, limits: dict[str, float]) -> ReportSection:
    """Return a section with limits for its numbers.

    Parameters
    ----------
    limits
        Largest absolute value by number key; other numbers keep their limits.
    """
    numbers = tuple(replace(n, limit=limits.get(n.key, n.limit)) for n in section.numbers)
    return replace(section, numbers=numbers)


def report_json(report: Report) -> dict[str, Any]:
    """Return the numbers of a report for `json.dump`; values that are not finite become None."""
    return {
        "title": report.title,
        "serial": report.serial,
        "made_at": report.made_at,
        "passed": report.passed,
        "sections": {
            section.key: {
                "numbers": {n.key: _json_number(n) for n in section.numbers},
                "remarks": list(section.sentences),
                "tables": {
                    t.title: [dict(zip(t.headings, row, strict=True)) for row in t.rows]
                    for t in section.tables
                },
            }
            for section in report.sections
        },
    }


def head_line(report: Report) -> str:
    """Return a line with sensor, date, and whether the limits are kept."""
    verdict = ""
    if any(n.limit is not None for s in report.sections for n in s.numbers):
        names = ", ".join(number.label for number in report.failed)
        verdict = "All limits are kept." if report.passed else f"Limits exceeded: {names}."
    sensor = f"Sensor {report.serial}, " if report.serial else ""
    return f"{sensor}{_day_and_time(report.made_at)}. {verdict}".strip()


def numbers_table(section: ReportSection) -> Table:
    """Return the numbers of a section and their verdicts as a table."""
    rows = tuple((n.label, n.text, n.verdict) for n in section.numbers)
    return Table("", ("", "", ""), rows)


def _is_number(text: str) -> bool:
    return re.fullmatch(r"[-+−]?[\d.]+(e[-+]?\d+)? ?[%°]?|[–—-]?|nan|inf", text.strip()) is not None


def _day_and_time(made_at: str) -> str:
    """Format an ISO time such as 2026-11-21T15:54:12+00:00 for display, to the minute."""
    try:
        return datetime.fromisoformat(made_at).astimezone(UTC).strftime("%Y-%m-%d %H:%M UTC")
    except ValueError:
        return made_at


def _json_number(number: Number) -> dict[str, Any]:
    value = number.value if math.isfinite(number.value) else None
    judged = {} if number.limit is None else {"limit": number.limit, "passed": number.passed}
    return {"value": value, "unit": number.unit, **judged}


def section_lines(section: ReportSection) -> list[str]:
    """Return a section as lines of text, for print and terminal."""
    lines = [section.title, *section.sentences]
    lines += [f"{n.label}: {n.text}   {n.verdict}".rstrip() for n in section.numbers]
    for table in section.tables:
        widths = [
            max(len(row[i]) for row in (table.headings, *table.rows))
            for i in range(len(table.headings))
        ]
        lines += ["", table.caption]
        lines += [
            "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True))
            for row in (table.headings, *table.rows)
        ]
    return lines


def bundled_limits_path() -> Path:
    """Return the path of the limits shipped with the product."""
    return resource_path("limits/kinect-v1.json")


def load_limits(path: Path) -> Limits:
    """Read a file of limits.

    Raises
    ------
    InputError
        Naming the file and the key of the first violation.
    """
    sections = JsonObject.read(path).object("limits")
    return {
        key: {name: item.number(name, 0) for name in item.values}
        for key in sections.values
        for item in [sections.object(key)]
    }


def judged(section: ReportSection, limits: Limits) -> ReportSection:
    """Return a section judged by its limits.

    Parameters
    ----------
    limits
        May hold limits of other sections too.

    Raises
    ------
    InputError
        If a limit refers to a number that the section lacks: it could not be checked.
    """
    named = limits.get(section.key, {})
    missing = named.keys() - {number.key for number in section.numbers}
    if missing:
        known = ", ".join(number.key for number in section.numbers)
        raise InputError(
            'The limit "{key}" has no number to judge in this evaluation; take it out, or use one '
            "of {known}.",
            key=min(missing),
            known=known,
        )
    return with_limits(section, named)
