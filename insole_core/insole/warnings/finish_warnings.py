"""What is unusual about a finished insole, and what its finish could not do as asked."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.insole.build import Insole
from insole_core.insole.design_warning import DesignWarning
from insole_core.insole.elements import Pelott
from insole_core.insole.fields import Place
from insole_core.insole.finishing.finished import FinishedSurface
from insole_core.insole.finishing.zones import STEEPEST_DEG
from insole_core.insole.outline.insole_outline import outline_reach
from insole_core.insole.pads.pad_heights import pad_outline
from insole_core.insole.prescription.finish import HEADS_ALONG
from insole_core.insole.primitives.outline_curve import inside_curve
from insole_core.messages import Message

_SHOWN_WIDENING_MM, _SHOWN_NARROWING_MM, _SHOWN_FREE_MM = 5.0, 0.5, 1.0
_SHOWN_BESIDE_MM, _SHOWN_RAISE_MM, _SHOWN_FILL_MM = 1.5, 0.5, 0.1
_SHOWN_ON_TRANSITION = 0.3
_WORDS = {"medial": "medially", "lateral": "laterally"}


def finish_warnings(insole: Insole) -> Iterator[DesignWarning]:
    """Yield what a finish could not do as asked; nothing for a design without a finish."""
    finished = insole.finished
    if finished is None:
        return
    yield from _of_widths(finished)
    yield from _of_walls(finished)
    yield from _of_flank(finished)
    yield from _of_stations(finished)
    yield from _of_raising(finished)
    yield from _of_arch(finished)
    yield from _of_expansion(insole, finished)
    for pad in insole.design.of(Pelott):
        yield from _of_pad(finished, pad)


def _of_widths(finished: FinishedSurface) -> Iterator[DesignWarning]:
    widths = finished.widths
    narrowed = widths.asked_mm - widths.width_mm
    at = int(narrowed.argmax())
    if narrowed[at] > _SHOWN_NARROWING_MM:
        yield _at_edge(
            finished,
            at,
            Message(
                "The transition to the rim of {asked_mm:.0f} mm has no room {where}, where the "
                "insole is {width_mm:.0f} mm wide: it is {used_mm:.0f} mm there; set a narrower "
                "transition.",
                asked_mm=widths.asked_mm[at],
                where=_where(finished, at),
                width_mm=2 * widths.room_mm[at],
                used_mm=widths.width_mm[at],
            ),
        )
    at = int(narrowed.argmin())
    if -narrowed[at] > _SHOWN_WIDENING_MM:
        yield _at_edge(
            finished,
            at,
            Message(
                "The transition to the rim is {used_mm:.0f} mm wide {where} instead of "
                "{asked_mm:.0f} mm, or the wall would be too steep or bent too sharply; a rim "
                "nearer to the foot needs less.",
                used_mm=widths.width_mm[at],
                where=_where(finished, at),
                asked_mm=widths.asked_mm[at],
            ),
        )


def _of_walls(finished: FinishedSurface) -> Iterator[DesignWarning]:
    slope = np.where(_inside(finished), finished.surface.slope_deg(), 0.0)
    row, column = np.unravel_index(slope.argmax(), slope.shape)
    is_wall = finished.zones.support_mm[row, column] < 0
    if is_wall and slope[row, column] > STEEPEST_DEG and finished.widths.is_steep.any():
        steep = Message(
            "The wall to the rim is {angle:.0f}° steep, and there is no room for a wider one; "
            "lower the rim there.",
            angle=slope[row, column],
        )
        yield DesignWarning(steep, place_mm=_place(finished, int(row), int(column)))


def _of_flank(finished: FinishedSurface) -> Iterator[DesignWarning]:
    """Warn of a cup or flange that is higher than the foot."""
    rim, behind_heads = finished.rim, finished.rim.edge.along < HEADS_ALONG
    free_mm = np.where(behind_heads, finished.curve.height_mm - rim.flank_mm, -np.inf)
    at = int(free_mm.argmax())
    if free_mm[at] > _SHOWN_FREE_MM:
        yield _at_edge(
            finished,
            at,
            Message(
                "The rim is {rim_mm:.0f} mm high {where}, and the scan of the foot reaches up to "
                "{flank_mm:.0f} mm beside it: above that the wall is designed, and no foot carries "
                "it; lower the rim, or scan more of the flank.",
                rim_mm=finished.curve.height_mm[at],
                where=_where(finished, at),
                flank_mm=max(rim.flank_mm[at], 0.0),
            ),
        )


def _of_stations(finished: FinishedSurface) -> Iterator[DesignWarning]:
    """Warn of the station that the rim misses most."""
    stations = finished.curve.stations
    off_mm = [abs(finished.curve.height_at(s.arc_mm) - s.height_mm) for s in stations]
    if not stations or max(off_mm) <= _SHOWN_BESIDE_MM:
        return
    station = stations[int(np.argmax(off_mm))]
    beside = Message(
        "The rim is {rim_mm:.1f} mm high where a station {where} asks for {asked_mm:.1f} mm, or it "
        "would bend too sharply; move the neighbouring stations away or nearer to its height.",
        rim_mm=finished.curve.height_at(station.arc_mm),
        where=_WORDS[station.station.border],
        asked_mm=station.height_mm,
    )
    yield DesignWarning(beside, place_mm=station.place_mm)


def _of_raising(finished: FinishedSurface) -> Iterator[DesignWarning]:
    """Warn of a rim so low that the whole insole is raised for it."""
    inside = finished.place.inside_mm > 0
    heights = finished.surface.heights_mm
    in_zones = finished.zones.support | finished.zones.floor
    if not in_zones.any():
        return
    lowest = np.where(inside, heights, np.inf)
    row, column = np.unravel_index(lowest.argmin(), lowest.shape)
    below_mm = float(heights[in_zones].min() - lowest[row, column])
    if below_mm > _SHOWN_RAISE_MM:
        low = Message(
            "The rim lies {below_mm:.1f} mm below the sole, so that the whole insole is "
            "{below_mm:.1f} mm thicker to keep its least thickness there; raise the rim or lower "
            "the posting.",
            below_mm=below_mm,
        )
        yield DesignWarning(low, place_mm=_place(finished, int(row), int(column)))


def _of_arch(finished: FinishedSurface) -> Iterator[DesignWarning]:
    arch, asked_mm = finished.arch, finished.finish.arch_fill_mm
    if asked_mm - arch.height_mm > _SHOWN_FILL_MM:
        deep = Message(
            "The arch is to be filled by {asked_mm:.1f} mm and is only {height_mm:.1f} mm high; it "
            "is filled by {height_mm:.1f} mm; set a smaller fill.",
            asked_mm=asked_mm,
            height_mm=arch.height_mm,
        )
        yield DesignWarning(deep, place_mm=arch.apex_mm)


def _of_expansion(insole: Insole, finished: FinishedSurface) -> Iterator[DesignWarning]:
    """Warn of an expansion of what is spread already, and of one the outline does not follow."""
    expansion_mm = finished.finish.expansion_mm
    if expansion_mm > 0 and insole.foot.form.is_spread:
        spread = Message(
            "The heel is widened by {expansion_mm:.1f} mm, but in an imprint or a cast taken under "
            "weight the tissue is spread already; set the expansion to 0.",
            expansion_mm=expansion_mm,
        )
        yield DesignWarning(spread)
    low, _ = outline_reach(insole.foot, insole.design.outline)
    beside_mm = float(-low[1])
    if expansion_mm > max(beside_mm, 0.0):
        narrow = Message(
            "The heel is widened by {expansion_mm:.1f} mm, and the outline lies only "
            "{beside_mm:.1f} mm behind the foot; widen the outline at the heel by as much.",
            expansion_mm=expansion_mm,
            beside_mm=beside_mm,
        )
        yield DesignWarning(narrow, place_mm=(0.0, float(low[1])))


def _of_pad(finished: FinishedSurface, pad: Pelott) -> Iterator[DesignWarning]:
    """Warn of a pad that supports, and lies on the transition to the rim."""
    if not pad.ends_behind_heads:
        return
    place = finished.place
    within = np.zeros(place.inside_mm.shape, bool)
    outline = pad_outline(pad)
    box = _within_box(place.x_mm, place.y_mm, outline)
    within[box] = inside_curve(outline, np.column_stack([place.x_mm[box], place.y_mm[box]]))
    if not within.any():
        return
    from_rim_mm = place.inside_mm - place.at_edge(finished.widths.width_mm)
    share = float((from_rim_mm[within] < 0).mean())
    if share > _SHOWN_ON_TRANSITION:
        beside = Message(
            "{share:.0%} of the {pad} lie on the transition to the rim; move it inwards or set a "
            "narrower transition.",
            share=share,
            pad=pad.noun,
        )
        yield DesignWarning(beside, pad.id, pad.centre_mm)


def _within_box(x_mm: FloatArray, y_mm: FloatArray, outline: FloatArray) -> BoolArray:
    (left, low), (right, high) = outline.min(axis=0), outline.max(axis=0)
    return np.asarray((x_mm >= left) & (x_mm <= right) & (y_mm >= low) & (y_mm <= high))


def _inside(finished: FinishedSurface) -> BoolArray:
    """Return the nodes whose neighbours all lie inside the edge."""
    return np.asarray(finished.place.inside_mm > 1.5 * finished.surface.step_mm)


def _place(finished: FinishedSurface, row: int, column: int) -> Place:
    field = finished.surface
    return float(field.x_mm[column]), float(field.y_mm[row])


def _at_edge(finished: FinishedSurface, at: int, sentence: Message) -> DesignWarning:
    x, y = finished.rim.edge.points_mm[at]
    return DesignWarning(sentence, place_mm=(float(x), float(y)))


def _where(finished: FinishedSurface, at: int) -> str:
    edge = finished.rim.edge
    return _WORDS[edge.border_of(float(edge.arc_mm[at]))]
