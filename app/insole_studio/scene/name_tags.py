"""Names of points, laid out again whenever the camera moves."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pyvista as pv

from insole_core.geometry.arrays import FloatArray
from insole_studio.scene.label_layout import leader_ends, name_boxes
from insole_studio.scene.pointer import MarkedPoint
from insole_studio.scene.view_camera import ViewTransform

_PADDING_PX = 3.0
_OPACITY = 0.75


class NameTags:
    """The name tags of one view, drawn over everything on a background of the scene's colour."""

    def __init__(self, plotter: Any) -> None:
        self._plotter = plotter
        self.pixel_ratio = 1.0
        self._texts: list[pv.Text] = []
        self._places = np.zeros((0, 3))
        self._sizes = np.zeros((0, 2))

    def show(self, points: Sequence[MarkedPoint], size: int, color: str, sheet: str) -> None:
        """Replace the tags; `place` then sets their positions.

        Parameters
        ----------
        points
            The named points, mm, insole frame.
        size
            Font size.
        color, sheet
            Colours of the text and of its background.
        """
        for number in range(len(self._texts)):
            self._plotter.remove_actor(f"name-{number}", render=False)
        self._places = np.array([p.position_mm for p in points], dtype=float).reshape(-1, 3)
        self._texts = [self._text(point.text, size, color, sheet) for point in points]
        for number, text in enumerate(self._texts):
            self._plotter.add_actor(text, name=f"name-{number}", render=False)
        self._sizes = np.array([self._size(text) for text in self._texts]).reshape(-1, 2)

    def place(self, look: ViewTransform, taken_px: FloatArray) -> list[FloatArray]:
        """Place the tags beside their points.

        Parameters
        ----------
        look
            The current view transform.
        taken_px : (m, 4) float64
            Boxes (left, top, right, bottom) that other texts occupy.

        Returns
        -------
        list of (2, 3) float64
            Leader lines from points to tags, mm.
        """
        anchors = look.pixels_of(self._places) if len(self._places) else np.zeros((0, 2))
        boxes = name_boxes(anchors, self._sizes, taken_px, look.size_px)
        for text, (left, _, _, bottom) in zip(self._texts, boxes, strict=True):
            up = look.size_px[1] - bottom
            text.position = (
                (left + _PADDING_PX) * self.pixel_ratio,
                (up + _PADDING_PX) * self.pixel_ratio,
            )
        ends = leader_ends(anchors, boxes)
        return [
            np.stack([place, look.point_at(*end)])
            for place, end in zip(self._places, ends, strict=True)
            if np.isfinite(end).all()
        ]

    def _text(self, words: str, size: int, color: str, sheet: str) -> pv.Text:
        text = pv.Text(words)
        text.prop = pv.TextProperty(
            color=color, font_size=size, background_color=sheet, background_opacity=_OPACITY
        )
        return text

    def _size(self, text: pv.Text) -> tuple[float, float]:
        """Return width and height of a text in pixels of the image."""
        box = [0.0] * 4
        text.GetBoundingBox(self._plotter.renderer, box)
        return (
            (box[1] - box[0]) / self.pixel_ratio + 2 * _PADDING_PX,
            (box[3] - box[2]) / self.pixel_ratio + 2 * _PADDING_PX,
        )
