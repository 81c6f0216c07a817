"""Warnings about how the scanned foot lies, and of one that was not scanned, or long ago."""

from __future__ import annotations

from collections.abc import Iterator

from insole_core.foot.contact_tilt import contact_tilt
from insole_core.geometry.rounding import rounded
from insole_core.insole.build import Insole
from insole_core.insole.design_warning import DesignWarning
from insole_core.messages import Message

LEVEL_DEG = 1.5
"""Greatest usual tilt of a foot from heel to ball: some 4 mm over the length of an insole."""
_SHOWN_DEG = 0.1


def scan_warnings(insole: Insole) -> Iterator[DesignWarning]:
    """Warn of a foot that is the other one's mirror image, of an older scan, or not level."""
    foot = insole.foot
    if foot.scanned_on:
        yield DesignWarning(
            Message(
                "The scan of the {side} foot is that of the visit of {day}, used once more; scan "
                "the foot again if it has changed.",
                side=foot.side.other if foot.mirrored else foot.side,
                day=foot.scanned_on,
            )
        )
    if foot.mirrored:
        yield DesignWarning(
            Message(
                "The {side} foot was not scanned: foot and insole are mirrored from the {other} "
                "foot.",
                side=foot.side,
                other=foot.side.other,
            )
        )
    yield from _tilt_warnings(insole)


def _tilt_warnings(insole: Insole) -> Iterator[DesignWarning]:
    """Warn of a foot that is not level, whose insole is thicker below heel or ball than asked.

    A base form replaces the foot's own heights, so that then there is nothing to warn of.
    """
    tilt = contact_tilt(insole.foot) if insole.design.base is None else None
    if tilt is None or abs(tilt.angle_deg) <= LEVEL_DEG:
        return
    higher_mm = abs(tilt.heel_mm - tilt.ball_mm)
    angle_deg = rounded(abs(tilt.angle_deg), _SHOWN_DEG)
    if tilt.angle_deg > 0:
        yield DesignWarning(
            Message(
                "The foot is not level: the heel lies {higher_mm:.0f} mm higher than the ball "
                "({angle:g}°), and the insole is as much thicker below it; turn the foot toes up "
                "by {angle:g}°, or scan it again with heel and ball on one level.",
                higher_mm=higher_mm,
                angle=angle_deg,
            )
        )
    else:
        yield DesignWarning(
            Message(
                "The foot is not level: the ball lies {higher_mm:.0f} mm higher than the heel "
                "({angle:g}°), and the insole is as much thicker below it; turn the foot toes "
                "down by {angle:g}°, or scan it again with heel and ball on one level.",
                higher_mm=higher_mm,
                angle=angle_deg,
            )
        )
