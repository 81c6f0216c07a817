"""What a program leaves of a block: removal of material on a height field, from its text alone."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
import numpy.typing as npt

_TOGETHER = 1000
"""Samples of a path whose pixels are looked at together."""
_WORD = re.compile(r"([A-Z])(-?\d*\.?\d+)")
FloatArray = npt.NDArray[np.float64]


@dataclass
class Tool:
    shape: Literal["flat", "ball"]
    radius_mm: float

    def height(self, distance2: FloatArray) -> FloatArray:
        if self.shape == "flat":
            return np.zeros_like(distance2)
        return self.radius_mm - np.sqrt(np.maximum(self.radius_mm**2 - distance2, 0))


def along(
    starts: FloatArray, ends: FloatArray, counts: FloatArray
) -> tuple[npt.NDArray[np.int64], FloatArray]:
    """Evenly spaced places (m, 3) on moves (n, 3), at least as many as asked, and their moves."""
    pieces = np.maximum(np.ceil(counts).astype(int), 1)
    move = np.repeat(np.arange(len(pieces)), pieces)
    number = np.arange(len(move)) - np.repeat(np.cumsum(pieces) - pieces, pieces) + 1
    return move, starts[move] + (ends - starts)[move] * (number / pieces[move])[:, None]


@dataclass
class Removal:
    """A block on whose top material is removed; `heights` is (x, y), above its bottom."""

    block_mm: tuple[float, float, float]
    origin_mm: tuple[float, float, float]
    tools: dict[int, Tool]
    along_x: bool = False
    flip: Literal["length", "width"] = "length"
    pitch_mm: float = 0.25
    sides: list[FloatArray] = field(default_factory=list)
    rapid_cuts_mm: float = 0.0
    low_mm: FloatArray = field(default_factory=lambda: np.full(3, np.inf))
    high_mm: FloatArray = field(default_factory=lambda: np.full(3, -np.inf))
    words: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        counts = [round(size / self.pitch_mm) for size in self.block_mm[:2]]
        self.x_mm, self.y_mm = ((np.arange(n) + 0.5) * self.pitch_mm for n in counts)
        self.heights = np.full(counts, float(self.block_mm[2]))
        self.from_below = np.zeros(counts)

    def run(self, text: str) -> None:
        tool, mode, turned = 0, "", False
        place, points = np.full(3, np.nan), []
        for line in text.splitlines():
            turned |= "foot side down" in line and not self.sides
            said = re.search(r"tool (\d+):", line)
            code = re.sub(r"\(.*?\)", "", line)
            words = _WORD.findall(code)
            self.words |= {letter + number for letter, number in words if letter in "GM"}
            found = {} if "G43" in code else dict(words)
            if "T" in found or said:
                self._cut(tool, points)
                points, tool = [place.copy()], int(found.get("T") or said.group(1))  # type: ignore[union-attr]
            if found.get("M") in ("0", "3") and turned:
                self._cut(tool, points)
                points, turned = [place.copy()], False
                self._turn()
            if "G53" in code:  # in the machine's own axes: from there it comes down anew
                place = np.array([*place[:2], np.nan])
                continue
            if found.get("G") in ("0", "1"):
                mode = found["G"]
            if found.keys() & set("XYZ"):
                place = place.copy()
                for axis, letter in enumerate("XYZ"):
                    if letter in found:
                        place[axis] = float(found[letter])
                points.append(np.append(place, float(mode)))  # type: ignore[arg-type]
        self._cut(tool, points)
        self.sides.append(self.heights)

    def _turn(self) -> None:
        self.sides.append(self.heights)
        axis = 0 if self.flip == "length" else 1
        self.from_below = np.flip(self.block_mm[2] - self.heights, axis)
        self.heights = np.full_like(self.heights, float(self.block_mm[2]))

    def _in_block(self, points: FloatArray) -> FloatArray:
        moved = points + self.origin_mm
        if self.along_x:
            moved = np.column_stack([self.block_mm[0] - moved[:, 1], moved[:, 0], moved[:, 2]])
        return moved

    def _cut(self, number: int, listed: list[FloatArray]) -> None:
        points = np.array([p for p in listed if len(p) == 4 and np.isfinite(p).all()])
        if len(points) < 2:
            return
        tool, mode = self.tools[number], points[1:, 3]
        places = self._in_block(points[:, :3])
        self.low_mm = np.minimum(self.low_mm, places.min(axis=0))
        self.high_mm = np.maximum(self.high_mm, places.max(axis=0))
        starts, ends = places[:-1], places[1:]
        begin = 0
        while begin < len(mode):
            end = begin
            while end < len(mode) and mode[end] == mode[begin]:
                end += 1
            if mode[begin] == 0:
                self._rapid(tool, starts[begin:end], ends[begin:end])
            else:
                self._feed(tool, starts[begin:end], ends[begin:end])
            begin = end

    def _samples(self, starts: FloatArray, ends: FloatArray, pitch_mm: float) -> FloatArray:
        across = np.linalg.norm(ends[:, :2] - starts[:, :2], axis=1)
        # Along a slope too, the tip sinks no more than a pitch between two samples.
        return along(starts, ends, np.maximum(across, np.abs(ends - starts)[:, 2] / 3) / pitch_mm)[
            1
        ]

    def _reached(
        self, tool: Tool, samples: FloatArray
    ) -> Iterator[tuple[npt.NDArray[np.int64], FloatArray]]:
        """Numbers of pixels below the tool, and how high it is there, for some samples at a time.

        The pixels are those of the heights with `_margin` round them.
        """
        reach, width = self._margin(tool) // 2, len(self.y_mm) + 2 * self._margin(tool)
        pixels = np.floor(samples[:, :2] / self.pitch_mm).astype(int)
        near = ((pixels >= -reach) & (pixels < self.heights.shape + np.array(reach))).all(axis=1)
        pixels, samples = pixels[near], samples[near]
        numbers = (pixels + self._margin(tool)) @ np.array([width, 1])
        x, y = ((pixels + 0.5) * self.pitch_mm - samples[:, :2]).T[..., None]
        i, j = np.mgrid[-reach : reach + 1, -reach : reach + 1].reshape(2, -1)
        within = np.hypot(i, j) <= tool.radius_mm / self.pitch_mm + 1
        i, j = i[within], j[within]
        for begin in range(0, len(samples), _TOGETHER):
            some = slice(begin, begin + _TOGETHER)
            distance2 = (x[some] + i * self.pitch_mm) ** 2 + (y[some] + j * self.pitch_mm) ** 2
            sample, offset = np.nonzero(distance2 <= tool.radius_mm**2)
            below = numbers[some][sample] + (i * width + j)[offset]
            yield below, samples[some][sample, 2] + tool.height(distance2[sample, offset])

    def _margin(self, tool: Tool) -> int:
        return 2 * (int(tool.radius_mm / self.pitch_mm) + 1)

    def _feed(self, tool: Tool, starts: FloatArray, ends: FloatArray) -> None:
        samples = self._samples(starts, ends, 0.2 if tool.shape == "flat" else 0.1)
        margin = self._margin(tool)
        left = np.pad(self.heights, margin)
        for pixels, heights in self._reached(tool, samples[samples[:, 2] < self.block_mm[2]]):
            np.minimum.at(left.reshape(-1), pixels, heights)
        self.heights = left[margin:-margin, margin:-margin].copy()

    def _rapid(self, tool: Tool, starts: FloatArray, ends: FloatArray) -> None:
        samples = self._samples(starts, ends, self.pitch_mm)
        left = np.pad(self.heights, self._margin(tool)).ravel()
        for pixels, heights in self._reached(tool, samples[samples[:, 2] < self.block_mm[2]]):
            deepest = (left[pixels] - heights).max(initial=0.0)
            self.rapid_cuts_mm = max(self.rapid_cuts_mm, float(deepest))
