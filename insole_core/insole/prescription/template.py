"""A prescription without its patient, for other feet by their landmarks, or for the other foot."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from insole_core.errors import DesignError, InputError
from insole_core.foot.landmarks import Landmarks
from insole_core.geometry.side import Side
from insole_core.insole.elements.correction import reflected, with_places
from insole_core.insole.fields import Place
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_json import design_from_json, design_to_json
from insole_core.json_object import JsonObject

FORMAT, VERSION = "insole-template", 1
ANCHORS = ("heel_centre", "metatarsal_head_1", "metatarsal_head_5")
_LEAST_AREA_MM2 = 500.0


def mirrored(design: InsoleDesign) -> InsoleDesign:
    """Mirror a design in the plane x = 0; medial stays medial, ids stay the same.

    Mirroring twice returns the original, except that turns of 360 degrees are unwound.
    """
    return replace(
        design,
        side=design.side.other,
        corrections=tuple(correction.mirrored() for correction in design.corrections),
        outline=reflected(design.outline),
        shell=None if design.shell is None else reflected(design.shell),
    )


def moved(design: InsoleDesign, move: Callable[[Place], Place]) -> InsoleDesign:
    """Move all places of a design on the foot: of corrections, outline and trim line.

    Parameters
    ----------
    move
        Maps a place (x, y) in mm to another.
    """
    return replace(
        design,
        corrections=tuple(with_places(correction, move) for correction in design.corrections),
        outline=with_places(design.outline, move),
        shell=None if design.shell is None else with_places(design.shell, move),
    )


@dataclass(frozen=True)
class Template:
    """A named design and the positions (x, y) of `ANCHORS` on the foot that it was made for."""

    name: str
    design: InsoleDesign
    anchors_mm: tuple[Place, Place, Place]


def make_template(name: str, design: InsoleDesign, landmarks: Landmarks) -> Template:
    """Make a template of a design.

    Parameters
    ----------
    name
        For display.
    landmarks
        Of the design's foot, insole frame.

    Raises
    ------
    DesignError
        If the landmarks lie in an impossible order.
    """
    return Template(name, design, _anchors(design.side, landmarks))


def apply_template(template: Template, side: Side, landmarks: Landmarks) -> InsoleDesign:
    """Transfer a template's design to a foot; it is mirrored first for the other side.

    Parameters
    ----------
    landmarks
        Of the foot of this side, insole frame.

    Returns
    -------
    InsoleDesign
        All positions moved by the affine map of the anchors; sizes and heights unchanged.

    Raises
    ------
    DesignError
        If the landmarks of the foot lie in an impossible order.
    """
    design, anchors = template.design, np.array(template.anchors_mm)
    if design.side is not side:
        design, anchors = mirrored(design), anchors * [-1, 1]
    to = np.array(_anchors(side, landmarks))
    homogeneous = np.column_stack([anchors, np.ones(3)])
    own2other = np.linalg.solve(homogeneous, to)

    def at_landmarks(place: Place) -> Place:
        x, y = np.array([*place, 1.0]) @ own2other
        return float(x), float(y)

    return moved(design, at_landmarks)


def template_to_json(template: Template) -> dict[str, Any]:
    """Return a template as plain values for `json.dump`."""
    anchors = zip(ANCHORS, template.anchors_mm, strict=True)
    return {
        "format": FORMAT,
        "version": VERSION,
        "name": template.name,
        "anchors_mm": {name: list(place) for name, place in anchors},
        "design": design_to_json(template.design),
    }


def read_template(path: Path) -> Template:
    """Read a template file.

    Raises
    ------
    InputError
        Naming the file and what is wrong with it.
    """
    return template_from_json(JsonObject.read(path))


def template_from_json(content: JsonObject) -> Template:
    """Build a template from the contents of a file.

    Raises
    ------
    InputError
        Naming the file and what is wrong with it.
    """
    content.check_format(FORMAT, VERSION)
    anchors = content.object("anchors_mm")
    heel, first, fifth = (anchors.pair(name) for name in ANCHORS)
    try:
        design = design_from_json(content.value("design"))
        check_anchors(design.side, dict(zip(ANCHORS, (heel, first, fifth), strict=True)))
    except DesignError as error:
        raise InputError("{file}: {reason}", file=content.file, reason=str(error)) from error
    return Template(content.text("name"), design, (heel, first, fifth))


def write_template(template: Template, path: Path) -> None:
    """Write a template to a path, as a rule the temporary one of `replacing_file`."""
    path.write_text(
        json.dumps(template_to_json(template), indent=1) + "\n", encoding="utf-8", newline="\n"
    )


def check_anchors(side: Side, places: Mapping[str, Place]) -> None:
    """Check that heel, 1st and 5th metatarsal head lie as on a foot.

    Parameters
    ----------
    places
        Positions (x, y) in mm, insole frame, by the names in `ANCHORS`.

    Raises
    ------
    DesignError
        Naming the landmark that is misplaced.
    """
    heel, first, fifth = (np.array(places[name]) for name in ANCHORS)
    for name, head in (("1st", first), ("5th", fifth)):
        if head[1] <= heel[1]:
            raise DesignError(
                "The {head} metatarsal head lies behind the heel; put it in place.", head=name
            )
    if (first - fifth)[0] * side.medial_sign <= 0:
        raise DesignError(
            "The 1st metatarsal head lies lateral of the 5th on this {side} foot; exchange the "
            "two, or check the side.",
            side=side,
        )
    (ax, ay), (bx, by) = first - heel, fifth - heel
    if abs(ax * by - ay * bx) < _LEAST_AREA_MM2:
        raise DesignError("Heel, 1st and 5th head lie on one line; put them in place.")


def _anchors(side: Side, landmarks: Landmarks) -> tuple[Place, Place, Place]:
    places = {n: (float(landmarks[n].point[0]), float(landmarks[n].point[1])) for n in ANCHORS}
    check_anchors(side, places)
    heel, first, fifth = (places[name] for name in ANCHORS)
    return heel, first, fifth
