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

import numpy as np
from contourpy import LineType, contour_generator
from PIL import Image
from reportlab.lib import colors
from reportlab.lib.units import mm
from reportlab.lib.utils import ImageReader
from reportlab.pdfgen.canvas import Canvas
from reportlab.pdfgen.pathobject import PDFPathObject
from reportlab.platypus import Flowable

from insole_core.export.lettering import as_written
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.height_map import HeightMap
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side

SCALES: Final = (1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0)
STATIONS: Final = (("A", "ball", 0.72), ("B", "arch", 0.45), ("C", "heel", 0.12))
"""Letter and name of each section across, and its place as a share of the length."""
_INK, _THIN, _SHADE = colors.black, colors.HexColor("#7a7a7a"), colors.HexColor("#dcdcdc")
_BLUE: Final = colors.HexColor("#1f4e8c")
_THICK_PT, _LINE_PT, _FINE_PT = 0.9, 0.45, 0.25
_TEXT_PT, _SMALL_PT = 7.0, 6.0
_ARROW_MM: Final = 1.6
_CONTOUR_STEP_MM: Final = 2.0
_GAP_MM: Final = 7.0
_TITLE_MM: Final = 34.0

View = Literal["top", "bottom"]


@dataclass(frozen=True)
class Element:
    """A post, pad or correction of the table beside a drawing.

    Parameters
    ----------
    place_mm
        x and y in the frame of the drawing; None for what has no one place.
    """

    number: int
    text: str
    place_mm: tuple[float, float] | None = None


@dataclass(frozen=True, eq=False)
class DrawnInsole:
    """A piece to draw: x to the patient's right, y from heel to toes, standing on z = 0.

    Parameters
    ----------
    heights
        Of the solid.
    """

    side: Side
    solid: TriangleMesh
    heights: HeightMap
    elements: tuple[Element, ...] = ()

    @cached_property
    def size_mm(self) -> tuple[float, float, float]:
        """Width, length and height of the solid."""
        width, length, height = (self.solid.bounds_mm[1] - self.solid.bounds_mm[0]).tolist()
        return width, length, height

    def x_range_mm(self, y_mm: float) -> tuple[float, float]:
        """Return the least and greatest x of the solid in a plane across it."""
        edges = self.solid.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
        starts, ends = (self.solid.vertices[edges[:, end]] for end in (0, 1))
        before, behind = starts[:, 1] - y_mm, ends[:, 1] - y_mm
        cut = before * behind < 0
        share = before[cut] / (before[cut] - behind[cut])
        x = starts[cut, 0] + share * (ends[cut, 0] - starts[cut, 0])
        return float(x.min()), float(x.max())

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

    def station_y_mm(self, share: float) -> float:
        """Return the place of a section across, on a row of the height map."""
        rows = np.flatnonzero(self.inside.any(axis=1))
        return float(self.y_mm[int(rows[0] + share * np.ptp(rows))])


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
        pen = _Pen(self.canv)
        self.canv.setFillColor(_INK)
        pen.line_width(_THICK_PT)
        pen.box(0, 0, self._width_mm, self._height_mm)
        _draw_title_block(pen, self._width_mm, self._title, self._words)
        self._draw_content(pen)

    def _draw_content(self, pen: _Pen) -> None:
        raise NotImplementedError

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
    ) -> None:
        self._pieces = pieces
        self._scale = _views_scale(pieces, size_mm)
        super().__init__(*size_mm, {**title, "scale": f"1:{self._scale:g}"}, words)

    def _draw_content(self, pen: _Pen) -> None:
        count = 2 * len(self._pieces)
        column = self._width_mm / count
        longest = max(piece.size_mm[1] for piece in self._pieces) / self._scale
        low = self._height_mm - 18 - longest
        views: tuple[View, ...] = ("top", "bottom")
        cells = [(piece, view) for piece in self._pieces for view in views]
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
        self._draw_table(pen, low - 61)

    def _draw_table(self, pen: _Pen, top: float) -> None:
        """List the elements by the numbers of the top views; what finds no room is counted."""
        pen.text(6, top, self._word("posts and pads"), bold=True)
        rows: list[tuple[str, str]] = []
        for piece in self._pieces:
            rows.append((self._word(str(piece.side)), "" if piece.elements else "–"))
            rows += _wrapped(piece.elements, self._width_mm - 24)
        room = max(int((top - _TITLE_MM - 16) / 3.6), 1)
        for number, (label, text) in enumerate(rows[:room]):
            y = top - 4.5 - 3.6 * number
            pen.text(8, y, label)
            pen.text(14, y, text)
        if len(rows) > room:
            pen.text(14, top - 4.5 - 3.6 * room, f"+{len(rows) - room}")

    def _draw_plan(
        self, pen: _Pen, piece: DrawnInsole, view: View, at: tuple[float, float]
    ) -> None:
        """Draw a piece from above or below: shading, outline, height lines, sections, elements."""
        scale = self._scale
        sign = 1.0 if view == "top" else -1.0
        width, length, _ = piece.size_mm
        inside = piece.inside
        middle = float(piece.x_mm[inside.any(axis=0)].mean())
        first = float(piece.y_mm[inside.any(axis=1)][0])

        def place(xy_mm: FloatArray) -> FloatArray:
            """Return places on the paper."""
            x = at[0] + sign * (xy_mm[:, 0] - middle) / scale
            return np.column_stack([x, at[1] + (xy_mm[:, 1] - first) / scale])

        outline = [place(line) for line in _outline(piece)]
        heights = piece.heights.top_mm if view == "top" else piece.heights.bottom_mm
        corners = place(
            np.array([[piece.x_mm[0], piece.y_mm[0]], [piece.x_mm[-1], piece.y_mm[-1]]])
        )
        pen.shaded(_shading(heights, mirrored=view == "bottom"), corners, outline)
        pen.line_width(_FINE_PT, _THIN)
        for line in _height_lines(piece, heights):
            pen.polyline(place(line))
        pen.line_width(_THICK_PT)
        for line in outline:
            pen.polyline(line)
        half = width / scale / 2
        if view == "top":
            for letter, _, share in STATIONS:
                y = at[1] + (piece.station_y_mm(share) - first) / scale
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
        rows = np.flatnonzero(piece.inside.any(axis=1))
        y_mm = piece.y_mm[rows]
        top, bottom = piece.heights.top_mm[rows], piece.heights.bottom_mm[rows]
        along = at[0] + sign * (y_mm - y_mm.mean()) / scale
        high, low = np.nanmax(top, axis=1) / scale, np.nanmin(bottom, axis=1) / scale
        points = np.column_stack(
            [np.r_[along, along[::-1]], at[1] + np.r_[high, low[::-1]]]
        )  # fmt: skip
        pen.line_width(_THICK_PT)
        pen.polygon(points, _SHADE)
        pen.line_width(_LINE_PT)
        near = _edge_heights(top, from_right=toes_right)
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
        scale = ", D–D ".join(f"1:{each:g}" for each in (self._across, self._along))
        super().__init__(*size_mm, {**title, "side": str(piece.side), "scale": scale}, words)

    def _draw_content(self, pen: _Pen) -> None:
        height = self._piece.size_mm[2]
        top = self._height_mm - 6.0
        for letter, name, share in STATIONS:
            base = top - 12 - height / self._across
            self._draw_across(pen, letter, name, share, (self._width_mm / 2, base))
            top = base - 11
        base = top - 8 - height / self._along
        self._draw_along(pen, (self._width_mm / 2, base))
        pen.scale_bar(6, _TITLE_MM + 5, 50, 1.0)

    def _draw_across(
        self, pen: _Pen, letter: str, name: str, share: float, at: tuple[float, float]
    ) -> None:
        piece, scale = self._piece, self._across
        row = round(piece.station_y_mm(share) - piece.y_mm[0])
        columns = np.flatnonzero(piece.inside[row])
        x = piece.x_mm[columns]
        top, bottom = piece.heights.top_mm[row, columns], piece.heights.bottom_mm[row, columns]
        left_mm, right_mm = piece.x_range_mm(piece.station_y_mm(share) + 1e-4)  # beside vertices
        width = right_mm - left_mm
        y_mm = f"y={piece.station_y_mm(share):.0f}"
        heading = "   ".join((f"{letter}–{letter}", self._word(name), y_mm))
        x = np.clip(x, left_mm, right_mm)
        x[[0, -1]] = left_mm, right_mm
        place = at[0] + (x - (left_mm + right_mm) / 2) / scale
        pen.text(at[0], at[1] + piece.size_mm[2] / scale + 4, heading, bold=True, centred=True)
        pen.section(place, at[1] + top / scale, at[1] + bottom / scale)
        pen.dimension((place[0], at[1]), (place[-1], at[1]), width, -5)
        for index, offset in ((0, 4.0), (len(x) - 1, -4.0)):
            edge = slice(0, 4) if index == 0 else slice(-4, None)
            height = float(top[edge].max())
            pen.dimension(
                (place[index], at[1]), (place[index], at[1] + height / scale), height, offset
            )
        lowest = 4 + int(np.argmin((top - bottom)[4:-4])) if len(x) > 12 else len(x) // 2
        for column in dict.fromkeys((len(x) // 2, lowest)):
            pen.thickness(
                place[column],
                at[1] + bottom[column] / scale,
                at[1] + top[column] / scale,
                top[column] - bottom[column],
            )
        words = (self._word("lateral"), self._word("medial"))
        left, right = words if piece.side is Side.LEFT else words[::-1]
        pen.text(at[0] - width / scale / 2 - 18, at[1] + 1, left, size=_SMALL_PT, right=True)
        pen.text(at[0] + width / scale / 2 + 18, at[1] + 1, right, size=_SMALL_PT)

    def _draw_along(self, pen: _Pen, at: tuple[float, float]) -> None:
        """Draw the section along the axis of the foot, x = 0, the heel at the left."""
        piece, scale = self._piece, self._along
        column = int(np.argmin(np.abs(piece.x_mm)))
        rows = np.flatnonzero(piece.inside[:, column])
        y = piece.y_mm[rows]
        top, bottom = piece.heights.top_mm[rows, column], piece.heights.bottom_mm[rows, column]
        place = at[0] + (y - y.mean()) / scale
        heading = "   ".join(("D–D", self._word("along the axis"), "x=0"))
        pen.text(at[0], at[1] + piece.size_mm[2] / scale + 4, heading, bold=True, centred=True)
        pen.section(place, at[1] + top / scale, at[1] + bottom / scale)
        for letter, _, share in STATIONS:
            index = int(np.argmin(np.abs(y - piece.station_y_mm(share))))
            pen.thickness(
                place[index],
                at[1] + bottom[index] / scale,
                at[1] + top[index] / scale,
                top[index] - bottom[index],
            )
            pen.text(place[index], at[1] - 6.8, letter, size=_SMALL_PT, centred=True)
        pen.text(place[0] - 3, at[1] + 1, self._word("heel"), size=_SMALL_PT, right=True)
        pen.text(place[-1] + 3, at[1] + 1, self._word("toes"), size=_SMALL_PT)


def _wrapped(elements: Sequence[Element], width_mm: float) -> Iterator[tuple[str, str]]:
    """Yield the lines of the table: the number at the first one of each element."""
    most = int(width_mm / 1.32)
    for element in elements:
        label, line = str(element.number), ""
        for word in element.text.split():
            if line and len(line) + 1 + len(word) > most:
                yield label, line
                label, line = "", ""
            line = f"{line} {word}".strip()
        yield label, line


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


def _outline(piece: DrawnInsole) -> list[FloatArray]:
    """Return the outline seen from above, (n, 2) each, smoothed below the pixel."""
    from scipy.ndimage import gaussian_filter

    padded = np.pad(piece.inside.astype(float), 3)
    x = piece.x_mm[0] - 3 + np.arange(float(padded.shape[1]))
    y = piece.y_mm[0] - 3 + np.arange(float(padded.shape[0]))
    lines = contour_generator(
        x, y, gaussian_filter(padded, 0.8), line_type=LineType.Separate
    ).lines(0.5)  # fmt: skip
    return [np.asarray(line, float) for line in lines]


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
            yield np.asarray(line, float)


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


def _draw_title_block(
    pen: _Pen, width_mm: float, title: Mapping[str, str], words: Mapping[str, str]
) -> None:
    """Draw the title block in rows of four at the bottom, then fields to sign."""
    cells = [(words.get(key, key), words.get(text, text)) for key, text in title.items()]
    cells += [(words.get(key, key), " ") for key in ("drawn", "approved")]  # to be signed
    columns = 4
    rows = -(-len(cells) // columns)
    height, width = _TITLE_MM / rows, width_mm / columns
    pen.line_width(_LINE_PT)
    for number, (name, text) in enumerate(cells):
        row, column = divmod(number, columns)
        x, y = column * width, _TITLE_MM - (row + 1) * height
        pen.box(x, y, width, height)
        pen.text(x + 1, y + height - 2.6, name, size=5.0)
        pen.fitted(x + 1.2, y + 1.7, text or "–", width - 2)


class _Pen:
    """Draws on a canvas with lengths in mm."""

    def __init__(self, canvas: Canvas) -> None:
        self._canvas = canvas

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
        self._canvas.setFont("DejaVuSans-Bold" if bold else "DejaVuSans", size)
        draw = self._canvas.drawRightString if right else self._canvas.drawString
        draw = self._canvas.drawCentredString if centred else draw
        draw(x * mm, y * mm, as_written(text))

    def fitted(self, x: float, y: float, text: str, width: float) -> None:
        """Write a text as small as its room needs, cut at the end if that is too small."""
        size = _TEXT_PT + 1
        text = as_written(text)
        while size > 5 and self._canvas.stringWidth(text, "DejaVuSans", size) > width * mm:
            size -= 0.5
        while self._canvas.stringWidth(text, "DejaVuSans", size) > width * mm:
            text = text[:-2] + "…"
        self.text(x, y, text, size=size)

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
        text = f"{value_mm:.1f}"
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

    def thickness(self, x: float, low: float, high: float, value_mm: float) -> None:
        """Draw a thickness: arrows from outside onto both faces, the number above."""
        self.line_width(_FINE_PT, _BLUE)
        for tip, away in ((high, 1.0), (low, -1.0)):
            self._arrow((x, tip + 4 * away), (x, tip))
        self._canvas.setFillColor(_BLUE)
        self.text(x + 0.8, high + 2.4, f"{value_mm:.1f}")
        self._canvas.setFillColor(_INK)

    def section(self, place: FloatArray, top: FloatArray, bottom: FloatArray) -> None:
        """Draw a cut face with hatching."""
        points = np.column_stack([np.r_[place, place[::-1]], np.r_[top, bottom[::-1]]])
        self._canvas.saveState()
        path = self._path(points)
        path.close()
        self._canvas.clipPath(path, stroke=0, fill=0)
        self.line_width(_FINE_PT, _THIN)
        low, high = points.min(axis=0), points.max(axis=0)
        for x in np.arange(low[0] - (high[1] - low[1]), high[0], 2.0):
            self.line((x, low[1]), (x + high[1] - low[1], high[1]))
        self._canvas.restoreState()
        self.line_width(_THICK_PT)
        self.polyline(np.vstack([points, points[:1]]))

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
