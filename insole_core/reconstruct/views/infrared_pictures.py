"""The infrared pictures of a view, averaged, or why they cannot be used."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from insole_core.errors import InputError
from insole_core.messages import Message, joined
from insole_core.reconstruct.fusion.infrared_evidence import InfraredView
from insole_core.reconstruct.fusion.infrared_surface import InfraredUse
from insole_core.reconstruct.views.infrared_pair import pair_of, pair_view
from insole_core.recording.session import View
from insole_core.sensing.infrared_reference import RAW_PER_PX, check_picture, on_depth_pixels

_TOLD_SHARE = 0.9
_TOLD_BRIGHT, _TOLD_NOISY = 0.13, 0.4
"""Of undisturbed views up to 0.05 is bright and 0.3 noisy; in sunlight 0.21 or more is bright."""
_BRIGHT = (
    "Bright light outshines the dots in the infrared pictures, so they were hardly trusted on part "
    "of the foot ({shares}), and the deviation stated there is larger; keep sunlight and lamps off "
    "the foot."
)
_NOISY = (
    "Noise covers the dots in the infrared pictures, so they were trusted less on part of the foot "
    "({shares}), and the deviation stated there is larger; see that emitter and lens are clean and "
    "the skin is dry and matt, and move the sensor nearer."
)
_MOVED = (
    "View {view}: the foot moved a little between its depth and its infrared pictures: depth "
    "changed by {moved:.2f} px. Hold the foot still, and take the view again."
)
_DRIFTED = (
    "View {view}: its infrared pictures lie {drift:.2f} px off the sensor's own depth, though "
    "nothing moved between the two, so the sensor's pattern of dots has drifted. Its own depth was "
    "taken for the distance of the whole; learn the pattern again by calibrate infrared."
)
_MOVED_OR_DRIFTED = (
    "View {view}: its infrared pictures lie {drift:.2f} px off the sensor's own depth, "
    "which was taken for the distance of the whole: the foot moved a little between "
    "the two, or the sensor has drifted. Take the view again; if it is told again, "
    "calibrate the sensor again, the pattern of a Kinect by calibrate infrared."
)
_MOVED_RAW = 0.4
"""Half a millimetre; without movement the noise of depth makes up to 0.25."""


def infrared_view(view: View) -> InfraredView | None:
    """Average the infrared pictures of a view: of its dots, or the pair of a stereo camera.

    Returns
    -------
    InfraredView or None
        None where the view was recorded without.

    Raises
    ------
    InputError
        When pictures or pattern cannot be used; as the end of a sentence on the view.
    """
    if (pair := pair_of(view)) is not None:
        return pair_view(view, pair)
    dots = view.dots
    if dots is None:
        return None
    if dots.fault:
        raise InputError(dots.fault)
    if dots.pictures is None or dots.reference is None:
        return None
    mean = dots.pictures.mean()
    check_picture(mean)
    placed = on_depth_pixels(mean, dots.shift_px)
    return InfraredView(placed.astype(np.float32), dots.reference, moved_raw=dots.moved_raw)


def unused_pictures(
    faults: Mapping[str, str], infrared: Mapping[str, InfraredUse]
) -> list[Message]:
    """Tell of each view whose infrared pictures were not used why.

    Parameters
    ----------
    faults
        Why the pictures of a view could not be compared, by its name.
    infrared
        As of `by_infrared`.

    Returns
    -------
    list of Message
        A sentence for each reason.
    """
    views: dict[str, list[str]] = {}
    for name in sorted(faults):
        views.setdefault(faults[name], []).append(name)
    told = [
        Message("View {view}: {warning}", view=names[0], warning=fault)
        if len(names) == 1
        else Message("Views {views}: {warning}", views=joined(names), warning=fault)
        for fault, names in views.items()
    ]
    told += [
        Message(
            "View {view}: its infrared pictures show the pattern on {share:.0%} of the foot only, "
            "so they are of another moment, pose or sensor, or the pattern has drifted.",
            view=name,
            share=use.share,
        )
        for name, use in infrared.items()
        if not use.used
    ]
    return told


def infrared_warnings(
    faults: Mapping[str, str], infrared: Mapping[str, InfraredUse]
) -> list[Message]:
    """Tell where infrared pictures were not used, or not trusted on all of the foot.

    Parameters
    ----------
    faults, infrared
        As of `unused_pictures`.

    Returns
    -------
    list of Message
        A sentence or two each.
    """
    told = [
        Message("{reason} The sensor's own depth was used.", reason=reason)
        for reason in unused_pictures(faults, infrared)
    ]
    told += [
        Message(
            "View {view}: its infrared pictures were trusted on {share:.0%} of the foot; on the "
            "rest the sensor's own depth was used.",
            view=name,
            share=use.share,
        )
        for name, use in infrared.items()
        if use.used and use.share < _TOLD_SHARE
    ]
    told += [
        Message(
            sentence,
            shares=joined(
                Message("{view} {share:.0%}", view=name, share=share)
                for name, share in shares.items()
            ),
        )
        for sentence, shares in doubted(infrared).items()
    ]
    told += [
        Message(
            sentence,
            view=name,
            drift=abs(use.drift_raw) / RAW_PER_PX,
            moved=(use.moved_raw or 0.0) / RAW_PER_PX,
        )
        for name, use in infrared.items()
        if use.used and (sentence := _why_off(use))
    ]
    return told


def doubted(infrared: Mapping[str, InfraredUse]) -> dict[str, dict[str, float]]:
    """Find the views whose pictures are disturbed enough to be told.

    Parameters
    ----------
    infrared
        As of `by_infrared`.

    Returns
    -------
    dict of dict of float
        On which share of the foot, by the sentence that tells it and the view's name.
    """
    found: dict[str, dict[str, float]] = {}
    for name, use in infrared.items():
        if use.used and (doubt := _doubt(use)):
            found.setdefault(doubt[0], {})[name] = doubt[1]
    return found


def _doubt(use: InfraredUse) -> tuple[str, float] | None:
    """Return what disturbs a picture, and on which share; bright light brings noise of its own."""
    if use.bright > _TOLD_BRIGHT:
        return _BRIGHT, use.bright
    if use.noisy > _TOLD_NOISY:
        return _NOISY, use.noisy
    return None


def _why_off(use: InfraredUse) -> str:
    """Return what tells that foot or pattern moved; empty when neither did."""
    if use.moved_raw is not None and use.moved_raw > _MOVED_RAW:
        return _MOVED
    if not use.has_drifted:
        return ""
    return _MOVED_OR_DRIFTED if use.moved_raw is None else _DRIFTED
