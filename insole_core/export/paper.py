"""PDF documents for the shop and the patient's record: the job sheet and the prescription.

The texts are in resources/texts and can be edited by a clinic; words.json translates the names of
the facts.
"""

from __future__ import annotations

import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from reportlab import rl_config
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
from insole_core.export.insole_drawing import DrawnInsole, SectionsPage, ViewsPage
from insole_core.export.lettering import as_written, font_path, with_known_letters
from insole_core.file_digest import sha256_of
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.height_map import HeightMap
from insole_core.messages import Translate
from insole_core.resources import resource_path

rl_config.useA85 = 0  # streams as text cost a fifth of the file, and most of the time of pictures

Facts = Mapping[str, str]
Place = tuple[float, float, float]
_FONT = "DejaVuSans"
BOLD = "DejaVuSans-Bold"
_MARGIN = 16 * mm
_PADDING = 6
"""Padding of a reportlab frame inside the margin, pt."""
_DRAWING_MM = (173.0, 259.0)
"""Of a page of the drawing, within the frame."""
BODY = ParagraphStyle("body", fontName=_FONT, fontSize=9, leading=12)
HEAD = ParagraphStyle("head", parent=BODY, fontSize=11, leading=15, spaceBefore=5, keepWithNext=1)
NOTE = ParagraphStyle("note", parent=BODY, fontSize=8, leading=10, spaceBefore=4)
TITLE = ParagraphStyle("title", parent=BODY, fontSize=16, leading=22)
QUIET = colors.HexColor("#595959")
_OF_THE_WHOLE_ORDER = ("pseudonym", "kind", "date")
_FAILED = "#b3261e"


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
    height_map
        Of the solid, in the frame of the file.
    failed_mm
        Places of failed checks, in the frame of the file.
    is_nested
        Whether the frame of the file is that of a block.
    drawn
        The piece for the drawing; without it there is none.
    title
        Of the title block of the drawing, beside the file's hash.
    """

    identification: Facts
    measures: Facts
    make: Facts
    sections: tuple[SectionDrawing, ...]
    checks: tuple[str, ...]
    file: Path
    file_name: str
    height_map: HeightMap | None = None
    failed_mm: tuple[Place, ...] = ()
    is_nested: bool = False
    drawn: DrawnInsole | None = None
    title: Facts = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class NestedPart:
    """A part where it lies in a block.

    Parameters
    ----------
    heights : mm, frame of the block
    bounds_mm : (2, 3) float64
        Least and greatest corner in the block.
    is_turned
        Whether its toes point to y = 0.
    failed_mm
        Places of failed checks in the block.
    """

    name: str
    heights: HeightMap
    bounds_mm: FloatArray
    is_turned: bool
    failed_mm: tuple[Place, ...] = ()


@dataclass(frozen=True, eq=False)
class Nesting:
    """A block with what is milled from it; its corner is the origin.

    Parameters
    ----------
    block_mm
        Width (x), length (y), height (z).
    """

    block_name: str
    block_mm: Place
    parts: tuple[NestedPart, ...]


def write_job_sheet(
    sheets: Sequence[JobSheet],
    path: Path,
    nesting: Nesting | None = None,
    pieces: Sequence[DrawnInsole] = (),
    translate: Translate = str,
) -> None:
    """Write the drawing and the job sheets of the parts, each on a page of its own.

    Parameters
    ----------
    pieces
        All of the order, which the first page of the drawing shows from four sides.
    translate
        Into the language of the paper.
    nesting
        Drawn on a page before them.

    Raises
    ------
    OutputError
        When the place cannot be written.
    InputError
        When an exported file or the texts cannot be read.
    """
    texts = paper_texts("job_sheet", translate)
    pages = [_sheet(sheet, texts, translate) for sheet in sheets]
    if nesting is not None:
        pages.insert(0, _nesting_page(nesting, sheets[0], texts))
    pages = [*_drawing(sheets, pieces, translate), *pages]
    story = [flowable for page in pages for flowable in (PageBreak(), *page)][1:]
    write_pages(story, path, texts["title"])


def _drawing(
    sheets: Sequence[JobSheet], pieces: Sequence[DrawnInsole], translate: Translate
) -> list[list[Flowable]]:
    """Return the pages of the drawing: views of all pieces, sections of each sheet's."""
    _register_font()
    words = paper_texts("words", translate)
    pages: list[list[Flowable]] = []
    for sheet in sheets:
        title = {**sheet.title, "SHA-256": _digest_of(sheet.file)[:16], "file": sheet.file_name}
        if pieces and not pages:
            pages.append([ViewsPage(pieces, _DRAWING_MM, title, words)])
        if sheet.drawn is not None:
            pages.append([SectionsPage(sheet.drawn, _DRAWING_MM, title, words)])
    return pages


def _sheet(sheet: JobSheet, texts: dict[str, str], translate: Translate) -> list[Flowable]:
    story = [paragraph(texts["title"], TITLE)]
    for key in ("identification", "measures", "make"):
        story += _facts(texts[key], getattr(sheet, key), translate)
    file = {"name": sheet.file_name, "SHA-256": _digest_of(sheet.file)}
    story += _facts(texts["file"], file, translate)
    frame = texts["frame on page 1" if sheet.is_nested else "frame"]
    story += [*_list(texts["checks"], sheet.checks), paragraph(f"{frame} {texts['footer']}", NOTE)]
    return [*story, paragraph(texts["sections"], HEAD), _pictures(sheet)]


def _nesting_page(nesting: Nesting, sheet: JobSheet, texts: dict[str, str]) -> list[Flowable]:
    """Draw the block from above, and say where each part lies in it."""
    common = {
        key: value for key, value in sheet.identification.items() if key in _OF_THE_WHOLE_ORDER
    }
    width, length, height = nesting.block_mm
    size = f"{nesting.block_name}, {length:g} × {width:g} × {height:g} mm"
    return [
        paragraph(texts["title"], TITLE),
        *_facts(texts["identification"], {**common, "file": sheet.file_name, "stock": size}),
        paragraph(texts["nesting"], HEAD),
        _nesting_picture(nesting),
        *_facts(texts["places"], {part.name: _position(part, texts) for part in nesting.parts}),
        paragraph(texts["frame in the block"], NOTE),
    ]


def _position(part: NestedPart, texts: dict[str, str]) -> str:
    (x, y, _), (x_end, y_end, z_end) = part.bounds_mm
    text = texts["turned" if part.is_turned else "not turned"]
    return f"x {x:.1f} – {x_end:.1f}, y {y:.1f} – {y_end:.1f}, z 0 – {z_end:.1f} mm; {text}"


def write_prescription(
    identification: Facts,
    corrections: Sequence[str],
    make: Facts,
    path: Path,
    *,
    responsible: Facts,
    translate: Translate = str,
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
    responsible
        Prescriber, clinic, maker and the maker's address. The text of the statement may name
        them, and every other fact here, in braces: ``{maker}``.
    translate
        Into the language of the paper; lines and facts come translated, names of facts do not.

    Raises
    ------
    OutputError
        When the place cannot be written.
    InputError
        When the texts cannot be read.
    """
    texts = paper_texts("prescription", translate)
    story = [paragraph(texts["title"], TITLE)]
    story += _facts(texts["identification"], identification, translate)
    given = {key: value for key, value in responsible.items() if value}
    story += _facts(texts["responsible"], given, translate)
    story += _list(texts["corrections"], corrections or ("–",))
    story += _facts(texts["make"], make, translate)
    statement = _filled(texts["statement"], {**identification, **responsible})
    story += _list(texts["statement_title"], (statement,))
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


def _digest_of(path: Path) -> str:
    try:
        return sha256_of(path)
    except OSError as error:
        raise InputError(
            "{path} cannot be read: {reason}; export it again.",
            path=path,
            reason=str(error.strerror),
        ) from error


def _filled(text: str, facts: Facts) -> str:
    """Replace the names of facts in braces; a clinic's other braces stay as they are."""
    for key, value in facts.items():
        text = text.replace(f"{{{key}}}", value)
    return text


@cache
def _register_font() -> None:
    """Register the font with reportlab, which requires italics too: they are upright here."""
    pdfmetrics.registerFont(TTFont(_FONT, str(font_path())))
    pdfmetrics.registerFont(TTFont(BOLD, str(font_path().with_stem(BOLD))))
    faces = {"normal": _FONT, "bold": BOLD, "italic": _FONT, "boldItalic": BOLD}
    pdfmetrics.registerFontFamily(_FONT, **faces)


def paper_texts(name: str, translate: Translate = str) -> dict[str, str]:
    """Return the texts of a paper, which a clinic can edit.

    Parameters
    ----------
    translate
        Into the language of the paper; what a clinic has edited stays as it is.

    Raises
    ------
    InputError
        When they cannot be read.
    """
    path = resource_path(f"texts/{name}.json")
    try:
        content: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise InputError("{path} is no valid JSON; correct the texts.", path=path) from error
    return {key: translate(str(value)) for key, value in content.items()}


def _facts(title: str, facts: Facts, translate: Translate = str) -> list[Flowable]:
    if not facts:
        return []
    words = paper_texts("words", translate)
    rows = [[paragraph(words.get(text, text)) for text in fact] for fact in facts.items()]
    table = Table(rows, colWidths=[50 * mm, 120 * mm], hAlign="LEFT")
    table.setStyle(
        [
            ("LINEBELOW", (0, 0), (-1, -1), 0.3, colors.lightgrey),
            ("VALIGN", (0, 0), (-1, -1), "TOP"),
            ("TOPPADDING", (0, 0), (-1, -1), 1),
            ("BOTTOMPADDING", (0, 0), (-1, -1), 2),
        ]
    )
    return [paragraph(title, HEAD), table]


def _list(title: str, lines: Sequence[str]) -> list[Flowable]:
    return [paragraph(title, HEAD), *(paragraph(line) for line in lines)]


def _pictures(sheet: JobSheet) -> Image:
    """Draw the height map, if there is one, and the sections, to equal scales."""
    # Fixed places: an automatic layout would take most of the time of a sheet.
    figure = Figure(figsize=(7, 2.9))
    FigureCanvasAgg(figure)
    if sheet.height_map is not None:
        axes = figure.add_axes((0.06, 0.15, 0.19, 0.8))
        _draw_map(axes, sheet.height_map, sheet.failed_mm)
        figure.colorbar(axes.images[0], cax=figure.add_axes((0.27, 0.23, 0.014, 0.64)), label="mm")
    count = max(1, len(sheet.sections))
    places = figure.add_gridspec(count, 1, left=0.4, right=0.99, bottom=0.08, top=0.92, hspace=0.7)
    rows = places.subplots(squeeze=False, sharex=True, sharey=True)[:, 0]
    for axes, section in zip(rows, sheet.sections, strict=False):
        axes.fill_between(section.along_mm, section.bottom_mm, section.top_mm, color="tan")
        axes.set_title(with_known_letters(section.title), fontsize=8)
        axes.set_aspect("equal")
        axes.tick_params(labelsize=6)
    picture = io.BytesIO()
    figure.savefig(picture, format="png", dpi=150)
    picture.seek(0)
    return Image(picture, width=162 * mm, height=162 * 2.9 / 7 * mm)


def _draw_map(
    axes: Axes, heights: HeightMap, failed_mm: Sequence[Place], most_mm: float | None = None
) -> None:
    """Draw heights at their places, x and y on the axes in mm, with failed checks crossed."""
    axes.imshow(
        heights.top_mm, origin="lower", cmap="viridis", extent=heights.extent_mm, vmin=0,
        vmax=most_mm,
    )  # fmt: skip
    for x, y, _ in failed_mm:
        axes.plot(x, y, "x", color="white", markersize=8, markeredgewidth=4)
        axes.plot(x, y, "x", color=_FAILED, markersize=7, markeredgewidth=2)
    axes.tick_params(labelsize=6)
    axes.set_xlabel("x, mm", fontsize=7)
    axes.set_ylabel("y, mm", fontsize=7)


def _nesting_picture(nesting: Nesting) -> Image:
    """Draw the block from above with its parts, heel and toes of each named."""
    width, length, height = nesting.block_mm
    figure = Figure(figsize=(6.4, 6.4))
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.08, 0.07, 0.78, 0.91))
    words = paper_texts("words")
    for part in nesting.parts:
        _draw_map(axes, part.heights, part.failed_mm, height)
        (left, low, _), (right, high, _) = part.bounds_mm
        heel, toes = (high, low) if part.is_turned else (low, high)
        for place, word in ((heel, "heel"), ((low + high) / 2, part.name), (toes, "toes")):
            inwards = place + np.sign((low + high) / 2 - place) * 12
            axes.text(
                (left + right) / 2, inwards, with_known_letters(words.get(word, word)),
                ha="center", va="center", fontsize=9,
                bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.5},
            )  # fmt: skip
    figure.colorbar(axes.images[0], cax=figure.add_axes((0.89, 0.25, 0.025, 0.55)), label="mm")
    axes.add_patch(Rectangle((0, 0), width, length, fill=False, linewidth=1.5))
    axes.set_xlim(-6, width + 6)
    axes.set_ylim(-6, length + 6)
    picture = io.BytesIO()
    figure.savefig(picture, format="png", dpi=150)
    picture.seek(0)
    return Image(picture, width=140 * mm, height=140 * mm)


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
