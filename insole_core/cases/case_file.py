"""Reading and writing of case files: one zip archive for each case (docs/formats/case.md)."""

from __future__ import annotations

import json
import zipfile
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from insole_core.cases.case_json import FORMAT, VERSION, case_from_json, case_to_json
from insole_core.cases.case_record import FIRST_NAME, CaseRecord
from insole_core.cases.stored_mesh import MAX_PART_BYTES, pack_mesh, unpack_mesh
from insole_core.errors import InputError, unreadable
from insole_core.files.atomic import replacing_file
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.given_file import sha256_of
from insole_core.json_object import JsonObject
from insole_core.strict_json import MOST_BYTES
from insole_core.zip_archive import DamagedArchiveError, ZipArchive

_FOOT_NAME_1 = "foot.npz"
CASE_NAME = "case.json"
FOOT_NAMES = {side: f"{side}.npz" for side in Side}
MAX_CASE_BYTES = 3 * MAX_PART_BYTES
_PARTS = (CASE_NAME, _FOOT_NAME_1, *FOOT_NAMES.values())
_WHEN = (1980, 1, 1, 0, 0, 0)


def _as_version_2(case: JsonObject) -> JsonObject:
    """Convert the root object of a case from version 1 to version 2.

    Raises
    ------
    InputError
        When a part is missing.
    """
    content: dict[str, Any] = {"patient": case.value("patient"), "feet": []}
    annotations = case.value("annotations")
    if case.has("foot"):
        foot = case.object("foot")
        content["at_hand"] = foot.value("side")
        content["feet"] = [
            {
                **foot.values,
                "source": case.value("source"),
                "annotations": annotations,
                "variants": [{"name": FIRST_NAME, "design": case.value("design")}],
                "chosen": FIRST_NAME,
            }
        ]
    return JsonObject(case.file, content)


def write_case(
    record: CaseRecord, path: Path, packed: Mapping[Side, bytes] = MappingProxyType({})
) -> str:
    """Write a case atomically; equal cases give equal files.

    Parameters
    ----------
    packed
        Surfaces that `pack_mesh` has packed before, which takes seconds.

    Returns
    -------
    str
        SHA-256 of the file.

    Raises
    ------
    OutputError
        When the place cannot be written; a file that was there before is untouched.
    """
    with replacing_file(path) as beside:
        with zipfile.ZipFile(beside, "w") as archive:
            text = json.dumps(case_to_json(record), indent=1, ensure_ascii=False)
            _add(archive, CASE_NAME, text.encode("utf-8"))
            for foot in record.feet:
                surface = packed.get(foot.side) or pack_mesh(foot.foot.mesh)
                _add(archive, FOOT_NAMES[foot.side], surface)
        return sha256_of(beside, MAX_CASE_BYTES)


def read_case(path: Path) -> CaseRecord:
    """Read a case, of this or an older version of the format.

    Raises
    ------
    InputError
        When the file is not a case, is damaged, or comes from a newer version.
    """
    return read_case_and_digest(path)[0]


def read_case_and_digest(path: Path) -> tuple[CaseRecord, str]:
    """Read a case and the SHA-256 of its file, of the same moment.

    Raises
    ------
    InputError
        As for `read_case`.
    """
    parts, digest = _read_parts(path)
    return _case_of(parts, path), digest


def digest_of_case(path: Path) -> str:
    """Return the SHA-256 of a case file, to notice that it has changed; "" where there is none.

    Raises
    ------
    InputError
        When it cannot be read.
    """
    try:
        return sha256_of(path, MAX_CASE_BYTES)
    except FileNotFoundError:
        return ""
    except OSError as error:
        raise unreadable(path, error) from error


def _case_of(parts: dict[str, bytes], path: Path) -> CaseRecord:
    if CASE_NAME not in parts:
        raise InputError(
            "{path} holds no {file}, so it is no case; choose an .insole file.",
            path=path,
            file=CASE_NAME,
        )
    case = JsonObject.parse(f"{path}: {CASE_NAME}", parts[CASE_NAME])
    names = dict(FOOT_NAMES)
    if case.check_format(FORMAT, VERSION) < VERSION:
        case = _as_version_2(case)
        names = dict.fromkeys(Side, _FOOT_NAME_1)

    def mesh_of(side: Side) -> TriangleMesh:
        name = names[side]
        if name not in parts:
            raise InputError(
                "{path} has lost its {file}; restore the file from a backup.", path=path, file=name
            )
        try:
            return unpack_mesh(name, parts[name])
        except InputError as error:
            raise _damaged(path, name) from error

    return case_from_json(case, mesh_of)


def _read_parts(path: Path) -> tuple[dict[str, bytes], str]:
    try:
        # Before the content: what changes between is noticed on saving.
        digest = sha256_of(path, MAX_CASE_BYTES)
        archive = ZipArchive(str(path), path)
        known = [name for name in _PARTS if name in archive.names]
        return {name: archive.read(name, _most_bytes(name)) for name in known}, digest
    except FileNotFoundError as error:
        raise InputError("{path} does not exist; check the name.", path=path) from error
    except PermissionError as error:
        raise InputError("{path} may not be read; ask for permission.", path=path) from error
    except (DamagedArchiveError, OSError) as error:
        raise InputError(
            "{path} is no readable case file; it may be damaged or cut off, so restore it from a "
            "backup.",
            path=path,
        ) from error


def _most_bytes(name: str) -> int:
    return MOST_BYTES if name == CASE_NAME else MAX_PART_BYTES


def _damaged(path: Path, name: str) -> InputError:
    return InputError(
        "{path}: {file} is damaged; restore the file from a backup.", path=path, file=name
    )


def _add(archive: zipfile.ZipFile, name: str, content: bytes) -> None:
    # A fixed date, so that equal cases give equal files.
    entry = zipfile.ZipInfo(name, _WHEN)
    entry.compress_type = zipfile.ZIP_DEFLATED if name == CASE_NAME else zipfile.ZIP_STORED
    archive.writestr(entry, content)
