"""Heights of solids from above as a picture on paper, with axes in mm and a key of the colours."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from PIL import Image
from reportlab.lib import colors
from reportlab.lib.utils import ImageReader
from reportlab.platypus import Flowable

from insole_core.export.lettering import as_written
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.height_map import HeightMap

_FONT: Final = "DejaVuSans"
_SMALL_PT: Final = 6.0
_FAILED: Final = colors.HexColor("#b3261e")
_COLOURS: Final = np.array(
    [(68, 1, 84), (59, 82, 139), (33, 145, 140), (94, 201, 98), (253, 231, 37)], float
)
"""From low to high; the lightness rises steadily, so that it can be read in black and white."""
_STEPS_MM: Final = (20.0, 50.0, 100.0)
_MARGIN_PT: Final = 22.0
_KEY_PT: Final = 40.0

Place = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class MappedHeights:
    """A solid of a picture.

    Parameters
    ----------
    heights : mm, frame of the picture
    failed_mm
        Places that are crossed out.
    labels
        x, y and a text each.
    """

    heights: HeightMap
    failed_mm: Sequence[Place] = ()
    labels: tuple[tuple[float, float, str], ...] = ()


class HeightPicture(Flowable):  # type: ignore[misc, unused-ignore]
    """Solids seen from above, to one scale.

    Parameters
    ----------
    frame_mm
        Least x and y, greatest x and y.
    height_pt
        Of the whole picture on the paper, at most.
    least_pt
        Height to which it shrinks so that it fits what is left of a page; by default not at all.
    most_mm
        Greatest height of the key; None for that of the solids.
    block_mm
        Least x and y, greatest x and y of a block, which is outlined.
    """

    def __init__(
        self,
        mapped: Sequence[MappedHeights],
        frame_mm: tuple[float, float, float, float],
        height_pt: float,
        *,
        least_pt: float | None = None,
        most_mm: float | None = None,
        block_mm: tuple[float, float, float, float] | None = None,
    ) -> None:
        super().__init__()
        self._mapped, self._frame_mm, self._block_mm = mapped, frame_mm, block_mm
        tops = [float(np.nanmax(each.heights.top_mm)) for each in mapped]
        self._most_mm = max(most_mm or max(tops), 1e-9)
        self._least_pt, self._most_pt = height_pt if least_pt is None else least_pt, height_pt
        self.wrap(np.inf, height_pt)

    def wrap(self, width: float, height: float) -> tuple[float, float]:
        """Return the size: as high as it may be and as the page lets it, and no wider."""
        left, low, right, high = self._frame_mm
        tall = min(max(height, self._least_pt), self._most_pt)
        self._scale = min(
            (tall - _MARGIN_PT) / (high - low), (width - _MARGIN_PT - _KEY_PT) / (right - left)
        )
        self.width = _MARGIN_PT + (right - left) * self._scale + _KEY_PT
        self.height = _MARGIN_PT + (high - low) * self._scale
        return self.width, self.height

    def draw(self) -> None:
        """Draw the solids, the axes, and the key."""
        canvas = self.canv
        for each in self._mapped:
            left, right, low, high = each.heights.extent_mm
            x, y = self._place(left, low)
            size = (right - left) * self._scale, (high - low) * self._scale
            canvas.drawImage(self._coloured(each.heights.top_mm), x, y, *size, mask="auto")
        self._draw_axes()
        for each in self._mapped:
            for x_mm, y_mm, _ in each.failed_mm:
                self._cross(*self._place(x_mm, y_mm))
            for x_mm, y_mm, text in each.labels:
                self._label(*self._place(x_mm, y_mm), as_written(text))
        self._draw_key()

    def _place(self, x_mm: float, y_mm: float) -> tuple[float, float]:
        left, low, _, _ = self._frame_mm
        return (
            _MARGIN_PT + (x_mm - left) * self._scale,
            _MARGIN_PT + (y_mm - low) * self._scale,
        )

    def _coloured(self, heights_mm: FloatArray) -> ImageReader:
        share = np.clip(np.nan_to_num(heights_mm / self._most_mm), 0, 1)
        places = np.linspace(0, 1, len(_COLOURS))
        rgb = [np.interp(share, places, channel) for channel in _COLOURS.T]
        seen = np.where(np.isfinite(heights_mm), 255.0, 0.0)
        pixels = np.stack([*rgb, seen], axis=-1).astype(np.uint8)
        return ImageReader(Image.fromarray(pixels[::-1].copy()))

    def _draw_axes(self) -> None:
        canvas, (left, low, right, high) = self.canv, self._frame_mm
        canvas.setStrokeColor(colors.black)
        canvas.setFillColor(colors.black)
        canvas.setFont(_FONT, _SMALL_PT)
        canvas.setLineWidth(0.5)
        canvas.rect(
            *self._place(left, low), (right - left) * self._scale, (high - low) * self._scale
        )
        if self._block_mm is not None:
            canvas.setLineWidth(1.5)
            x, y = self._place(*self._block_mm[:2])
            far_x, far_y = self._place(*self._block_mm[2:])
            canvas.rect(x, y, far_x - x, far_y - y)
            canvas.setLineWidth(0.5)
        room_mm = 24 / self._scale
        step = next((step for step in _STEPS_MM if step >= room_mm), _STEPS_MM[-1])
        for x_mm in np.arange(np.ceil(left / step) * step, right, step):
            x, y = self._place(x_mm, low)
            canvas.line(x, y, x, y - 3)
            canvas.drawCentredString(x, y - 10, f"{x_mm + 0.0:g}")
        for y_mm in np.arange(np.ceil(low / step) * step, high, step):
            x, y = self._place(left, y_mm)
            canvas.line(x, y, x - 3, y)
            canvas.drawRightString(x - 4, y - 2, f"{y_mm + 0.0:g}")
        canvas.drawString(self._place(right, low)[0] - 18, 2, "x, mm")
        canvas.drawString(0, self._place(left, high)[1] - 6, "y")

    def _draw_key(self) -> None:
        canvas, (_, low, right, high) = self.canv, self._frame_mm
        x, bottom = self._place(right, low)
        _, top = self._place(right, high)
        bottom, top = bottom + (top - bottom) * 0.2, top - (top - bottom) * 0.2
        shades = np.linspace(0, self._most_mm, 64)[:, None]
        canvas.drawImage(self._coloured(shades), x + 8, bottom, 6, top - bottom, mask="auto")
        canvas.setStrokeColor(colors.black)
        canvas.setFillColor(colors.black)
        canvas.setFont(_FONT, _SMALL_PT)
        canvas.setLineWidth(0.5)
        canvas.rect(x + 8, bottom, 6, top - bottom)
        for share in (0.0, 0.5, 1.0):
            y = bottom + share * (top - bottom)
            canvas.drawString(x + 17, y - 2, f"{share * self._most_mm:.0f} mm")

    def _cross(self, x: float, y: float) -> None:
        for color, width in ((colors.white, 3.6), (_FAILED, 1.6)):
            self.canv.setStrokeColor(color)
            self.canv.setLineWidth(width)
            self.canv.line(x - 4, y - 4, x + 4, y + 4)
            self.canv.line(x - 4, y + 4, x + 4, y - 4)

    def _label(self, x: float, y: float, text: str) -> None:
        canvas = self.canv
        width = canvas.stringWidth(text, _FONT, 8) + 4
        canvas.setFillColor(colors.white)
        canvas.rect(x - width / 2, y - 3, width, 11, fill=1, stroke=0)
        canvas.setFillColor(colors.black)
        canvas.setFont(_FONT, 8)
        canvas.drawCentredString(x, y, text)
