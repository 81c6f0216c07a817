"""Measures of a person over the visits."""

from __future__ import annotations

from collections.abc import Sequence

from insole_core.geometry.side import Side
from insole_core.records.visit import Visit
from insole_studio.features.records.record_form import label_of
from insole_studio.features.records.rows import Trend
from insole_studio.texts import tr


def trends_of(visits: Sequence[Visit]) -> list[Trend]:
    """Return each measure that two or more visits have, over their days, oldest first."""
    found: dict[tuple[str, Side | None], list[tuple[str, float]]] = {}
    for visit in sorted(visits, key=lambda visit: visit.visited_on):
        day = visit.visited_on.isoformat()
        for key, value in visit.measures.items():
            side, measure = _side_and_measure(key)
            name = _names().get(measure)
            if name is not None:
                found.setdefault((name, side), []).append((day, value))
        if visit.weight_kg is not None:
            found.setdefault((label_of(Visit, "weight_kg"), None), []).append(
                (day, visit.weight_kg)
            )
    return [
        Trend(name, tuple(day for day, _ in points), tuple(value for _, value in points), side)
        for (name, side), points in found.items()
        if len(points) > 1
    ]


def _side_and_measure(key: str) -> tuple[Side | None, str]:
    """Return side and measure of a key such as "left_length_mm"."""
    for side in Side:
        if key.startswith(f"{side}_"):
            return side, key.removeprefix(f"{side}_")
    return None, key


def _names() -> dict[str, str]:
    return {
        "foot_length_mm": tr("Foot length (mm)"),
        "ball_width_mm": tr("Ball width (mm)"),
        "heel_width_mm": tr("Heel width (mm)"),
        "arch_height_mm": tr("Arch height (mm)"),
        "navicular_height_mm": tr("Navicular height (mm)"),
    }
