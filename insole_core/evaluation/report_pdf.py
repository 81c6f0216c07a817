"""A report as PDF for print, A4."""

from __future__ import annotations

import io
from pathlib import Path

from reportlab.lib import colors
from reportlab.lib.styles import ParagraphStyle
from reportlab.lib.units import mm
from reportlab.platypus import Flowable, Image, KeepTogether, Spacer
from reportlab.platypus import Table as Grid

from insole_core.evaluation.report import (
    Plot,
    Report,
    ReportSection,
    Table,
    head_line,
    numbers_table,
)
from insole_core.evaluation.report_html import plot_png
from insole_core.export.lettering import as_written
from insole_core.export.paper import BODY, BOLD, HEAD, QUIET, TITLE, paragraph, write_pages

_PLOT_MM = (135.0, 82.5)
"""Three fit on a page."""
_VERDICTS = {"failed": colors.HexColor("#b00020"), "passed": colors.HexColor("#00692b")}
_BOLD_TITLE = ParagraphStyle("bold title", parent=TITLE, fontName=BOLD)
_CHAPTER = ParagraphStyle("chapter", parent=HEAD, fontName=BOLD, fontSize=13, leading=20)
_CAPTION = ParagraphStyle("caption", parent=HEAD, fontName=BOLD, fontSize=10)
_QUIET_BODY = ParagraphStyle("quiet", parent=BODY, textColor=QUIET)


def write_pdf(report: Report, path: Path) -> None:
    """Write a report for print, A4.

    Raises
    ------
    OutputError
        If the path cannot be written.
    """
    story = [paragraph(report.title, _BOLD_TITLE), paragraph(head_line(report), _QUIET_BODY)]
    for section in report.sections:
        # A report of one section already shows its title.
        titled = section.title != report.title
        story += _section(section, [paragraph(section.title, _CHAPTER)] * titled)
    sensor = f"Sensor {report.serial} · " if report.serial else ""
    write_pages(story, path, report.title, f"{sensor}{report.page_word} #")


def _section(section: ReportSection, heading: list[Flowable]) -> list[Flowable]:
    """Lay out a section; heading and sentences are kept with the next element."""
    lead = heading + [paragraph(sentence) for sentence in section.sentences]
    story: list[Flowable] = []
    for table in (numbers_table(section), *section.tables):
        if table.rows:
            lead += [paragraph(table.caption, _CAPTION)] * bool(table.caption)
            story.append(KeepTogether([*lead, Spacer(1, 2 * mm), _grid(table)]))
            lead = []
    for plot in section.plots:
        story.append(KeepTogether([*lead, Spacer(1, 4 * mm), _picture(plot)]))
        lead = []
    return story + lead


def _grid(table: Table) -> Grid:
    """Lay out a table, with its headings repeated on every page."""
    headings = [table.headings] * any(table.headings)
    rows = [*headings, *table.rows]
    style = [
        ("FONT", (0, 0), (-1, -1), BODY.fontName, BODY.fontSize),
        ("LEFTPADDING", (0, 0), (0, -1), 0),
        ("TOPPADDING", (0, 0), (-1, -1), 1),
        ("BOTTOMPADDING", (0, 0), (-1, -1), 3),
        ("LINEBELOW", (0, 0), (-1, -1), 0.3, colors.lightgrey),
    ]
    if headings:
        style += [("TEXTCOLOR", (0, 0), (-1, 0), QUIET), ("LINEBELOW", (0, 0), (-1, 0), 0.9, QUIET)]
    for column, numeric in enumerate(table.numeric):
        style.append(("ALIGN", (column, 0), (column, -1), "RIGHT" if numeric else "LEFT"))
    for i, row in enumerate(rows):
        for j, cell in enumerate(row):
            if color := _VERDICTS.get(cell.partition(" (")[0]):
                style.append(("TEXTCOLOR", (j, i), (j, i), color))
    cells = [[as_written(cell) for cell in row] for row in rows]
    return Grid(cells, style=style, repeatRows=len(headings), hAlign="LEFT")


def _picture(plot: Plot) -> Image:
    width, height = (side * mm for side in _PLOT_MM)
    return Image(io.BytesIO(plot_png(plot)), width, height)
