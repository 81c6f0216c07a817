"""Names of points in an image, without overlap, laid out again whenever the camera moves."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pyvista as pv

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_studio.scene.pointer import MarkedPoint
from insole_studio.scene.view_camera import ViewTransform

GAP_PX = 11.0
"""Gap between a point and its name."""
_ROW = 1.15
_ROWS = 9
_ASIDE_PX = (0.0, 26.0, 60.0)
_CLEAR_PX = 4.0
_END_ON = 0.8
"""Cosine of the angle to the line of sight above which a direction is not seen as one."""
_PADDING_PX = 3.0
_OPACITY = 0.75


def name_boxes(
    anchors_px: FloatArray, sizes_px: FloatArray, taken_px: FloatArray, room_px: tuple[int, int]
) -> FloatArray:
    """Place names without overlap, each at the first free candidate from near to far.

    Parameters
    ----------
    anchors_px, sizes_px : (n, 2) float64
        Positions of the points, and sizes of the names.
    taken_px : (m, 4) float64
        Boxes (left, top, right, bottom) that names must not cover.
    room_px
        Width and height of the image; names stay inside where possible.

    Returns
    -------
    (n, 4) float64
        Left, top, right, bottom. A name without any free candidate gets its nearest one.
    """
    dots = np.hstack([anchors_px - GAP_PX + 2, anchors_px + GAP_PX - 2])
    taken = np.vstack([taken_px, dots])
    boxes = np.zeros((len(anchors_px), 4))
    for i in np.lexsort((anchors_px[:, 0], anchors_px[:, 1])):
        tried = _candidates(anchors_px[i], sizes_px[i])
        free = ~is_covered(tried, taken)
        inside = (tried[:, :2] >= 0).all(axis=1) & (tried[:, 2:] <= room_px).all(axis=1)
        boxes[i] = tried[int((free & inside).argmax())]
        taken = np.vstack([taken, boxes[i]])
    return boxes


def leader_ends(anchors_px: FloatArray, boxes_px: FloatArray) -> FloatArray:
    """Return where the leader line from each point meets its name.

    Parameters
    ----------
    anchors_px : (n, 2) float64
        Positions of the points.
    boxes_px : (n, 4) float64
        Left, top, right, bottom of the names.

    Returns
    -------
    (n, 2) float64
        NaN where the name stands directly beside its point.
    """
    near = np.clip(anchors_px, boxes_px[:, :2], boxes_px[:, 2:])
    near[:, 1] = boxes_px[:, 1::2].mean(axis=1)
    away = np.hypot(*(near - anchors_px).T) > GAP_PX + 2
    return np.where(away[:, None], near, np.nan)


def is_covered(boxes_px: FloatArray, taken_px: FloatArray) -> BoolArray:
    """Return which boxes (n, 4) overlap any of the taken ones (m, 4): left, top, right, bottom."""
    return np.asarray(_overlap(boxes_px, taken_px).any(axis=1))


def is_across_view(places: FloatArray, look: ViewTransform) -> BoolArray:
    """Return which of the places (n, 3) around a thing are beside it, not before or behind it."""
    return np.abs(_outwards(places) @ look.back) < _END_ON


def moved_clear(
    places: FloatArray, half_px: FloatArray, gaps_mm: FloatArray, look: ViewTransform
) -> FloatArray:
    """Move words around a thing outwards until none of them touches it, however small it is seen.

    Parameters
    ----------
    places : (n, 3) float64
        The middles of the words.
    half_px : (n, 2) float64
        Half of their widths and heights.
    gaps_mm : (n,) float64
        How far the middles are from the thing.

    Returns
    -------
    (n, 3) float64
    """
    outwards = _outwards(places)
    seen = np.abs(np.stack([outwards @ look.right, outwards @ look.up], axis=1))
    needed_px = (seen * half_px).sum(axis=1) + _CLEAR_PX
    shown_px = gaps_mm * np.linalg.norm(seen, axis=1) / look.mm_per_px
    missing_mm = np.maximum(needed_px - shown_px, 0.0) * look.mm_per_px
    return places + missing_mm[:, None] * outwards


def moved_into_image(places: FloatArray, half_px: FloatArray, look: ViewTransform) -> FloatArray:
    """Move words that the border of the image cuts, until they are whole.

    Parameters
    ----------
    places : (n, 3) float64
        The middles of the words.
    half_px : (n, 2) float64
        Half of their widths and heights.

    Returns
    -------
    (n, 3) float64
        Words wholly outside stay there.
    """
    middle, room = look.pixels_of(places), np.array(look.size_px)
    in_sight = ((middle > -half_px) & (middle < room + half_px)).all(axis=1, keepdims=True)
    inside = np.clip(middle, half_px, np.maximum(room - half_px, half_px))
    shift = np.where(in_sight, inside - middle, 0.0) * look.mm_per_px
    return places + shift[:, :1] * look.right - shift[:, 1:] * look.up


def moved_off(
    places: FloatArray, half_px: FloatArray, taken_px: FloatArray, look: ViewTransform
) -> FloatArray:
    """Move words up or down the image, whichever is nearer, until no label covers them.

    Parameters
    ----------
    places : (n, 3) float64
        The middles of the words.
    half_px : (n, 2) float64
        Half of their widths and heights.
    taken_px : (m, 4) float64
        Boxes (left, top, right, bottom) of the labels.

    Returns
    -------
    (n, 3) float64
    """
    middle = look.pixels_of(places)
    boxes = np.hstack([middle - half_px, middle + half_px])
    down_px = np.zeros(len(places))
    for number, over in enumerate(_overlap(boxes, taken_px)):
        if over.any():
            down = taken_px[over, 3].max() - boxes[number, 1] + _CLEAR_PX
            up = boxes[number, 3] - taken_px[over, 1].min() + _CLEAR_PX
            down_px[number] = down if down < up else -up
    return np.asarray(places - down_px[:, None] * look.mm_per_px * look.up)


def _outwards(places: FloatArray) -> FloatArray:
    """Return the unit vectors (n, 3) from the middle of places around a thing to each of them."""
    away = places - places.mean(axis=0)
    return np.asarray(away / np.linalg.norm(away, axis=1, keepdims=True))


def _candidates(anchor: FloatArray, size: FloatArray) -> FloatArray:
    """Return candidate boxes (k, 4): right and left of the point, then row by row up and down."""
    rows = sorted(range(-_ROWS, _ROWS + 1), key=lambda row: (abs(row), row))
    corners = [
        (x, anchor[1] + (row * _ROW - 0.5) * size[1])
        for row in rows
        for aside in _ASIDE_PX
        for x in (anchor[0] + GAP_PX + aside, anchor[0] - GAP_PX - aside - size[0])
    ]
    start = np.array(corners)
    return np.hstack([start, start + size])


def _overlap(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return whether boxes a (k, 4) and b (m, 4) overlap, (k, m)."""
    a, b = a[:, None], b[None]
    return np.asarray(
        (a[..., 0] < b[..., 2])
        & (b[..., 0] < a[..., 2])
        & (a[..., 1] < b[..., 3])
        & (b[..., 1] < a[..., 3])
    )


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
