"""PDF documents for the shop and the patient's record: the job sheet and the prescription.

The texts are in resources/texts and can be edited by a clinic; words.json translates the names of
the facts.
"""

from __future__ import annotations

import hashlib
import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from reportlab.lib import colors
from reportlab.lib.pagesizes import A4
from reportlab.lib.styles import ParagraphStyle
from reportlab.lib.units import mm
from reportlab.pdfbase import pdfmetrics
from reportlab.pdfbase.ttfonts import TTFont
from reportlab.pdfgen.canvas import Canvas
from reportlab.platypus import (
    Flowable,
    Image,
    PageBreak,
    Paragraph,
    SimpleDocTemplate,
    Spacer,
    Table,
)

from insole_core.errors import InputError
from insole_core.export.atomic import replacing_file
from insole_core.export.lettering import as_written, font_path, with_known_letters
from insole_core.geometry.arrays import FloatArray
from insole_core.resources import resource_path

Facts = Mapping[str, str]
_FONT = "DejaVuSans"
BOLD = "DejaVuSans-Bold"
_MARGIN = 16 * mm
_PADDING = 6
"""Padding of a reportlab frame inside the margin, pt."""
BODY = ParagraphStyle("body", fontName=_FONT, fontSize=9, leading=12)
HEAD = ParagraphStyle("head", parent=BODY, fontSize=11, leading=16, spaceBefore=8, keepWithNext=1)
TITLE = ParagraphStyle("title", parent=BODY, fontSize=16, leading=22)
QUIET = colors.HexColor("#595959")


@dataclass(frozen=True, eq=False)
class SectionDrawing:
    """A cross-section of an insole.

    Parameters
    ----------
    along_mm : (n,) float64
        Position along the section.
    top_mm, bottom_mm : (n,) float64
        Heights; NaN where there is no material.
    """

    title: str
    along_mm: FloatArray
    top_mm: FloatArray
    bottom_mm: FloatArray


@dataclass(frozen=True, eq=False)
class JobSheet:
    """The data of the job sheet for one exported file.

    Parameters
    ----------
    identification
        Pseudonym, side, date and so on; never the patient's name.
    measures
        Dimensions of the solid.
    make
        Material and tolerances.
    checks
        One sentence each.
    file
        The exported file, whose hash is printed; it may still have a temporary name.
    file_name
        Its final name.
    height_map_mm : (ny, nx) float64, optional
    """

    identification: Facts
    measures: Facts
    make: Facts
    sections: tuple[SectionDrawing, ...]
    checks: tuple[str, ...]
    file: Path
    file_name: str
    height_map_mm: FloatArray | None = None


def write_job_sheet(sheets: Sequence[JobSheet], path: Path) -> None:
    """Write the job sheets of the parts, each on a page of its own.

    Raises
    ------
    OutputError
        When the place cannot be written.
    InputError
        When an exported file or the texts cannot be read.
    """
    texts = _texts("job_sheet")
    story: list[Flowable] = []
    for number, sheet in enumerate(sheets):
        story += [PageBreak()] * bool(number) + _sheet(sheet, texts)
    write_pages(story, path, texts["title"])


def _sheet(sheet: JobSheet, texts: dict[str, str]) -> list[Flowable]:
    story = [paragraph(texts["title"], TITLE)]
    for key in ("identification", "measures", "make"):
        story += _facts(texts[key], getattr(sheet, key))
    story += _facts(texts["file"], {"name": sheet.file_name, "SHA-256": sha256_of(sheet.file)})
    story += _list(texts["checks"], sheet.checks)
    story += [paragraph(texts["sections"], HEAD), _pictures(sheet)]
    return [*story, Spacer(1, 4 * mm), paragraph(texts["footer"])]


def write_prescription(
    identification: Facts, corrections: Sequence[str], make: Facts, path: Path
) -> None:
    """Write the prescription for the patient and the record, with the statement of Annex XIII.

    Parameters
    ----------
    identification
        Patient, side, date and so on.
    corrections
        One line each.
    make
        Material and other facts of manufacture.

    Raises
    ------
    OutputError
        When the place cannot be written.
    InputError
        When the texts cannot be read.
    """
    texts = _texts("prescription")
    story = [paragraph(texts["title"], TITLE)]
    story += _facts(texts["identification"], identification)
    story += _list(texts["corrections"], corrections or ("–",))
    story += _facts(texts["make"], make)
    story += _list(texts["statement_title"], (texts["statement"],))
    story += [Spacer(1, 20 * mm), paragraph("_" * 40)]
    story += [paragraph(texts["signature"])]
    write_pages(story, path, texts["title"])


def write_report(
    title: str, sections: Sequence[tuple[str, Facts]], picture: bytes, path: Path
) -> None:
    """Write a document of a picture with tables of facts below it.

    Parameters
    ----------
    sections
        Heading and facts of each table.
    picture
        PNG, width to height 9 : 8.

    Raises
    ------
    OutputError
        When the place cannot be written.
    """
    image = Image(io.BytesIO(picture), width=135 * mm, height=120 * mm)
    story: list[Flowable] = [paragraph(title, TITLE), image]
    for heading, facts in sections:
        story += _facts(heading, facts)
    write_pages(story, path, title)


def paragraph(text: str, style: ParagraphStyle = BODY) -> Paragraph:
    """Return a paragraph in the product's own font; the text may be in any script."""
    _register_font()
    return Paragraph(escape(as_written(text)), style)


def write_pages(story: list[Flowable], path: Path, title: str, foot: str = "") -> None:
    """Lay out A4 pages.

    Parameters
    ----------
    title
        Title in the metadata of the document.
    foot
        Footer of every page; "#" is replaced by the page number.

    Raises
    ------
    OutputError
        When the place cannot be written; a file that was there before is untouched.
    """

    def draw_foot(page: Canvas, _document: SimpleDocTemplate) -> None:
        page.setFont(_FONT, 8)
        page.setFillColor(QUIET)
        line = as_written(foot.replace("#", str(page.getPageNumber())))
        page.drawString(_MARGIN + _PADDING, _MARGIN / 2, line)

    with replacing_file(path) as beside, beside.open("wb") as file:
        document = SimpleDocTemplate(
            file, pagesize=A4, title=title, author="Insole Studio",
            leftMargin=_MARGIN, rightMargin=_MARGIN, topMargin=_MARGIN, bottomMargin=_MARGIN,
        )  # fmt: skip
        document.build(story, onFirstPage=draw_foot, onLaterPages=draw_foot)


def sha256_of(path: Path) -> str:
    """Return the SHA-256 of a file, in hexadecimal.

    Raises
    ------
    InputError
        When it cannot be read.
    """
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise InputError(
            "{path} cannot be read: {reason}; export it again.",
            path=path,
            reason=str(error.strerror),
        ) from error


@cache
def _register_font() -> None:
    """Register the font with reportlab, which requires italics too: they are upright here."""
    pdfmetrics.registerFont(TTFont(_FONT, str(font_path())))
    pdfmetrics.registerFont(TTFont(BOLD, str(font_path().with_stem(BOLD))))
    faces = {"normal": _FONT, "bold": BOLD, "italic": _FONT, "boldItalic": BOLD}
    pdfmetrics.registerFontFamily(_FONT, **faces)


def _texts(name: str) -> dict[str, str]:
    path = resource_path(f"texts/{name}.json")
    try:
        content: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise InputError("{path} is no valid JSON; correct the texts.", path=path) from error
    return {key: str(value) for key, value in content.items()}


def _facts(title: str, facts: Facts) -> list[Flowable]:
    if not facts:
        return []
    words = _texts("words")
    rows = [[paragraph(words.get(text, text)) for text in fact] for fact in facts.items()]
    table = Table(rows, colWidths=[50 * mm, 120 * mm], hAlign="LEFT")
    table.setStyle([("LINEBELOW", (0, 0), (-1, -1), 0.3, colors.lightgrey)])
    return [paragraph(title, HEAD), table]


def _list(title: str, lines: Sequence[str]) -> list[Flowable]:
    return [paragraph(title, HEAD), *(paragraph(line) for line in lines)]


def _pictures(sheet: JobSheet) -> Image:
    """Draw the height map, if there is one, and the sections, to equal scales."""
    figure = Figure(figsize=(7, 4.2), layout="constrained")
    FigureCanvasAgg(figure)
    left, right = np.array(figure.subfigures(1, 2, width_ratios=[1, 2]), dtype=object)
    if sheet.height_map_mm is not None:
        axes = left.subplots()
        image = axes.imshow(sheet.height_map_mm, origin="lower", cmap="viridis")
        axes.set_axis_off()
        left.colorbar(image, ax=axes, label="mm", shrink=0.8)
    count = max(1, len(sheet.sections))
    rows = right.subplots(count, 1, squeeze=False, sharex=True, sharey=True)[:, 0]
    for axes, section in zip(rows, sheet.sections, strict=False):
        axes.fill_between(section.along_mm, section.bottom_mm, section.top_mm, color="tan")
        axes.set_title(with_known_letters(section.title), fontsize=8)
        axes.set_aspect("equal")
        axes.tick_params(labelsize=6)
    picture = io.BytesIO()
    figure.savefig(picture, format="png", dpi=150)
    picture.seek(0)
    return Image(picture, width=170 * mm, height=102 * mm)


def section_along(
    top_mm: FloatArray, bottom_mm: FloatArray, pitch_mm: float, *, share: float, across: bool
) -> SectionDrawing:
    """Cut the height maps of a solid along a row or a column.

    Parameters
    ----------
    top_mm, bottom_mm : (ny, nx) float64, mm
        Upper and lower surface; NaN outside the solid.
    pitch_mm
        Grid spacing.
    share
        Position of the cut, 0 to 1: of the length for a cut across, of the width for one along.
    across
        Whether the cut runs across the foot; otherwise along it.

    Returns
    -------
    SectionDrawing
        ``along_mm`` begins at 0 at the edge of the maps.
    """
    rows, columns = np.nonzero(np.isfinite(top_mm))
    where = rows if across else columns
    index = int(where.min() + share * np.ptp(where))
    cut = np.s_[index, :] if across else np.s_[:, index]
    top, bottom = top_mm[cut], bottom_mm[cut]
    title = f"{'across' if across else 'along'}, at {share:.0%}"
    return SectionDrawing(title, pitch_mm * np.arange(float(len(top))), top, bottom)
