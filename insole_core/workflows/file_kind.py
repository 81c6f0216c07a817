"""Classify paths: case, session, or mesh."""

from __future__ import annotations

from pathlib import Path

from insole_core.errors import InputError
from insole_core.formats.file_formats import SCAN_SUFFIXES
from insole_core.messages import joined
from insole_core.recording.reader import is_session
from insole_core.scans.scan_folder import holds_scans

CASE_SUFFIX = ".insole"


def kind_of(path: Path) -> str:
    """Return "case", "manifest", "session" or "mesh", without reading all of it.

    Raises
    ------
    InputError
        When it is none of them.
    """
    if path.suffix.lower() == CASE_SUFFIX:
        return "case"
    if path.name == "manifest.json":
        return "manifest"
    if is_session(path):
        return "mesh" if holds_scans(path) else "session"
    if path.suffix.lower() in SCAN_SUFFIXES:
        return "mesh"
    raise InputError(
        "{path} is neither a case, a session nor a mesh; open a {case_suffix} file, the folder or "
        "zip archive of a session, or a {mesh_suffixes} file.",
        path=path,
        case_suffix=CASE_SUFFIX,
        mesh_suffixes=joined(SCAN_SUFFIXES),
    )
