"""How long a controller takes for a program: as GRBL plans it, move by move, from the text."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from itertools import pairwise

_CORNER_MM = 0.01


@dataclass
class _Move:
    along: tuple[float, ...]
    length: float
    speed: float
    enter2: float = 0.0


def program_minutes(
    text: str, rapid_mm_min: float, acceleration_mm_s2: tuple[float, float, float]
) -> tuple[float, float, float]:
    """Return the time of all moves, that without ramps, and the metres that are cut."""
    seconds = plain = metres = 0.0
    queue: list[_Move] = []
    place: list[float | None] = [None, None, None]
    mode, feed = "", 0.0
    for line in text.splitlines():
        code = re.sub(r"\(.*?\)", "", line)
        words = dict(re.findall(r"([GMTXYZF])(-?[\d.]+)", code))
        if {"M", "T"} & words.keys() or "G53" in code:
            seconds += _taken(queue, acceleration_mm_s2)
            queue = []
            if "G53" in code:
                place[2] = None
        if "G43" in code or "G53" in code:
            continue
        mode = words["G"] if words.get("G") in ("0", "1") else mode
        feed = float(words.get("F", feed))
        there = [float(words[a]) if a in words else p for a, p in zip("XYZ", place, strict=True)]
        if words.keys() & set("XYZ") and None not in place:
            steps = [b - a for a, b in zip(place, there, strict=True)]  # type: ignore[operator]
            length = math.hypot(*steps)
            speed = (rapid_mm_min if mode == "0" else feed) / 60
            if length > 0:
                queue.append(_Move(tuple(step / length for step in steps), length, speed))
                plain += length / speed
                metres += length / 1000 if mode == "1" else 0.0
        place = there
    return (seconds + _taken(queue, acceleration_mm_s2)) / 60, plain / 60, metres


def _limit(direction: tuple[float, ...], axes: tuple[float, float, float]) -> float:
    return min(a / abs(d) for a, d in zip(axes, direction, strict=True) if abs(d) > 1e-9)


def _corner2(before: _Move, after: _Move, axes: tuple[float, float, float]) -> float:
    cosine = -sum(a * b for a, b in zip(before.along, after.along, strict=True))
    slowest2 = min(before.speed, after.speed) ** 2
    if cosine > 0.999999:
        return 0.0
    if cosine < -0.999999:
        return slowest2
    change = [b - a for a, b in zip(before.along, after.along, strict=True)]
    size = math.hypot(*change)
    acceleration = _limit(tuple(c / size for c in change), axes)
    half = math.sqrt((1 - cosine) / 2)
    return min(acceleration * _CORNER_MM * half / (1 - half), slowest2)


def _taken(queue: list[_Move], axes: tuple[float, float, float]) -> float:
    for before, after in pairwise(queue):
        after.enter2 = _corner2(before, after, axes)
    leave2 = 0.0
    for move in reversed(queue):
        gain = 2 * _limit(move.along, axes) * move.length
        move.enter2 = leave2 = min(move.enter2, leave2 + gain)
    if queue:
        queue[0].enter2 = 0.0
    seconds = 0.0
    for number, move in enumerate(queue):
        acceleration = _limit(move.along, axes)
        after = queue[number + 1] if number + 1 < len(queue) else None
        end2 = after.enter2 if after else 0.0
        end2 = min(end2, move.enter2 + 2 * acceleration * move.length)
        if after:
            after.enter2 = end2
        seconds += _trapezoid(move.length, move.enter2, end2, move.speed, acceleration)
    return seconds


def _trapezoid(
    length: float, enter2: float, leave2: float, speed: float, acceleration: float
) -> float:
    up, down = (speed**2 - enter2) / 2 / acceleration, (speed**2 - leave2) / 2 / acceleration
    if up + down <= length:
        ramps = (2 * speed - math.sqrt(enter2) - math.sqrt(leave2)) / acceleration
        return ramps + (length - up - down) / speed
    top = math.sqrt((2 * acceleration * length + enter2 + leave2) / 2)
    return (2 * top - math.sqrt(enter2) - math.sqrt(leave2)) / acceleration
