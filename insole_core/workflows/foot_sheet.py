"""The foot sheet: the measures of a patient's feet with their ±, and what their angles are."""

from __future__ import annotations

import io
import textwrap
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import date
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from insole_core.export import paper
from insole_core.foot.measures import DEFINITIONS
from insole_core.foot.spread import MeasuredFoot, explained, spread_text
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.messages import Message, Translate

PAPER_IN, WINDOW_IN = (9.0, 8.0), (9.0, 6.0)
"""Sizes of the drawing for the foot sheet, and for a window on a low screen."""
_EXAGGERATED = 2.0
_ANKLE, _HEEL_LONG, _LEG_LONG = np.array([0.0, 60.0]), 52.0, 130.0
_LEG, _HEEL, _QUIET = "#1f5fa8", "#b5541c", "0.45"
_ARC_STEPS = 40
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
        A foot of which no leg was scanned is left out.
    path
        A file, or a buffer in memory.
    say
        Into the language of the picture.
    size_in
        Width and height of the picture, inches of 100 px.
    """
    figure = Figure(figsize=size_in, layout="constrained")
    FigureCanvasAgg(figure)
    shown = {side: feet[side] for side in (Side.LEFT, Side.RIGHT) if side in feet}
    figure.supxlabel(textwrap.fill(say(_CONVENTION), 110), fontsize=9)
    for axes, (side, foot) in zip(
        np.ravel(figure.subplots(1, max(len(shown), 1))), shown.items(), strict=False
    ):
        _draw_foot(axes, side, foot, say)
    figure.savefig(path, format="png", dpi=100)


def _draw_foot(axes: Axes, side: Side, foot: MeasuredFoot, say: Translate) -> None:
    axes.set(aspect="equal", xlim=(-85, 85), ylim=(-12, 272))
    axes.set_axis_off()
    axes.text(0, 264, say(Message("{side} foot", side=str(side))), ha="center", fontsize=12)
    leans = _leans(foot)
    if leans is None:
        axes.text(0, 90, say(Message("the leg was not scanned")), ha="center", color=_QUIET)
        return
    outwards = side.medial_sign
    axes.plot([-60, 60], [0, 0], color=_QUIET)
    for x, word in ((60, "medial"), (-60, "lateral")):
        axes.text(x * outwards, -9, say(Message(word)), ha="center", color=_QUIET, fontsize=9)
    _line(axes, 0.0, _LEG_LONG, outwards, color=_QUIET, linestyle="--")
    _line(axes, leans.leg, _LEG_LONG, outwards, color=_LEG, linewidth=3)
    if leans.upright is not None:
        _line(axes, leans.upright, _LEG_LONG, outwards, color=_QUIET, linestyle=":")
        _arc(axes, (leans.upright, leans.leg), 122, outwards, (_LEG, "3"))
    _arc(axes, (0.0, leans.leg), 95, outwards, (_LEG, "2"))
    if leans.heel is not None:
        _line(axes, leans.heel, -_HEEL_LONG, outwards, color=_HEEL, linewidth=3)
        _line(axes, leans.heel, 70, outwards, color=_HEEL, linestyle="--")
        _arc(axes, (leans.heel, leans.leg), 66, outwards, (_HEEL, "1"))
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


def _way(lean_deg: float, outwards: int) -> FloatArray:
    turn = np.radians(_EXAGGERATED * lean_deg)
    return np.array([outwards * np.sin(turn), np.cos(turn)])


def _line(axes: Axes, lean_deg: float, long: float, outwards: int, **style: Any) -> None:
    ends = np.stack([_ANKLE, _ANKLE + long * _way(lean_deg, outwards)])
    axes.plot(*ends.T, **style)


def _arc(
    axes: Axes,
    leans_deg: tuple[float, float],
    radius: float,
    outwards: int,
    drawn: tuple[str, str],
) -> None:
    """Draw the arc of an angle, in its colour and with its number beside the leg."""
    color, number = drawn
    way = [_ANKLE + radius * _way(lean, outwards) for lean in np.linspace(*leans_deg, _ARC_STEPS)]
    axes.plot(*np.array(way).T, color=color, linewidth=1.2)
    beside = 7.0 * outwards * np.sign(leans_deg[1] - leans_deg[0] or 1.0)
    axes.text(way[-1][0] + beside, way[-1][1], number, color=color, ha="center", va="center")


def value_text(name: str, foot: MeasuredFoot) -> str:
    """Return a measure of a foot with its ± and unit, an angle to the side that it is."""
    value, definition = foot.values.get(name), DEFINITIONS[name]
    if value is None:
        return Message("not scanned")
    limits = spread_text(name, foot.spread(name).limits_95)
    if definition.unit == "degrees":
        word = Message(definition.positive if value >= 0 else definition.negative)
        return Message("{value:.1f} {limits}° {word}", value=abs(value), limits=limits, word=word)
    if definition.unit == "mm":
        return Message("{value:.1f} {limits} mm", value=value, limits=limits)
    if definition.decimals == 2:
        return Message("{value:.2f} {limits}", value=value, limits=limits)
    return Message("{value:.1f} {limits}", value=value, limits=limits)


def write_foot_sheet(
    feet: Mapping[Side, MeasuredFoot], path: Path, say: Translate = str, identification: str = ""
) -> None:
    """Write the measures of one or both feet as PDF, below a drawing of their angles.

    Parameters
    ----------
    identification
        Whose feet they are, such as a pseudonym; empty for nothing.
    say
        Into the language of the paper.

    Raises
    ------
    OutputError
        When the place cannot be written.
    """
    picture = io.BytesIO()
    draw_angles(feet, picture, say)
    head = {say(Message("date")): date.today().isoformat()}
    if identification:
        head[say(Message("pseudonym"))] = identification
    spreads = [
        foot.spread(name)
        for foot in feet.values()
        for name, value in foot.values.items()
        if value is not None
    ]
    told = {say(Message("error")): "; ".join(map(say, explained(spreads)))}
    sections = [(say(Message("What")), {**head, **told})]
    for side, foot in feet.items():
        facts = {
            say(name.removesuffix("_deg").replace("_", " ")): say(value_text(name, foot))
            for name, value in foot.values.items()
            if value is not None
        }
        sections.append((say(Message("{side} foot", side=str(side))), facts))
    paper.write_report(say(Message("Measures of the feet")), sections, picture.getvalue(), path)
