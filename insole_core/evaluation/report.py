"""A report of calibrations and evaluations, as one HTML, one PDF, and the numbers as JSON."""

from __future__ import annotations

import base64
import html
import io
import json
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.figure import Figure

from insole_core.export.atomic import replacing_file

_A4_IN = (8.27, 11.69)
_PLOT_IN = (7.2, 4.4)
_ROWS_A_PAGE = 42
_PLOTS_A_PAGE = 3
_STYLE = (
    "body{font-family:sans-serif;max-width:60em;margin:2em auto;color:#222}"
    "table{border-collapse:collapse;margin:1em 0}td,th{border:1px solid #bbb;padding:.25em .7em;"
    "text-align:left}.failed{color:#b00020;font-weight:bold}.passed{color:#00692b}img{max-width:100%}"
)


@dataclass(frozen=True)
class Number:
    """One measured number and, where it is judged, its limit.

    Parameters
    ----------
    key
        In the JSON.
    label
        For people.
    value
    unit
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
        """Whether it keeps its limit; nothing when there is none."""
        return None if self.limit is None else bool(abs(self.value) <= self.limit)

    @property
    def text(self) -> str:
        """The number with its unit."""
        return f"{self.value:.4g} {self.unit}".strip()

    @property
    def verdict(self) -> str:
        """The judgement in words; empty without a limit."""
        if self.limit is None:
            return ""
        return f"{'passed' if self.passed else 'failed'} (limit {self.limit:g} {self.unit})".strip()


@dataclass(frozen=True)
class Table:
    """Rows of texts under headings."""

    title: str
    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Plot:
    """A picture that is drawn when the report is written."""

    title: str
    draw: Callable[[Figure], None]


@dataclass(frozen=True)
class Section:
    """One calibration or evaluation."""

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
    title
    serial
        Of the device.
    made_at
        ISO 8601.
    sections
    """

    title: str
    serial: str
    made_at: str
    sections: tuple[Section, ...] = field(default_factory=tuple)

    @property
    def failed(self) -> tuple[Number, ...]:
        """The numbers that exceed their limits."""
        return tuple(n for s in self.sections for n in s.numbers if n.passed is False)

    @property
    def passed(self) -> bool:
        """Whether every judged number keeps its limit."""
        return not self.failed


def with_limits(section: Section, limits: dict[str, float]) -> Section:
    """Give a section whose numbers are judged by limits, number key to largest absolute value."""
    numbers = tuple(
        Number(n.key, n.label, n.value, n.unit, limits.get(n.key, n.limit)) for n in section.numbers
    )
    return Section(
        section.key, section.title, numbers, section.sentences, section.tables, section.plots
    )


def report_json(report: Report) -> dict[str, Any]:
    """Give the numbers of a report; what is not finite is null."""
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


def write_json(report: Report, path: Path) -> None:
    """Write the numbers.

    Raises
    ------
    OutputError
    """
    with replacing_file(path) as beside:
        text = json.dumps(report_json(report), indent=1, ensure_ascii=False)
        beside.write_text(text + "\n", encoding="utf-8")


def write_html(report: Report, path: Path) -> None:
    """Write one page that holds everything, pictures included.

    Raises
    ------
    OutputError
    """
    body = "".join(_section_html(section) for section in report.sections)
    page = (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8">'
        f"<title>{html.escape(report.title)}</title><style>{_STYLE}</style></head><body>"
        f"<h1>{html.escape(report.title)}</h1><p>{html.escape(_head(report))}</p>{body}"
        "</body></html>\n"
    )
    with replacing_file(path) as beside:
        beside.write_text(page, encoding="utf-8")


def write_pdf(report: Report, path: Path) -> None:
    """Write the report for print, A4.

    Raises
    ------
    OutputError
    """
    with replacing_file(path) as beside, PdfPages(beside) as pages:
        head = [report.title, _head(report), ""]
        for section in report.sections:
            own = section_lines(section)
            # A report of one section bears its title.
            _text_pages(pages, [*head, *(own[1:] if section.title == report.title else own)])
            _plot_pages(pages, section.plots)
            head = []


WRITERS: dict[str, Callable[[Report, Path], None]] = {
    ".html": write_html,
    ".pdf": write_pdf,
    ".json": write_json,
}
"""How a report is written, by the suffix of its file."""


def _head(report: Report) -> str:
    verdict = ""
    if any(n.limit is not None for s in report.sections for n in s.numbers):
        names = ", ".join(number.label for number in report.failed)
        verdict = "All limits are kept." if report.passed else f"Limits exceeded: {names}."
    return f"Sensor {report.serial or 'unknown'}, {report.made_at}. {verdict}".strip()


def _json_number(number: Number) -> dict[str, Any]:
    value = number.value if math.isfinite(number.value) else None
    judged = {} if number.limit is None else {"limit": number.limit, "passed": number.passed}
    return {"value": value, "unit": number.unit, **judged}


def _section_html(section: Section) -> str:
    rows = "".join(
        f"<tr><td>{html.escape(n.label)}</td><td>{html.escape(n.text)}</td>"
        f'<td class="{"failed" if n.passed is False else "passed"}">'
        f"{html.escape(n.verdict)}</td></tr>"
        for n in section.numbers
    )
    remarks = "".join(f"<p>{html.escape(sentence)}</p>" for sentence in section.sentences)
    tables = "".join(_table_html(table) for table in section.tables)
    plots = "".join(
        f'<h3>{html.escape(plot.title)}</h3><img alt="{html.escape(plot.title)}" '
        f'src="data:image/png;base64,{base64.b64encode(plot_png(plot)).decode()}">'
        for plot in section.plots
    )
    return f"<h2>{html.escape(section.title)}</h2>{remarks}<table>{rows}</table>{tables}{plots}"


def _table_html(table: Table) -> str:
    head = "".join(f"<th>{html.escape(heading)}</th>" for heading in table.headings)
    rows = "".join(
        f"<tr>{''.join(f'<td>{html.escape(cell)}</td>' for cell in row)}</tr>" for row in table.rows
    )
    return f"<h3>{html.escape(table.title)}</h3><table><tr>{head}</tr>{rows}</table>"


def plot_png(plot: Plot) -> bytes:
    """Draw a plot as PNG."""
    stream = io.BytesIO()
    figure = _drawn(plot)
    FigureCanvasAgg(figure)
    figure.savefig(stream, format="png")
    return stream.getvalue()


def _drawn(plot: Plot) -> Figure:
    figure = Figure(figsize=_PLOT_IN, layout="constrained")
    plot.draw(figure)
    figure.suptitle(plot.title)
    return figure


def section_lines(section: Section) -> list[str]:
    """Give what a section says as lines of text, for paper and terminal."""
    lines = [section.title, *section.sentences]
    lines += [f"{n.label}: {n.text}   {n.verdict}".rstrip() for n in section.numbers]
    for table in section.tables:
        widths = [
            max(len(row[i]) for row in (table.headings, *table.rows))
            for i in range(len(table.headings))
        ]
        lines += ["", table.title]
        lines += [
            "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True))
            for row in (table.headings, *table.rows)
        ]
    return lines


def _plot_pages(pages: PdfPages, plots: Sequence[Plot]) -> None:
    for start in range(0, len(plots), _PLOTS_A_PAGE):
        page = Figure(figsize=_A4_IN, layout="constrained")
        places = page.subfigures(_PLOTS_A_PAGE, 1, squeeze=False).ravel()
        for plot, place in zip(plots[start : start + _PLOTS_A_PAGE], places, strict=False):
            plot.draw(place)
            place.suptitle(plot.title)
        pages.savefig(page)  # type: ignore[no-untyped-call]


def _text_pages(pages: PdfPages, lines: Sequence[str]) -> None:
    for start in range(0, len(lines), _ROWS_A_PAGE):
        page = Figure(figsize=_A4_IN)
        part = lines[start : start + _ROWS_A_PAGE]
        for row, line in enumerate(part):
            title = start == 0 and row == 0
            page.text(
                0.08,
                0.94 - row * 0.021,
                line,
                fontsize=13 if title else 8,
                family="sans-serif" if title else "monospace",
                wrap=True,
            )
        pages.savefig(page)  # type: ignore[no-untyped-call]
