"""A finished part as the drawing of the job sheet shows it: its true outlines and sections."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Final

import numpy as np

from insole_core.errors import DesignError
from insole_core.export.insole_drawing import (
    DrawnInsole,
    Element,
    Section,
)
from insole_core.foot.landmarks import Landmarks
from insole_core.geometry.transforms import rigid
from insole_core.insole.elements import Correction
from insole_core.insole.prescription.prescription_lines import correction_lines, make_facts
from insole_core.messages import Translate
from insole_core.solids.checks import survey_heights
from insole_core.solids.order import Part
from insole_core.solids.silhouette import polygons_of
from insole_core.solids.simplification import to_manifold

if TYPE_CHECKING:
    import manifold3d

_XZY: Final = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, 1, 0, 0]])
"""Lays a plane across the foot level: x stays, z becomes y."""
_YZX: Final = np.array([[0.0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0]])
"""Lays the plane of the side views level."""
_POSTS: Final = {"rearfoot post": "C", "forefoot post": "A"}
"""Facts of the prescription, and the section that is in the middle of each post."""
_BESIDE_MM: Final = 1e-4
"""From a round place, where vertices may lie in the plane of a cut."""
_OFF_FRONT_MM: Final = 5.0
"""From the front of a piece that ends behind the heads of the metatarsals."""


def drawn_part(part: Part, translate: Translate = str) -> DrawnInsole | None:
    """Return a part for the drawing, standing on z = 0, with its posts and corrections numbered.

    Returns
    -------
    DrawnInsole or None
        None for a mesh that is not closed, which has no sections.
    """
    low = part.solid.bounds_mm[0]
    solid = part.solid.transformed(rigid(np.eye(3), np.array([0.0, 0.0, -low[2]])))
    try:
        body = to_manifold(solid)
    except DesignError:
        return None
    across, along = body.transform(_XZY), body.transform(_YZX)
    lengthwise = _section(along, "along the axis", 0.0)
    stations = _stations(part.landmarks, *lengthwise.ends_mm)
    sections = {letter: _section(across, *station) for letter, station in stations.items()}
    return DrawnInsole(
        side=part.side,
        bounds_mm=solid.bounds_mm,
        heights=survey_heights(solid),
        outline=polygons_of(body.project()),
        profile=polygons_of(along.project()),
        sections=sections,
        lengthwise=lengthwise,
        elements=_elements(part, sections, translate),
    )


def _stations(
    landmarks: Landmarks, back_mm: float, front_mm: float
) -> dict[str, tuple[str, float]]:
    """Return name and place of each section across.

    They lie at landmarks; in a piece that ends behind the heads, at its front instead of the ball.

    Parameters
    ----------
    back_mm, front_mm
        Of the piece, on the axis of the foot.
    """
    heads = (landmarks[name].point[1] for name in ("metatarsal_head_1", "metatarsal_head_5"))
    heel, ball = float(landmarks["heel_centre"].point[1]), float(np.mean([*heads]))
    front = ("ball", ball) if ball < front_mm else ("front edge", front_mm - _OFF_FRONT_MM)
    places = {"A": front, "B": ("arch", (heel + ball) / 2), "C": ("heel", heel)}
    return {
        letter: (name, float(np.round(np.clip(at, back_mm + 1, front_mm - 1))))
        for letter, (name, at) in places.items()
    }


def _section(body: manifold3d.Manifold, name: str, at_mm: float) -> Section:
    cut = body.slice(at_mm + _BESIDE_MM)
    return Section(name, at_mm, polygons_of(cut))


def _elements(
    part: Part, sections: Mapping[str, Section], translate: Translate
) -> tuple[Element, ...]:
    design = part.insole.design
    turn = -1.0 if part.order.kind == "positive" else 1.0
    facts = make_facts(design)
    listed: list[tuple[str, str, tuple[float, float] | None]] = [
        (name, translate(facts[name]), _middle(sections[letter]))
        for name, letter in _POSTS.items()
        if name in facts
    ]
    for line, correction in zip(
        correction_lines(design, part.landmarks), design.active, strict=True
    ):
        listed.append(("", translate(line), _centre(correction, turn)))
    return tuple(Element(number, *each) for number, each in enumerate(listed, 1))


def _middle(section: Section) -> tuple[float, float]:
    """Return the middle of a section across, x and y in the frame of the solid."""
    return sum(section.ends_mm) / 2, section.at_mm


def _centre(correction: Correction, turn: float) -> tuple[float, float] | None:
    """Return the centre of a correction that has one, in the frame of the solid."""
    centre = getattr(correction, "centre_mm", None)
    return None if centre is None else (turn * centre[0], centre[1])
