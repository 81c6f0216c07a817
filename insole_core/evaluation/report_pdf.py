"""A report as PDF for print, A4."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType

from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from insole_core.evaluation.report import Plot, Report, Table, head_line, numbers_table
from insole_core.export.atomic import replacing_file

_A4_IN = (8.27, 11.69)
_LEFT, _RIGHT, _TOP, _BOTTOM = 0.09, 0.91, 0.94, 0.07
_LINE = 0.0175
"""Of the height of the page."""
_TEXT_PT = 9.0
_WIDE_LETTERS = 98
_LETTER = 0.0094
"""Width of a letter, of the page's."""
_GAP_LETTERS = 3
_PLOT_HEIGHT = (_TOP - _BOTTOM) / 3
"""Of the page's."""
_GREY, _RED, _GREEN = "#595959", "#b00020", "#00692b"


def write_pdf(report: Report, path: Path) -> None:
    """Write the report for print, A4.

    Raises
    ------
    OutputError
    """
    with replacing_file(path) as beside, _Paper(beside, report.serial) as paper:
        paper.heading(report.title, 17)
        paper.paragraph(head_line(report), _GREY)
        for section in report.sections:
            # A report of one section bears its title.
            if section.title != report.title:
                paper.heading(section.title, 13)
            for sentence in section.sentences:
                paper.paragraph(sentence)
            paper.table(numbers_table(section))
            for table in section.tables:
                paper.table(table)
            paper.plots(section.plots)


class _Paper:
    """Pages that are filled from top to bottom.

    Parameters
    ----------
    path
    serial
        Of the sensor, for the foot of each page.
    """

    def __init__(self, path: Path, serial: str) -> None:
        self._pages, self._serial = PdfPages(path), serial
        self._page: Figure | None = None
        self._y, self._number = _TOP, 0

    def __enter__(self) -> _Paper:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._end_page()
        self._pages.close()  # type: ignore[no-untyped-call]

    def heading(self, text: str, size_pt: float) -> None:
        """Write a heading, with some of what follows on the same page."""
        self._room(8)
        self._y -= 0.4 * _LINE * (self._y < _TOP)
        self._room(0).text(_LEFT, self._y, text, fontsize=size_pt, weight="bold", va="top")
        self._y -= size_pt / _TEXT_PT * _LINE

    def paragraph(self, text: str, color: str = "black") -> None:
        """Write a sentence or more."""
        for line in textwrap.wrap(text, _WIDE_LETTERS):
            self._write(self._room(1), line, _LEFT, color)
            self._y -= _LINE
        self._y -= 0.3 * _LINE

    def table(self, table: Table) -> None:
        """Write a table, its headings again on every page."""
        if not table.rows:
            return
        self._y -= 0.8 * _LINE
        if table.caption:
            self.heading(table.caption, 10)
        starts, ends = _columns(table)
        self._head(table, starts, ends)
        for row in table.rows:
            if self._y < _BOTTOM + _LINE:
                self._end_page()
                self._head(table, starts, ends)
            self._row(table, row, starts, ends)

    def plots(self, plots: Sequence[Plot]) -> None:
        """Draw plots below each other: below the text as far as they find room, then on pages."""
        rest = list(plots)
        self._y -= _LINE
        while rest:
            page = self._room(_PLOT_HEIGHT / _LINE)
            count = min(len(rest), int((self._y - _BOTTOM) / _PLOT_HEIGHT + 1e-6))
            height = count * _PLOT_HEIGHT
            area = (_LEFT, self._y - height, _RIGHT - _LEFT, height)
            page.set_layout_engine("constrained", rect=area)
            places = page.subfigures(count, 1, squeeze=False, hspace=0.06).ravel()
            for plot, place in zip(rest, places, strict=False):
                plot.draw(place)
                place.suptitle(plot.title, fontsize=_TEXT_PT + 2, weight="bold")
            self._end_page()
            rest = rest[count:]

    def _head(self, table: Table, starts: Sequence[float], ends: Sequence[float]) -> None:
        if not any(table.headings):
            return
        self._row(table, table.headings, starts, ends, _GREY)
        self._rule(ends[-1], 0.9)

    def _row(
        self,
        table: Table,
        cells: Sequence[str],
        starts: Sequence[float],
        ends: Sequence[float],
        color: str = "black",
    ) -> None:
        page = self._room(1)
        for cell, numeric, start, end in zip(cells, table.numeric, starts, ends, strict=True):
            verdict = _RED if cell.startswith("failed") else _GREEN
            judged = verdict if cell.startswith(("failed (", "passed (")) else color
            x, side = (end, "right") if numeric else (start, "left")
            self._write(page, cell, x, judged, side)
        self._y -= _LINE
        self._rule(ends[-1], 0.3)

    def _rule(self, end: float, width_pt: float) -> None:
        y = self._y + 0.22 * _LINE
        line = Line2D([_LEFT, max(end, 0.5)], [y, y], color="#bbbbbb", linewidth=width_pt)
        self._room(0).add_artist(line)

    def _write(self, page: Figure, text: str, x: float, color: str, side: str = "left") -> None:
        page.text(x, self._y, text, fontsize=_TEXT_PT, color=color, va="top", ha=side)

    def _room(self, lines: float) -> Figure:
        """Give the page that has room for some more lines."""
        if self._page is not None and self._y - lines * _LINE < _BOTTOM:
            self._end_page()
        if self._page is None:
            self._page, self._y = Figure(figsize=_A4_IN), _TOP
            self._number += 1
            sensor = f"Sensor {self._serial} · " if self._serial else ""
            foot = f"{sensor}page {self._number}"
            self._page.text(_LEFT, 0.035, foot, fontsize=_TEXT_PT - 1, color=_GREY)
        return self._page

    def _end_page(self) -> None:
        if self._page is not None:
            self._pages.savefig(self._page)  # type: ignore[no-untyped-call]
        self._page = None


def _columns(table: Table) -> tuple[list[float], list[float]]:
    """Left and right ends of the columns, as shares of the page's width."""
    letters = [
        max(len(row[i]) for row in (table.headings, *table.rows))
        for i in range(len(table.headings))
    ]
    whole = sum(letters) + _GAP_LETTERS * (len(letters) - 1)
    letter = min(_LETTER, (_RIGHT - _LEFT) / whole)
    starts, ends, x = [], [], _LEFT
    for count in letters:
        starts.append(x)
        ends.append(x + count * letter)
        x = ends[-1] + _GAP_LETTERS * letter
    return starts, ends
