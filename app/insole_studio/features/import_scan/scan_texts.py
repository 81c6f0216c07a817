"""The texts with which a scan is asked about."""

from __future__ import annotations

from insole_core.foot.foot_candidate import FootCandidate, FoundFoot
from insole_core.geometry.side import Side
from insole_core.imprints.form import Form
from insole_studio.texts import fill, tr

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


def candidate_text(candidate: FootCandidate) -> str:
    """Describe one way in which a scan can be a foot."""
    length = fill(tr("{length_mm:.0f} mm long"), length_mm=candidate.length_mm)
    parts = [length]
    if candidate.covered < 1:
        parts.append(tr("toes missing"))
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
    return f"{side}, {candidate_text(chosen)}"


def foot_text(foot: FoundFoot, candidate: FootCandidate | None) -> str:
    """Describe one of several feet of a scan."""
    shown = candidate or foot.candidates[0]
    side = tr("Left or right foot") if candidate is None else side_text(shown.side)
    return f"{side}, {candidate_text(shown)}"


def form_options() -> list[tuple[str, str]]:
    """Return the forms of a scan, with the first for what the shape tells."""
    return [
        ("", tr("As the shape tells")),
        (Form.FOOT.value, tr("A foot")),
        (Form.IMPRINT.value, tr("A foam box or another imprint")),
        (Form.CAST.value, tr("A plaster cast, taken under weight")),
        (Form.UNLOADED_CAST.value, tr("A plaster cast, taken without weight")),
    ]
