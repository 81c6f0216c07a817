"""Conversion between case.json and `CaseRecord` (docs/formats/case.md)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from insole_core.cases.case_record import (
    Annotations,
    CaseRecord,
    FootRecord,
    Found,
    KeyPoint,
    Patient,
    ReferencePlane,
    Variant,
)
from insole_core.cases.order_note import OrderNote, note_from_json, note_to_json
from insole_core.cases.plantar_json import plantar_from_json, plantar_to_json
from insole_core.cases.scan_source import NOTHING_SAID, ScanSource, choice_from_json, choice_to_json
from insole_core.errors import DesignError, InputError
from insole_core.foot.foot import Foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import is_rotation
from insole_core.imprints.form import Form
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_json import design_from_json, design_to_json
from insole_core.insole.prescription.template import Template, template_from_json, template_to_json
from insole_core.json_object import JsonObject
from insole_core.recording.capture_place import place_from_json, place_to_json
from insole_core.recording.session import WEIGHT_BEARING

FORMAT, VERSION = "insole-case", 2
_MOST_MM, _MOST_SOURCE_MM = 1e4, 1e9


def case_to_json(record: CaseRecord) -> dict[str, Any]:
    """Return everything but the surfaces as plain values for `json.dump`."""
    content: dict[str, Any] = {
        "format": FORMAT,
        "version": VERSION,
        "patient": vars(record.patient).copy(),
        "feet": [foot_to_json(foot) for foot in record.feet],
    }
    if record.at_hand is not None:
        content["at_hand"] = str(record.at_hand)
    if record.order != OrderNote():
        content["order"] = note_to_json(record.order)
    return content


def case_from_json(case: JsonObject, mesh_of: Callable[[Side], TriangleMesh]) -> CaseRecord:
    """Build a case from its JSON form and the surfaces of its feet.

    Parameters
    ----------
    case
        The root object of case.json, in the newest version.
    mesh_of
        Returns the surface of a side, mm, insole frame.

    Raises
    ------
    InputError
        Names the file and the key of the first violation.
    """
    patient = _patient(case.object("patient"))
    feet = [foot_from_json(foot, mesh_of) for foot in case.objects("feet")]
    sides = [foot.side for foot in feet]
    if len(set(sides)) < len(sides):
        raise case.fail("feet", "has two feet of the same side")
    order = note_from_json(case.object("order")) if case.has("order") else OrderNote()
    record = CaseRecord(patient, order=order)
    for foot in feet:
        record = record.with_foot(foot)
    if not feet:
        return record
    return record.at(case.choice("at_hand", sides))


def foot_to_json(record: FootRecord) -> dict[str, Any]:
    """Return a foot and its prescriptions without the surface, as plain values."""
    foot = record.foot
    content: dict[str, Any] = {
        "side": str(foot.side),
        "length_mm": foot.length_mm,
        "source2insole": foot.source2insole.tolist(),
        "notes": list(foot.notes),
        "source": _source_to_json(record.source),
        "annotations": _annotations_to_json(record.annotations),
        "variants": [
            {"name": variant.name, "design": design_to_json(variant.design)}
            for variant in record.variants
        ],
        "chosen": record.chosen,
    }
    if record.earlier is not None:
        content["earlier"] = template_to_json(record.earlier)
    return content | plantar_to_json(record.plantar)


def _annotations_to_json(annotations: Annotations) -> dict[str, Any]:
    content: dict[str, Any] = {
        "key_points": [
            {"name": point.name, "position_mm": list(point.position_mm), **_found_to_json(point)}
            for point in annotations.key_points
        ]
    }
    if annotations.plane is not None:
        plane = annotations.plane
        content["plane"] = {
            "origin_mm": list(plane.origin_mm),
            "pitch_deg": plane.pitch_deg,
            "roll_deg": plane.roll_deg,
        }
    return content


def _found_to_json(point: KeyPoint) -> dict[str, Any]:
    return {} if point.found is None else {"found": vars(point.found).copy()}


def foot_from_json(foot: JsonObject, mesh_of: Callable[[Side], TriangleMesh]) -> FootRecord:
    """Build a foot from its JSON form and its surface; the inverse of `foot_to_json`.

    Raises
    ------
    InputError
        Names the file and the key of the first violation.
    """
    side = foot.choice("side", list(Side))
    variants = tuple(_variant(variant, side) for variant in foot.objects("variants"))
    names = [variant.name for variant in variants]
    if not names:
        raise foot.fail("variants", "must hold at least one prescription")
    if len(set(names)) < len(names):
        raise foot.fail("variants", "have the same name twice")
    source = source_from_json(foot.object("source"))
    return FootRecord(
        foot=_foot(foot, side, source, mesh_of),
        source=source,
        variants=variants,
        chosen=foot.choice("chosen", names),
        annotations=_annotations(foot.object("annotations")),
        earlier=_earlier(foot, side),
        plantar=plantar_from_json(foot),
    )


def _foot(
    foot: JsonObject, side: Side, source: ScanSource, mesh_of: Callable[[Side], TriangleMesh]
) -> Foot:
    matrix = np.array(foot.matrix("source2insole", 4))
    is_near = np.abs(matrix).max() < _MOST_SOURCE_MM
    if not (is_near and is_rotation(matrix[:3, :3]) and np.array_equal(matrix[3], [0, 0, 0, 1])):
        raise foot.fail("source2insole", "is no rigid transform")
    return Foot(
        side=side,
        mesh=mesh_of(side),
        source2insole=matrix,
        length_mm=foot.number("length_mm", 50, 500),
        notes=tuple(foot.texts("notes")),
        form=source.form,
        mirrored=source.mirrored,
        scanned_on=source.scanned_on,
    )


def _variant(variant: JsonObject, side: Side) -> Variant:
    try:
        design = design_from_json(variant.value("design"))
    except DesignError as error:
        raise InputError(
            "{file}: {place}design: {reason}",
            file=variant.file,
            place=variant.place,
            reason=str(error),
        ) from error
    return Variant(variant.text("name"), _of_side(variant, design, side))


def _earlier(foot: JsonObject, side: Side) -> Template | None:
    if not foot.has("earlier"):
        return None
    template = template_from_json(foot.object("earlier"))
    _of_side(foot, template.design, side)
    return template


def _of_side(place: JsonObject, design: InsoleDesign, side: Side) -> InsoleDesign:
    if design.side is not side:
        raise InputError(
            "{file}: the design is for a {side} foot and the foot is a {foot_side} one; restore "
            "the file from a backup.",
            file=place.file,
            side=design.side,
            foot_side=side,
        )
    return design


def _patient(patient: JsonObject) -> Patient:
    keys = ["name", "born", "visit", "notes"]
    keys += ["pseudonym"] * patient.has("pseudonym")
    return Patient(**{key: patient.text(key, empty=True) for key in keys})


def _found(point: JsonObject) -> Found | None:
    if not point.has("found"):
        return None
    found = point.object("found")
    has_deviation = found.has("deviation_mm") and found.values["deviation_mm"] is not None
    return Found(
        found.number("confidence", 0, 1),
        found.number("deviation_mm", 0, _MOST_MM) if has_deviation else None,
        found.flag("is_coarse"),
    )


def _annotations(annotations: JsonObject) -> Annotations:
    points = tuple(
        KeyPoint(point.text("name"), point.triple("position_mm", _MOST_MM), _found(point))
        for point in annotations.objects("key_points")
    )
    names = [point.name for point in points]
    if len(set(names)) < len(names):
        raise annotations.fail("key_points", "name the same point twice")
    if not annotations.has("plane"):
        return Annotations(points)
    plane = annotations.object("plane")
    pitch, roll = plane.number("pitch_deg", -90, 90), plane.number("roll_deg", -90, 90)
    return Annotations(points, ReferencePlane(plane.triple("origin_mm", _MOST_MM), pitch, roll))


def source_from_json(source: JsonObject) -> ScanSource:
    """Read what a foot was made from.

    Raises
    ------
    InputError
        Names the file and the key of the first violation.
    """
    return ScanSource(
        source.choice("kind", ["session", "mesh"]),
        source.path_text("path"),
        source.text("sha256"),
        source.text("recorded_at", empty=True),
        source.choice("form", list(Form)) if source.has("form") else Form.FOOT,
        choice_from_json(source.object("choice")) if source.has("choice") else NOTHING_SAID,
        source.flag("mirrored") if source.has("mirrored") else False,
        source.date("scanned_on")[:10] if source.has("scanned_on") else "",
        place_from_json(source.object("place")) if source.has("place") else None,
        source.choice("weight_bearing", WEIGHT_BEARING)
        if source.has("weight_bearing")
        else WEIGHT_BEARING[0],
    )


def _source_to_json(source: ScanSource) -> dict[str, Any]:
    content = vars(source).copy()
    if source.form is Form.FOOT:
        del content["form"]
    content["choice"] = choice_to_json(source.choice)
    if not content["choice"]:
        del content["choice"]
    content["place"] = None if source.place is None else place_to_json(source.place)
    if source.weight_bearing == WEIGHT_BEARING[0]:
        del content["weight_bearing"]
    for key in ("mirrored", "scanned_on", "place"):
        if not content[key]:
            del content[key]
    return content
