"""The measures of the foot as a table: names in the language of the window, units, numbers."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Sequence

from insole_core.cases.record import CaseRecord
from insole_core.foot.measures import DEFINITIONS, measure
from insole_studio.stages.design.rows import Measure
from insole_studio.texts import tr
from insole_studio.workbench.landmarks import landmarks_of

_NAMES: dict[str, Callable[[], str]] = {
    "foot_length": lambda: tr("Foot length"),
    "ball_width": lambda: tr("Ball width"),
    "ball_width_across": lambda: tr("Ball width across"),
    "ball_length": lambda: tr("Ball length"),
    "heel_width": lambda: tr("Heel width"),
    "ball_girth": lambda: tr("Ball girth"),
    "instep_height": lambda: tr("Instep height"),
    "arch_height": lambda: tr("Arch height"),
    "arch_height_index": lambda: tr("Arch height index"),
    "arch_index": lambda: tr("Arch index"),
    "navicular_height": lambda: tr("Navicular height"),
    "rearfoot_angle_deg": lambda: tr("Rearfoot angle"),
    "achilles_angle_deg": lambda: tr("Achilles to sole"),
    "achilles_lean_deg": lambda: tr("Achilles lean"),
    "forefoot_angle_deg": lambda: tr("Forefoot angle"),
    "shoe_size_eu": lambda: tr("Shoe size EU"),
    "shoe_size_uk": lambda: tr("Shoe size UK"),
    "shoe_size_us": lambda: tr("Shoe size US"),
    "mondopoint": lambda: tr("Mondopoint"),
}


def measures_of(record: CaseRecord) -> list[Measure]:
    """Give all measures that the scan allows; none before there is a foot."""
    if record.foot is None:
        return []
    found = measure(record.foot, landmarks_of(record))
    return [_measure(key, value) for key, value in found.items() if value is not None]


def as_csv(measures: Sequence[Measure], side: str) -> str:
    """Give a table with a head line; numbers with a point."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("measure", "side", "value", "unit"))
    for row in measures:
        number, _, unit = row.value.partition(" ")
        writer.writerow((row.key or row.name, side, number, unit))
    return text.getvalue()


def _measure(key: str, value: float) -> Measure:
    unit = {"degrees": "°", "mm": "mm"}.get(DEFINITIONS[key].unit, "")
    number = f"{value:.2f}" if "index" in key else f"{value:.1f}"
    name = _NAMES[key]() if key in _NAMES else key
    return Measure(name, f"{number} {unit}".strip(), DEFINITIONS[key].text, key)
