"""Texts of the hints for setting up a sensor."""

from __future__ import annotations

from insole_core.geometry.side import Side
from insole_studio.acquisition.guidance import Hint, HintKind
from insole_studio.texts import fill, tr


def hint_text(hint: Hint) -> str:
    """Return the translated text of a hint."""
    if hint.side is not None:
        return _text_of_one_foot(hint.kind, hint.side)
    texts = {
        HintKind.NOTHING_MEASURED: tr("Almost nothing is measured; check distance and light"),
        HintKind.TOO_NEAR: tr("Too near: {found:.0f} mm, at least {wanted:.0f} mm is good"),
        HintKind.TOO_FAR: tr("Too far: {found:.0f} mm, at most {wanted:.0f} mm is good"),
        HintKind.NO_MARKERS: tr(
            "The markers are not recognised; bring the reference system into the picture"
        ),
        HintKind.MARKERS_HIDDEN: tr("{found:.0f} of {wanted:.0f} markers are hidden"),
        HintKind.NO_FOOT: tr("No foot between the markers"),
        HintKind.TOO_DARK: tr("Too dark; add light"),
        HintKind.TOO_BRIGHT: tr("Too bright; turn strong lights away"),
        HintKind.MOVING: tr("Something moves; hold the foot still"),
    }
    return fill(texts[hint.kind], found=hint.found, wanted=hint.wanted)


def _text_of_one_foot(kind: HintKind, side: Side) -> str:
    left = side is Side.LEFT
    if kind is HintKind.FOOT_MISSING:
        return tr("No left foot in its place") if left else tr("No right foot in its place")
    return (
        tr("The left foot is partly hidden by the right one; move the sensor or part the feet")
        if left
        else tr("The right foot is partly hidden by the left one; move the sensor or part the feet")
    )
