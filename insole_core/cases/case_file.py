"""The case file: one zip archive with everything that a case holds (docs/formats/case.md).

Patient files are read strictly: what is not understood is refused, never guessed.
"""

from __future__ import annotations

import io
import json
import zipfile
import zlib
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from insole_core.cases.record import (
    Annotations,
    CaseRecord,
    KeyPoint,
    Patient,
    Point,
    ReferencePlane,
    Source,
)
from insole_core.errors import DesignError, InputError
from insole_core.export.atomic import replacing_file
from insole_core.foot.foot import Foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import is_rotation
from insole_core.insole.design import InsoleDesign
from insole_core.insole.design_json import design_from_json, design_to_json
from insole_core.json_object import JsonObject

FORMAT, VERSION = "insole-case", 1
CASE_NAME, FOOT_NAME = "case.json", "foot.npz"
MAX_PART_BYTES = 512 * 2**20
_WHEN = (1980, 1, 1, 0, 0, 0)


def write_case(record: CaseRecord, path: Path) -> None:
    """Write a case as a whole or not at all.

    Raises
    ------
    OutputError
        When the place cannot be written; what stood there before is untouched.
    """
    with replacing_file(path) as beside, zipfile.ZipFile(beside, "w") as archive:
        text = json.dumps(_case_to_json(record), indent=1, ensure_ascii=False)
        _add(archive, CASE_NAME, text.encode("utf-8"))
        if record.foot is not None:
            _add(archive, FOOT_NAME, _pack_mesh(record.foot.mesh))


def read_case(path: Path) -> CaseRecord:
    """Read a case.

    Raises
    ------
    InputError
        When the file is no case, is damaged, or comes from a newer version.
    """
    parts = _read_parts(path)
    if CASE_NAME not in parts:
        raise InputError(f"{path} holds no {CASE_NAME}, so it is no case; choose an .insole file.")
    case = JsonObject.parse(f"{path}: {CASE_NAME}", parts[CASE_NAME])
    _check_version(case)
    record = CaseRecord(
        patient=_patient(case.object("patient")),
        annotations=_annotations(case.object("annotations")),
    )
    if not case.has("foot"):
        return record
    return replace(
        record,
        source=_source(case.object("source")),
        foot=(foot := _foot(case.object("foot"), parts, path)),
        design=_design(case, foot.side),
    )


def _case_to_json(record: CaseRecord) -> dict[str, Any]:
    content: dict[str, Any] = {
        "format": FORMAT,
        "version": VERSION,
        "patient": vars(record.patient).copy(),
        "annotations": _annotations_to_json(record.annotations),
    }
    if record.foot is not None and record.source is not None and record.design is not None:
        content["source"] = vars(record.source).copy()
        content["foot"] = {
            "side": str(record.foot.side),
            "length_mm": record.foot.length_mm,
            "source2insole": record.foot.source2insole.tolist(),
            "notes": list(record.foot.notes),
        }
        content["design"] = design_to_json(record.design)
    return content


def _annotations_to_json(annotations: Annotations) -> dict[str, Any]:
    content: dict[str, Any] = {
        "key_points": [
            {"name": point.name, "position_mm": list(point.position_mm)}
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


def _check_version(case: JsonObject) -> None:
    if case.values.get("format") != FORMAT:
        raise case.fail("format", f'must be "{FORMAT}", so this is no case')
    version = case.integer("version", 1, 10**6)
    if version > VERSION:
        raise InputError(
            f"{case.file} is of version {version}, and this program reads up to {VERSION}; "
            "open it with a newer Insole Studio."
        )


def _patient(patient: JsonObject) -> Patient:
    texts = {}
    for key in ("name", "born", "visit", "notes"):
        value = patient.value(key)
        if not isinstance(value, str):
            raise patient.fail(key, "must be a text")
        texts[key] = value
    return Patient(**texts)


def _annotations(annotations: JsonObject) -> Annotations:
    points = tuple(
        KeyPoint(point.text("name"), _point(point, "position_mm"))
        for point in annotations.objects("key_points")
    )
    names = [point.name for point in points]
    if len(set(names)) < len(names):
        raise annotations.fail("key_points", "name the same point twice")
    if not annotations.has("plane"):
        return Annotations(points)
    plane = annotations.object("plane")
    pitch, roll = plane.number("pitch_deg", -90, 90), plane.number("roll_deg", -90, 90)
    return Annotations(points, ReferencePlane(_point(plane, "origin_mm"), pitch, roll))


def _design(case: JsonObject, side: Side) -> InsoleDesign:
    try:
        design = design_from_json(case.value("design"))
    except DesignError as error:
        raise InputError(f"{case.file}: design: {error}") from error
    if design.side is not side:
        raise InputError(
            f"{case.file}: the design is for a {design.side} foot and the foot is a {side} one; "
            "restore the file from a backup."
        )
    return design


def _point(values: JsonObject, key: str) -> Point:
    x, y, z = values.numbers(key, 3)
    return x, y, z


def _source(source: JsonObject) -> Source:
    recorded_at = source.value("recorded_at")
    if not isinstance(recorded_at, str):
        raise source.fail("recorded_at", "must be a text")
    kind = source.choice("kind", ["session", "mesh"])
    return Source(kind, source.text("path"), source.text("sha256"), recorded_at)


def _foot(foot: JsonObject, parts: dict[str, bytes], path: Path) -> Foot:
    if FOOT_NAME not in parts:
        raise InputError(f"{path} has lost its {FOOT_NAME}; restore the file from a backup.")
    rows = foot.items("source2insole")
    if len(rows) != 4:
        raise foot.fail("source2insole", "must have four rows")
    numbered = JsonObject(foot.file, {f"row {i}": row for i, row in enumerate(rows)}, foot.place)
    matrix = np.array([numbered.numbers(key, 4) for key in numbered.values])
    if not is_rotation(matrix[:3, :3]) or not np.array_equal(matrix[3], [0, 0, 0, 1]):
        raise foot.fail("source2insole", "is no rigid transform")
    return Foot(
        side=Side(foot.choice("side", [side.value for side in Side])),
        mesh=_unpack_mesh(parts[FOOT_NAME], path),
        source2insole=matrix,
        length_mm=foot.number("length_mm", 50, 500),
        notes=tuple(str(note) for note in foot.items("notes")),
    )


def _pack_mesh(mesh: TriangleMesh) -> bytes:
    arrays = {"vertices": mesh.vertices, "triangles": mesh.triangles}
    if mesh.colors is not None:
        arrays["colors"] = mesh.colors
    packed = io.BytesIO()
    np.savez_compressed(packed, **arrays)  # type: ignore[arg-type]
    return packed.getvalue()


def _unpack_mesh(packed: bytes, path: Path) -> TriangleMesh:
    try:
        with np.load(io.BytesIO(packed), allow_pickle=False) as arrays:
            mesh = TriangleMesh(arrays["vertices"], arrays["triangles"], arrays.get("colors"))
    except (ValueError, KeyError, OSError, EOFError, zipfile.BadZipFile, zlib.error) as error:
        raise _damaged(path, FOOT_NAME) from error
    if not _is_sound(mesh):
        raise _damaged(path, FOOT_NAME)
    return mesh


def _is_sound(mesh: TriangleMesh) -> bool:
    vertices, triangles, colors = mesh.vertices, mesh.triangles, mesh.colors
    kinds = vertices.dtype == np.float64 and triangles.dtype == np.int32
    shapes = vertices.ndim == triangles.ndim == 2 and vertices.shape[1] == triangles.shape[1] == 3
    if not (kinds and shapes and len(triangles) and np.isfinite(vertices).all()):
        return False
    if colors is not None and (colors.dtype != np.uint8 or colors.shape != vertices.shape):
        return False
    return bool(triangles.min() >= 0 and triangles.max() < len(vertices))


def _read_parts(path: Path) -> dict[str, bytes]:
    try:
        with zipfile.ZipFile(path) as archive:
            known = [name for name in (CASE_NAME, FOOT_NAME) if name in archive.namelist()]
            return {name: _read_part(archive, name, path) for name in known}
    except FileNotFoundError as error:
        raise InputError(f"{path} does not exist; check the name.") from error
    except PermissionError as error:
        raise InputError(f"{path} may not be read; ask for permission.") from error
    except (zipfile.BadZipFile, OSError, EOFError, zlib.error, NotImplementedError) as error:
        raise InputError(
            f"{path} is no readable case file; it may be damaged or cut off, so restore it from a "
            "backup."
        ) from error


def _read_part(archive: zipfile.ZipFile, name: str, path: Path) -> bytes:
    # The archive's own word on sizes is not trusted: never inflate past the limit.
    with archive.open(name) as file:
        content = file.read(MAX_PART_BYTES + 1)
    if len(content) > MAX_PART_BYTES:
        raise InputError(f"{path}: {name} is far larger than a case has; do not use this file.")
    return content


def _damaged(path: Path, name: str) -> InputError:
    return InputError(f"{path}: {name} is damaged; restore the file from a backup.")


def _add(archive: zipfile.ZipFile, name: str, content: bytes) -> None:
    # A fixed date: equal cases are equal files.
    entry = zipfile.ZipInfo(name, _WHEN)
    entry.compress_type = zipfile.ZIP_DEFLATED if name == CASE_NAME else zipfile.ZIP_STORED
    archive.writestr(entry, content)
