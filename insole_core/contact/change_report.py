"""The change of the pressure as JSON, in the contract's form."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from insole_core.contact.change import HEADS, SENTENCE, PressureChange, Told
from insole_core.contact.fit import Fitted
from insole_core.insole.fields import Place
from insole_core.messages import Message

REGION_WORDS = {
    "heel": Message("Heel"),
    "midfoot": Message("Midfoot"),
    "metatarsal_heads": Message("Metatarsal heads"),
    "toes": Message("Toes"),
    **{head: Message("Head {number}", number=head[-1]) for head in HEADS},
}
"""What each of `GROUPS` is called."""


def signed(percent: float) -> str:
    """Return a change in whole per cent as all texts write it: "+31", "−24", "0"."""
    whole = round(percent)
    return f"{whole:+d}".replace("-", "−") if whole else "0"


def change_lines(told: PressureChange) -> tuple[Message, ...]:
    """Return what is told of a change for a paper, a sentence each; the last says what it is."""
    lines = []
    for name, one in told.regions.items():
        if one.reason or one.percent is None or one.limits is None:
            lines.append(Message("{region}: cannot tell.", region=REGION_WORDS[name]))
        else:
            low, high = one.limits
            lines.append(
                Message(
                    "{region}: {percent} % of the peak pressure, {low} to {high} %.",
                    region=REGION_WORDS[name],
                    percent=signed(one.percent),
                    low=signed(low),
                    high=signed(high),
                )
            )
    return (*lines, SENTENCE)


def change_report(
    told: PressureChange,
    points: Sequence[Place],
    notes: Sequence[str] = (),
    fitted: Fitted | None = None,
) -> dict[str, Any]:
    """Return what is told of a change, in the insole frame.

    Parameters
    ----------
    points
        Those that were asked for, mm.
    notes
        What was assumed, a sentence each.
    fitted
        To a measured map; None without one.
    """
    old_mm2, new_mm2 = told.change.areas_mm2
    return {
        "total_load_N": round(float(told.load_n), 3),
        "posture": str(told.loading.posture),
        "regions": {name: _region(one) for name, one in told.regions.items()},
        "points": [
            {"x_mm": float(x), "y_mm": float(y), **_told(one), "reason": str(one.reason)}
            for (x, y), one in zip(points, told.points, strict=True)
        ],
        "contact_area_mm2": {"old": round(old_mm2, 1), "new": round(new_mm2, 1)},
        "cannot_tell": list(told.cannot_tell),
        "reasons": {name: str(one.reason) for name, one in told.regions.items() if one.reason},
        "notes": [*notes, str(SENTENCE)],
        **({} if fitted is None else {"fit": _fit(fitted)}),
    }


def _fit(fitted: Fitted) -> dict[str, Any]:
    tissue = fitted.assumed.tissue
    return {
        "heel_mpa": round(tissue.heel_mpa, 4),
        "forefoot_mpa": round(tissue.forefoot_mpa, 4),
        "held_out": {
            name: {"measured_kpa": round(measured, 1), "computed_kpa": round(found, 1)}
            for name, (measured, found) in fitted.held_out.items()
        },
        "held_out_error_percent": _rounded(fitted.error_percent),
    }


def _region(told: Told) -> dict[str, Any]:
    return {**_told(told), "load_change_percent": _rounded(told.load_percent)}


def _told(told: Told) -> dict[str, Any]:
    limits = None if told.limits is None else [_rounded(limit) for limit in told.limits]
    return {"change_percent": _rounded(told.percent), "limits_95": limits}


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(value, 2)
