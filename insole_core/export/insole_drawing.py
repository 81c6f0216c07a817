"""The technical drawing of insoles: four views, sections with dimensions, numbered elements.

Vector graphics to a stated scale; only the shading of the views is a picture. Views lie as seen
from their side: a bottom view is mirrored, and the toes of a side view point away from the viewer's
left or right as they do on the piece.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final, Literal

import cv2
import numpy as np
from contourpy import LineType, contour_generator
from PIL import Image
from reportlab.lib import colors
from reportlab.lib.units import mm
from reportlab.lib.utils import ImageReader, simpleSplit
from reportlab.pdfbase.pdfmetrics import stringWidth
from reportlab.pdfgen.canvas import FILL_EVEN_ODD, Canvas
from reportlab.pdfgen.pathobject import PDFPathObject
from reportlab.platypus import Flowable

from insole_core.export.lettering import as_written
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.height_map import HeightMap
from insole_core.geometry.side import Side

SCALES: Final = (1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0)
_INK, _THIN, _SHADE = colors.black, colors.HexColor("#7a7a7a"), colors.HexColor("#dcdcdc")
_BLUE: Final = colors.HexColor("#1f4e8c")
_THICK_PT, _LINE_PT, _FINE_PT = 0.9, 0.45, 0.25
_FONT: Final = "DejaVuSans"
_TEXT_PT, _SMALL_PT = 7.0, 6.0
_LEAST_LINE_PT: Final = 5.0
"""Of a field of the title block; what is too long for one line then takes several."""
_LEADING: Final = 1.1
"""From line to line, to the size of the letters."""
_ARROW_MM: Final = 1.6
_CONTOUR_STEP_MM: Final = 2.0
_STRAIGHT_MM: Final = 0.05
"""From a height line to what is drawn of it: thinner than the line itself."""
_ROW_MM: Final = 3.8
_MOST_REMARKS: Final = 6
"""Lines of them on the drawing; the job sheet has them all."""
_BESIDE_MM: Final = 9.0
"""On the paper between two thicknesses that can be read."""
_THICKNESS_MM: Final = 4.0
"""Length of the arrows of a thickness."""
_BELOW_ARROWS_MM: Final = 6.5
"""From a section to its width, whose number stands below those arrows."""
_TITLE_MM: Final = 38.0
_DECIMAL_POINT: Final = "."
"""A word of words.json: the sign of decimals in its language."""
_RIM_MM: Final = 4.0
"""Width of the rim of a section, which is dimensioned by its height."""

_TABLE_TOP_MM: Final = 8.0
_BELOW_HEADING_MM: Final = 2.0
_OVER_TITLE_MM: Final = 12.0
"""Between the table and the title block, for the scale bar."""

_Row = tuple[str, str, str]
"""Of the table of the elements: side where it begins, number where an element begins, text."""
View = Literal["top", "bottom"]
VIEWS: Final[tuple[View, View]] = ("top", "bottom")


@dataclass(frozen=True)
class Element:
    """A post, pad or correction of the table beside a drawing.

    Parameters
    ----------
    name
        A word of words.json that stands before the text; may be empty.
    place_mm
        x and y in the frame of the drawing; None for what has no one place.
    """

    number: int
    name: str
    text: str
    place_mm: tuple[float, float] | None = None


@dataclass(frozen=True, eq=False)
class Section:
    """The face of a plane cut through a solid.

    Parameters
    ----------
    name
        Of the place, a word of words.json.
    at_mm
        Place of the plane.
    polygons : (n, 2) float64 each, mm
        Place along the cut, and height.
    """

    name: str
    at_mm: float
    polygons: tuple[FloatArray, ...]

    @cached_property
    def ends_mm(self) -> tuple[float, float]:
        """Least and greatest place along the cut."""
        places = np.concatenate([polygon[:, 0] for polygon in self.polygons])
        return float(places.min()), float(places.max())

    def heights_mm(self, along_mm: float) -> tuple[float, float]:
        """Return the lowest and highest place of the face above a place along the cut."""
        found = []
        for polygon in self.polygons:
            ends = np.roll(polygon, -1, axis=0)
            before, behind = polygon[:, 0] - along_mm, ends[:, 0] - along_mm
            cut = (before < 0) != (behind < 0)
            share = before[cut] / (before[cut] - behind[cut])
            found.append(polygon[cut, 1] + share * (ends[cut, 1] - polygon[cut, 1]))
        heights = np.concatenate(found)
        return float(heights.min()), float(heights.max())

    def thinnest_mm(self) -> float:
        """Return the place along the cut where the face is thinnest, its rims left out."""
        low, high = self.ends_mm
        places = np.arange(low + _RIM_MM, high - _RIM_MM, 1.0)
        if not len(places):
            return (low + high) / 2
        return float(places[np.argmin([np.ptp(self.heights_mm(place)) for place in places])])

    def rim_mm(self, end: Literal[0, 1]) -> float:
        """Return the greatest height near an end of the cut."""
        near = (
            polygon[np.abs(polygon[:, 0] - self.ends_mm[end]) < _RIM_MM, 1]
            for polygon in self.polygons
        )
        return float(np.concatenate(list(near)).max())


@dataclass(frozen=True, eq=False)
class DrawnInsole:
    """A piece to draw: x to the patient's right, y from heel to toes, standing on z = 0.

    Parameters
    ----------
    bounds_mm : (2, 3) float64
        Least and greatest corner of the solid.
    heights
        Of the solid, for shading and height lines alone.
    outline : (n, 2) float64 each, mm
        Of the solid from above: x, y.
    profile : (n, 2) float64 each, mm
        Of the solid from its side: y, z.
    sections
        Across, by their letters, from the toes to the heel.
    lengthwise
        In the plane x = 0.
    """

    side: Side
    bounds_mm: FloatArray
    heights: HeightMap
    outline: tuple[FloatArray, ...]
    profile: tuple[FloatArray, ...]
    sections: Mapping[str, Section]
    lengthwise: Section
    elements: tuple[Element, ...] = ()

    @property
    def size_mm(self) -> tuple[float, float, float]:
        """Width, length and height of the solid."""
        width, length, height = (self.bounds_mm[1] - self.bounds_mm[0]).tolist()
        return width, length, height

    @property
    def inside(self) -> BoolArray:
        """Pixels of the solid, (ny, nx)."""
        return np.isfinite(self.heights.top_mm)

    @property
    def x_mm(self) -> FloatArray:
        """Places of the columns, (nx,)."""
        return self.heights.first_mm[0] + np.arange(float(self.heights.top_mm.shape[1]))

    @property
    def y_mm(self) -> FloatArray:
        """Places of the rows, (ny,)."""
        return self.heights.first_mm[1] + np.arange(float(self.heights.top_mm.shape[0]))

    @cached_property
    def seen(self) -> Mapping[View, Seen]:
        """Shading and height lines from above and below; the pages of an order share them."""
        return {view: Seen.of(self, view) for view in VIEWS}


@dataclass(frozen=True, eq=False)
class Seen:
    """A surface from above or below.

    Parameters
    ----------
    shading
        From the middle of the first pixel to that of the last one.
    height_lines : (n, 2) float64 each, mm
        x, y of lines of equal height.
    """

    shading: Image.Image
    height_lines: tuple[FloatArray, ...]

    @classmethod
    def of(cls, piece: DrawnInsole, view: View) -> Seen:
        """Light a surface, and find its height lines."""
        heights_mm = piece.heights.top_mm if view == "top" else piece.heights.bottom_mm
        shading = _shading(heights_mm, mirrored=view == "bottom")
        return cls(shading, tuple(_height_lines(piece, heights_mm)))


class _Page(Flowable):  # type: ignore[misc, unused-ignore]
    """A page of a drawing; lengths are mm on the paper, the origin is at the lower left.

    Parameters
    ----------
    title
        Names and values of the title block.
    words
        Translations of the words of the drawing.
    """

    def __init__(
        self, width_mm: float, height_mm: float, title: Mapping[str, str], words: Mapping[str, str]
    ) -> None:
        super().__init__()
        self.width, self.height = width_mm * mm, height_mm * mm
        self._width_mm, self._height_mm = width_mm, height_mm
        self._title, self._words = title, words

    def wrap(self, _width: float, _height: float) -> tuple[float, float]:
        """Return the size."""
        return self.width, self.height

    def draw(self) -> None:
        """Draw frame, title block and content."""
        pen = _Pen(self.canv, self._word(_DECIMAL_POINT))
        self.canv.setFillColor(_INK)
        pen.line_width(_THICK_PT)
        pen.box(0, 0, self._width_mm, self._height_mm)
        _draw_title_block(pen, self._width_mm, self._title, self._words)
        self._draw_content(pen)

    def _draw_content(self, pen: _Pen) -> None:
        raise NotImplementedError

    def _draw_table(self, pen: _Pen, top: float, rows: Sequence[_Row]) -> None:
        """List elements by the numbers of the top views."""
        pen.text(6, top, self._word("posts and pads"), bold=True)
        top -= _BELOW_HEADING_MM
        right = self._width_mm - 6
        pen.line_width(_FINE_PT)
        for number, (side, label, text) in enumerate(rows):
            y = top - _ROW_MM * (number + 1)
            if side or not number:
                pen.line((6, y + _ROW_MM), (right, y + _ROW_MM))
            pen.text(7, y + 1, side)
            pen.text(28, y + 1, label, right=True)
            pen.text(31, y + 1, text)
        bottom = top - _ROW_MM * len(rows)
        pen.line((6, bottom), (right, bottom))
        for x in (6.0, 22.0, 29.5, right):
            pen.line((x, top), (x, bottom))

    def _word(self, word: str) -> str:
        return self._words.get(word, word)


class ViewsPage(_Page):
    """Top, bottom, medial and lateral view of all pieces of an order, with overall dimensions."""

    def __init__(
        self,
        pieces: Sequence[DrawnInsole],
        size_mm: tuple[float, float],
        title: Mapping[str, str],
        words: Mapping[str, str],
        *,
        remarks: str = "",
    ) -> None:
        self._pieces, self._remarks = pieces, remarks
        self._scale = _views_scale(pieces, size_mm)
        scale = _scale_text(self._scale, words)
        super().__init__(*size_mm, {**title, "scale": scale}, words)
        self._low = self._height_mm - 18 - max(one.size_mm[1] for one in pieces) / self._scale
        self._remark_lines = self._wrapped_remarks()
        remarks_mm = _ROW_MM * (len(self._remark_lines) + 1.5) if self._remark_lines else 0.0
        self._remarks_top = self._low - 61
        self._table_top = self._remarks_top - remarks_mm
        self._rows, self.rest = self._fitting(self._all_rows())

    def _draw_content(self, pen: _Pen) -> None:
        count = 2 * len(self._pieces)
        column = self._width_mm / count
        low = self._low
        cells = [(piece, view) for piece in self._pieces for view in VIEWS]
        for number, (piece, view) in enumerate(cells):
            centre = (number + 0.5) * column
            word = self._word("top" if view == "top" else "bottom view")
            heading = f"{self._word(str(piece.side))}, {word}"
            pen.text(centre, self._height_mm - 6, heading, bold=True, centred=True)
            self._draw_plan(pen, piece, view, (centre, low))
        half = self._width_mm / len(self._pieces)
        for row, medial in enumerate((True, False)):
            base = low - 26 - row * 21
            for number, piece in enumerate(self._pieces):
                self._draw_profile(pen, piece, medial, ((number + 0.5) * half, base))
        pen.scale_bar(6, _TITLE_MM + 5, 50, self._scale)
        self._draw_remarks(pen, self._remarks_top)
        self._draw_table(pen, self._table_top, self._rows)

    def _wrapped_remarks(self) -> list[str]:
        """Return the lines of the remarks of the order, as many as find room."""
        lines = [
            part
            for line in self._remarks.splitlines()
            for part in _wrapped(line, self._width_mm - 14)
        ]
        if len(lines) > _MOST_REMARKS:
            lines = [*lines[: _MOST_REMARKS - 1], "… " + self._word("see job sheet")]
        return lines

    def _draw_remarks(self, pen: _Pen, top: float) -> None:
        if self._remark_lines:
            pen.text(6, top, self._word("remarks"), bold=True)
        for number, line in enumerate(self._remark_lines, 1):
            pen.text(7, top - _ROW_MM * number, line)

    def _fitting(self, rows: list[_Row]) -> tuple[list[_Row], list[_Row]]:
        """Return the rows of the table, and those that find no room above the title block."""
        room = _rows_below(self._table_top)
        if len(rows) <= room:
            return rows, []
        kept = max(room - 1, 0)
        see = "… " + self._word("see next sheet")
        return [*rows[:kept], ("", "", see)], _going_on(rows, kept)

    def _all_rows(self) -> list[_Row]:
        """Return side, number and text of the elements by the numbers of the top views."""
        rows: list[_Row] = []
        for piece in self._pieces:
            side = self._word(str(piece.side))
            lines = list(self._lines(piece.elements)) or [("–", "–")]
            rows += [(side if not number else "", *line) for number, line in enumerate(lines)]
        return rows

    def _lines(self, elements: Sequence[Element]) -> Iterator[tuple[str, str]]:
        """Yield the lines of the table: the number at the first one of each element."""
        for element in elements:
            named = f"{self._word(element.name)}: " if element.name else ""
            label = str(element.number)
            for line in _wrapped(named + element.text, self._width_mm - 40):
                yield label, line
                label = ""

    def _draw_plan(
        self, pen: _Pen, piece: DrawnInsole, view: View, at: tuple[float, float]
    ) -> None:
        """Draw a piece from above or below: shading, outline, height lines, sections, elements."""
        scale = self._scale
        sign = 1.0 if view == "top" else -1.0
        width, length, _ = piece.size_mm
        middle, first = piece.bounds_mm.mean(axis=0)[0], piece.bounds_mm[0, 1]

        def place(xy_mm: FloatArray) -> FloatArray:
            """Return places on the paper."""
            x = at[0] + sign * (xy_mm[:, 0] - middle) / scale
            return np.column_stack([x, at[1] + (xy_mm[:, 1] - first) / scale])

        outline = [place(closed(line)) for line in piece.outline]
        corners = place(
            np.array([[piece.x_mm[0], piece.y_mm[0]], [piece.x_mm[-1], piece.y_mm[-1]]])
        )
        pen.shaded(piece.seen[view].shading, corners, outline)
        pen.line_width(_FINE_PT, _THIN)
        for line in piece.seen[view].height_lines:
            pen.polyline(place(line))
        pen.line_width(_THICK_PT)
        for line in outline:
            pen.polyline(line)
        half = width / scale / 2
        if view == "top":
            for letter, section in piece.sections.items():
                y = at[1] + (section.at_mm - first) / scale
                pen.section_mark(at[0] - half - 2.5, at[0] + half + 2.5, y, letter)
            for element in piece.elements:
                if element.place_mm is not None:
                    x, y = place(np.array([element.place_mm]))[0]
                    pen.balloon(float(x), float(y), str(element.number))
            pen.dimension((at[0] - half, at[1]), (at[0] + half, at[1]), width, -5)
            pen.dimension(
                (at[0] + half, at[1]), (at[0] + half, at[1] + length / scale), length, -8.5
            )

    def _draw_profile(
        self, pen: _Pen, piece: DrawnInsole, medial: bool, at: tuple[float, float]
    ) -> None:
        """Draw a piece from its medial or lateral side: silhouette, and the near upper edge."""
        scale = self._scale
        toes_right = (piece.side.medial_sign > 0) == medial
        sign = 1.0 if toes_right else -1.0
        at = at[0] + 3.5 * sign, at[1]  # leaves room for the dimension behind the heel
        middle = piece.bounds_mm.mean(axis=0)[1]
        pen.line_width(_THICK_PT)
        for polygon in piece.profile:
            along = at[0] + sign * (polygon[:, 0] - middle) / scale
            pen.polygon(np.column_stack([along, at[1] + polygon[:, 1] / scale]), _SHADE)
        pen.line_width(_LINE_PT)
        rows = np.flatnonzero(piece.inside.any(axis=1))
        near = _edge_heights(piece.heights.top_mm[rows], from_right=toes_right)
        along = at[0] + sign * (piece.y_mm[rows] - middle) / scale
        pen.polyline(np.column_stack([along, at[1] + near / scale]))
        word = self._word("medial" if medial else "lateral")
        heading = f"{self._word(str(piece.side))}, {word}"
        pen.text(at[0], at[1] - 5, heading, bold=True, centred=True)
        ends = (self._word("heel"), self._word("toes"))
        left, right = ends if toes_right else ends[::-1]
        half = piece.size_mm[1] / scale / 2
        pen.text(at[0] - half, at[1] - 5, left, size=_SMALL_PT)
        pen.text(at[0] + half, at[1] - 5, right, size=_SMALL_PT, right=True)
        heel = at[0] - sign * half
        top_at = at[1] + piece.size_mm[2] / scale
        pen.dimension((heel, at[1]), (heel, top_at), piece.size_mm[2], sign * 4.0)


class ElementsPage(_Page):
    """The elements that find no room on the page of the views."""

    def __init__(
        self,
        rows: Sequence[_Row],
        size_mm: tuple[float, float],
        title: Mapping[str, str],
        words: Mapping[str, str],
    ) -> None:
        super().__init__(*size_mm, title, words)
        self._rows = rows

    @classmethod
    def parts(cls, rows: Sequence[_Row], size_mm: tuple[float, float]) -> list[Sequence[_Row]]:
        """Divide rows into those of one page each."""
        room = _rows_below(size_mm[1] - _TABLE_TOP_MM)
        return [_going_on(rows, first)[:room] for first in range(0, len(rows), room)]

    def _draw_content(self, pen: _Pen) -> None:
        self._draw_table(pen, self._height_mm - _TABLE_TOP_MM, self._rows)


class SectionsPage(_Page):
    """Sections of one piece at heel, arch and ball, and along it, with dimensions; its elements."""

    def __init__(
        self,
        piece: DrawnInsole,
        size_mm: tuple[float, float],
        title: Mapping[str, str],
        words: Mapping[str, str],
    ) -> None:
        self._piece = piece
        available = size_mm[0] - 50
        self._across = _scale_for(piece.size_mm[0], available)
        self._along = _scale_for(piece.size_mm[1], size_mm[0] - 30)
        scales = (self._across, self._along)
        scale = ", D–D ".join(_scale_text(each, words) for each in scales)
        super().__init__(*size_mm, {**title, "side": str(piece.side), "scale": scale}, words)

    def _draw_content(self, pen: _Pen) -> None:
        height = self._piece.size_mm[2]
        top = self._height_mm - 6.0
        for letter in self._piece.sections:
            base = top - 12 - height / self._across
            self._draw_across(pen, letter, (self._width_mm / 2, base))
            top = base - 11
        base = top - 8 - height / self._along
        self._draw_along(pen, (self._width_mm / 2, base))
        pen.scale_bar(6, _TITLE_MM + 5, 50, 1.0)

    def _draw_across(self, pen: _Pen, letter: str, at: tuple[float, float]) -> None:
        piece, scale = self._piece, self._across
        section = piece.sections[letter]
        left_mm, right_mm = section.ends_mm
        width = right_mm - left_mm
        heading = "   ".join(
            (f"{letter}–{letter}", self._word(section.name), f"y={section.at_mm:.0f}")
        )

        def place(along_mm: float) -> float:
            """Return a place along the cut on the paper."""
            return at[0] + (along_mm - (left_mm + right_mm) / 2) / scale

        pen.text(at[0], at[1] + piece.size_mm[2] / scale + 4, heading, bold=True, centred=True)
        pen.section(_on_paper(section, scale, place(0.0), at[1]))
        pen.dimension((place(left_mm), at[1]), (place(right_mm), at[1]), width, -_BELOW_ARROWS_MM)
        ends: tuple[tuple[Literal[0, 1], float, float], ...] = (
            (0, left_mm, 4.0), (1, right_mm, -4.0),
        )  # fmt: skip
        for end, along_mm, offset in ends:
            height, x = section.rim_mm(end), place(along_mm)
            pen.dimension((x, at[1]), (x, at[1] + height / scale), height, offset)
        thinnest, middle = section.thinnest_mm(), (left_mm + right_mm) / 2
        shown = [thinnest]
        if abs(middle - thinnest) / scale > _BESIDE_MM:
            shown.append(middle)
        for along_mm in shown:
            pen.thickness(section.heights_mm(along_mm), scale, (place(along_mm), at[1]))
        words = (self._word("lateral"), self._word("medial"))
        left, right = words if piece.side is Side.LEFT else words[::-1]
        pen.text(at[0] - width / scale / 2 - 18, at[1] + 1, left, size=_SMALL_PT, right=True)
        pen.text(at[0] + width / scale / 2 + 18, at[1] + 1, right, size=_SMALL_PT)

    def _draw_along(self, pen: _Pen, at: tuple[float, float]) -> None:
        """Draw the section along the axis of the foot, x = 0, the heel at the left."""
        piece, scale, section = self._piece, self._along, self._piece.lengthwise
        heel_mm, toes_mm = section.ends_mm
        origin = at[0] - (heel_mm + toes_mm) / 2 / scale
        heading = "   ".join(("D–D", self._word(section.name), "x=0"))
        pen.text(at[0], at[1] + piece.size_mm[2] / scale + 4, heading, bold=True, centred=True)
        pen.section(_on_paper(section, scale, origin, at[1]))
        for letter, across in piece.sections.items():
            x = origin + across.at_mm / scale
            if heel_mm < across.at_mm < toes_mm:
                pen.thickness(section.heights_mm(across.at_mm), scale, (x, at[1]))
            pen.text(x, at[1] - 6.8, letter, size=_SMALL_PT, centred=True)
        heel, toes = origin + heel_mm / scale - 3, origin + toes_mm / scale + 3
        pen.text(heel, at[1] + 1, self._word("heel"), size=_SMALL_PT, right=True)
        pen.text(toes, at[1] + 1, self._word("toes"), size=_SMALL_PT)


def _on_paper(section: Section, scale: float, x: float, y: float) -> list[FloatArray]:
    """Return the closed polygons of a section on the paper, its origin at (x, y)."""
    return [closed(polygon) / scale + [x, y] for polygon in section.polygons]


def closed(polygon: FloatArray) -> FloatArray:
    """Return a polygon with its first point at its end again."""
    return np.vstack([polygon, polygon[:1]])


def _wrapped(text: str, width_mm: float) -> list[str]:
    """Return the lines that a text takes in the letters of the table."""
    return list(simpleSplit(text, _FONT, _TEXT_PT, width_mm * mm))


def _broken(text: str, size: float, width_mm: float) -> list[str]:
    """Return the lines of a text, within a word broken only where it alone is wider than a line."""
    lines = []
    for line in simpleSplit(text, _FONT, size, width_mm * mm):
        first = 0
        while first < len(line):
            ends = range(len(line), first, -1)
            end = next(n for n in ends if _width_mm(line[first:n], size) <= width_mm)
            lines.append(line[first:end])
            first = end
    return lines


def _width_mm(text: str, size: float) -> float:
    return float(stringWidth(text, _FONT, size) / mm)


def _scale_for(length_mm: float, room_mm: float) -> float:
    """Return the largest usual scale at which a length finds room."""
    return next((scale for scale in SCALES if length_mm / scale <= room_mm), 2 * SCALES[-1])


def _views_scale(pieces: Sequence[DrawnInsole], size_mm: tuple[float, float]) -> float:
    column = size_mm[0] / (2 * len(pieces)) - 12
    half = size_mm[0] / len(pieces) - 21
    room = size_mm[1] - _TITLE_MM - 110
    wanted = [
        scale
        for width, length, _ in (piece.size_mm for piece in pieces)
        for scale in (
            _scale_for(width, column), _scale_for(length, room), _scale_for(length, half)
        )
    ]  # fmt: skip
    return max(wanted)


def _height_lines(piece: DrawnInsole, heights_mm: FloatArray) -> Iterator[FloatArray]:
    """Yield lines of equal height, (n, 2) each."""
    from scipy.ndimage import gaussian_filter

    smooth = gaussian_filter(_continued(heights_mm), 0.7)
    smooth[~piece.inside] = np.nan
    found = contour_generator(
        piece.x_mm, piece.y_mm, np.ma.masked_invalid(smooth), line_type=LineType.Separate
    )
    low, high = np.nanmin(smooth), np.nanmax(smooth)
    for level in np.arange(np.ceil(low / _CONTOUR_STEP_MM + 0.1), high / _CONTOUR_STEP_MM):
        for line in found.lines(level * _CONTOUR_STEP_MM):
            points = np.asarray(line, np.float32)[:, None]
            yield np.asarray(cv2.approxPolyDP(points, _STRAIGHT_MM, False)[:, 0], float)


def _shading(heights_mm: FloatArray, *, mirrored: bool) -> Image.Image:
    """Return the surface lit from the upper left, its first row at the top."""
    from scipy.ndimage import gaussian_filter

    smooth = gaussian_filter(_continued(heights_mm), 0.8)
    seen = -smooth[:, ::-1] if mirrored else smooth
    down, across = np.gradient(seen)
    lit = (0.5 * across - 0.5 * down + 0.9) / np.sqrt(across**2 + down**2 + 1)
    grey = np.clip(150 + 105 * lit, 110, 255).astype(np.uint8)
    picture = Image.fromarray(grey[::-1].copy())
    return picture.resize((2 * picture.width, 2 * picture.height), Image.Resampling.BICUBIC)


def _continued(heights_mm: FloatArray) -> FloatArray:
    """Return the heights, with those of the nearest place beside the solid."""
    from scipy.ndimage import distance_transform_edt

    outside = ~np.isfinite(heights_mm)
    rows, columns = distance_transform_edt(outside, return_distances=False, return_indices=True)
    return np.asarray(heights_mm[rows, columns], float)


def _edge_heights(top_mm: FloatArray, *, from_right: bool) -> FloatArray:
    """Return the upper edge of each row at one side: the highest of its outermost 3 mm."""
    rows = top_mm[:, ::-1] if from_right else top_mm
    first = np.argmax(np.isfinite(rows), axis=1)
    columns = np.minimum(first[:, None] + np.arange(3), rows.shape[1] - 1)
    return np.asarray(np.nanmax(np.take_along_axis(rows, columns, axis=1), axis=1), float)


def _scale_text(scale: float, words: Mapping[str, str]) -> str:
    sign = words.get(_DECIMAL_POINT, _DECIMAL_POINT)
    return f"1:{scale:g}".replace(_DECIMAL_POINT, sign)


def _rows_below(top_mm: float) -> int:
    """Return how many rows of a table find room below its heading."""
    return int((top_mm - _BELOW_HEADING_MM - _TITLE_MM - _OVER_TITLE_MM) / _ROW_MM)


def _going_on(rows: Sequence[_Row], first: int) -> list[_Row]:
    """Return the rows of a table from one on, which tells its side again."""
    side = next(side for side, _, _ in reversed(rows[: first + 1]) if side)
    _, label, text = rows[first]
    return [(side, label, text), *rows[first + 1 :]]


def _draw_title_block(
    pen: _Pen, width_mm: float, title: Mapping[str, str], words: Mapping[str, str]
) -> None:
    """Draw the title block in rows of four at the bottom, the last field to sign."""
    cells = [(words.get(key, key), words.get(text, text)) for key, text in title.items()]
    cells.append((words.get("approved", "approved"), " "))
    columns = 4
    rows = -(-len(cells) // columns)
    height, width = _TITLE_MM / rows, width_mm / columns
    pen.line_width(_LINE_PT)
    for number, (name, text) in enumerate(cells):
        row, column = divmod(number, columns)
        x, y = column * width, _TITLE_MM - (row + 1) * height
        is_last = number == len(cells) - 1
        pen.box(x, y, width_mm - x if is_last else width, height)
        pen.text(x + 1, y + height - 2.0, name, size=5.0)
        pen.fitted(x + 1.2, y, text or "–", (width - 2, height - 2.6))


class _Pen:
    """Draws on a canvas with lengths in mm.

    Parameters
    ----------
    decimal_sign
        Of the numbers that it writes.
    """

    def __init__(self, canvas: Canvas, decimal_sign: str) -> None:
        self._canvas = canvas
        self._decimal_sign = decimal_sign

    def line_width(self, points: float, color: colors.Color = _INK) -> None:
        self._canvas.setLineWidth(points)
        self._canvas.setStrokeColor(color)
        self._canvas.setDash()

    def box(self, x: float, y: float, width: float, height: float) -> None:
        self._canvas.rect(x * mm, y * mm, width * mm, height * mm)

    def line(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        self._canvas.line(start[0] * mm, start[1] * mm, end[0] * mm, end[1] * mm)

    def polyline(self, points: FloatArray) -> None:
        self._canvas.drawPath(self._path(points))

    def polygon(self, points: FloatArray, fill: colors.Color) -> None:
        self._canvas.setFillColor(fill)
        path = self._path(points)
        path.close()
        self._canvas.drawPath(path, fill=1)
        self._canvas.setFillColor(_INK)

    def shaded(self, picture: Image.Image, corners: FloatArray, clip: list[FloatArray]) -> None:
        """Draw a picture between two corners, within outlines."""
        self._canvas.saveState()
        path = self._canvas.beginPath()
        for line in clip:
            self._add(path, line)
            path.close()
        self._canvas.clipPath(path, stroke=0, fill=0)
        low, high = corners.min(axis=0) * mm, corners.max(axis=0) * mm
        self._canvas.drawImage(ImageReader(picture), *low, *(high - low))
        self._canvas.restoreState()

    def text(
        self,
        x: float,
        y: float,
        text: str,
        *,
        size: float = _TEXT_PT,
        bold: bool = False,
        centred: bool = False,
        right: bool = False,
    ) -> None:
        self._canvas.setFont(f"{_FONT}-Bold" if bold else _FONT, size)
        draw = self._canvas.drawRightString if right else self._canvas.drawString
        draw = self._canvas.drawCentredString if centred else draw
        draw(x * mm, y * mm, as_written(text))

    def fitted(self, x: float, y: float, text: str, room: tuple[float, float]) -> None:
        """Write a text above (x, y) as small as its room needs, in several lines if it has to be.

        It is never cut: a piece is told from others by what stands here.
        """
        for size in np.arange(_TEXT_PT + 1, 0, -0.5).tolist():
            lines = [text] if size >= _LEAST_LINE_PT else _broken(text, size, room[0])
            widest = max(_width_mm(as_written(line), size) for line in lines)
            leading = _LEADING * size / mm
            if widest <= room[0] and len(lines) * leading <= room[1]:
                break
        y += 1.4 if len(lines) == 1 else (len(lines) - 0.7) * leading
        for line in lines:
            self.text(x, y, line, size=size)
            y -= leading

    def dimension(
        self,
        start: tuple[float, float],
        end: tuple[float, float],
        value_mm: float,
        offset: float,
    ) -> None:
        """Draw a dimension line beside two points: below a level one, beside an upright one.

        Parameters
        ----------
        offset
            Distance on the paper; < 0 below, or at the right of an upright one.
        """
        self.line_width(_FINE_PT)
        text = self._number(value_mm)
        if abs(end[0] - start[0]) > abs(end[1] - start[1]):
            y = start[1] + offset
            for x in (start[0], end[0]):
                self.line((x, start[1] - 0.6), (x, y - 1))
            self._arrows((start[0], y), (end[0], y))
            self._label((start[0] + end[0]) / 2, y, text)
            return
        x = start[0] - offset
        for y in (start[1], end[1]):
            self.line((start[0] - np.sign(offset) * 0.6, y), (x - np.sign(offset), y))
        self._arrows((x, start[1]), (x, end[1]))
        if abs(end[1] - start[1]) > 12:
            self._label(x, (start[1] + end[1]) / 2, text, upright=True)
        else:
            beside = x - np.sign(offset) * 1.2
            self.text(beside, (start[1] + end[1]) / 2 - 0.9, text, right=offset > 0)

    def thickness(
        self, heights_mm: tuple[float, float], scale: float, at: tuple[float, float]
    ) -> None:
        """Draw a thickness over a place: arrows from outside onto both faces, the number above."""
        x, (low, high) = at[0], (at[1] + height / scale for height in heights_mm)
        value_mm = heights_mm[1] - heights_mm[0]
        self.line_width(_FINE_PT, _BLUE)
        for tip, away in ((high, 1.0), (low, -1.0)):
            self._arrow((x, tip + _THICKNESS_MM * away), (x, tip))
        self._canvas.setFillColor(_BLUE)
        self.text(x + 0.8, high + 2.4, self._number(value_mm))
        self._canvas.setFillColor(_INK)

    def section(self, polygons: Sequence[FloatArray]) -> None:
        """Draw a cut face with hatching."""
        self._canvas.saveState()
        path = self._canvas.beginPath()
        for polygon in polygons:
            self._add(path, polygon)
            path.close()
        self._canvas.clipPath(path, stroke=0, fill=0, fillMode=FILL_EVEN_ODD)
        self.line_width(_FINE_PT, _THIN)
        points = np.concatenate(polygons)
        low, high = points.min(axis=0), points.max(axis=0)
        for x in np.arange(low[0] - (high[1] - low[1]), high[0], 2.0):
            self.line((x, low[1]), (x + high[1] - low[1], high[1]))
        self._canvas.restoreState()
        self.line_width(_THICK_PT)
        for polygon in polygons:
            self.polyline(polygon)

    def section_mark(self, left: float, right: float, y: float, letter: str) -> None:
        """Draw the chain line of a section, with its letter at both ends."""
        self.line_width(_LINE_PT)
        self._canvas.setDash([6, 2, 1, 2])
        self.line((left, y), (right, y))
        self._canvas.setDash()
        self.text(left - 2.2, y + 0.6, letter, bold=True)
        self.text(right - 0.4, y + 0.6, letter, bold=True)

    def balloon(self, x: float, y: float, number: str) -> None:
        """Draw the number of an element in a circle."""
        self.line_width(_LINE_PT)
        self._canvas.setFillColor(colors.white)
        self._canvas.circle(x * mm, y * mm, 2.1 * mm, fill=1)
        self._canvas.setFillColor(_INK)
        self.text(x, y - 0.9, number, bold=True, centred=True)

    def scale_bar(self, x: float, y: float, length_mm: float, scale: float) -> None:
        """Draw a bar of a length on the piece, in five fields."""
        step = length_mm / 5 / scale
        self.line_width(_FINE_PT)
        for number in range(5):
            self._canvas.setFillColor(colors.white if number % 2 else _INK)
            self._canvas.rect((x + number * step) * mm, y * mm, step * mm, 1.4 * mm, fill=1)
        self._canvas.setFillColor(_INK)
        self.text(x, y + 2.4, "0", size=_SMALL_PT, centred=True)
        self.text(x + 5 * step, y + 2.4, f"{length_mm:g} mm", size=_SMALL_PT, centred=True)

    def _number(self, value_mm: float) -> str:
        return f"{value_mm:.1f}".replace(_DECIMAL_POINT, self._decimal_sign)

    def _label(self, x: float, y: float, text: str, *, upright: bool = False) -> None:
        self._canvas.saveState()
        self._canvas.translate(x * mm, y * mm)
        if upright:
            self._canvas.rotate(90)
        width = self._canvas.stringWidth(text, "DejaVuSans", _TEXT_PT) / mm + 1
        self._canvas.setFillColor(colors.white)
        self._canvas.rect(-width / 2 * mm, -1.3 * mm, width * mm, 2.6 * mm, fill=1, stroke=0)
        self._canvas.setFillColor(_INK)
        self.text(0, -0.9, text, centred=True)
        self._canvas.restoreState()

    def _arrows(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        """Draw a line with an arrow at both ends."""
        self._arrow(start, end)
        self._arrow(end, start)

    def _arrow(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        """Draw a line with an arrow at its end."""
        self.line(start, end)
        tip, tail = np.array(end), np.array(start)
        length = float(np.linalg.norm(tip - tail))
        if length == 0:
            return
        along = (tip - tail) / length * min(_ARROW_MM, length / 2)
        across = np.array([-along[1], along[0]]) * 0.17
        path = self._path(np.array([tip, tip - along + across, tip - along - across]))
        path.close()
        self._canvas.drawPath(path, fill=1, stroke=0)

    def _path(self, points: FloatArray) -> PDFPathObject:
        path = self._canvas.beginPath()
        self._add(path, points)
        return path

    @staticmethod
    def _add(path: PDFPathObject, points: FloatArray) -> None:
        (x, y), *others = (points * mm).tolist()
        path.moveTo(x, y)
        for x, y in others:
            path.lineTo(x, y)
