"""PDF documents for the shop and the patient's record: the job sheet and the prescription.

The texts are in resources/texts and can be edited by a clinic; words.json translates the names of
the facts.
"""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, partial
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape

from reportlab import rl_config
from reportlab.lib import colors
from reportlab.lib.pagesizes import A4
from reportlab.lib.styles import ParagraphStyle
from reportlab.lib.units import mm
from reportlab.pdfbase import pdfmetrics
from reportlab.pdfbase.ttfonts import TTFont
from reportlab.pdfgen.canvas import Canvas
from reportlab.platypus import (
    CondPageBreak,
    Flowable,
    Image,
    PageBreak,
    Paragraph,
    SimpleDocTemplate,
    Spacer,
    Table,
)

from insole_core.errors import InputError
from insole_core.export.height_picture import HeightPicture, MappedHeights
from insole_core.export.insole_drawing import DrawnInsole, ElementsPage, SectionsPage, ViewsPage
from insole_core.export.lettering import as_written, font_path
from insole_core.files.atomic import replacing_file
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.height_map import HeightMap
from insole_core.given_file import sha256_of
from insole_core.messages import Message, Translate
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
_HEAD_ALONE = ParagraphStyle("head alone", parent=HEAD, keepWithNext=0)
"""Of what takes as much of the page as is left, which together with a heading it could not."""
NOTE = ParagraphStyle("note", parent=BODY, fontSize=8, leading=10, spaceBefore=4)
TITLE = ParagraphStyle("title", parent=BODY, fontSize=16, leading=22)
QUIET = colors.HexColor("#595959")
_LEAST_PICTURE_MM, _MOST_PICTURE_MM = 50.0, 160.0
"""Height of the picture of a job sheet."""
_TURNS = {0: "not turned", 90: "toes to x = 0", 180: "turned", 270: "heel to x = 0"}
"""Texts of a job sheet by how far a part is turned."""
_END_MM = 12.0
"""From heel and toes of a part to their words."""
_OF_THE_WHOLE_ORDER = ("pseudonym", "kind", "date")


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
    checks, warnings
        One sentence each; warnings are what is unusual about the design.
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
    title, own_title
        Of the title block of the drawing, beside the file's hash: where all pieces of the order
        are shown, and where this one alone is.
    remarks
        Of the order, for the drawing.
    """

    identification: Facts
    measures: Facts
    make: Facts
    checks: tuple[str, ...]
    file: Path
    file_name: str
    warnings: tuple[str, ...] = ()
    height_map: HeightMap | None = None
    failed_mm: tuple[Place, ...] = ()
    is_nested: bool = False
    drawn: DrawnInsole | None = None
    title: Facts = field(default_factory=dict)
    own_title: Facts = field(default_factory=dict)
    remarks: str = ""


@dataclass(frozen=True, eq=False)
class NestedPart:
    """A part where it lies in a block.

    Parameters
    ----------
    heights : mm, frame of the block
    bounds_mm : (2, 3) float64
        Least and greatest corner in the block.
    turn_deg
        Counter-clockwise: its toes point along y at 0, to x = 0 at 90.
    material
        Where those of a nest may differ; empty for none.
    label
        On the picture, where many parts leave no room for their names; empty for the name.
    failed_mm
        Places of failed checks in the block.
    """

    name: str
    heights: HeightMap
    bounds_mm: FloatArray
    turn_deg: int = 0
    material: str = ""
    label: str = ""
    failed_mm: tuple[Place, ...] = ()


@dataclass(frozen=True, eq=False)
class Nesting:
    """A block with what is milled from it; its corner is the origin.

    Parameters
    ----------
    stock
        Name and sides of the block, in words.
    block_mm
        Width (x), length (y), height (z).
    """

    stock: str
    block_mm: Place
    parts: tuple[NestedPart, ...]


def write_job_sheet(
    sheets: Sequence[JobSheet],
    path: Path,
    nesting: Nesting | None = None,
    pieces: Sequence[DrawnInsole] = (),
    translate: Translate = str,
    *,
    keyword: str = "",
) -> None:
    """Write the drawing and the job sheets of the parts, each on a page of its own.

    Parameters
    ----------
    keyword
        Of the document, for programs: see `sheet_terms`.
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
        facts = {
            **{key: sheets[0].identification[key] for key in _OF_THE_WHOLE_ORDER
               if key in sheets[0].identification},
            "file": sheets[0].file_name,
            "stock": translate(nesting.stock),
        }  # fmt: skip
        page = _nesting_page(nesting, facts, texts, translate)
        pages.insert(0, [paragraph(texts["title"], TITLE), *page])
    pages = [*_drawing(sheets, pieces, translate), *pages]
    story = [flowable for page in pages for flowable in (PageBreak(), *page)][1:]
    write_pages(story, path, texts["title"], keyword=keyword)


def _drawing(
    sheets: Sequence[JobSheet], pieces: Sequence[DrawnInsole], translate: Translate
) -> list[list[Flowable]]:
    """Return the pages of the drawing: views of all pieces, sections of each sheet's."""
    _register_font()
    words = paper_texts("words", translate)
    files = [{"file": sheet.file_name, "SHA-256": _digest_of(sheet.file)[:16]} for sheet in sheets]
    made: list[Callable[[Facts], Flowable]] = []
    if pieces:
        views = partial(ViewsPage, pieces, _DRAWING_MM, words=words, remarks=sheets[0].remarks)
        rest = ElementsPage.parts(views(title={}).rest, _DRAWING_MM)
        title = {**sheets[0].title, **files[0]}
        made.append(lambda count: views(title={**title, **count}))
        made += [partial(_elements_page, rows, title, words) for rows in rest]
    for sheet, file in zip(sheets, files, strict=True):
        if sheet.drawn is not None:
            own_title = {**sheet.own_title, **file}
            made.append(partial(_sections_page, sheet.drawn, own_title, words))
    return [[make({"sheet": f"{number} / {len(made)}"})] for number, make in enumerate(made, 1)]


def _elements_page(
    rows: Sequence[tuple[str, str, str]], title: Facts, words: Facts, count: Facts
) -> Flowable:
    return ElementsPage(rows, _DRAWING_MM, {**title, **count}, words)


def _sections_page(drawn: DrawnInsole, title: Facts, words: Facts, count: Facts) -> Flowable:
    return SectionsPage(drawn, _DRAWING_MM, {**title, **count}, words)


def _sheet(sheet: JobSheet, texts: dict[str, str], translate: Translate) -> list[Flowable]:
    story = [paragraph(texts["title"], TITLE)]
    for key in ("identification", "measures", "make"):
        story += facts_table(texts[key], getattr(sheet, key), translate)
    file = {"name": sheet.file_name, "SHA-256": _digest_of(sheet.file)}
    story += facts_table(texts["file"], file, translate)
    frame = texts["frame on page 1" if sheet.is_nested else "frame"]
    story += listed(texts["checks"], sheet.checks)
    story += _warnings(texts, sheet.warnings)
    story += [paragraph(f"{frame} {texts['footer']}", NOTE)]
    return [*story, *_picture(sheet, texts["heights"])]


def write_nest_sheet(
    nesting: Nesting,
    facts: Facts,
    path: Path,
    *,
    notes: Sequence[str] = (),
    translate: Translate = str,
) -> None:
    """Write where the pieces of several orders lie on one block.

    Parameters
    ----------
    facts
        Of the nest; never a patient's name.
    notes
        What the shop should know, one sentence each.

    Raises
    ------
    OutputError
        When the place cannot be written.
    InputError
        When the texts cannot be read.
    """
    texts = paper_texts("job_sheet", translate)
    story = [paragraph(texts["nest title"], TITLE)]
    story += _nesting_page(nesting, facts, texts, translate)
    if notes:
        story += listed(texts["warnings"], notes)
    write_pages(story, path, texts["nest title"])


def _nesting_page(
    nesting: Nesting, facts: Facts, texts: dict[str, str], translate: Translate
) -> list[Flowable]:
    """Draw the block from above, and say where each part lies in it."""
    return [
        *facts_table(texts["identification"], facts, translate),
        paragraph(texts["nesting"], HEAD),
        _nesting_picture(nesting, paper_texts("words", translate)),
        *facts_table(
            texts["places"],
            {
                part.name: ", ".join(
                    filter(None, (translate(_position(part, texts)), part.material))
                )
                for part in nesting.parts
            },
            translate,
        ),
        paragraph(texts["frame in the block"], NOTE),
    ]


def _position(part: NestedPart, texts: dict[str, str]) -> Message:
    (x, y, _), (x_end, y_end, z_end) = part.bounds_mm
    return Message(
        "x {x:.1f} – {x_end:.1f}, y {y:.1f} – {y_end:.1f}, z 0 – {z_end:.1f} mm; {turn}",
        x=x,
        y=y,
        x_end=x_end,
        y_end=y_end,
        z_end=z_end,
        turn=texts[_TURNS[part.turn_deg]],
    )


def write_prescription(
    identification: Facts,
    corrections: Sequence[str],
    make: Facts,
    path: Path,
    *,
    responsible: Facts,
    warnings: Sequence[str] = (),
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
    warnings
        What is unusual about the design, a sentence each.
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
    story += facts_table(texts["identification"], identification, translate)
    given = {key: value for key, value in responsible.items() if value}
    story += facts_table(texts["responsible"], given, translate)
    story += listed(texts["corrections"], corrections or ("–",))
    story += _warnings(texts, warnings)
    story += facts_table(texts["make"], make, translate)
    statement = _filled(texts["statement"], {**identification, **responsible})
    story += listed(texts["statement_title"], (statement,))
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
        story += facts_table(heading, facts)
    write_pages(story, path, title)


def paragraph(text: str, style: ParagraphStyle = BODY) -> Paragraph:
    """Return a paragraph in the product's own font; the text may be in any script."""
    _register_font()
    return Paragraph(escape(as_written(text)), style)


def write_pages(
    story: list[Flowable], path: Path, title: str, foot: str = "", keyword: str = ""
) -> None:
    """Lay out A4 pages.

    Parameters
    ----------
    title, keyword
        In the metadata of the document.
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
            file, pagesize=A4, title=title, author="Insole Studio", keywords=keyword,
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


def facts_table(title: str, facts: Facts, translate: Translate = str) -> list[Flowable]:
    """Return a heading and a table of names and values; the names are words of words.json."""
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


def listed(title: str, lines: Sequence[str]) -> list[Flowable]:
    """Return a heading and lines below it."""
    return [paragraph(title, HEAD), *(paragraph(line) for line in lines)]


def _warnings(texts: Facts, sentences: Sequence[str]) -> list[Flowable]:
    return (
        listed(texts["warnings"], [f"! {sentence}" for sentence in sentences]) if sentences else []
    )


def _picture(sheet: JobSheet, title: str) -> list[Flowable]:
    """Draw the height map of the file, if there is one, as large as what is left of the page.

    Only where too little is left does it go to a page of its own, and fills that.
    """
    if sheet.height_map is None:
        return []
    left, right, low, high = sheet.height_map.extent_mm
    mapped = MappedHeights(sheet.height_map, sheet.failed_mm)
    frame = (left, low, right, high)
    return [
        CondPageBreak(_LEAST_PICTURE_MM * mm + HEAD.leading + HEAD.spaceBefore),
        paragraph(title, _HEAD_ALONE),
        HeightPicture([mapped], frame, _MOST_PICTURE_MM * mm, least_pt=_LEAST_PICTURE_MM * mm),
    ]


def _nesting_picture(nesting: Nesting, words: Facts) -> Flowable:
    """Draw the block from above with its parts, heel and toes of each named where there is room."""
    width, length, height = nesting.block_mm
    mapped = []
    for part in nesting.parts:
        (left, low, _), (right, high, _) = part.bounds_mm
        across, along = (left + right) / 2, (low + high) / 2
        ends = {
            0: ((across, low + _END_MM), (across, high - _END_MM)),
            90: ((right - _END_MM, along), (left + _END_MM, along)),
            180: ((across, high - _END_MM), (across, low + _END_MM)),
            270: ((left + _END_MM, along), (right - _END_MM, along)),
        }
        heel, toes = ends[part.turn_deg]
        places = [((across, along), part.label or part.name)]
        if not part.label:
            places += [(heel, "heel"), (toes, "toes")]
        labels = [(*place, words.get(word, word)) for place, word in places]
        mapped.append(MappedHeights(part.heights, part.failed_mm, tuple(labels)))
    frame = (-6.0, -6.0, width + 6.0, length + 6.0)
    return HeightPicture(mapped, frame, 140 * mm, most_mm=height, block_mm=(0, 0, width, length))
