"""Conversion between manifest.json and `Manifest`."""

from __future__ import annotations

import re
from typing import Any

from insole_core.geometry.side import BOTH, Side, Sides
from insole_core.json_object import JsonObject
from insole_core.recording.box import Box
from insole_core.recording.session import (
    WEIGHT_BEARING,
    CaptureCondition,
    FootPlace,
    Manifest,
    Marker,
    ReferenceSystem,
)

FORMAT = "insole-session"
VERSION = 3
"""Of a session with a sensor that delivers millimetres, of one foot or both."""
_ONE_FOOT, _BOTH_FEET = 1, 2
"""Of sessions of Kinects alone."""
_KNOWN = {
    "format", "version", "recorded_at", "side", "reference_frame", "views",
    "volume_of_interest_mm", "capture_condition",
}  # fmt: skip
MOST_MM = 10_000.0
"""No sensor sees farther; larger numbers are mistakes, and overflow."""
MOST_MARKERS = 100
"""Naming the markers in a picture takes long with more of them."""
_VIEW_NAME = re.compile(r"[a-z0-9_]{1,32}")


def parse_manifest(file: str, text: bytes) -> Manifest:
    """Read a manifest.

    Parameters
    ----------
    file
        Name of the file, for messages.

    Raises
    ------
    InputError
        Names the file and the key of the first violation.
    """
    root = JsonObject.parse(file, text)
    version = root.check_format(FORMAT, VERSION)
    side = _captured(root, version)
    frame = root.object("reference_frame")
    system = parse_reference_system(frame)
    _check_feet(root, system, version, side)
    return Manifest(
        recorded_at=root.date("recorded_at"),
        side=side,
        reference_system=system,
        views=_view_names(root),
        volume_of_interest=parse_box(root) if root.has("volume_of_interest_mm") else None,
        capture_condition=_condition(root) if root.has("capture_condition") else None,
        metric=version == VERSION,
        extra={key: value for key, value in root.values.items() if key not in _KNOWN},
    )


def manifest_json(manifest: Manifest) -> dict[str, Any]:
    """Return the JSON form of a manifest."""
    of_kinects = _BOTH_FEET if manifest.side == BOTH else _ONE_FOOT
    values: dict[str, Any] = {
        "format": FORMAT,
        "version": VERSION if manifest.metric else of_kinects,
        "recorded_at": manifest.recorded_at,
        "side": str(manifest.side),
        "reference_frame": reference_system_json(manifest.reference_system),
        "views": list(manifest.views),
    }
    if (box := manifest.volume_of_interest) is not None:
        values["volume_of_interest_mm"] = box_json(box)
    if (condition := manifest.capture_condition) is not None:
        values["capture_condition"] = {
            "weight_bearing": condition.weight_bearing,
            "held": condition.held,
            "notes": condition.notes,
        }
    return {**values, **manifest.extra}


def parse_reference_system(frame: JsonObject) -> ReferenceSystem:
    """Read a reference system, from a manifest or from a file of its own.

    Raises
    ------
    InputError
        Names the file and the key of the first violation.
    """
    markers = tuple(
        Marker(item.text("id"), item.triple("position_mm", MOST_MM), item.text("face"))
        for item in frame.objects("markers")
    )
    if len({marker.id for marker in markers}) < len(markers):
        raise frame.fail("markers", "names the same marker id twice")
    if len(markers) > MOST_MARKERS:
        raise frame.fail(
            "markers",
            "has {count} markers, but a reference system has at most {most}",
            count=len(markers),
            most=MOST_MARKERS,
        )
    if not markers:
        raise frame.fail("markers", "is empty, but a reference system has at least 4 markers")
    feet = _feet(frame.object("feet")) if frame.has("feet") else ()
    return ReferenceSystem(frame.text("name"), markers, feet)


def reference_system_json(system: ReferenceSystem) -> dict[str, Any]:
    """Return the JSON form of a reference system."""
    values: dict[str, Any] = {
        "name": system.name,
        "markers": [
            {"id": m.id, "position_mm": list(m.position_mm), "face": m.face} for m in system.markers
        ],
    }
    if system.feet:
        values["feet"] = {
            place.side.value: {
                "origin_mm": list(place.origin_mm),
                "volume_of_interest_mm": box_json(place.volume_of_interest),
            }
            for place in system.feet
        }
    return values


def _captured(root: JsonObject, version: int) -> Sides:
    """Read which foot was captured, of which there are as many as the version says."""
    said = root.value("side")
    if version == VERSION:
        return BOTH if said == BOTH else root.choice("side", list(Side))
    if version == _ONE_FOOT and said == BOTH:
        raise root.fail(
            "version",
            'is 1, that of a session of one foot, but "side" is "both"; make the version 2 if both '
            "feet were captured, or name the one that was",
        )
    if version == _ONE_FOOT:
        return root.choice("side", list(Side))
    if said in list(Side):
        raise root.fail(
            "version",
            'is 2, that of a session of both feet, but "side" is "{side}"; make the version 1 if '
            "this foot alone was captured",
            side=said,
        )
    root.choice("side", [BOTH])
    return BOTH


def _feet(feet: JsonObject) -> tuple[FootPlace, ...]:
    """Read the places of both feet, the left one first."""
    left, right = (_foot_place(feet.object(side.value), side) for side in Side)
    if left.origin_mm[0] >= right.origin_mm[0]:
        raise feet.fail(
            "left",
            "must lie at smaller x than the right foot, since +x points to the patient's right",
        )
    ends = [place.volume_of_interest.moved(place.origin_mm) for place in (left, right)]
    if ends[0].max_mm[0] > ends[1].min_mm[0]:
        raise feet.fail(
            "left",
            "has a volume that reaches into that of the right foot; make the volumes narrower",
        )
    return left, right


def _foot_place(place: JsonObject, side: Side) -> FootPlace:
    return FootPlace(side, place.triple("origin_mm", MOST_MM), parse_box(place))


def _check_feet(root: JsonObject, system: ReferenceSystem, version: int, side: Sides) -> None:
    """Check that there is a place for each captured foot, and that the volume is said once."""
    if version == VERSION and side != BOTH and system.feet:
        raise root.fail(
            "side",
            'is "{side}", but the reference system "{system}" is for both feet; make it "both", '
            "or name the system for one foot that was used",
            side=side,
            system=system.name,
        )
    if version == _ONE_FOOT and system.feet:
        raise root.fail(
            "version",
            'is 1, that of a session of one foot, but the reference system "{system}" is for both '
            'feet; make it 2, and "side" "both"',
            system=system.name,
        )
    if side != BOTH:
        return
    if not system.feet:
        raise root.fail(
            "side",
            'is "both", but the reference system "{system}" is for one foot; name the foot that '
            "was captured, or the system for two feet that was used",
            system=system.name,
        )
    if root.has("volume_of_interest_mm"):
        raise root.fail(
            "volume_of_interest_mm",
            'is for a session of one foot; of both, each has its own in "reference_frame.feet"',
        )


def _view_names(root: JsonObject) -> tuple[str, ...]:
    names = root.items("views")
    for name in names:
        if not isinstance(name, str) or not _VIEW_NAME.fullmatch(name):
            raise root.fail(
                "views",
                "names {name!r}, but a view has 1 to 32 of the letters a-z, 0-9 and _",
                name=name,
            )
    if not names or len(set(names)) < len(names):
        raise root.fail("views", "must name at least one view, and none twice")
    return tuple(names)


def box_json(box: Box) -> dict[str, Any]:
    """Return the JSON form of a volume of interest."""
    return {"min": list(box.min_mm), "max": list(box.max_mm)}


def parse_box(root: JsonObject) -> Box:
    """Read ``volume_of_interest_mm`` of a root object.

    Raises
    ------
    InputError
        Names the file and the key of the first violation.
    """
    box = root.object("volume_of_interest_mm")
    low, high = box.triple("min", MOST_MM), box.triple("max", MOST_MM)
    if not all(a < b for a, b in zip(low, high, strict=True)):
        raise root.fail("volume_of_interest_mm", "must have min below max in x, y and z")
    return Box(low, high)


def _condition(root: JsonObject) -> CaptureCondition:
    condition = root.object("capture_condition")
    notes = condition.text("notes", empty=True) if condition.has("notes") else ""
    return CaptureCondition(
        condition.choice("weight_bearing", WEIGHT_BEARING),
        condition.flag("held") if condition.has("held") else False,
        notes,
    )
