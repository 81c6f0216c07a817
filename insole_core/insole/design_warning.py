"""A warning about an insole that can be built but is unusual, or made otherwise than asked for."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.insole.fields import Place
from insole_core.messages import Message


@dataclass(frozen=True)
class DesignWarning:
    """A property of an insole that can be built but is unusual.

    Parameters
    ----------
    correction_id
        The correction that causes it; empty if the insole as a whole does.
    place_mm
        Position to look at, insole frame.
    """

    sentence: Message
    correction_id: str = ""
    place_mm: Place | None = None
