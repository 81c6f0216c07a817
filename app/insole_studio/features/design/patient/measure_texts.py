"""The measures of the foot as a table: names, units, numbers, and where each is taken."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from insole_core.cases.case_record import CaseRecord
from insole_core.foot.measure_table import MeasureRow, measure_table
from insole_core.foot.measures import DEFINITIONS, MISSING, NOT_MARKED
from insole_core.foot.spread import EXPLAINED, Spread, explained, spread_text
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_core.workflows.measured_feet import measured_feet
from insole_studio.features.design.rows import Measure
from insole_studio.features.design.tools.key_point_tool import distances
from insole_studio.scene.view_camera import Preset
from insole_studio.texts import fill, localised, tr, translate_core_message

ANGLES = "angles"
"""Key of the line that leads to a drawing of the angles."""
_ABOUT = "≈"  # precedes an uncertain value; the tooltip gives the reason
_NONE = "–"  # in the narrow columns of two feet, where the scan shows no value
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
_TO_SIDES: dict[str, Callable[[], str]] = {
    "valgus": lambda: tr("{angle}° valgus"),
    "varus": lambda: tr("{angle}° varus"),
    "medial": lambda: tr("{angle}° medial"),
    "lateral": lambda: tr("{angle}° lateral"),
}
_SHORT_SIDES: dict[str, Callable[[], str]] = {
    "valgus": lambda: tr("valg."),
    "varus": lambda: tr("var."),
    "medial": lambda: tr("med."),
    "lateral": lambda: tr("lat."),
}
_HEEL_TO_TOE = ("pternion", "toe_tip_2")
_BALL = ("metatarsale_tibiale", "metatarsale_fibulare")
_ACHILLES = ("achilles_lower", "achilles_upper")
_ARCH = ("heel_centre", "arch_apex", "metatarsal_head_1")
_PLACES: dict[str, tuple[tuple[str, ...], Preset]] = {
    "foot_length": (_HEEL_TO_TOE, Preset.PLANTAR),
    "ball_width": (_BALL, Preset.PLANTAR),
    "ball_width_across": (_BALL, Preset.PLANTAR),
    "ball_length": (("pternion", "metatarsale_tibiale"), Preset.PLANTAR),
    "heel_width": (("heel_medial", "heel_lateral"), Preset.PLANTAR),
    "ball_girth": (_BALL, Preset.PLANTAR),
    "instep_height": (_ARCH, Preset.MEDIAL),
    "arch_height": (_ARCH, Preset.MEDIAL),
    "arch_height_index": (_ARCH, Preset.MEDIAL),
    "arch_index": (_ARCH, Preset.PLANTAR),
    "navicular_height": (("navicular",), Preset.MEDIAL),
    "rearfoot_angle_deg": (("calcaneus_lower", "calcaneus_upper"), Preset.POSTERIOR),
    "achilles_angle_deg": (_ACHILLES, Preset.POSTERIOR),
    "achilles_lean_deg": (_ACHILLES, Preset.POSTERIOR),
    "forefoot_angle_deg": (("metatarsal_head_1", "metatarsal_head_5"), Preset.ANTERIOR),
    "shoe_size_eu": (_HEEL_TO_TOE, Preset.PLANTAR),
    "shoe_size_uk": (_HEEL_TO_TOE, Preset.PLANTAR),
    "shoe_size_us": (_HEEL_TO_TOE, Preset.PLANTAR),
    "mondopoint": (_HEEL_TO_TOE, Preset.PLANTAR),
}


def table_of(record: CaseRecord) -> list[MeasureRow]:
    """Return the measures of all feet of a case as table rows."""
    return measure_table(measured_feet(record.feet))


def measures_of(record: CaseRecord) -> list[Measure]:
    """Return all measures, of one foot or of both with their asymmetry, and what their ± is."""
    if not record.feet:
        return []
    feet = measured_feet(record.feet)
    doubtful = {side: foot.doubts for side, foot in feet.items()}
    rows = measure_table(feet, with_missing=True)
    measures = [_measure(row, doubtful) for row in rows]
    if any(row.unit == "degrees" for row in rows):
        measures.append(Measure(tr("What the angles are…"), (), key=ANGLES))
    if any(measure.is_within_error for measure in measures):
        measures.append(Measure(tr("Grey difference: within the error"), (), is_within_error=True))
    return [*measures, *_explained(rows)]


def _explained(rows: Sequence[MeasureRow]) -> list[Measure]:
    """Return a line for each source of the ± that stand beside values."""
    shown = (
        spread
        for row in rows
        for value, spread in _told(row).values()
        if value is not None and row.key not in NOT_MARKED
    )
    return [Measure(translate_core_message(line), ()) for line in explained(shown)]


def distances_of(record: CaseRecord) -> list[Measure]:
    """Return the distances between the custom points of the active foot."""
    found = distances(record.annotations)
    rows = []
    for a, b, distance in found:
        value = localised(distance)
        values: tuple[str, ...] = (value,)
        if len(record.feet) == 2:
            empty = ("", "", "")
            values = (value, "", *empty) if record.side is Side.LEFT else ("", value, *empty)
        rows.append(Measure(f"{a} – {b}", values, "mm"))
    return rows


def _measure(row: MeasureRow, doubtful: Mapping[Side, Mapping[str, str]]) -> Measure:
    """Put a row into words.

    Parameters
    ----------
    row
    doubtful
        Why measures are uncertain, by the sides that the case has.
    """
    both = len(doubtful) == 2
    found = {side: told for side, told in _told(row).items() if side in doubtful}
    doubt = [
        doubtful[s][row.key]
        for s, (value, _) in found.items()
        if value is not None and row.key in doubtful[s]
    ]
    is_missing = any(value is None for value, _ in found.values())
    missing = [MISSING[row.key]] if is_missing else []
    texts = [
        _side_text(row, value, spread, row.key in doubtful[s], both)
        for s, (value, spread) in found.items()
    ]
    if both:
        difference = _number(row.difference, _decimals(row), "+")
        texts += [_wider(row), difference, _number(row.percent, 0, "+")]
    name = _NAMES[row.key]() if row.key in _NAMES else row.key
    unit = {"degrees": "°", "mm": "mm"}.get(row.unit, "")
    if not both and (missing or row.unit == "degrees"):
        unit = ""  # the text says it
    told = [EXPLAINED[spread.source] for value, spread in found.values() if value is not None]
    said = (DEFINITIONS[row.key].text, *dict.fromkeys((*doubt, *missing, *told)))
    tip = "\n".join(map(translate_core_message, said))
    is_within_error = both and bool(row.is_within_error)
    return Measure(name, tuple(texts), unit, tip, row.key, is_within_error)


def _told(row: MeasureRow) -> dict[Side, tuple[float | None, Spread]]:
    return {Side.LEFT: (row.left, row.left_spread), Side.RIGHT: (row.right, row.right_spread)}


def _side_text(
    row: MeasureRow, value: float | None, spread: Spread, is_doubtful: bool, both: bool
) -> str:
    if value is None:
        return _NONE if both else tr("not scanned")
    limits = "" if both else f" {_limits(row, spread.limits_95)}"
    text = (
        _angle(row, value, limits, both)
        if row.unit == "degrees"
        else f"{_number(value, _decimals(row))}{limits}"
    )
    return f"{_ABOUT} {text}" if is_doubtful else text


def _limits(row: MeasureRow, limits_95: float | None) -> str:
    return translate_core_message(spread_text(row.key, limits_95))


def _wider(row: MeasureRow) -> str:
    """Return the wider ± of both feet, without its sign, which heads the column."""
    known = [spread.limits_95 for value, spread in _told(row).values() if value is not None]
    if not known:
        return ""
    wider = None if None in known else max(limit for limit in known if limit is not None)
    return _limits(row, wider).removeprefix("± ")


def _angle(row: MeasureRow, value: float, limits: str, both: bool) -> str:
    """Say an angle without a sign: to which side it is, below it in the narrow columns of both."""
    number, definition = _number(abs(value), _decimals(row)), DEFINITIONS[row.key]
    word = definition.positive if value > 0 else definition.negative
    told = f"{number}{limits}"
    if round(value, _decimals(row)) == 0:
        return told if both else f"{told}°"
    return f"{told}\n{_SHORT_SIDES[word]()}" if both else fill(_TO_SIDES[word](), angle=told)


def _decimals(row: MeasureRow) -> int:
    return DEFINITIONS[row.key].decimals


def _number(value: float | None, decimals: int, sign: str = "") -> str:
    if value is None:
        return ""
    rounded = round(value, decimals) + 0.0  # never "-0.0"
    return localised(rounded, f"{sign}.{decimals}f" if rounded else f".{decimals}f")


def place_of(key: str, record: CaseRecord) -> tuple[FloatArray, Preset] | None:
    """Return the place of a measure.

    Parameters
    ----------
    key
        Key of the measure.
    record
        The open case.

    Returns
    -------
    tuple or None
        Points (n, 3), mm, and viewing direction; None if the measure has no place.
    """
    names, preset = _PLACES.get(key, ((), Preset.PLANTAR))
    landmarks = landmarks_of(record)
    points = [landmarks[name].point for name in names if name in landmarks]
    return (np.array(points), preset) if points else None
