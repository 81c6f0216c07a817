"""The texts with which a scan is asked about."""

from __future__ import annotations

from insole_core.foot.foot_candidate import FootCandidate, FoundFoot
from insole_core.formats.units import Unit, UnitReading
from insole_core.geometry.side import Side
from insole_core.imprints.form import Form
from insole_core.workflows.scan_doubts import foot_text as foot_text_in
from insole_studio.texts import fill, tr, translate_core_message

CLICKS = ("heel", "toe", "sole")
"""The points that tell a pose, in the order in which they are clicked."""


def click_sentence(clicked: int) -> str:
    """Say which point is to be clicked next."""
    sentences = (
        tr("Click the end of the heel."),
        tr("Click the tip of a toe."),
        tr("Click the sole, under the ball of the foot."),
    )
    return sentences[clicked]


def click_name(clicked: int) -> str:
    """Return the name of a clicked point."""
    return (tr("Heel"), tr("Toes"), tr("Sole"))[clicked]


def side_text(side: Side) -> str:
    """Name a foot by its side."""
    return tr("Left foot") if side is Side.LEFT else tr("Right foot")


def unit_text(reading: UnitReading) -> str:
    """Say what the scan is in one unit."""
    unit = dict(unit_options())[reading.unit]
    return f"{unit}: {translate_core_message(foot_text_in(reading))}"


def candidate_text(candidate: FootCandidate) -> str:
    """Describe one way in which a scan can be a foot."""
    parts = [translate_core_message(candidate.length_text)]
    if candidate.leg is not None:
        parts.append(fill(tr("leg cut off at {mm:.0f} mm"), mm=candidate.leg.height_mm))
    return ", ".join(parts)


def finding_text(foot: FoundFoot, chosen: FootCandidate | None) -> str:
    """Say what the scan is taken for, and by what."""
    if chosen is None:
        return tr("Choose which foot it is.")
    if chosen.side is foot.told_side:
        side = {
            Side.LEFT: tr("A left foot by its shape"),
            Side.RIGHT: tr("A right foot by its shape"),
        }[chosen.side]
    else:
        side = side_text(chosen.side)
    return _described(side, foot, chosen)


def _described(side: str, foot: FoundFoot, candidate: FootCandidate) -> str:
    if foot.unit_readings:  # a length that is a guess is none
        return side
    return f"{side}, {candidate_text(candidate)}"


def foot_text(foot: FoundFoot, candidate: FootCandidate | None) -> str:
    """Describe one of several feet of a scan."""
    shown = candidate or foot.candidates[0]
    side = tr("Left or right foot") if candidate is None else side_text(shown.side)
    return _described(side, foot, shown)


def unit_options() -> list[tuple[Unit, str]]:
    """Return the units in which a file may be."""
    return [
        ("mm", tr("Millimetres")),
        ("cm", tr("Centimetres")),
        ("m", tr("Metres")),
        ("inch", tr("Inches")),
    ]


def form_options() -> list[tuple[str, str]]:
    """Return the forms of a scan, with the first for what the shape tells."""
    return [
        ("", tr("As the shape tells")),
        (Form.FOOT.value, tr("A foot")),
        (Form.IMPRINT.value, tr("A foam box or another imprint")),
        (Form.CAST.value, tr("A plaster cast, taken under weight")),
        (Form.UNLOADED_CAST.value, tr("A plaster cast, taken without weight")),
    ]
