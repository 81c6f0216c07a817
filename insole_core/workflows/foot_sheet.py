"""The foot sheet: the measures of a patient's feet with their ±, and what their angles are."""

from __future__ import annotations

import io
import textwrap
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from datetime import date
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from insole_core.cases.scan_source import ScanSource
from insole_core.errors import InputError
from insole_core.export import paper
from insole_core.foot.measure_table import MeasureRow, measure_table
from insole_core.foot.measures import DEFINITIONS
from insole_core.foot.spread import MeasuredFoot, explained, number_text, spread_text
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.messages import Message, Translate, joined

PAPER_IN, WINDOW_IN = (9.0, 8.0), (9.0, 6.0)
"""Sizes of the drawing for the foot sheet, and for a window on a low screen."""
_EXAGGERATED = 2.0
_ANKLE, _HEEL_LONG, _LEG_LONG = np.array([0.0, 60.0]), 52.0, 130.0
_LEG, _HEEL, _QUIET = "#1f5fa8", "#b5541c", "0.45"
_ARC_STEPS = 40
_WEIGHTS = {
    "none": Message("none stated"),
    "semi": Message("semi-weight-bearing"),
    "full": Message("full weight-bearing"),
}
_CONVENTION = Message(
    "Seen from behind, angles twice as large. Blue: Achilles tendon; brown: calcaneus; grey: "
    "normal of the sole (dashed), upright of the scan (dotted). An angle is 0 where its two lines "
    "are one. Valgus: the heel tilts to the outside under the leg; medial: the leg leans to the "
    "other foot. In files, valgus and medial are above 0; of the forefoot, varus is."
)
_ANGLES: Mapping[str, tuple[str, str]] = {
    "rearfoot_angle_deg": (Message("Rearfoot angle: calcaneus to Achilles tendon"), _HEEL),
    "achilles_angle_deg": (Message("Achilles to sole: against the normal of the sole"), _LEG),
    "achilles_lean_deg": (Message("Achilles lean: against the upright of the scan"), _LEG),
}


@dataclass(frozen=True)
class _Leans:
    """Leans in the plane seen from behind, degrees, > 0 to medial, against the sole's normal."""

    leg: float
    heel: float | None
    upright: float | None


def draw_angles(
    feet: Mapping[Side, MeasuredFoot],
    path: Path | io.BytesIO,
    say: Translate,
    size_in: tuple[float, float] = PAPER_IN,
) -> None:
    """Draw what the angles of the rearfoot are, with those of the feet, as PNG.

    Parameters
    ----------
    feet
        Of one whose leg was not scanned a sentence says so.
    path
        A file, or a buffer in memory.
    say
        Into the language of the picture.
    size_in
        Width and height of the picture, inches of 100 px.

    Raises
    ------
    InputError
        When there is no foot.
    """
    check_any(feet)
    figure = Figure(figsize=size_in, layout="constrained")
    FigureCanvasAgg(figure)
    shown = {side: feet[side] for side in (Side.LEFT, Side.RIGHT) if side in feet}
    figure.supxlabel(textwrap.fill(say(_CONVENTION), 110), fontsize=9)
    for axes, (side, foot) in zip(
        np.ravel(figure.subplots(1, max(len(shown), 1))), shown.items(), strict=False
    ):
        _draw_foot(axes, side, foot, say)
    figure.savefig(path, format="png", dpi=100)


def check_any(feet: Mapping[Side, MeasuredFoot]) -> None:
    """Check that there is a foot to tell measures of.

    Raises
    ------
    InputError
    """
    if not feet:
        raise InputError(
            "There is no foot with measures of its own: a mirror image has none; open a scan of "
            "the foot first."
        )


def _draw_foot(axes: Axes, side: Side, foot: MeasuredFoot, say: Translate) -> None:
    axes.set(aspect="equal", xlim=(-85, 85), ylim=(-12, 272))
    axes.set_axis_off()
    axes.text(0, 264, say(Message("{side} foot", side=str(side))), ha="center", fontsize=12)
    leans = _leans(foot)
    if leans is None:
        axes.text(0, 90, say(Message("the leg was not scanned")), ha="center", color=_QUIET)
        return
    medial = side.medial_sign
    axes.plot([-60, 60], [0, 0], color=_QUIET)
    for x, word in ((60, "medial"), (-60, "lateral")):
        axes.text(x * medial, -9, say(Message(word)), ha="center", color=_QUIET, fontsize=9)
    _line(axes, 0.0, _LEG_LONG, medial, color=_QUIET, linestyle="--")
    _line(axes, leans.leg, _LEG_LONG, medial, color=_LEG, linewidth=3)
    if leans.upright is not None:
        _line(axes, leans.upright, _LEG_LONG, medial, color=_QUIET, linestyle=":")
        _arc(axes, (leans.upright, leans.leg), 122, medial, (_LEG, "3"))
    _arc(axes, (0.0, leans.leg), 95, medial, (_LEG, "2"))
    if leans.heel is not None:
        _line(axes, leans.heel, -_HEEL_LONG, medial, color=_HEEL, linewidth=3)
        _line(axes, leans.heel, 70, medial, color=_HEEL, linestyle="--")
        _arc(axes, (leans.heel, leans.leg), 66, medial, (_HEEL, "1"))
    _tell(axes, foot, say)


def _tell(axes: Axes, foot: MeasuredFoot, say: Translate) -> None:
    """Write each angle and what it is, above the drawing."""
    for row, (name, (what, color)) in enumerate(_ANGLES.items()):
        text = f"{row + 1}  {say(what)}\n     {say(value_text(name, foot))}"
        axes.text(-85, 254 - 16 * row, text, color=color, fontsize=8.5, va="top")


def _leans(foot: MeasuredFoot) -> _Leans | None:
    leg, rear, lean = (foot.values.get(name) for name in (
        "achilles_angle_deg", "rearfoot_angle_deg", "achilles_lean_deg",
    ))  # fmt: skip
    if leg is None:
        return None
    return _Leans(leg, None if rear is None else rear + leg, None if lean is None else leg - lean)


def _way(lean_deg: float, medial: int) -> FloatArray:
    turn = np.radians(_EXAGGERATED * lean_deg)
    return np.array([medial * np.sin(turn), np.cos(turn)])


def _line(axes: Axes, lean_deg: float, long: float, medial: int, **style: Any) -> None:
    ends = np.stack([_ANKLE, _ANKLE + long * _way(lean_deg, medial)])
    axes.plot(*ends.T, **style)


def _arc(
    axes: Axes,
    leans_deg: tuple[float, float],
    radius: float,
    medial: int,
    drawn: tuple[str, str],
) -> None:
    """Draw the arc of an angle, in its colour and with its number beside the leg."""
    color, number = drawn
    way = [_ANKLE + radius * _way(lean, medial) for lean in np.linspace(*leans_deg, _ARC_STEPS)]
    axes.plot(*np.array(way).T, color=color, linewidth=1.2)
    beside = 7.0 * medial * np.sign(leans_deg[1] - leans_deg[0] or 1.0)
    axes.text(way[-1][0] + beside, way[-1][1], number, color=color, ha="center", va="center")


def value_text(name: str, foot: MeasuredFoot) -> str:
    """Return a measure of a foot with its ± and unit, an angle to the side that it is.

    As in the window, "≈" precedes an uncertain one.
    """
    value = foot.values.get(name)
    if value is None:
        return Message("not scanned")
    text = _with_unit(name, value, spread_text(name, foot.spread(name).limits_95))
    return Message("≈ {value}", value=text) if name in foot.doubts else text


def _with_unit(name: str, value: float, limits: str) -> str:
    definition = DEFINITIONS[name]
    if definition.unit != "degrees":
        number = number_text(name, value)
        if definition.unit == "mm":
            return Message("{value} {limits} mm", value=number, limits=limits)
        return Message("{value} {limits}", value=number, limits=limits)
    number = number_text(name, abs(value))
    if round(value, definition.decimals) == 0:
        return Message("{value} {limits}°", value=number, limits=limits)
    word = Message(definition.positive if value > 0 else definition.negative)
    return Message("{value} {limits}° {word}", value=number, limits=limits, word=word)


def _told(name: str, foot: MeasuredFoot) -> str:
    """Return a measure with why it is uncertain, if it is."""
    text = value_text(name, foot)
    if name not in foot.doubts:
        return text
    return Message("{value}: {reason}", value=text, reason=foot.doubts[name])


def _difference_text(row: MeasureRow) -> str:
    """Return the left measure minus the right one, with its ± and whether it is more than that."""
    assert row.difference is not None
    unit = {"mm": " mm", "degrees": "°", "": ""}[row.unit]
    difference = round(row.difference, DEFINITIONS[row.key].decimals) + 0.0  # never "-0.0"
    sign = "+" if difference > 0 else ""
    number = number_text(row.key, difference)
    limits = spread_text(row.key, row.difference_limits)
    text = Message(
        "{sign}{value} {limits}{unit}", sign=sign, value=number, limits=limits, unit=unit
    )
    if row.is_within_error:
        return Message("{difference}: within the error", difference=text)
    return text


def _captured(source: ScanSource | None) -> str:
    """Return the day of a scan (UTC), as far as it is known."""
    day = "" if source is None else source.recorded_at[:10] or source.scanned_on
    return day or Message("not known")


def _weight(source: ScanSource | None) -> str:
    """Return how much weight was on a foot, as far as a session says."""
    said = None if source is None else source.said_weight
    return Message("not known") if said is None else _WEIGHTS[said]


def write_foot_sheet(
    feet: Mapping[Side, MeasuredFoot],
    sources: Mapping[Side, ScanSource],
    path: Path,
    say: Translate = str,
    identification: str = "",
) -> None:
    """Write the measures of one or both feet as PDF, below a drawing of their angles.

    Parameters
    ----------
    sources
        The scans of the feet; of a mirror image the sheet says that it was not measured.
    identification
        Whose feet they are, such as a pseudonym; empty for nothing.
    say
        Into the language of the paper.

    Raises
    ------
    InputError
        When there is no foot.
    OutputError
        When the place cannot be written.
    """
    picture = io.BytesIO()
    draw_angles(feet, picture, say)
    sections = [
        (say(title), {say(key): say(text) for key, text in facts.items()})
        for title, facts in _sections(feet, sources, identification)
    ]
    paper.write_report(say(Message("Measures of the feet")), sections, picture.getvalue(), path)


_MIRRORED = Message("none of its own: this foot is a mirror image of the other one")


def _sections(
    feet: Mapping[Side, MeasuredFoot], sources: Mapping[Side, ScanSource], identification: str
) -> Iterator[tuple[str, dict[str, str]]]:
    """Yield title and facts of each part of the sheet."""
    head: dict[str, str] = {Message("printed"): date.today().isoformat()}
    if identification:
        head[Message("pseudonym")] = identification
    spreads = (
        foot.spread(name)
        for foot in feet.values()
        for name, value in foot.values.items()
        if value is not None
    )
    head[Message("uncertainty")] = joined(explained(spreads), "; ")
    yield Message("What"), head
    for side, foot in feet.items():
        told = {_name(n): _told(n, foot) for n, value in foot.values.items() if value is not None}
        captured: dict[str, str] = {
            Message("captured"): _captured(sources.get(side)),
            Message("weight bearing"): _weight(sources.get(side)),
        }
        yield Message("{side} foot", side=str(side)), captured | told
    for side, source in sources.items():
        if source.mirrored:
            yield Message("{side} foot", side=str(side)), {Message("measures"): _MIRRORED}
    rows = [row for row in measure_table(feet) if row.difference is not None]
    if rows:
        differences = {_name(row.key): _difference_text(row) for row in rows}
        yield Message("Left foot minus right foot"), differences


def _name(key: str) -> str:
    return key.removesuffix("_deg").replace("_", " ")
