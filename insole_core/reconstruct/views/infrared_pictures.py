"""The infrared pictures of a view, averaged, or why they cannot be used."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from insole_core.errors import InputError
from insole_core.messages import Message
from insole_core.reconstruct.fusion.infrared_evidence import InfraredView
from insole_core.reconstruct.fusion.infrared_surface import LEAST_SHARE
from insole_core.recording.session import View

_GREATEST = 1023
_SATURATED_SHARE = 0.02
_BLACK = 20
"""Number (of 1023) that one pixel in a hundred exceeds, also where the foot fills little."""
_TOLD_SHARE = 0.9


def infrared_view(view: View) -> InfraredView | None:
    """Average the infrared pictures of a view.

    Returns
    -------
    InfraredView or None
        None where the view was recorded without, or the session says why not.

    Raises
    ------
    InputError
        When they are black or saturated.
    """
    dots = view.dots
    if dots is None or dots.pictures is None or dots.reference is None:
        return None
    total = np.zeros((view.sensor.depth_camera.height, view.sensor.depth_camera.width), np.float64)
    for index in range(dots.pictures.count):
        total += dots.pictures.read(index)
    mean = total / dots.pictures.count
    if (mean >= _GREATEST).mean() > _SATURATED_SHARE:
        raise InputError(
            "its infrared pictures are saturated; lower their brightness, or keep sunlight off the "
            "foot"
        )
    if np.percentile(mean, 99) < _BLACK:
        raise InputError("its infrared pictures are black; see that the emitter is on")
    return InfraredView(mean.astype(np.float32), dots.reference)


def infrared_warnings(faults: Mapping[str, str], shares: Mapping[str, float]) -> list[str]:
    """Tell where infrared pictures were not used, or not trusted on all of the foot.

    Parameters
    ----------
    faults
        Why the pictures of a view could not be used, by its name.
    shares
        As of `by_infrared`.

    Returns
    -------
    list of str
        A sentence each.
    """
    told: list[str] = [
        Message(
            "View {view}: {fault}; the sensor's own depth was used.",
            view=name,
            fault=fault.removesuffix("."),
        )
        for name, fault in faults.items()
    ]
    for name, share in shares.items():
        if share < LEAST_SHARE:
            told.append(
                Message(
                    "View {view}: its infrared pictures show the pattern on {share:.0%} of the "
                    "foot only, so they are of another moment, pose or sensor, or the pattern has "
                    "drifted; the sensor's own depth was used.",
                    view=name,
                    share=share,
                )
            )
        elif share < _TOLD_SHARE:
            told.append(
                Message(
                    "View {view}: its infrared pictures were trusted on {share:.0%} of the foot; "
                    "on the rest the sensor's own depth was used.",
                    view=name,
                    share=share,
                )
            )
    return told
