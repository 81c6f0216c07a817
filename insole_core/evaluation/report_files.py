"""A report as a file: one HTML page with its pictures, PDF for print, or JSON, by the suffix."""

from __future__ import annotations

import base64
import html
import io
import json
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
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
    report_json,
)
from insole_core.export.lettering import as_written
from insole_core.export.paper import BODY, BOLD, HEAD, QUIET, TITLE, paragraph, write_pages
from insole_core.files.atomic import write_text
from insole_core.recording.images import encode_png
from insole_core.visible_text import visible

_PLOT_IN = (7.2, 4.4)
_DOTS_PER_IN = 130
_STYLE = """
body{font:15px/1.5 system-ui,"Segoe UI",Roboto,sans-serif;max-width:52em;margin:2em auto;
padding:0 1.5em;color:#222;background:#fff}
h1{font-size:1.7em;margin:0}h2{font-size:1.3em;margin:2em 0 .4em}
h3{font-size:1.05em;margin:1.6em 0 .4em}
.head{color:#595959;margin:.2em 0 1.5em}p{margin:.3em 0}
table{border-collapse:collapse;margin:.8em 0;font-variant-numeric:tabular-nums}
td,th{padding:.28em .9em .28em 0;border-bottom:1px solid #ddd;text-align:left}
th{border-bottom:2px solid #999;font-weight:600}.number{text-align:right}
.failed{color:#b00020;font-weight:bold}.passed{color:#00692b}
img{max-width:100%;height:auto}figure{margin:1.5em 0;break-inside:avoid}
""".strip()
_PLOT_MM = (135.0, 82.5)
"""Three fit on a page."""
_VERDICTS = {"failed": colors.HexColor("#b00020"), "passed": colors.HexColor("#00692b")}
_BOLD_TITLE = ParagraphStyle("bold title", parent=TITLE, fontName=BOLD)
_CHAPTER = ParagraphStyle("chapter", parent=HEAD, fontName=BOLD, fontSize=13, leading=20)
_CAPTION = ParagraphStyle("caption", parent=HEAD, fontName=BOLD, fontSize=10)
_QUIET_BODY = ParagraphStyle("quiet", parent=BODY, textColor=QUIET)
__all__ = ["WRITERS", "write_html", "write_json", "write_pdf"]


def write_html(report: Report, path: Path) -> None:
    """Write a report as a single page with embedded pictures.

    Raises
    ------
    OutputError
        If the path cannot be written.
    """
    write_text(visible(_page(report)), path)


def _page(report: Report) -> str:
    body = "".join(_section_html(section, report.title) for section in report.sections)
    title = html.escape(report.title)
    return (
        f'<!doctype html><html lang="{html.escape(report.language)}"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width">'
        f"<title>{title}</title><style>{_STYLE}</style></head><body><h1>{title}</h1>"
        f'<p class="head">{html.escape(head_line(report))}</p>{body}</body></html>\n'
    )


def _section_html(section: ReportSection, report_title: str) -> str:
    # A report of one section already shows its title.
    title = section.title if section.title != report_title else ""
    sentences = "".join(f"<p>{html.escape(sentence)}</p>" for sentence in section.sentences)
    tables = "".join(_table_html(table) for table in section.tables)
    plots = "".join(_plot_html(plot) for plot in section.plots)
    return f"{_titled('h2', title)}{sentences}{_numbers_html(section)}{tables}{plots}"


def _numbers_html(section: ReportSection) -> str:
    rows = "".join(
        f'<tr><td>{html.escape(n.label)}</td><td class="number">{html.escape(n.text)}</td>'
        f'<td class="{"failed" if n.passed is False else "passed"}">'
        f"{html.escape(n.verdict)}</td></tr>"
        for n in section.numbers
    )
    return f"<table>{rows}</table>" if rows else ""


def _table_html(table: Table) -> str:
    sides = [' class="number"' if numeric else "" for numeric in table.numeric]
    head = _row_html("th", table.headings, sides)
    rows = "".join(_row_html("td", row, sides) for row in table.rows)
    return f"{_titled('h3', table.caption)}<table>{head}{rows}</table>"


def _row_html(cell: str, texts: Sequence[str], sides: Sequence[str]) -> str:
    cells = [
        f"<{cell}{side}>{html.escape(text)}</{cell}>"
        for text, side in zip(texts, sides, strict=True)
    ]
    return f"<tr>{''.join(cells)}</tr>"


def _plot_html(plot: Plot) -> str:
    picture = base64.b64encode(plot_png(plot)).decode()
    return (
        f'<figure><img alt="{html.escape(plot.title)}" src="data:image/png;base64,{picture}">'
        "</figure>"
    )


def _titled(tag: str, title: str) -> str:
    return f"<{tag}>{html.escape(title)}</{tag}>" if title else ""


def plot_png(plot: Plot) -> bytes:
    """Return a plot as PNG; it is drawn once."""
    return plot.drawn.get("png", (), lambda: _drawn(plot))


def _drawn(plot: Plot) -> bytes:
    figure = Figure(figsize=_PLOT_IN, dpi=_DOTS_PER_IN, layout="constrained")
    canvas = FigureCanvasAgg(figure)
    plot.draw(figure)
    figure.suptitle(plot.title)
    # Figure.savefig would draw a figure with a layout twice.
    canvas.draw()  # type: ignore[no-untyped-call]
    drawn = np.asarray(canvas.buffer_rgba())  # type: ignore[no-untyped-call]
    return encode_png(np.ascontiguousarray(drawn[..., :3]))


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


def write_json(report: Report, path: Path) -> None:
    """Write the numbers of a report.

    Raises
    ------
    OutputError
        If the path cannot be written.
    """
    write_text(json.dumps(report_json(report), indent=1, ensure_ascii=False) + "\n", path)


WRITERS: dict[str, Callable[[Report, Path], None]] = {
    ".html": write_html,
    ".pdf": write_pdf,
    ".json": write_json,
}
"""Writer of a report by the suffix of its file."""
